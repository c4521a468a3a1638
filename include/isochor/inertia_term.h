/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_inertia_term_h
#define isochor_inertia_term_h

#include <isochor/boundary_condition.h>
#include <isochor/equation_term.h>

#include <memory>

namespace isochor
{
  /**
   * Inertia with lumped nodal masses and Newmark's scheme (P, Section 4):
   *   R_u,I = m_I a_I,  a_I = (Δu_I - Δt v_I) / (β Δt²) - (1/(2β) - 1) a_n,I,
   * v_I and a_n,I mapped from the points with their masses. Only present in
   * dynamic scenes.
   */
  template <int dim>
  class InertiaTerm : public EquationTerm<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** Whether the scene is dynamic; reads β and γ. */
    bool
    parse_parameters(ParameterHandler &prm);

    /** Map masses, velocities and accelerations to the nodes. Collective. */
    void
    start_step(const StepContext<dim> &step);

    /** The accelerations of the points at the start of the first step, from the
     * forces of the boundary conditions at the nodes that these leave free.
     * Collective. */
    void
    set_initial_acceleration(
      const StepContext<dim>                                     &step,
      const std::vector<std::unique_ptr<BoundaryCondition<dim>>> &conditions,
      const NodalConstraints                                     &constraints,
      const NodalField                                           &unknowns,
      PointArrays<dim>                                           &points) const;

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;

    /** The acceleration at a local node that belongs to @p unknowns. */
    Tensor<1, dim>
    acceleration(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      node) const;

    /** v_{n+1} = v_n + Δt ((1 - γ) a_n + γ a_{n+1}) of a point. */
    Tensor<1, dim>
    velocity(const Tensor<1, dim> &old_velocity,
             const Tensor<1, dim> &old_acceleration,
             const Tensor<1, dim> &acceleration,
             const double          step_size) const
    {
      return old_velocity + step_size * ((1 - gamma) * old_acceleration +
                                         gamma * acceleration);
    }

    /** Velocity (m/s) of the body at t = 0, formulas in x, y(, z). */
    std::string initial_velocity;

  private:
    double beta = 0.25, gamma = 0.5;
    /** Per node: mass, then dim components of velocity and acceleration. */
    NodalField                    mapped;
    static constexpr unsigned int n_mapped = 1 + 2 * dim;
  };
} // namespace isochor

#endif
