/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BoundaryPoints for points on faces of domains.
#include <deal.II/base/mpi.h>

#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/grid/nearest_cells.h>

#include <cmath>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  BoundaryPoints<dim>::drop_points_on_domains()
  {
    clear_stencils();
    PointRecords<dim> others(n_entries);
    for (std::size_t b = 0; b < records.size(); ++b)
      if (!is_on_domain(b))
        others.push_back(records.cells[b],
                         records.ids[b],
                         records.locations[b],
                         records.payload(b));
    records = std::move(others);
  }



  template <int dim>
  void
  BoundaryPoints<dim>::add_points_on_domains(const PointArrays<dim> &body)
  {
    const auto parts = on_domains.parts(grid.geometry(), body, false);
    check_parts(parts);
    types::particle_index id = new_ids(rule.size() * parts.size());
    for (const auto &part : parts)
      {
        add_points_on_domain(part, body, id);
        id += rule.size();
      }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::add_points_on_domain(
    const typename SurfaceOnDomains<dim>::Part &part,
    const PointArrays<dim>                     &body,
    const types::particle_index                 first_id)
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const SurfaceFace<dim>     &face     = on_domains.faces()[part.face];
    const unsigned int          cell     = body.cell[part.k];
    const Tensor<2, dim>        F        = body.F[part.q];
    const Point<dim>     centre = body.location(geometry, part.k, part.q);
    const Tensor<1, dim> u      = body.displacement[part.q];
    const auto           nodes  = body.stencil(geometry, part.k, part.q);
    const Tensor<1, dim> area =
      face.area * (measure<dim>(part.corners) / face.area.norm());
    std::array<double, n_entries> payload{};
    payload[surface_entry]   = face.surface;
    payload[on_domain_entry] = 1;
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int e = 0; e < dim; ++e)
        payload[F_entry + d * dim + e] = F[d][e];
    for (unsigned int i = 0; i < rule.size(); ++i)
      {
        const Point<dim> X = place_on_face<dim>(part.corners, rule.point(i));
        const Tensor<1, dim> R = X - (centre - u), r = F * R;
        for (unsigned int d = 0; d < dim; ++d)
          {
            payload[displacement_entry + d] = u[d] + r[d] - R[d];
            payload[area_entry + d]         = rule.weight(i) * area[d];
          }
        records.push_back(cell,
                          first_id + i,
                          centre + r,
                          ArrayView<const double>(payload.data(), n_entries));
        // linear on the domain
        for (unsigned int I = 0; I < nodes.n_nodes; ++I)
          {
            stencil_vertex.push_back(nodes.vertex[I]);
            stencil_shape.push_back(nodes.shape[I] + nodes.gradient[I] * r);
            stencil_gradient.push_back(nodes.gradient[I]);
          }
        stencil_start.push_back(stencil_vertex.size());
      }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::check_parts(
    const std::vector<typename SurfaceOnDomains<dim>::Part> &parts) const
  {
    constexpr double tolerance = 1e-5;
    double           area = 0, of_faces = 0;
    for (const auto &part : parts)
      area += measure<dim>(part.corners);
    for (const SurfaceFace<dim> &face : on_domains.faces())
      of_faces += face.area.norm();
    area = Utilities::MPI::sum(area, grid.communicator());
    std::ostringstream share;
    share << 100 * area / of_faces;
    AssertThrow(std::abs(area - of_faces) < tolerance * of_faces,
                ExcMessage("The domains of the material points at the surfaces "
                           "of <Boundary conditions/Surfaces of body> or "
                           "<Boundary conditions/Traction> have " +
                           share.str() +
                           " % of the area at t = 0: points were lost, or "
                           "split in another way than their neighbours."));
  }



  template <int dim>
  void
  BoundaryPoints<dim>::save_faces(std::ostream &text) const
  {
    text << on_domains.faces().size() << '\n';
    for (const SurfaceFace<dim> &face : on_domains.faces())
      {
        text << face.surface << ' ' << face.cell << ' ' << face.area;
        for (const Point<dim> &corner : face.corners)
          text << ' ' << corner;
        text << '\n';
      }
  }



  template <int dim>
  void
  BoundaryPoints<dim>::load_faces(std::istream &text)
  {
    std::size_t n = 0;
    text >> n;
    std::vector<SurfaceFace<dim>> faces;
    for (std::size_t f = 0; f < n; ++f)
      {
        SurfaceFace<dim> face;
        text >> face.surface >> face.cell;
        for (unsigned int d = 0; d < dim; ++d)
          text >> face.area[d];
        for (Point<dim> &corner : face.corners)
          for (unsigned int d = 0; d < dim; ++d)
            text >> corner[d];
        AssertThrow(text,
                    ExcMessage("The saved state of the boundary points is "
                               "damaged."));
        faces.push_back(face);
      }
    on_domains = SurfaceOnDomains<dim>(faces);
  }



  template void
  BoundaryPoints<2>::drop_points_on_domains();
  template void
  BoundaryPoints<2>::add_points_on_domains(const PointArrays<2> &);
  template void
  BoundaryPoints<2>::save_faces(std::ostream &) const;
  template void
  BoundaryPoints<2>::load_faces(std::istream &);
  template void
  BoundaryPoints<3>::drop_points_on_domains();
  template void
  BoundaryPoints<3>::add_points_on_domains(const PointArrays<3> &);
  template void
  BoundaryPoints<3>::save_faces(std::ostream &) const;
  template void
  BoundaryPoints<3>::load_faces(std::istream &);
} // namespace isochor
