/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// What InteractionTerm leaves of a step: in the statistics and for the next
// one.

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/interaction/interaction_term.h>

#include <array>

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
    memory.start_noting();
    forces.start_noting();
    update_partners(step, unknowns);
    for (const FaceElement &element : faces)
      {
        actions.clear();
        evaluate_face(step, unknowns, element, false, kernel, &actions);
        const auto key = BodySurface<dim>::key(surface.faces()[element.face]);
        std::array<Tensor<1, dim>, BodySurface<dim>::n_gauss> on_place;
        for (const Action &action : actions)
          {
            const unsigned int i   = element.partners[action.partner];
            auto              &sum = sums[i];
            for (unsigned int a = 0; a < dim; ++a)
              sum[a] += action.force[a];
            const Tensor<1, 3> moment =
              interactions[i]->partner->moment(action.y,
                                               action.force,
                                               step.has_inertia);
            for (unsigned int a = 0; a < 3; ++a)
              sum[dim + a] += moment[a];
            on_place[action.gauss_point] += action.force;
            forces.set_next(key,
                            action.gauss_point,
                            on_place[action.gauss_point]);
            if (action.kept < 1 || action.remembered.norm_square() > 0)
              memory.set_next(key,
                              action.gauss_point,
                              action.remembered,
                              action.kept);
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



  template <int dim>
  std::string
  InteractionTerm<dim>::objection(const StepContext<dim> &step,
                                  const NodalField       &unknowns) const
  {
    update_partners(step, unknowns);
    const NodalUnknowns<dim> nodal(step, unknowns);
    std::vector<double>      depths(interactions.size());
    for (const FaceElement &element : faces)
      {
        const auto      &face = surface.faces()[element.face];
        const auto       N = points->stencil(grid->geometry(), face.k, face.q);
        const Point<dim> x = points->location(grid->geometry(), face.k, face.q);
        std::array<typename Partner<dim>::Way, dim + 1> corners;
        Tensor<1, dim>                                  opposite;
        for (unsigned int c = 0; c <= dim; ++c)
          {
            const Tensor<1, dim> r =
              c < dim ? points->F[face.q] * face.corners[c] : opposite;
            opposite -= r;
            corners[c] = {{x + r, x + r}};
            for (unsigned int I = 0; I < N.n_nodes; ++I)
              corners[c][1] +=
                (N.shape[I] + N.gradient[I] * r) * nodal.increment(N.vertex[I]);
          }
        for (const unsigned int i : element.partners)
          if (interactions[i]->law->is_unilateral())
            depths[i] =
              std::max(depths[i], interactions[i]->partner->depth(corners));
      }
    Utilities::MPI::max(depths, step.grid.communicator(), depths);
    for (unsigned int i = 0; i < depths.size(); ++i)
      if (depths[i] > 0)
        return "<" + interactions[i]->partner_name + "> is " +
               rounded(depths[i]) + " m deep in <" + interactions[i]->body +
               ">, from where contact can't push it out (<" +
               interactions[i]->section +
               ">): let them be apart at t = 0, or take smaller steps";
    return {};
  }



  template <int dim>
  void
  InteractionTerm<dim>::advance(const StepContext<dim> & /*step*/,
                                const NodalField & /*unknowns*/)
  {
    memory.accept();
    forces.accept();
  }



  template <int dim>
  std::string
  InteractionTerm<dim>::save_state() const
  {
    const MPI_Comm    comm  = grid->communicator();
    const std::string first = memory.save(comm);
    return std::to_string(first.size()) + '\n' + first + forces.save(comm);
  }



  template <int dim>
  void
  InteractionTerm<dim>::load_state(const std::string &state)
  {
    const std::size_t line = state.find('\n');
    if (line == std::string::npos)
      return;
    const std::size_t size = std::stoul(state);
    memory.load(state.substr(line + 1, size));
    forces.load(state.substr(line + 1 + size));
  }



  template void
  InteractionTerm<2>::advance(const StepContext<2> &, const NodalField &);
  template std::string
  InteractionTerm<2>::save_state() const;
  template void
  InteractionTerm<2>::load_state(const std::string &);
  template std::string
  InteractionTerm<2>::objection(const StepContext<2> &,
                                const NodalField &) const;
  template void
  InteractionTerm<3>::advance(const StepContext<3> &, const NodalField &);
  template std::string
  InteractionTerm<3>::save_state() const;
  template void
  InteractionTerm<3>::load_state(const std::string &);
  template std::string
  InteractionTerm<3>::objection(const StepContext<3> &,
                                const NodalField &) const;
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
