/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The member of BoundaryPoints that puts them on faces of domains.
#include <isochor/boundary_condition/boundary_points.h>

namespace isochor
{
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
        // what is between bodies belongs to no named surface
        if (face.meets_other_body)
          continue;
        const Tensor<2, dim> F      = body.F[face.q];
        const Point<dim>     centre = body.location(geometry, face.k, face.q);
        const Tensor<1, dim> u      = body.displacement[face.q];
        const auto           nodes  = body.stencil(geometry, face.k, face.q);
        FaceCorners<dim>     corners; // from the point
        for (unsigned int c = 0; c < dim; ++c)
          corners[c] = Point<dim>(face.corners[c]);
        std::array<double, n_entries> payload{};
        for (unsigned int d = 0; d < dim; ++d)
          for (unsigned int e = 0; e < dim; ++e)
            payload[F_entry + d * dim + e] = F[d][e];
        const Point<dim>          X = BodySurface<dim>::centre(face);
        std::vector<unsigned int> n_points;
        for (const SurfaceRegion<dim> &region : regions)
          n_points.push_back(region.contains(X) ? rule.size() : 0);
        for (unsigned int s = 0; s < regions.size(); ++s)
          for (unsigned int i = 0; i < n_points[s]; ++i)
            {
              const Tensor<1, dim> R =
                                     place_on_face<dim>(corners, rule.point(i)),
                                   r = F * R;
              payload[surface_entry] = s;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  payload[displacement_entry + d] = u[d] + r[d] - R[d];
                  payload[area_entry + d] =
                    rule.weight(i) * face.area * face.normal[d];
                }
              records.push_back(
                body.cell[face.k],
                (BodySurface<dim>::key(face) * regions.size() + s) *
                    rule.size() +
                  i,
                centre + r,
                ArrayView<const double>(payload.data(), n_entries));
              // linear on the domain
              for (unsigned int I = 0; I < nodes.n_nodes; ++I)
                {
                  stencil_vertex.push_back(nodes.vertex[I]);
                  stencil_shape.push_back(nodes.shape[I] +
                                          nodes.gradient[I] * r);
                  stencil_gradient.push_back(nodes.gradient[I]);
                }
              stencil_start.push_back(stencil_vertex.size());
            }
      }
  }



  template void
  BoundaryPoints<2>::add_points_on_domains(const PointArrays<2> &);
  template void
  BoundaryPoints<3>::add_points_on_domains(const PointArrays<3> &);
} // namespace isochor
