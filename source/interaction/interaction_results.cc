/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// What InteractionTerm leaves behind: resultants in the statistics, and what it
// remembers from step to step.

#include <isochor/base/mpi_sums.h>
#include <isochor/interaction/interaction_term.h>

#include <limits>
#include <sstream>

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
                                 const NodalConstraints & /*constraints*/,
                                 Statistics &statistics) const
  {
    loads.evaluate(step, unknowns, statistics);
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



  template <int dim>
  void
  InteractionTerm<dim>::advance(const StepContext<dim> & /*step*/,
                                const NodalField & /*unknowns*/)
  {
    slips.accept();
    forces.accept();
  }



  template <int dim>
  std::string
  InteractionTerm<dim>::save_state() const
  {
    const MPI_Comm     comm  = grid->communicator();
    const std::string  first = slips.save(comm);
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    text << Utilities::MPI::sum(acting, comm) << ' ' << first.size() << '\n'
         << first << forces.save(comm);
    return text.str();
  }



  template <int dim>
  void
  InteractionTerm<dim>::load_state(const std::string &state)
  {
    const std::size_t line = state.find('\n');
    if (line == std::string::npos)
      return;
    std::istringstream text(state);
    std::size_t        size = 0;
    for (unsigned int d = 0; d < dim; ++d)
      text >> acting[d];
    text >> size;
    slips.load(state.substr(line + 1, size));
    forces.load(state.substr(line + 1 + size));
  }



  template std::vector<std::array<double, 2 + 3>>
  InteractionTerm<2>::resultants(const StepContext<2> &,
                                 const NodalField &) const;
  template void
  InteractionTerm<2>::evaluate(const StepContext<2> &,
                               const NodalField &,
                               const MixedSystem<2> &,
                               const NodalConstraints &,
                               Statistics &) const;
  template void
  InteractionTerm<2>::advance(const StepContext<2> &, const NodalField &);
  template std::string
  InteractionTerm<2>::save_state() const;
  template void
  InteractionTerm<2>::load_state(const std::string &);
  template std::vector<std::array<double, 3 + 3>>
  InteractionTerm<3>::resultants(const StepContext<3> &,
                                 const NodalField &) const;
  template void
  InteractionTerm<3>::evaluate(const StepContext<3> &,
                               const NodalField &,
                               const MixedSystem<3> &,
                               const NodalConstraints &,
                               Statistics &) const;
  template void
  InteractionTerm<3>::advance(const StepContext<3> &, const NodalField &);
  template std::string
  InteractionTerm<3>::save_state() const;
  template void
  InteractionTerm<3>::load_state(const std::string &);
} // namespace isochor
