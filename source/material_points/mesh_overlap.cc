/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/numerics/rtree.h>

#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/mesh_overlap.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace isochor
{
  namespace
  {
    /** How far inside of its cell a place at a face is, of the way to the
     * centroid: more than meshes of CAD models are inexact. */
    constexpr double depth = 0.03;

    /** A place in a cell, near one of its faces. */
    struct Origin
    {
      unsigned int cell, face;
    };

    template <int dim>
    using Place = std::pair<Point<dim>, Origin>;

    /** Places near the faces of @p cell that have no neighbour. */
    template <int dim>
    void
    add_places(const SimplexGeometry<dim>       &geometry,
               const std::vector<unsigned char> &is_in,
               const unsigned int                cell,
               unsigned int                     &n_faces,
               std::vector<Place<dim>>          &places)
    {
      const Point<dim> centroid = cell_centroid(geometry, cell);
      for (unsigned int v = 0; v <= dim; ++v)
        {
          const unsigned int behind = geometry.neighbours(cell)[v];
          if (behind != SimplexGeometry<dim>::no_cell && is_in[behind])
            continue;
          Point<dim> middle;
          const auto add = [&](const Point<dim> &x) {
            places.push_back({x + depth * (centroid - x), {cell, n_faces}});
          };
          for (unsigned int i = 0; i <= dim; ++i)
            if (i != v)
              {
                const Point<dim> &vertex =
                  geometry.vertices()[geometry.vertex_indices(cell)[i]];
                middle += vertex / dim;
                add(vertex);
              }
          add(middle);
          ++n_faces;
        }
    }
  } // namespace



  template <int dim>
  MeshOverlap<dim>
  find_overlap(const SimplexGeometry<dim>       &geometry,
               const std::vector<unsigned char> &is_in)
  {
    AssertDimension(is_in.size(), geometry.n_cells());
    namespace bgi = boost::geometry::index;
    MeshOverlap<dim>        result;
    std::vector<Place<dim>> places;
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      if (is_in[cell])
        add_places(geometry, is_in, cell, result.n_faces, places);

    const auto                 tree = pack_rtree(places);
    std::vector<Place<dim>>    near;
    std::vector<unsigned char> overlaps(result.n_faces, 0);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        if (!is_in[cell])
          continue;
        std::array<Point<dim>, dim + 1> corners;
        for (unsigned int v = 0; v <= dim; ++v)
          corners[v] = geometry.vertices()[geometry.vertex_indices(cell)[v]];
        near.clear();
        tree.query(bgi::intersects(BoundingBox<dim>(
                     std::vector<Point<dim>>(corners.begin(), corners.end()))),
                   std::back_inserter(near));
        for (const auto &[x, origin] : near)
          {
            const auto lambda = geometry.barycentric(cell, x);
            if (origin.cell == cell || overlaps[origin.face] ||
                *std::min_element(lambda.begin(), lambda.end()) <= 0)
              continue;
            overlaps[origin.face] = 1;
            if (result.n_overlapping++ == 0)
              result.place = x;
          }
      }
    return result;
  }



  template MeshOverlap<2>
  find_overlap(const SimplexGeometry<2> &, const std::vector<unsigned char> &);
  template MeshOverlap<3>
  find_overlap(const SimplexGeometry<3> &, const std::vector<unsigned char> &);
} // namespace isochor
