/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_equation_term_h
#define isochor_equation_term_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/mixed_kernel.h>
#include <isochor/equations/mixed_system.h>
#include <isochor/material_points/material_points.h>

namespace isochor
{
  /** What every part of a step needs to know of it. */
  template <int dim>
  struct StepContext
  {
    const BackgroundGrid<dim> &grid;
    const ActiveNodes<dim>    &nodes;
    const PointArrays<dim>    &points;
    const MixedKernel<dim>    &kernel;
    /** dim in the u form, dim + 1 in the u-p form. */
    unsigned int n_components;
    double       old_time;
    double       time;
    /** Whether the grid is still the one that the last step has deformed; see
     * GridReset. */
    bool grid_is_kept = false;
    /** Dynamics, not statics. */
    bool has_inertia = false;
    /** Of a step that starts with the forces of stresses, and takes the mean of
     * those and the ones at its end: what they come from. Else null. */
    const NodalField *unknowns_at_start = nullptr;
    /** The share m that forces at the end of the step have in it, those at its
     * start having 1 - m. */
    double end_weight = 0.5;

    bool
    mixed() const
    {
      return n_components == dim + 1;
    }
    double
    step_size() const
    {
      return time - old_time;
    }
  };

  /**
   * A part of the discrete equations: the body itself, inertia, a penalty, a
   * follower load. A term names its elements (lists of active nodes) at the
   * start of a step and adds their residuals and matrices in each iteration.
   * The nodal unknowns are the displacement increment of the step and, as
   * component dim, the pressure.
   */
  template <int dim>
  class EquationTerm
  {
  public:
    virtual ~EquationTerm() = default;

    /** Add to @p vertices those whose nodes the term needs active. */
    virtual void
    touch_vertices(std::vector<unsigned int> & /*vertices*/)
    {}

    /** Append this rank's elements of the coming step. */
    virtual void
    collect_elements(const StepContext<dim> & /*step*/,
                     ElementNodes & /*elements*/)
    {}

    /**
     * Add the elements, numbered from @p first_element on, to @p system.
     * @p unknowns has its ghosts updated; @p pending are the prescribed
     * increments still to come, see MixedSystem::add_element().
     */
    virtual EvaluationStatus
    assemble(const StepContext<dim> & /*step*/,
             const NodalField & /*unknowns*/,
             const NodalField & /*pending*/,
             const unsigned int /*first_element*/,
             const bool /*with_matrix*/,
             MixedSystem<dim> & /*system*/)
    {
      return EvaluationStatus::success;
    }

    /** Add residuals that, times some 1e-14, are what rounding errors leave of
     * the term's at equilibrium: Newton's method can't do better. Entries by
     * node and component, not negative. */
    virtual void
    add_unit_residual(const StepContext<dim> & /*step*/,
                      NodalField & /*scale*/) const
    {}
  };
} // namespace isochor

#endif
