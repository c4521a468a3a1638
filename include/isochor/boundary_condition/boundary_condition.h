/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_boundary_condition_h
#define isochor_boundary_condition_h

#include <isochor/base/named_plugin.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/statistics.h>
#include <isochor/equations/equation_term.h>
#include <isochor/grid/prescribed_motion.h>
#include <isochor/material_points/body_shape.h>

#include <string>

namespace isochor
{
  /** What became of the nodes that one-sided conditions hold; the same on all
   * ranks. */
  struct ContactChange
  {
    bool        any = false; ///< nodes were released, or are held now
    std::string failure;     ///< why the search is to be given up, if it is
  };

  /** The nodes that a wall holds. */
  template <int dim>
  struct WallContacts
  {
    /** The same on all ranks but for the force. */
    struct Node
    {
      unsigned int   vertex;
      Tensor<1, dim> normal; ///< from the wall towards the body
      double         force;  ///< N, on the rank that owns the node; elsewhere 0
      double distance = 0;   ///< of the node from the wall along the normal (m)
    };

    std::string       parameter, boundary;
    std::vector<Node> nodes;
    bool              holds = false; ///< it also pulls
  };



  /**
   * Interface of the boundary conditions and loads. To add one, write
   * `source/boundary_condition/<name>.cc` with the class and its registration.
   * Its parameters live in the subsection "Boundary conditions"; a condition
   * whose parameters are left empty does nothing.
   */
  template <int dim>
  class BoundaryCondition : public EquationTerm<dim>, public NamedPlugin
  {
  public:
    BoundaryCondition()
      : NamedPlugin("Boundary conditions")
    {}

    /** For those that have none. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Look up boundary names and the like, after the grid is made; and again
     * when it has been replaced, unless grid_changed() does something else. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The grid has been replaced (BackgroundGrid::change()): cells and
     * vertices have other numbers. @p at_start: there was no step yet. By
     * default initialize() is called once more. Collective. */
    virtual void
    grid_changed(const BackgroundGrid<dim> &grid, const bool /*at_start*/)
    {
      initialize(grid);
    }

    /** The cells have got other owners (BackgroundGrid::set_owners()), with the
     * numbers that they had, and so have the vertices: bring what is kept by
     * rank to where it belongs now. What all ranks know alike stays as it is,
     * and BoundaryPoints find their ranks by themselves. Collective. */
    virtual void
    owners_changed(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** For conditions on the body: where it is at t = 0, and its points, which
     * are set up anew before touch_vertices() is called. Both outlive this
     * object. Once, before initialize(). */
    virtual void
    set_body(const BodyShape<dim> & /*shape*/,
             const PointArrays<dim> & /*points*/)
    {}

    /** Whether parse_parameters() has found a boundary that only pushes, which
     * the body may leave and come to again. See why_to_reset(). */
    bool
    only_pushes() const
    {
      return pushes_only;
    }

    /** The first step is set up: what it acts on, in lines for the terminal, if
     * the parameters alone don't say it. The same on all ranks. */
    virtual std::string
    describe() const
    {
      return {};
    }

    /** The first step is set up: warn of what can't be meant, as parts of the
     * parameters that act on nothing. See boundary_checks.h. Collective. */
    virtual void
    check_scene(const StepContext<dim> & /*step*/) const
    {}

    /** Unknowns of the condition's own, see ControlNode: as many as ever, as
     * they are at the start of the step. All ranks alike. */
    virtual std::vector<ControlNode<dim>>
    control_nodes() const
    {
      return {};
    }
    /** Once, before the first step: control_nodes() are those of the step from
     * number @p first on, see ActiveNodes::control_vertex(). */
    virtual void
    set_first_control_node(const unsigned int /*first*/)
    {}

    /** The touched @p vertices of this rank are known: add those that the
     * equations of constrain() need on this rank, for nodes that this rank
     * touches and for those it owns and others touch. @p nodes are those of the
     * last step. Collective. */
    virtual void
    touch_masters(const ActiveNodes<dim> & /*nodes*/,
                  std::vector<unsigned int> & /*vertices*/)
    {}

    /** Vertices whose displacements constrain() may determine, ahead of what is
     * periodic. */
    virtual std::vector<unsigned int>
    held_vertices() const
    {
      return {};
    }
    /** What held_vertices() of all conditions name, sorted: once they are
     * initialised, and when the grid has changed. */
    virtual void
    set_held_vertices(const std::vector<unsigned int> & /*vertices*/)
    {}

    /** Where evaluate() puts the force through @p boundary, if it isn't in its
     * nodes' reactions: the name of the column, with x for the component. */
    virtual std::string
    force_column(const std::string & /*boundary*/) const
    {
      return {};
    }

    /** Material points have left the grid as it was put back, through
     * @p boundaries: what of this condition may be the cause, for the message.
     * @p step is the one that would begin. The same on all ranks. */
    virtual std::string
    why_points_left(const StepContext<dim> & /*step*/,
                    const std::vector<std::string> & /*boundaries*/) const
    {
      return {};
    }

    /** Vertices that are not to be tied for want of material, see
     * DiscreteExtension::exempt(). */
    virtual std::vector<unsigned int>
    vertices_never_tied() const
    {
      return {};
    }

    /** Prescribe increments of nodal unknowns over the step, or add linear
     * equations between them. */
    virtual void
    constrain(const StepContext<dim> & /*step*/,
              NodalConstraints & /*constraints*/) const
    {}

    /** Whether there are equations whose coefficients change with the unknowns
     * (Equation::changes). */
    virtual bool
    relinearises() const
    {
      return false;
    }
    /** Linearise these equations at @p unknowns: change their coefficients,
     * and their value such that they hold where what is prescribed has come in
     * altogether. Not in trial steps of dynamics. */
    virtual void
    relinearise(const StepContext<dim> & /*step*/,
                const NodalField & /*unknowns*/,
                NodalConstraints & /*constraints*/) const
    {}

    /** After the assembly of a matrix: add what comes from the curvature of
     * these equations, multiplier times second derivative, to elements that
     * collect_elements() has named, from @p first_element on, by
     * MixedSystem::add_matrix(). */
    virtual void
    add_constraint_stiffness(const StepContext<dim> & /*step*/,
                             const NodalField & /*unknowns*/,
                             const NodalConstraints & /*constraints*/,
                             const unsigned int /*first_element*/,
                             MixedSystem<dim> & /*system*/) const
    {}

    /** Of an equation of this condition that changes: what is added to its
     * value for accelerations at the start of the step, given the nodal
     * velocities (dim per node): for a rotation, that towards its axis. */
    virtual double
    convective_acceleration(
      const StepContext<dim> & /*step*/,
      const NodalField & /*velocity*/,
      const NodalConstraints & /*constraints*/,
      const NodalConstraints::Equation & /*equation*/) const
    {
      return 0.;
    }

    /** Before the first start_contact() of a step or of an attempt at it: look
     * where the body is. Collective. */
    virtual void
    prepare_contact(const StepContext<dim> & /*step*/)
    {}

    /** In dynamics, where a step starts with the acceleration of the forces:
     * @p unknowns are those at its start, without increments, with what
     * pressures the nodes of its grid can have, and @p forces those that all
     * conditions then have by add_boundary_force(). @p start is the step that
     * ends there. Collective. */
    virtual void
    note_start(const StepContext<dim> & /*start*/,
               const NodalField & /*unknowns*/,
               const NodalField & /*forces*/)
    {}

    /** The search for the contact nodes of a step begins, or begins again
     * after a failure: with those of the last step that was accepted. */
    virtual void
    start_contact()
    {}

    /** What check_contact() compares with zero. */
    struct ContactTolerance
    {
      double force;    ///< N
      double relative; ///< of penetrations to displacements of the step
      /** Whether Newton's method has, or the unknowns are those of an iterate
       * on the way. */
      bool converged;
    };

    /** Newton's method has converged, or made an iteration: change what
     * constrain() will prescribe where a one-sided condition is violated. The
     * forces of the boundary on the body are the residual of @p system where
     * unknowns are prescribed (N), and its multiplier() for equations of @p
     * constraints. Nodes that follow others (ties) because hardly any material
     * touches them may go through a wall: where they are the body isn't.
     * Collective. */
    virtual ContactChange
    check_contact(const StepContext<dim> & /*step*/,
                  const NodalField & /*unknowns*/,
                  const MixedSystem<dim> & /*system*/,
                  const NodalConstraints & /*constraints*/,
                  const ContactTolerance & /*tolerance*/)
    {
      return {};
    }

    /** Newton's method has converged with the right nodes in contact: whether
     * what assemble() prescribes has to be corrected, and the solution with it,
     * since it brings the body to another place than was meant. The same on all
     * ranks. Collective. */
    virtual bool
    correct(const StepContext<dim> & /*step*/, const NodalField & /*unknowns*/)
    {
      return false;
    }

    /** The step has converged: append the nodes that walls hold, by
     * wall; see check_early_contact(). */
    virtual void
    append_contacts(const StepContext<dim> & /*step*/,
                    const MixedSystem<dim> & /*system*/,
                    const NodalConstraints & /*constraints*/,
                    std::vector<WallContacts<dim>> & /*walls*/) const
    {}

    /** Add the dead loads at the end of the step (N) from this rank's cells,
     * entry n_components * node + component. */
    virtual void
    add_external_force(const StepContext<dim> & /*step*/,
                       NodalField & /*force*/) const
    {}

    /** The part of the dead loads that acts on all mass alike (m/s²), at
     * @p time. The stabilisation of the pressure leaves out what is in
     * equilibrium with it. */
    virtual Tensor<1, dim>
    body_acceleration(const double /*time*/) const
    {
      return {};
    }

    /** Whether what assemble() adds is symmetric. */
    virtual bool
    has_symmetric_matrix() const
    {
      return true;
    }

    /** Whether assemble() adds a load, which add_external_force() doesn't show:
     * one that turns with the body, such as a pressure. The same on all ranks.
     */
    virtual bool
    assembles_load(const StepContext<dim> & /*step*/) const
    {
      return false;
    }

    /** Whether assemble() can hold the body up against @p gravity. */
    virtual bool
    supports_body(const Tensor<1, dim> & /*gravity*/) const
    {
      return false;
    }

    /** Whether assemble() sets this rank's part of the body in motion over the
     * step. The first residual of such a step is no measure of forces. */
    virtual bool
    moves_body(const StepContext<dim> & /*step*/) const
    {
      return false;
    }

    /** Append what the condition prescribes at @p step.time to @p values,
     * displacements (m), whether it holds at the moment or not; only how they
     * change with the time counts. Always in the same order. This rank's. */
    virtual void
    append_motion(const StepContext<dim> &step,
                  std::vector<double>    &values) const
    {
      NodalConstraints constraints;
      constraints.reinit(step.nodes.n_local() * step.n_components,
                         step.nodes.control_entries(step.n_components));
      constrain(step, constraints);
      for (unsigned int i = 0; i < constraints.increment.size(); ++i)
        if (constraints.constrained[i] != NodalConstraints::is_free)
          values.push_back(constraints.increment[i]);
      for (const auto &equation : constraints.equations)
        values.push_back(equation.value);
    }

    /**
     * For conditions that move_body(): a trial step in dynamics begins, of size
     * @p trial_size (positive or negative, s), which looks for the initial
     * acceleration; 0: it is over. What the condition prescribes is the
     * increment h V + h²/2 A then, with V and A what a @p start with its
     * motion_of_step() in @p step needs; in a step that ends before it begins,
     * those of the motion up to then. See InertiaTerm.
     */
    virtual void
    set_trial(const StepContext<dim> & /*step*/,
              const double /*trial_size*/,
              const SmoothStart & /*start*/)
    {}

    /** In a trial: whether what is prescribed on this rank's part of the body
     * has another velocity than the body, which has @p velocity (dim per node).
     */
    virtual bool
    starts_suddenly(const StepContext<dim> & /*step*/,
                    const NodalField & /*velocity*/) const
    {
      return false;
    }

    /** Add the forces on the body (N) that assemble() accounts for, as
     * add_external_force(): what residuals are measured against. */
    virtual void
    add_boundary_force(const StepContext<dim> & /*step*/,
                       const NodalField & /*unknowns*/,
                       NodalField & /*force*/) const
    {}

    /** The step has converged: set columns of the statistics. Collective. */
    virtual void
    evaluate(const StepContext<dim> & /*step*/,
             const NodalField & /*unknowns*/,
             const MixedSystem<dim> & /*system*/,
             const NodalConstraints & /*constraints*/,
             Statistics & /*statistics*/) const
    {}

    /** The step has converged: follow the body. Collective. */
    virtual void
    advance(const StepContext<dim> & /*step*/, const NodalField & /*unknowns*/)
    {}

    /** The step has converged and the grid may be kept: whether the next step
     * needs a reset, as what touch_vertices() has found no longer holds. The
     * same on all ranks. */
    virtual bool
    needs_reset() const
    {
      return false;
    }

    /** What has to survive a restart, the same text on all ranks. Collective.
     */
    virtual std::string
    save_state() const
    {
      return {};
    }
    /** Called on all ranks, after initialize(). */
    virtual void
    load_state(const std::string & /*state*/)
    {}

  protected:
    bool pushes_only = false; ///< see only_pushes()
  };
} // namespace isochor

#endif
