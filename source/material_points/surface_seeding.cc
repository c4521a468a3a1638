/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>

#include <isochor/base/plain_message.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/seeding.h>
#include <isochor/material_points/surface_seeding.h>

#include <algorithm>
#include <numeric>

namespace isochor
{
  template <int dim>
  double
  measure(const FaceCorners<dim> &face)
  {
    if constexpr (dim == 2)
      return (face[1] - face[0]).norm();
    else
      return cross_product_3d(face[1] - face[0], face[2] - face[0]).norm() / 2;
  }



  template <int dim>
  Quadrature<dim - 1>
  surface_rule(const unsigned int n_points)
  {
    if constexpr (dim == 2)
      return QGauss<1>(n_points);
    else
      return material_point_rule<dim - 1>(
        n_points,
        "boundary points per face (<Boundary conditions/Boundary points per "
        "face>)");
  }



  namespace
  {
    template <int dim>
    class CoveredPart
    {
    public:
      using Inside = std::function<bool(const Point<dim> &)>;

      explicit CoveredPart(const Inside &inside)
        : inside(inside)
      {}

      std::vector<FaceCorners<dim>> pieces;

      /** Add the covered part of @p face; whole if that is all of it. */
      void
      add(const FaceCorners<dim> &face, const unsigned int n_halvings)
      {
        if (n_halvings == 0)
          {
            add_leaf(face);
            return;
          }
        const std::size_t n_before = pieces.size();
        const auto        parts    = halve(face);
        for (const auto &part : parts)
          add(part, n_halvings - 1);
        double sum = 0;
        for (std::size_t i = n_before; i < pieces.size(); ++i)
          sum += measure<dim>(pieces[i]);
        if (sum > (1 - 1e-12) * measure<dim>(face))
          {
            pieces.resize(n_before);
            pieces.push_back(face);
          }
      }

    private:
      static std::vector<FaceCorners<dim>>
      halve(const FaceCorners<dim> &f)
      {
        const auto middle = [](const Point<dim> &a, const Point<dim> &b) {
          return a + (b - a) / 2;
        };
        const Point<dim> m = middle(f[0], f[1]);
        if constexpr (dim == 2)
          return {{{f[0], m}}, {{m, f[1]}}};
        else
          {
            const Point<dim> n = middle(f[1], f[2]), o = middle(f[2], f[0]);
            return {{{f[0], m, o}},
                    {{m, f[1], n}},
                    {{o, n, f[2]}},
                    {{m, n, o}}};
          }
      }

      /** Where on the way from @p in to @p out the body ends. */
      Point<dim>
      cut(const Point<dim> &in, const Point<dim> &out) const
      {
        double lower = 0, upper = 1;
        for (unsigned int i = 0; i < 50; ++i)
          {
            const double middle = (lower + upper) / 2;
            (inside(in + middle * (out - in)) ? lower : upper) = middle;
          }
        return in + lower * (out - in);
      }

      void
      add_leaf(const FaceCorners<dim> &face)
      {
        std::vector<Point<dim>> in, out;
        for (const Point<dim> &corner : face)
          (inside(corner) ? in : out).push_back(corner);
        if (out.empty())
          pieces.push_back(face);
        else if (in.empty())
          return;
        else if constexpr (dim == 2)
          pieces.push_back({{in[0], cut(in[0], out[0])}});
        else if (in.size() == 1)
          pieces.push_back({{in[0], cut(in[0], out[0]), cut(in[0], out[1])}});
        else
          {
            const Point<dim> a = cut(in[0], out[0]), b = cut(in[1], out[0]);
            pieces.push_back({{in[0], in[1], b}});
            pieces.push_back({{in[0], b, a}});
          }
      }

      const Inside &inside;
    };



    /** One run of seed_surfaces(). */
    template <int dim>
    class Seeding
    {
    public:
      Seeding(const BackgroundGrid<dim>             &grid,
              const BodyShape<dim>                  &shape,
              const std::vector<SurfaceRegion<dim>> &surfaces)
        : grid(grid)
        , shape(shape)
        , surfaces(surfaces)
      {
        result.covered.assign(surfaces.size(), 0.);
        result.candidate.assign(surfaces.size(), 0.);
      }

      void
      add_grid_boundaries()
      {
        for (const BoundaryFace &face : grid.boundary_faces())
          for (unsigned int s = 0; s < surfaces.size(); ++s)
            if (surfaces[s].on_grid_boundary && surfaces[s].id == face.id)
              add_face(
                grid.geometry(), face.cell, face.opposite_vertex, s, true);
      }

      void
      add_free_faces(const SimplexGeometry<dim>      &geometry,
                     const std::vector<unsigned int> &occupied,
                     const bool                       of_grid)
      {
        for (const unsigned int cell : occupied)
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const unsigned int behind = geometry.neighbours(cell)[v];
              if (behind != SimplexGeometry<dim>::no_cell &&
                  holds_body(occupied, behind, of_grid))
                continue;
              const Point<dim> centre =
                centre_of<dim>(corners_of(geometry, cell, v));
              for (unsigned int s = 0; s < surfaces.size(); ++s)
                if (!surfaces[s].on_grid_boundary &&
                    surfaces[s].contains(centre))
                  add_face(geometry, cell, v, s, of_grid);
            }
      }

      SeededSurfaces<dim> result;

    private:
      /** Whether @p cell is one of @p occupied. In a grid of several layers
       * also whether a copy of it is: faces between bodies are no surface. */
      bool
      holds_body(const std::vector<unsigned int> &occupied,
                 const unsigned int               cell,
                 const bool                       of_grid) const
      {
        const auto is_occupied = [&](const unsigned int c) {
          return std::binary_search(occupied.begin(), occupied.end(), c);
        };
        if (!of_grid || grid.n_layers() == 1 || grid.is_adaptive())
          return is_occupied(cell);
        const unsigned int of_first_layer =
          cell % grid.geometry().n_cells_of_first_layer();
        for (unsigned int layer = 0; layer < grid.n_layers(); ++layer)
          if (is_occupied(grid.cell_in_layer(of_first_layer, layer)))
            return true;
        return false;
      }

      static FaceCorners<dim>
      corners_of(const SimplexGeometry<dim> &geometry,
                 const unsigned int          cell,
                 const unsigned int          v)
      {
        FaceCorners<dim> corners;
        for (unsigned int i = 0; i < dim; ++i)
          corners[i] =
            geometry
              .vertices()[geometry.vertex_indices(cell)[i < v ? i : i + 1]];
        return corners;
      }

      void
      add_face(const SimplexGeometry<dim> &geometry,
               const unsigned int          cell,
               const unsigned int          v,
               const unsigned int          surface,
               const bool                  of_grid)
      {
        const FaceCorners<dim> face = corners_of(geometry, cell, v);
        // |face| = dim |cell| |∇λ_v|, and ∇λ_v points inwards
        const Tensor<1, dim> area =
          -(dim * geometry.measure(cell)) * geometry.gradients(cell)[v];
        result.candidate[surface] += area.norm();
        if (!of_grid || shape.is_everywhere())
          {
            add_piece(face,
                      area,
                      surface,
                      of_grid ?
                        cell :
                        shape.cell_of_layer_at(cell_centroid(geometry, cell)));
            return;
          }
        // seen from within the cell, as a region may end right at the face
        const Point<dim> middle = cell_centroid(geometry, cell);
        const typename CoveredPart<dim>::Inside inside =
          [&](const Point<dim> &x) {
            return shape.contains(x + 1e-8 * (middle - x), cell);
          };
        for (const auto &piece : covered_part<dim>(face, inside))
          add_piece(piece,
                    area * (measure<dim>(piece) / area.norm()),
                    surface,
                    cell);
      }

      void
      add_piece(const FaceCorners<dim> &piece,
                const Tensor<1, dim>   &area,
                const unsigned int      surface,
                const unsigned int      cell)
      {
        result.covered[surface] += area.norm();
        result.faces.push_back({piece, area, surface, cell});
      }

      const BackgroundGrid<dim>             &grid;
      const BodyShape<dim>                  &shape;
      const std::vector<SurfaceRegion<dim>> &surfaces;
    };



    template <int dim>
    void
    add_body_mesh(const std::string &file_name, Seeding<dim> &seeding)
    {
      Triangulation<dim> mesh;
      read_mesh<dim>(file_name,
                     "Boundary conditions/Mesh of body surfaces",
                     mesh);
      const SimplexGeometry<dim> geometry(mesh);
      std::vector<unsigned int>  all_cells(geometry.n_cells());
      std::iota(all_cells.begin(), all_cells.end(), 0);
      seeding.add_free_faces(geometry, all_cells, false);
    }
  } // namespace



  template <int dim>
  std::vector<FaceCorners<dim>>
  covered_part(const FaceCorners<dim>                        &face,
               const std::function<bool(const Point<dim> &)> &inside)
  {
    CoveredPart<dim> part(inside);
    part.add(face, dim == 2 ? 4 : 3);
    return part.pieces;
  }



  template <int dim>
  SeededSurfaces<dim>
  seed_surfaces(const BackgroundGrid<dim>             &grid,
                const BodyShape<dim>                  &shape,
                const std::vector<unsigned int>       &occupied,
                const std::vector<SurfaceRegion<dim>> &surfaces,
                const std::string                     &body_mesh)
  {
    Seeding<dim> seeding(grid, shape, surfaces);
    seeding.add_grid_boundaries();
    const bool has_conditions =
      std::any_of(surfaces.begin(), surfaces.end(), [](const auto &surface) {
        return !surface.on_grid_boundary;
      });
    if (has_conditions && body_mesh.empty())
      seeding.add_free_faces(grid.geometry(), occupied, true);
    else if (has_conditions)
      add_body_mesh(body_mesh, seeding);

    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        const SurfaceRegion<dim> &surface = surfaces[s];
        AssertThrow(
          seeding.result.covered[s] > 0,
          ExcMessage(
            surface.on_grid_boundary ?
              "The body does not touch the boundary <" + surface.name +
                "> of the grid at t = 0, where the parameter <" +
                surface.parameter +
                "> puts a condition on the body's surface. Name a boundary "
                "that the body touches, or describe the place by <Boundary "
                "conditions/Surfaces of body>." :
            seeding.result.candidate[s] > 0 ?
              "The body's surface <" + surface.name + "> of the parameter <" +
                surface.parameter +
                "> does not lie on faces of the grid's cells: they, or the end "
                "of the <Material points/Region>, are elsewhere. Let grid lines "
                "and region end at the surface, or give the body's mesh in "
                "<Boundary conditions/Mesh of body surfaces>." :
              "The body's surface <" + surface.name + "> of the parameter <" +
                surface.parameter +
                "> has no face. Its condition must hold at the centres of "
                "faces of the cells that the body fills at t = 0."));
      }
    return seeding.result;
  }



  template <int dim>
  std::string
  describe_surfaces(const SeededSurfaces<dim>             &seeded,
                    const std::vector<SurfaceRegion<dim>> &surfaces)
  {
    std::string text;
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        std::vector<Point<dim>> corners;
        for (const SurfaceFace<dim> &face : seeded.faces)
          if (face.surface == s)
            corners.insert(corners.end(),
                           face.corners.begin(),
                           face.corners.end());
        const unsigned int n_faces = corners.size() / dim;
        const auto ends = BoundingBox<dim>(corners).get_boundary_points();
        text += (s > 0 ? "\nSurface <" : "Surface <") + surfaces[s].name +
                "> of <" + surfaces[s].parameter +
                ">: " + std::to_string(n_faces) +
                (n_faces == 1 ? " face, " : " faces, ") +
                rounded(seeded.covered[s]) + (dim == 2 ? " m in " : " m^2 in ");
        for (unsigned int d = 0; d < dim; ++d)
          text += (d > 0 ? " x [" : "[") + rounded(ends.first[d]) + ", " +
                  rounded(ends.second[d]) + "]";
      }
    return text;
  }



  template double
  measure<2>(const FaceCorners<2> &);
  template double
  measure<3>(const FaceCorners<3> &);
  template Quadrature<1>
  surface_rule<2>(const unsigned int);
  template Quadrature<2>
  surface_rule<3>(const unsigned int);
  template std::vector<FaceCorners<2>>
  covered_part<2>(const FaceCorners<2> &,
                  const std::function<bool(const Point<2> &)> &);
  template std::vector<FaceCorners<3>>
  covered_part<3>(const FaceCorners<3> &,
                  const std::function<bool(const Point<3> &)> &);
  template SeededSurfaces<2>
  seed_surfaces<2>(const BackgroundGrid<2> &,
                   const BodyShape<2> &,
                   const std::vector<unsigned int> &,
                   const std::vector<SurfaceRegion<2>> &,
                   const std::string &);
  template std::string
  describe_surfaces<2>(const SeededSurfaces<2> &,
                       const std::vector<SurfaceRegion<2>> &);
  template std::string
  describe_surfaces<3>(const SeededSurfaces<3> &,
                       const std::vector<SurfaceRegion<3>> &);
  template SeededSurfaces<3>
  seed_surfaces<3>(const BackgroundGrid<3> &,
                   const BodyShape<3> &,
                   const std::vector<unsigned int> &,
                   const std::vector<SurfaceRegion<3>> &,
                   const std::string &);
} // namespace isochor
