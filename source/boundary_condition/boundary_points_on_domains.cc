/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BoundaryPoints that put them on faces of domains.
#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_points.h>

namespace isochor
{
  template <int dim>
  SeededSurfaces<dim>
  BoundaryPoints<dim>::find_on_domains(
    const std::vector<SurfaceRegion<dim>> &regions,
    const PointArrays<dim>                &body) const
  {
    std::vector<double> values;
    BodySurface<dim>    surface;
    surface.find(grid.geometry(), body);
    for (const auto &face : surface.faces())
      for (unsigned int s = 0; s < regions.size(); ++s)
        if (is_of(face, regions[s]))
          {
            values.push_back(s);
            values.push_back(face.area);
            for (const Tensor<1, dim> &corner : face.corners)
              for (unsigned int d = 0; d < dim; ++d)
                values.push_back(face.reference[d] + corner[d]);
          }
    SeededSurfaces<dim> result;
    result.covered.resize(regions.size());
    for (const auto &of_rank : all_gather_arrays(grid.communicator(), values))
      for (auto v = of_rank.begin(); v != of_rank.end();)
        {
          SurfaceFace<dim> face{};
          face.surface = static_cast<unsigned int>(*v++);
          result.covered[face.surface] += *v++;
          for (Point<dim> &corner : face.corners)
            for (unsigned int d = 0; d < dim; ++d)
              corner[d] = *v++;
          result.faces.push_back(face);
        }
    result.candidate = result.covered;
    for (unsigned int s = 0; s < regions.size(); ++s)
      AssertThrow(result.covered[s] > 0,
                  ExcMessage(
                    regions[s].on_grid_boundary ?
                      "The body does not touch the boundary <" +
                        regions[s].name +
                        "> of the grid at t = 0, where the parameter <" +
                        regions[s].parameter +
                        "> puts a condition on the body's surface. Name a "
                        "boundary that the body touches, or describe the place "
                        "by <Boundary conditions/Surfaces of body>." :
                      "The body's surface <" + regions[s].name +
                        "> of the parameter <" + regions[s].parameter +
                        "> has no face. Its condition must hold at the centres "
                        "of faces of the points' domains at t = 0."));
    return result;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::add_points_on_domains(const PointArrays<dim> &body)
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    BodySurface<dim>            surface;
    surface.find(geometry, body);
    records = PointRecords<dim>(n_entries);
    for (const auto &face : surface.faces())
      {
        const Tensor<2, dim> F     = body.F[face.q];
        const auto           nodes = body.stencil(geometry, face.k, face.q);
        FaceCorners<dim>     corners; // from the point
        for (unsigned int c = 0; c < dim; ++c)
          corners[c] = Point<dim>(face.corners[c]);
        std::array<double, n_entries> payload{};
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            payload[F_entry + d * dim + e] = F[d][e];
        for (unsigned int s = 0; s < regions.size(); ++s)
          for (unsigned int i = 0,
                            n = is_of(face, regions[s]) ? rule.size() : 0;
               i < n;
               ++i)
            {
              const auto place =
                BodySurface<dim>::place(geometry,
                                        body,
                                        face,
                                        place_on_face<dim>(corners,
                                                           rule.point(i)));
              payload[surface_entry] = s;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  payload[displacement_entry + d] = place.displacement[d];
                  payload[area_entry + d] =
                    rule.weight(i) * face.area * face.normal[d];
                }
              records.push_back(body.cell[face.k],
                                0,
                                place.x,
                                ArrayView<const double>(payload.data(),
                                                        n_entries));
              // linear on the domain
              for (unsigned int I = 0; I < nodes.n_nodes; ++I)
                {
                  stencil_vertex.push_back(nodes.vertex[I]);
                  stencil_shape.push_back(nodes.shape[I] +
                                          nodes.gradient[I] * place.r);
                  stencil_gradient.push_back(nodes.gradient[I]);
                }
              stencil_start.push_back(stencil_vertex.size());
            }
      }
    types::particle_index id =
      exclusive_and_total_sum(records.size(), grid.communicator()).first;
    for (types::particle_index &one : records.ids)
      one = id++;
  }



  template SeededSurfaces<2>
  BoundaryPoints<2>::find_on_domains(const std::vector<SurfaceRegion<2>> &,
                                     const PointArrays<2> &) const;
  template void
  BoundaryPoints<2>::add_points_on_domains(const PointArrays<2> &);
  template SeededSurfaces<3>
  BoundaryPoints<3>::find_on_domains(const std::vector<SurfaceRegion<3>> &,
                                     const PointArrays<3> &) const;
  template void
  BoundaryPoints<3>::add_points_on_domains(const PointArrays<3> &);
} // namespace isochor
