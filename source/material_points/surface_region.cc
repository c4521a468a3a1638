/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/surface_region.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Whether @p text is a word that no formula consists of: a boundary of
     * the grid, perhaps with a typing mistake. */
    bool
    is_name(const std::string &text)
    {
      constexpr std::array<const char *, 5> numbers = {
        {"x", "y", "z", "t", "pi"}};
      return !text.empty() &&
             std::isalpha(static_cast<unsigned char>(text[0])) &&
             std::all_of(text.begin(),
                         text.end(),
                         [](const unsigned char c) {
                           return std::isalnum(c) || c == '_';
                         }) &&
             std::find(numbers.begin(), numbers.end(), text) == numbers.end();
    }



    /** Of the size of a face: meshes of bodies are rounded to some digits in
     * their files. */
    template <int dim>
    double
    rounding_of(const FaceCorners<dim> &face)
    {
      return 1e-4 * face[0].distance(face[1]);
    }



    template <int dim>
    bool
    lies_on(const FaceCorners<dim> &face, const Point<dim> &x)
    {
      // x - x_0 = Σ λ_i e_i + r, r at right angles to the edges e_i
      const Tensor<1, dim>                d = x - face[0];
      Tensor<2, dim - 1>                  products;
      Tensor<1, dim - 1>                  of_d;
      std::array<Tensor<1, dim>, dim - 1> edges;
      for (unsigned int i = 0; i + 1 < dim; ++i)
        edges[i] = face[i + 1] - face[0];
      for (unsigned int i = 0; i + 1 < dim; ++i)
        {
          of_d[i] = d * edges[i];
          for (unsigned int j = 0; j + 1 < dim; ++j)
            products[i][j] = edges[i] * edges[j];
        }
      const Tensor<1, dim - 1> lambda = invert(products) * of_d;
      Tensor<1, dim>           r      = d;
      double                   least  = 1;
      for (unsigned int i = 0; i + 1 < dim; ++i)
        {
          r -= lambda[i] * edges[i];
          least -= lambda[i];
        }
      for (unsigned int i = 0; i + 1 < dim; ++i)
        least = std::min(least, lambda[i]);
      const double small = rounding_of<dim>(face);
      return r.norm() <= small && least * edges[0].norm() >= -small;
    }
  } // namespace



  template <int dim>
  std::vector<SurfaceRegion<dim>>
  SurfaceRegion<dim>::parse(const std::string &text,
                            const std::string &parameter)
  {
    std::vector<SurfaceRegion<dim>> regions;
    for (const auto &entry : split_list_of_unique_names(text, parameter))
      {
        regions.emplace_back();
        regions.back().name      = entry.first;
        regions.back().parameter = parameter;
        regions.back().condition = entry.second;
      }
    return regions;
  }



  template <int dim>
  void
  SurfaceRegion<dim>::find_place(const BackgroundGrid<dim> &grid)
  {
    if (!on_grid_boundary && grid.boundary_names().count(condition) == 0 &&
        !is_name(condition))
      {
        formula.emplace(condition, parameter, FormulaVariables::space);
        double size = 0;
        for (const Point<dim> &vertex : grid.vertices_at_time(0.))
          size = std::max(size, vertex.norm());
        size      = Utilities::MPI::max(size, grid.communicator());
        per_digit = std::pow(10., 10 - std::ceil(std::log10(size)));
        return;
      }
    id = grid.boundary_id(condition.empty() ? name : condition, parameter);
    on_grid_boundary                       = true;
    const SimplexGeometry<dim>   &geometry = grid.geometry();
    const std::vector<Point<dim>> vertices = grid.vertices_at_time(0.);
    std::vector<Entry>            entries;
    for (const BoundaryFace &face : grid.boundary_faces())
      if (face.id == id)
        {
          FaceCorners<dim> corners;
          unsigned int     i = 0;
          for (unsigned int v = 0; v <= dim; ++v)
            if (v != face.opposite_vertex)
              corners[i++] = vertices[geometry.vertex_indices(face.cell)[v]];
          BoundingBox<dim> box(
            std::vector<Point<dim>>(corners.begin(), corners.end()));
          box.extend(rounding_of<dim>(corners));
          entries.emplace_back(box, corners);
        }
    faces = pack_rtree(entries);
  }



  template <int dim>
  bool
  SurfaceRegion<dim>::contains(const Point<dim> &X) const
  {
    if (!on_grid_boundary)
      {
        Point<dim> place;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = std::round(X[d] * per_digit) / per_digit;
        return (*formula)(place, 0.) > 0;
      }
    namespace bgi = boost::geometry::index;
    std::vector<Entry> near;
    faces.query(bgi::intersects(X) && bgi::satisfies([&X](const Entry &entry) {
                  return lies_on<dim>(entry.second, X);
                }),
                std::back_inserter(near));
    return !near.empty();
  }



  template struct SurfaceRegion<2>;
  template struct SurfaceRegion<3>;
} // namespace isochor
