/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_forces_h
#define isochor_surface_forces_h

#include <isochor/boundary_points.h>
#include <isochor/surface_conditions.h>

namespace isochor
{
  /**
   * Forces on the surface of the body, by boundary points b with reference area
   * A_b:
   *  - dead loads t per reference area: f_I = Σ_b N_I A_b t;
   *  - a follower pressure p per present area: f_I = -Σ_b N_I p a_b;
   *  - prescribed displacements ū by a penalty, component by component,
   *    f_I = -Σ_b N_I β (G/h) A_b (u_b - ū), u_b the total displacement of the
   *    point. The force of a surface on the body is Σ_b of that.
   * Formulas are in the reference position.
   */
  template <int dim>
  class SurfaceForces
  {
  public:
    /** Both are kept by reference. */
    SurfaceForces(const SurfaceConditions<dim> &conditions,
                  BoundaryPoints<dim>          &points)
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

    /** Give the points that need it the G of their penalty: that of the body
     * or, if it consists of several materials, the mean by volume around the
     * point's nodes. After the points are located. Collective. */
    void
    find_shear_moduli(const StepContext<dim> &step) const;

    const SurfaceCondition<dim> &
    condition_at(const unsigned int b) const
    {
      return conditions.surfaces[points.surface(b)];
    }

    /** Whether point @p b adds to the matrix; dead loads don't. */
    bool
    has_element(const unsigned int b) const
    {
      return condition_at(b).is_fixed() || !condition_at(b).pressure.empty();
    }

    /** The penalty's force on the body (N). */
    Tensor<1, dim>
    penalty_force(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const unsigned int      b) const;

    /** Penalty and pressure at point @p b, entries by node and component. */
    EvaluationStatus
    evaluate_point(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const unsigned int      b,
                   const bool              with_matrix,
                   PointElement           &element) const;

    /** Add the dead loads (N) to nodal forces. */
    void
    add_dead_loads(const StepContext<dim> &step, NodalField &force) const;

  private:
    /** β G/h A_b at a point. */
    double
    stiffness(const unsigned int b) const;
    Tensor<1, dim>
    displacement(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b) const;
    void
    add_penalty(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const unsigned int      b,
                const bool              with_matrix,
                PointElement           &element) const;
    EvaluationStatus
    add_pressure(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b,
                 const bool              with_matrix,
                 PointElement           &element) const;

    const SurfaceConditions<dim> &conditions;
    BoundaryPoints<dim>          &points;
  };
} // namespace isochor

#endif
