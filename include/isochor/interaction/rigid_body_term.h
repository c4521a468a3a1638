/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_body_term_h
#define isochor_rigid_body_term_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/rigid_body/rigid_body.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /** A rigid body in a scene. What is free of it has its unknowns at two
   * control nodes: the increments of the displacement, and those of the
   * rotation times a length. */
  template <int dim>
  struct RigidBodyInScene
  {
    using Components = typename RigidBody<dim>::Components;

    explicit RigidBodyInScene(const std::string &section)
      : body(section)
    {}

    RigidBody<dim> body;
    /** Of the control nodes, if there are such. */
    unsigned int first_control_node = numbers::invalid_unsigned_int;
    double       arm                = 1; ///< m

    /** The entries of its components in nodal fields of a @p step; invalid
     * where the rank does not know them. */
    std::array<unsigned int, RigidBody<dim>::n_components>
    entries(const StepContext<dim> &step) const;

    /** What an increment of component @p i is as an unknown, per one. */
    double
    scale(const unsigned int i) const
    {
      return i < dim ? 1. : arm;
    }

    /** Increments of what is free, of others 0. */
    Components
    increments(const StepContext<dim> &step, const NodalField &unknowns) const;
  };



  /** The equations of the rigid bodies' free components. */
  template <int dim>
  class RigidBodyTerm : public BoundaryCondition<dim>,
                        public ConstrainsNodes<dim>,
                        public HasControlNodes<dim>,
                        public ActsByAssembly<dim>,
                        public HasMass<dim>
  {
  public:
    using Bodies = std::vector<std::shared_ptr<RigidBodyInScene<dim>>>;

    explicit RigidBodyTerm(const Bodies &bodies)
      : bodies(bodies)
    {
      this->name = "Rigid bodies";
    }

    const Bodies &
    all_bodies() const
    {
      return bodies;
    }

    std::vector<ControlNode<dim>>
    control_nodes() const override;
    void
    set_first_control_node(const unsigned int first) override;
    void
    touch_masters(const ActiveNodes<dim>    &nodes,
                  std::vector<unsigned int> &vertices) override;
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;
    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override;
    void
    set_trial(const StepContext<dim> &step,
              const double            trial_size,
              const SmoothStart      &start) override;
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
    bool
    assembles_load(const StepContext<dim> &step) const override;
    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override;
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override;
    std::optional<double>
    kinetic_energy() const override;
    std::string
    save_state() const override;
    void
    load_state(const std::string &state) override;

  private:
    static constexpr unsigned int n_components = RigidBody<dim>::n_components;

    /** Whether this rank has the equations of @p one. */
    bool
    owns(const StepContext<dim> &step, const RigidBodyInScene<dim> &one) const;

    const Bodies bodies;
    /** Whether there is a trial step in which bodies move. */
    bool in_trial = false;
  };
} // namespace isochor

#endif
