/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_condition_roles_h
#define isochor_condition_roles_h

#include <isochor/equations/equation_term.h>
#include <isochor/grid/prescribed_motion.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /** How far a condition has moved a boundary of the grid. */
  struct BoundaryPush
  {
    /** As a component: along the normal into the grid. */
    static constexpr unsigned int along_normal = -1;

    std::string  boundary, condition; ///< its name, and what says so
    unsigned int component;
    /** The least and the most, beyond what moves the grid (m). */
    std::array<double, 2> ways;
  };

  /** A boundary condition that prescribes unknowns of nodes or adds equations
   * between them. */
  template <int dim>
  class ConstrainsNodes
  {
  public:
    virtual ~ConstrainsNodes() = default;

    /** Prescribe increments of nodal unknowns over the step, or add linear
     * equations between them. */
    virtual void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const = 0;

    /** Vertices whose displacements constrain() may determine, ahead of what is
     * periodic. */
    virtual std::vector<unsigned int>
    held_vertices() const
    {
      return {};
    }

    /** What it has done with boundaries up to the start of the step. */
    virtual std::vector<BoundaryPush>
    pushes(const StepContext<dim> & /*step*/) const
    {
      return {};
    }

    /** Append the formulas that prescribe displacements (m), see
     * MotionStarts. */
    virtual void
    append_motions(std::vector<Expression<dim>> & /*motions*/) const
    {}
  };



  /** A boundary condition with unknowns of its own, see ControlNode. */
  template <int dim>
  class HasControlNodes
  {
  public:
    virtual ~HasControlNodes() = default;

    /** As many as ever, as they are at the start of the step. All ranks alike.
     */
    virtual std::vector<ControlNode<dim>>
    control_nodes() const = 0;
    /** Once, before the first step: control_nodes() are those of the step from
     * number @p first on, see ActiveNodes::control_vertex(). */
    virtual void
    set_first_control_node(const unsigned int first) = 0;

    /** The touched @p vertices of this rank are known: add those that the
     * equations of the condition need on this rank, for nodes that this rank
     * touches and for those it owns and others touch. @p nodes are those of the
     * last step. Collective. */
    virtual void
    touch_masters(const ActiveNodes<dim>    &nodes,
                  std::vector<unsigned int> &vertices) = 0;
  };



  /** A boundary condition that acts on the body by what it assembles. */
  template <int dim>
  class ActsByAssembly
  {
  public:
    virtual ~ActsByAssembly() = default;

    /** A step begins, or an attempt at it: find what is constant in it.
     * Collective. */
    virtual void
    prepare(const StepContext<dim> & /*step*/)
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

    /** Whether assemble() sets this rank's part of the body in motion over the
     * step. The first residual of such a step is no measure of forces. */
    virtual bool
    moves_body(const StepContext<dim> & /*step*/) const
    {
      return false;
    }

    /** As ConstrainsNodes::append_motions(). */
    virtual void
    append_motions(std::vector<Expression<dim>> & /*motions*/) const
    {}

    /**
     * A trial step in dynamics begins, of size @p trial_size (positive or
     * negative, s), which looks for the initial acceleration; 0: it is over.
     * What the condition prescribes is the increment h V + h²/2 A then, with V
     * and A what a @p start with its motion_of_step() in @p step needs; in a
     * step that ends before it begins, those of the motion up to then. See
     * InertiaTerm.
     */
    virtual void
    set_trial(const StepContext<dim> & /*step*/,
              const double /*trial_size*/,
              const SmoothStart & /*start*/)
    {}

    /** Add the forces on the body (N) that assemble() accounts for, as
     * BoundaryCondition::add_external_force(): what residuals are measured
     * against; and to the pressure equation the volumes (m^3) that it leaves
     * out. */
    virtual void
    add_boundary_force(const StepContext<dim> & /*step*/,
                       const NodalField & /*unknowns*/,
                       NodalField & /*force*/) const
    {}

    /** Newton's method has found @p unknowns: why they are no solution all the
     * same, for messages, if so. Collective. */
    virtual std::string
    objection(const StepContext<dim> & /*step*/,
              const NodalField & /*unknowns*/) const
    {
      return {};
    }

    /** The step has converged and the grid may be kept: whether the next step
     * needs a reset, as what touch_vertices() has found no longer holds. The
     * same on all ranks. */
    virtual bool
    needs_reset() const
    {
      return false;
    }
  };



  /** A load that acts, in a component, on nodes alone at which this component
   * is prescribed: it goes into the support, and the body doesn't feel it. */
  struct LoadOnSupport
  {
    std::string  surface, parameter; ///< where it is, and what says so
    unsigned int component;
  };

  /** A boundary condition that knows of its loads where they act. */
  template <int dim>
  class FindsLoadsOnSupports
  {
  public:
    virtual ~FindsLoadsOnSupports() = default;

    /** Of the step that BoundaryCondition::evaluate() has looked at. */
    virtual const std::vector<LoadOnSupport> &
    loads_on_supports() const = 0;
  };



  /** A boundary condition with a mass of its own. */
  template <int dim>
  class HasMass
  {
  public:
    virtual ~HasMass() = default;

    /** Of what is free to move (J), if anything is, at the start of the step
     * or, after BoundaryCondition::advance(), at its end; the same on all
     * ranks. */
    virtual std::optional<double>
    kinetic_energy() const = 0;
  };



  /** Those of @p conditions, a list of pointers, that have a role. */
  template <typename Role, typename Conditions>
  std::vector<Role *>
  with_role(const Conditions &conditions)
  {
    std::vector<Role *> found;
    for (const auto &condition : conditions)
      if (auto *const role = dynamic_cast<Role *>(&*condition))
        found.push_back(role);
    return found;
  }
} // namespace isochor

#endif
