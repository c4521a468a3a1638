/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// What InteractionTerm leaves in the statistics.

#include <isochor/base/mpi_sums.h>
#include <isochor/interaction/interaction_term.h>

namespace isochor
{
  template <int dim>
  std::vector<std::array<double, dim + 3>>
  InteractionTerm<dim>::resultants(const StepContext<dim> &step,
                                   const NodalField       &unknowns) const
  {
    std::vector<std::array<double, dim + 3>> sums(interactions.size());
    InteractionKernel<dim>                   kernel;
    std::vector<Action>                      actions;
    slips.start_noting();
    forces.start_noting();
    update_partners(step, unknowns);
    for (const FaceElement &element : faces)
      {
        actions.clear();
        evaluate_face(step, unknowns, element, false, kernel, &actions);
        const auto key = BodySurface<dim>::key(surface.faces()[element.face]);
        for (const Action &action : actions)
          {
            auto &sum = sums[action.interaction];
            for (unsigned int a = 0; a < dim; ++a)
              sum[a] += action.force[a];
            const Tensor<1, 3> moment =
              interactions[action.interaction]->partner->moment(
                action.y, action.force, step.has_inertia);
            for (unsigned int a = 0; a < 3; ++a)
              sum[dim + a] += moment[a];
            forces.set_next(key, action.gauss_point, action.force);
            if (action.slip.norm_square() > 0)
              slips.set_next(key, action.gauss_point, action.slip);
          }
      }
    for (auto &sum : sums)
      sum_over_ranks(sum, step.grid.communicator());
    return sums;
  }



  template <int dim>
  void
  InteractionTerm<dim>::evaluate(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 const MixedSystem<dim> & /*system*/,
                                 const NodalConstraints &constraints,
                                 Statistics             &statistics) const
  {
    loads.evaluate(step, unknowns, constraints, statistics);
    if (interactions.empty())
      return;
    const auto sums = resultants(step, unknowns);
    for (unsigned int i = 0; i < interactions.size(); ++i)
      {
        const std::string of = " on " + interactions[i]->body + " by " +
                               interactions[i]->partner_name;
        for (unsigned int a = 0; a < dim; ++a)
          statistics.set(interactions[i]->force_column(a), sums[i][a]);
        const bool turns =
          interactions[i]->partner->has_moments() && !step.kernel.axisymmetric;
        for (unsigned int a = (dim == 2 ? 2 : 0); a < 3 && turns; ++a)
          statistics.set((dim == 2 ? std::string("Moment") :
                                     std::string("Moment ") + "xyz"[a]) +
                           of + " (N m)",
                         sums[i][dim + a]);
      }
  }



  template void
  InteractionTerm<2>::evaluate(const StepContext<2> &,
                               const NodalField &,
                               const MixedSystem<2> &,
                               const NodalConstraints &,
                               Statistics &) const;
  template void
  InteractionTerm<3>::evaluate(const StepContext<3> &,
                               const NodalField &,
                               const MixedSystem<3> &,
                               const NodalConstraints &,
                               Statistics &) const;
} // namespace isochor
