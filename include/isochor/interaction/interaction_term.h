/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_term_h
#define isochor_interaction_term_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/interaction/interaction_face_kernel.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * All that acts on the surface of the bodies by interactions. An element is a
   * face with all its partners (InteractionFaceKernel), or a pressure
   * (FaceLoads): its nodes are those of the face's subdomain, so that neither
   * contact nor its loss changes the pattern of the matrix.
   */
  template <int dim>
  class InteractionTerm : public BoundaryCondition<dim>,
                          public ActsByAssembly<dim>,
                          public FindsLoadsOnSupports<dim>
  {
  public:
    /** @param loads The interactions that are loads.
     * @param walls Boundaries that each body has frictionless contact with,
     * unless there is an interaction between the two. */
    InteractionTerm(Interactions<dim>              &&interactions,
                    Interactions<dim>              &&loads,
                    const std::vector<OneSidedWall> &walls);

    /** The names of the bodies, by layer of the grid, once they are known. */
    void
    set_bodies(const std::vector<std::string> &names)
    {
      add_walls(walls, names, interactions);
      for (const auto &interaction : interactions)
        interaction->find_bodies(names);
      for (const auto &load : loads.interactions())
        load->find_bodies(names);
    }

    const std::vector<LoadOnSupport> &
    loads_on_supports() const override
    {
      return loads.loads_on_supports();
    }

    const FaceLoads<dim> &
    given() const
    {
      return loads;
    }
    InteractionFaces<dim> &
    in_contact()
    {
      return faces;
    }

    /** Whether surfaces may leave what they touch. */
    bool
    may_let_go() const
    {
      for (const auto &interaction : interactions)
        if (interaction->law->is_unilateral())
          return true;
      return false;
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      this->grid = &grid;
      for (const auto &interaction : interactions)
        {
          interaction->partner->initialize(grid);
          interaction->find_place(grid);
        }
      for (const auto &load : loads.interactions())
        load->find_place(grid);
    }
    void
    set_body(const BodyShape<dim> & /*shape*/,
             const PointArrays<dim> &points) override
    {
      this->points = &points;
    }
    std::string
    describe() const override
    {
      return faces.describe();
    }
    void
    touch_vertices(std::vector<unsigned int> & /*vertices*/) override
    {
      find_faces();
    }
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;
    /** Find γ and the adjoint of the step. */
    void
    prepare(const StepContext<dim> &step) override;
    void
    set_trial(const StepContext<dim> &step,
              const double            trial_size,
              const SmoothStart      &start) override
    {
      for (const auto &interaction : interactions)
        interaction->partner->set_trial(
          {step.old_time, step.time, trial_size, start});
    }
    void
    append_motions(std::vector<Expression<dim>> &motions) const override
    {
      for (const auto &interaction : interactions)
        interaction->partner->append_motions(motions);
    }
    void
    note_start(const StepContext<dim> &start,
               const NodalField       &unknowns,
               const NodalField       &forces) override;
    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;
    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      loads.add_dead_loads(step, force);
    }
    void
    add_unit_residual(const StepContext<dim> &step,
                      NodalField             &scale) const override;
    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override;
    bool
    has_symmetric_matrix() const override
    {
      return interactions.empty() && walls.empty() && !loads.have_pressures();
    }
    bool
    assembles_load(const StepContext<dim> & /*step*/) const override
    {
      return loads.have_pressures();
    }
    bool
    moves_body(const StepContext<dim> &step) const override
    {
      return !faces.all().empty() &&
             std::any_of(interactions.begin(),
                         interactions.end(),
                         [&](const auto &one) {
                           return one->law->is_unilateral() ||
                                  one->partner->moves(step);
                         });
    }
    /** Contact that was missed: what is behind the surface is in a partner. */
    std::string
    objection(const StepContext<dim> &step,
              const NodalField       &unknowns) const override;
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> & /*step*/,
            const NodalField & /*unknowns*/) override
    {
      history.accept();
    }
    std::string
    save_state() const override
    {
      return history.save(grid->communicator());
    }
    void
    load_state(const std::string &state) override
    {
      history.load(state);
    }

  private:
    using Action = typename InteractionFaceKernel<dim>::Action;

    void
    update_partners(const StepContext<dim> &step,
                    const NodalField       &unknowns) const
    {
      for (const auto &interaction : interactions)
        interaction->partner->update(step, unknowns);
    }
    /** The faces that take part, as they are at the start of the step.
     * Collective. */
    void
    find_faces()
    {
      faces.find(*grid, *points, loads);
      history.send(faces.surface(), grid->communicator());
    }
    /** The force (N) and the moment (N m; in 2D the third component) on the
     * body by each interaction, of all ranks. Notes what is remembered, too. */
    std::vector<std::array<double, dim + 3>>
    resultants(const StepContext<dim> &step, const NodalField &unknowns) const;
    void
    set_nodes(const StepContext<dim>     &step,
              const InteractionFace<dim> &face,
              std::vector<unsigned int>  &nodes) const;

    Interactions<dim>                  interactions;
    FaceLoads<dim>                     loads;
    const std::vector<OneSidedWall>    walls;
    const BackgroundGrid<dim>         *grid   = nullptr;
    const PointArrays<dim>            *points = nullptr;
    InteractionFaces<dim>              faces;
    mutable InteractionHistory<dim>    history;
    mutable InteractionFaceKernel<dim> kernel;
  };
} // namespace isochor

#endif
