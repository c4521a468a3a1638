/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_forces_h
#define isochor_surface_forces_h

#include <isochor/base/expression.h>
#include <isochor/base/statistics.h>
#include <isochor/boundary_condition/condition_roles.h>
#include <isochor/equations/equation_term.h>

#include <array>
#include <string>
#include <vector>

namespace isochor
{
  /** The loads on a surface of the body, formulas in the reference position and
   * time. */
  template <int dim>
  struct SurfaceLoad
  {
    std::string                  surface;   ///< its name
    std::string                  parameter; ///< the origin, for messages
    std::string                  owner;     ///< see Statistics::set_owner()
    std::vector<Expression<dim>> traction;  ///< dim or none
    std::vector<Expression<dim>> pressure;  ///< one or none
  };

  /**
   * Loads on the surface of the body, by places b on it with reference area
   * A_b:
   *  - dead loads t per reference area: f_I = Σ_b N_I A_b t;
   *  - a follower pressure p per present area: f_I = -Σ_b N_I p a_b, with
   *    Nanson's a = det F F^{-T} A.
   * Classes derived from this know the places.
   */
  template <int dim>
  class SurfaceForces
  {
  public:
    virtual ~SurfaceForces() = default;

    using Surfaces = std::vector<const SurfaceLoad<dim> *>;

    /** A place of the surface; a stencil for NodalUnknowns. */
    struct Place
    {
      Point<dim>     X;            ///< at t = 0
      Tensor<1, dim> displacement; ///< up to the start of the step (m)
      /** A_b, outward, at t = 0 (m^(dim-1), of the plane in axisymmetry). */
      Tensor<1, dim>        area;
      Tensor<2, dim>        F; ///< at the start of the step
      unsigned int          n_nodes;
      const unsigned int   *vertex;
      std::vector<double>   shape;
      const Tensor<1, dim> *gradient; ///< ∇_n N_I
    };

    /** Append the elements of assemble(). */
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) const;

    /** Add the pressures to residual and matrix, the elements being those from
     * number @p first_element on. */
    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) const;

    /** Add the dead loads (N) to nodal forces. */
    void
    add_dead_loads(const StepContext<dim> &step, NodalField &force) const;

    /** Add what assemble() accounts for to nodal forces (N). */
    void
    add_pressures(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  NodalField             &force) const;

    /** Set the columns of all @p surfaces, and find loads on supports.
     * Collective. */
    void
    evaluate(const Surfaces         &surfaces,
             const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalConstraints &constraints,
             Statistics             &statistics) const;

    /** As evaluate() has found them, see FindsLoadsOnSupports. */
    const std::vector<LoadOnSupport> &
    loads_on_supports() const
    {
      return on_supports;
    }

  protected:
    /** How many places this rank has. */
    virtual unsigned int
    n_places() const = 0;
    virtual const SurfaceLoad<dim> &
    load_at(const unsigned int b) const = 0;
    virtual Place
    place(const unsigned int b) const = 0;

  private:
    /** The number of what place @p b has of @p surfaces. */
    unsigned int
    surface_at(const Surfaces &surfaces, const unsigned int b) const;

    /** Residual and tangent of a place, entries by node and component. */
    struct Element
    {
      std::vector<double> residual, matrix;
    };

    /** The pressure at place @p b, which has one. */
    EvaluationStatus
    evaluate_pressure(const StepContext<dim> &step,
                      const NodalField       &unknowns,
                      const unsigned int      b,
                      const Place            &at,
                      const bool              with_matrix,
                      Element                &element) const;
    /** The dead load (N), zero without. */
    Tensor<1, dim>
    dead_load(const StepContext<dim> &step,
              const unsigned int      b,
              const Place            &at) const;
    /** The force of dead load and pressure on the body (N). */
    Tensor<1, dim>
    force_at(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const unsigned int      b,
             const Place            &at) const;

    mutable std::vector<LoadOnSupport> on_supports;
  };
} // namespace isochor

#endif
