/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_model/tensor_tools.h>
#include <isochor/material_points/point_reader.h>

namespace isochor
{
  template <int dim>
  void
  PointReader<dim>::resize(PointArrays<dim> &arrays, const unsigned int n) const
  {
    const PointLayout &l = layout;
    arrays.n_history     = l.n_history;
    arrays.deformed_cell.clear();
    arrays.stencil_start.clear();
    arrays.domain_corners.cells.clear();
    arrays.volume.clear();
    arrays.mass.clear();
    arrays.pressure.clear();
    arrays.F.clear();
    arrays.shape.resize(n);
    arrays.weight.resize(n);
    arrays.radius.resize(l.axisymmetric ? n : 0);
    arrays.material.resize(n);
    arrays.history.resize(n * std::size_t(l.n_history));
    arrays.shear_stress.assign(dissipates.empty() ? 0 : n, 0.);
    arrays.velocity.resize(l.dynamic ? n : 0);
    arrays.acceleration.resize(l.dynamic ? n : 0);
    arrays.domain.resize(l.with_domains ? n : 0);
    arrays.reference.resize(l.with_domains ? n : 0);
    arrays.displacement.resize(l.with_domains ? n : 0);
    arrays.domain_corners.stretch.resize(l.with_domains ? n : 0);
    arrays.domain_corners.outer_faces.resize(l.with_surface ? n : 0);
    arrays.domain_corners.id.resize(l.with_surface ? n : 0);
  }



  template <int dim>
  void
  PointReader<dim>::attach(PointArrays<dim> &arrays) const
  {
    const PointLayout &l = layout;
    arrays.volume.attach(slots, l.volume, fields_are_copied);
    arrays.mass.attach(slots, l.mass);
    arrays.pressure.attach(slots, l.pressure);
    arrays.F.attach(slots, l.F, fields_are_copied);
  }



  template <int dim>
  void
  PointReader<dim>::read_state(const unsigned int             q,
                               const Point<dim>              &location,
                               const ArrayView<const double> &properties,
                               PointArrays<dim>              &arrays) const
  {
    const PointLayout &l = layout;
    if (fields_are_copied)
      {
        arrays.volume.refresh(q, properties[l.volume]);
        arrays.F.refresh(q, deformation_gradient<dim>(properties.data(), l));
      }
    if (l.axisymmetric)
      arrays.radius[q] = location[0];
    for (unsigned int d = 0; l.with_domains && d < dim; ++d)
      arrays.displacement[q][d] = properties[l.displacement + d];
    double *const history =
      arrays.history.data() + q * std::size_t(l.n_history);
    for (unsigned int i = 0; i < l.n_history; ++i)
      history[i] = properties[l.history + i];
    if (!dissipates.empty() && dissipates[arrays.material[q]])
      arrays.shear_stress[q] =
        deviator(load_symmetric<dim>(&properties[l.stress])).norm();
    if (l.dynamic)
      for (unsigned int d = 0; d < dim; ++d)
        {
          arrays.velocity[q][d]     = properties[l.velocity + d];
          arrays.acceleration[q][d] = properties[l.acceleration + d];
        }
  }



  template <int dim>
  void
  PointReader<dim>::read(const unsigned int             q,
                         const Point<dim>              &location,
                         const ArrayView<const double> &properties,
                         PointArrays<dim>              &arrays) const
  {
    arrays.weight[q] = properties[layout.volume];
    arrays.material[q] =
      static_cast<unsigned char>(properties[layout.material]);
    read_state(q, location, properties, arrays);
    if (layout.with_surface)
      arrays.domain_corners.outer_faces[q] =
        static_cast<unsigned char>(properties[layout.outer_faces]);
    if (layout.with_domains)
      read_domain(q, location, properties, arrays);
  }



  template <int dim>
  void
  PointReader<dim>::read_domain(const unsigned int             q,
                                const Point<dim>              &location,
                                const ArrayView<const double> &properties,
                                PointArrays<dim>              &arrays) const
  {
    const PointLayout &l       = layout;
    const double       stretch = domain_stretch<dim>(properties.data(), l);
    arrays.reference[q]        = Point<dim>(location - arrays.displacement[q]);
    arrays.domain_corners.stretch[q] = stretch;
    arrays.domain[q][0]              = Tensor<1, dim>();
    for (unsigned int c = 0; c < dim; ++c)
      {
        for (unsigned int d = 0; d < dim; ++d)
          arrays.domain[q][c + 1][d] =
            stretch * properties[l.domain + c * dim + d];
        arrays.domain[q][0] -= arrays.domain[q][c + 1];
      }
  }



  template struct PointReader<2>;
  template struct PointReader<3>;
} // namespace isochor
