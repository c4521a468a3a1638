/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/field_followers.h>
#include <isochor/dynamics/mass_matrix.h>
#include <isochor/dynamics/unfelt_pressure.h>
#include <isochor/equations/mixed_kernel.templates.h>

namespace isochor
{
  template <int dim>
  void
  leave_out_unfelt_pressure(const StepContext<dim> &step,
                            const NodalConstraints &constraints,
                            NodalField             &unknowns,
                            NodalField             &force)
  {
    const PointArrays<dim> &points = step.points;
    std::vector<double>     weight(points.n_points());
    for (unsigned int q = 0; q < points.n_points(); ++q)
      weight[q] =
        points.measure(q) * step.kernel.pressure_factor_at_start(points, q);
    MassMatrix<dim> volume;
    NodalField      load, pressure;
    volume.reinit(step, weight, 1);
    volume.collect(step, points.pressure.values(), load);
    step.nodes.initialize(pressure, 1);
    const std::vector<unsigned char> none_held(step.nodes.n_local(), 0);
    volume.set_lumped_solution(load, none_held, pressure);
    // where the iteration ends too early, nodes can represent the result, too
    volume.solve(step,
                 load,
                 none_held,
                 pressure_followers<dim>(constraints),
                 {},
                 pressure);

    pressure.update_ghost_values();
    for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
      unknowns.local_element(node * step.n_components + dim) =
        pressure.local_element(node);

    NodalField unfelt;
    step.nodes.initialize(unfelt, dim);
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          double     p       = points.pressure[q];
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            p -= stencil.shape[I] *
                 pressure.local_element(step.nodes.node(stencil.vertex[I]));
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int first =
                step.nodes.node(stencil.vertex[I]) * dim;
              for (unsigned int a = 0; a < dim; ++a)
                unfelt.local_element(first + a) +=
                  weight[q] * p * stencil.gradient[I][a];
              if (step.kernel.axisymmetric)
                unfelt.local_element(first) +=
                  weight[q] * p * stencil.shape[I] / points.radius[q];
            }
        }
    unfelt.compress(VectorOperation::add);
    for (unsigned int i = 0; i < step.nodes.n_owned() * dim; ++i)
      force.local_element(i) += unfelt.local_element(i);
  }



  template void
  leave_out_unfelt_pressure(const StepContext<2> &,
                            const NodalConstraints &,
                            NodalField &,
                            NodalField &);
  template void
  leave_out_unfelt_pressure(const StepContext<3> &,
                            const NodalConstraints &,
                            NodalField &,
                            NodalField &);
} // namespace isochor
