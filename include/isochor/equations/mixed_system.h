/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mixed_system_h
#define isochor_mixed_system_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/constraint_forces.h>
#include <isochor/equations/equation_layout.h>
#include <isochor/equations/nodal_constraints.h>
#include <isochor/equations/tied_elements.h>
#include <isochor/linear_solver/sparse_system.h>

#include <vector>

namespace isochor
{
  /**
   * The algebraic system of the free unknowns at the active nodes, whose
   * elements add up at known places (EquationLayout). Constrained unknowns have
   * no
   * equation; what they contribute goes to the right-hand side. Neither have
   * those that follow others (see NodalConstraints): their rows and columns,
   * and the forces on them, go to the unknowns that they follow.
   */
  template <int dim>
  class MixedSystem
  {
  public:
    MixedSystem(const ActiveNodes<dim> &nodes);

    /**
     * Number the equations and lay out the matrix. Nothing is done if neither
     * the active nodes (@p nodes_changed), the elements nor the constraints
     * have changed since the last call; then the solver keeps its analysis.
     * Whether anything was done. Collective.
     */
    bool
    reinit(const bool              nodes_changed,
           const unsigned int      n_components,
           const ElementNodes     &elements,
           const NodalConstraints &constraints,
           const bool              symmetric);

    /** Whether the same unknowns are free, held, or follow the same others as
     * in the last call of reinit(), on this rank. */
    bool
    fits(const NodalConstraints &constraints) const
    {
      return constrained == constraints.constrained &&
             tied.followers().same_structure(constraints.followers);
    }

    /** Zero the residual, and matrix and lifting if @p with_matrix. */
    void
    start_assembly(const bool with_matrix);

    /**
     * Add an element's residual (n_dofs) and, if not null, matrix (n_dofs x
     * n_dofs by rows; of a symmetric one the upper triangle is read).
     * @p pending holds per nodal unknown the part of the prescribed increments
     * that is still to come; their columns go to the right-hand side.
     */
    void
    add_element(const unsigned int e,
                const double      *element_residual,
                const double      *element_matrix,
                const NodalField  &pending);

    /** Add an element's matrix alone, with nothing to come. Also after
     * finish_assembly(). */
    void
    add_matrix(const unsigned int e, const double *element_matrix);

    /** Sum the residual over ranks, subtract the dead loads @p external_force
     * (summed up), and move what acts on followers to those they follow. */
    void
    finish_assembly(const NodalField &external_force);

    /** The force (N; component dim: the volume defect) that was moved away from
     * a follower, if it is this rank's and @p entry is one. Valid after
     * finish_assembly(). */
    double
    follower_force(const unsigned int entry) const
    {
      const unsigned int k = tied.follower(entry);
      return k == TiedElements::none ? 0. : tied.force(k);
    }

    bool
    follows(const unsigned int entry) const
    {
      return tied.follower(entry) != TiedElements::none;
    }

    /** The part of a follower's increment that is prescribed for it (m), apart
     * from what it follows. */
    double
    prescribed_value(const unsigned int entry) const
    {
      return tied.followers().value[tied.follower(entry)];
    }

    /** follower_force(), but of ties only (NodalTies). */
    double
    tie_force(const unsigned int entry) const
    {
      const unsigned int k = tied.follower(entry);
      return k == TiedElements::none ||
                 !tied.followers().has(k, Followers::is_tie) ?
               0. :
               tied.force(k);
    }

    /** What follows what; values as in the last iteration. */
    const Followers &
    followers() const
    {
      return tied.followers();
    }

    /** λ of an equation of the constraints, see ConstraintForces. Valid after
     * finish_assembly() on the rank that owns the pivot. */
    double
    multiplier(const unsigned int equation) const
    {
      return constraint_forces.multiplier(equation);
    }

    /** The force (N) of walls and prescribed displacements on the
     * body; elsewhere the residual. Valid after finish_assembly() on owned
     * entries. */
    const NodalField &
    reaction() const
    {
      return any_equations ? reactions : residual;
    }

    /** Whether there are equations between unknowns, other than ties. */
    bool
    has_equations() const
    {
      return any_equations;
    }

    /** Whether reaction() is one there. */
    bool
    is_held(const unsigned int entry) const
    {
      return any_equations ? constraint_forces.is_held(entry) :
                             !layout.has_equation(entry);
    }

    /** Make @p vector one over the equations, if it isn't. Collective. */
    void
    shape(TrilinosWrappers::MPI::Vector &vector) const;

    /** rhs = - residual - (columns of pending increments), free unknowns. */
    void
    right_hand_side(TrilinosWrappers::MPI::Vector &rhs) const;

    /** Write the solution to the free unknowns of @p field, add what follows
     * from it to the followers, keep the others, and update ghosts. */
    void
    to_nodes(const TrilinosWrappers::MPI::Vector &solution,
             NodalField                          &field) const;

    /** Set those followers of @p field, ghosts updated, for which nothing is
     * prescribed by those that they follow; ghosts too. */
    void
    interpolate_followers(NodalField &field) const;

    /** Equation of an entry of a nodal field, local number, or invalid. */
    unsigned int
    equation(const unsigned int entry) const
    {
      return layout.equation(entry);
    }

    /** Its values are those of the last assembly, empty once a linear solver
     * has freed them. */
    const SparseSystem &
    matrix() const
    {
      return system;
    }
    SparseSystem &
    matrix()
    {
      return system;
    }

    /** Residual at all active nodes, prescribed ones included: there it is
     * the force that holds them. Valid after finish_assembly() on owned
     * entries. */
    NodalField residual;

  private:
    /** Add the columns of what is @p pending. */
    void
    add_lifting(const unsigned int *const node,
                const unsigned int        n_nodes,
                const double *const       matrix,
                const NodalField         &pending);

    const ActiveNodes<dim>    &nodes;
    unsigned int               n_components = 0;
    ElementNodes               elements;
    std::vector<unsigned char> constrained;
    TiedElements               tied;
    ConstraintForces           constraint_forces;
    /** On any rank. */
    bool any_followers = false, any_equations = false;

    SparseSystem        system;
    EquationLayout<dim> layout;
    NodalField          lifting;
    /** If there are equations between unknowns. */
    NodalField reactions;
  };
} // namespace isochor

#endif
