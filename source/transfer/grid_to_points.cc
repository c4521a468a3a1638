/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/transfer/grid_to_points.h>
#include <isochor/transfer/volume_error.h>

#include <array>
#include <cmath>

namespace isochor
{
  template <int dim>
  void
  GridToPoints<dim>::transfer(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const InertiaTerm<dim> &inertia,
                              MaterialPoints<dim>    &points,
                              PointArrays<dim>       &of_step)
  {
    const PointLayout              &l      = points.layout();
    const PointArrays<dim>         &arrays = step.points;
    const NodalUnknowns<dim>        nodal(step, unknowns);
    std::array<double, max_history> history;
    Kinematics<dim>                 increment;
    SymmetricTensor<2, dim>         strain_increment;
    unsigned int                    last_cell = numbers::invalid_unsigned_int;
    if (step.mixed())
      unseen_volume.start(step);
    step_energy = 0;
    excesses.clear();
    excesses.reserve(step.mixed() ? arrays.volume.size() : 0);

    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim>        &location,
                        ArrayView<double>  properties) {
      const auto stencil = arrays.stencil(step.grid.geometry(), k, q);
      if (k != last_cell || arrays.has_stencils())
        {
          increment.set_increment(nodal.deformation_at(stencil));
          if (measures_energy)
            strain_increment = symmetrize(unit_symmetric_tensor<dim>() -
                                          invert(increment.F_increment));
          last_cell = k;
        }

      const Tensor<1, dim> displacement = nodal.increment_at(stencil);
      increment.hoop_increment          = nodal.hoop_at(stencil, arrays, q);
      const auto state                  = step.kernel.final_state(arrays,
                                                 q,
                                                 increment,
                                                 step.mixed(),
                                                 nodal.pressure_at(stencil),
                                                 history.data());
      if (step.mixed())
        {
          const double excess =
            excess_of_volume<dim>(state,
                                  *step.kernel.materials[arrays.material[q]]);
          excesses.push_back(excess);
          unseen_volume.set(step, q, excess, state, history.data());
        }
      location += displacement;
      properties[l.pressure] = state.pressure;
      for (unsigned int a = 0; a < dim; ++a)
        {
          properties[l.displacement + a] += displacement[a];
          for (unsigned int b = 0; b < dim; ++b)
            properties[l.F + a * dim + b] = state.F[a][b];
        }
      of_step.F.refresh(q, state.F);
      store_symmetric<dim>(state.cauchy_stress, &properties[l.stress]);
      if (measures_energy)
        {
          double work = 0;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              work += state.cauchy_stress[a][b] * strain_increment[a][b];
          work +=
            state.cauchy_stress[2][2] * (1 - 1 / increment.hoop_increment);
          step_energy += std::abs(work) * state.J * properties[l.volume] *
                         arrays.thickness(q);
        }
      for (unsigned int i = 0; i < l.n_history; ++i)
        properties[l.history + i] = history[i];
      const double kinetic_energy =
        inertia.move_point(step, stencil, q, l, properties);
      if (measures_energy)
        step_energy += kinetic_energy;
    });
  }



  template <int dim>
  void
  GridToPoints<dim>::pass_unseen_volume(const StepContext<dim> &step,
                                        const bool              grid_is_reset,
                                        MaterialPoints<dim>    &points,
                                        PointArrays<dim>       &of_step)
  {
    if (step.mixed())
      unseen_volume.apply(step, grid_is_reset, points, of_step);
  }



  template class GridToPoints<2>;
  template class GridToPoints<3>;
} // namespace isochor
