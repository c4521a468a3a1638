/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/transfer/held_boundary.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** Outward, of length 1. */
    template <int dim>
    Tensor<1, dim>
    normal_of_face(const SimplexGeometry<dim> &geometry,
                   const unsigned int          cell,
                   const unsigned int          face)
    {
      const Tensor<1, dim> inward = geometry.gradients(cell)[face];
      return -inward / inward.norm();
    }



    template <int dim>
    bool
    contains_direction(const std::vector<Tensor<1, dim>> &normals,
                       const Tensor<1, dim>              &normal,
                       const double along = 0.5) // walls may be curved
    {
      return std::any_of(normals.begin(),
                         normals.end(),
                         [&](const Tensor<1, dim> &n) {
                           return n * normal > along;
                         });
    }
  } // namespace



  template <int dim>
  void
  HeldBoundary<dim>::set(const std::vector<unsigned int> &vertices)
  {
    walls = vertices;
    normals.clear();
  }



  template <int dim>
  bool
  HeldBoundary<dim>::is_wall(const unsigned int vertex) const
  {
    return std::binary_search(walls.begin(), walls.end(), vertex);
  }



  template <int dim>
  void
  HeldBoundary<dim>::find_normals(const SimplexGeometry<dim> &geometry)
  {
    if (!normals.empty() || walls.empty())
      return;
    for (unsigned int c = 0; c < geometry.n_cells(); ++c)
      for (unsigned int f = 0; f <= dim; ++f)
        if (geometry.neighbours(c)[f] == SimplexGeometry<dim>::no_cell)
          for (unsigned int v = 0; v <= dim; ++v)
            if (v != f)
              {
                auto &of_vertex        = normals[geometry.vertex_indices(c)[v]];
                const Tensor<1, dim> n = normal_of_face(geometry, c, f);
                if (!contains_direction(of_vertex, n))
                  of_vertex.push_back(n);
              }
  }



  template <int dim>
  typename HeldBoundary<dim>::Normals
  HeldBoundary<dim>::touched_normals(const SimplexGeometry<dim>   &geometry,
                                     const std::set<VertexOfPart> &touched,
                                     const unsigned int            cell,
                                     const unsigned int            name) const
  {
    std::vector<Tensor<1, dim>> result;
    for (const unsigned int v : geometry.vertex_indices(cell))
      if (touched.count({v, name}) > 0)
        {
          const auto of_vertex = normals.find(v);
          if (of_vertex != normals.end())
            for (const Tensor<1, dim> &n : of_vertex->second)
              if (!contains_direction(result, n))
                result.push_back(n);
        }
    return result;
  }



  template <int dim>
  void
  HeldBoundary<dim>::follow(const SimplexGeometry<dim> &geometry,
                            const unsigned int          cell,
                            Normals                    &own) const
  {
    constexpr double alike = 0.95;
    for (const unsigned int v : geometry.vertex_indices(cell))
      {
        const auto of_vertex = own.empty() ? normals.end() : normals.find(v);
        if (of_vertex != normals.end())
          for (const Tensor<1, dim> &n : of_vertex->second)
            if (contains_direction(own, n) &&
                !contains_direction(own, n, alike))
              own.push_back(n);
      }
  }



  template <int dim>
  bool
  HeldBoundary<dim>::is_at(const SimplexGeometry<dim> &geometry,
                           const LocateResult<dim>    &place) const
  {
    constexpr double at_face  = 1e-6;
    const auto      &vertices = geometry.vertex_indices(place.cell);
    for (unsigned int f = 0; f <= dim; ++f)
      if (geometry.neighbours(place.cell)[f] == SimplexGeometry<dim>::no_cell &&
          place.barycentric[f] < at_face)
        {
          bool is_held = true;
          for (unsigned int v = 0; v <= dim; ++v)
            is_held = is_held && (v == f || is_wall(vertices[v]));
          if (is_held)
            return true;
        }
    return false;
  }



  template <int dim>
  void
  HeldBoundary<dim>::find_others(const SimplexGeometry<dim> &geometry,
                                 const unsigned int          cell,
                                 const Normals              &own,
                                 const unsigned int          name,
                                 std::set<VertexOfPart>     &found) const
  {
    const auto &vertices   = geometry.vertex_indices(cell);
    const auto &neighbours = geometry.neighbours(cell);
    for (unsigned int f = 0; f <= dim; ++f)
      if (neighbours[f] == SimplexGeometry<dim>::no_cell &&
          !contains_direction(own, normal_of_face(geometry, cell, f)))
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != f && is_wall(vertices[v]))
            found.emplace(vertices[v], name);
  }



  template <int dim>
  void
  HeldBoundary<dim>::find_own(const SimplexGeometry<dim> &geometry,
                              const unsigned int          cell,
                              const Normals              &own,
                              const unsigned int          name,
                              std::set<VertexOfPart>     &found) const
  {
    if (own.empty())
      return;
    for (const unsigned int v : geometry.vertex_indices(cell))
      if (is_wall(v) && normals.count(v) > 0)
        for (const Tensor<1, dim> &n : normals.at(v))
          if (contains_direction(own, n))
            found.emplace(v, name);
  }



  template class HeldBoundary<2>;
  template class HeldBoundary<3>;
} // namespace isochor
