/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_forces_h
#define isochor_surface_forces_h

#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/boundary_condition/surface_conditions.h>

namespace isochor
{
  /**
   * Loads on the surface of the body, by boundary points b with reference area
   * A_b:
   *  - dead loads t per reference area: f_I = Σ_b N_I A_b t;
   *  - a follower pressure p per present area: f_I = -Σ_b N_I p a_b.
   * Formulas are in the reference position.
   */
  template <int dim>
  class SurfaceForces
  {
  public:
    /** Both are kept by reference. */
    SurfaceForces(const SurfaceConditions<dim> &conditions,
                  const BoundaryPoints<dim>    &points)
      : conditions(conditions)
      , points(points)
    {}

    /** Residual and tangent of one point; room for any number of nodes. */
    struct PointElement
    {
      std::vector<double> residual, matrix;

      void
      reinit(const unsigned int n_dofs, const bool with_matrix)
      {
        residual.assign(n_dofs, 0.);
        if (with_matrix)
          matrix.assign(n_dofs * n_dofs, 0.);
      }
    };

    const SurfaceCondition<dim> &
    condition_at(const unsigned int b) const
    {
      return conditions.surfaces[points.surface(b)];
    }

    /** Whether point @p b adds to the matrix; dead loads don't. */
    bool
    has_element(const unsigned int b) const
    {
      return !condition_at(b).pressure.empty();
    }

    /** The pressure at point @p b, which has one, entries by node and
     * component. */
    EvaluationStatus
    evaluate_point(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const unsigned int      b,
                   const bool              with_matrix,
                   PointElement           &element) const;

    /** The force of the loads at point @p b, dead ones and pressures, on the
     * body (N). */
    Tensor<1, dim>
    load(const StepContext<dim> &step,
         const NodalField       &unknowns,
         const unsigned int      b) const;

    /** Add the dead loads (N) to nodal forces. */
    void
    add_dead_loads(const StepContext<dim> &step, NodalField &force) const;

  private:
    /** A_b at t = 0 (m^(dim-1); in axisymmetry m^2, of the ring). */
    double
    area(const StepContext<dim> &step, const unsigned int b) const;
    /** The dead load at a point (N), zero without. */
    Tensor<1, dim>
    dead_load(const StepContext<dim> &step, const unsigned int b) const;
    const SurfaceConditions<dim> &conditions;
    const BoundaryPoints<dim>    &points;
  };
} // namespace isochor

#endif
