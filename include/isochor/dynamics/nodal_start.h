/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_start_h
#define isochor_nodal_start_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/dynamics/mass_matrix.h>
#include <isochor/dynamics/time_integrator.h>
#include <isochor/equations/equation_term.h>

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * What the nodes start a step with, see InertiaTerm: velocities, the
   * projection of those of the points, and accelerations, that of theirs or
   * what forces give; where displacements are prescribed those of the
   * prescribed motion.
   */
  template <int dim>
  class NodalStart
  {
  public:
    using Conditions = std::vector<std::unique_ptr<BoundaryCondition<dim>>>;

    /** See InertiaTerm. */
    void
    take_pressures(const StepContext<dim> &step, const NodalField &unknowns);
    /** Those of the forces that the step takes a mean with; else null. */
    const NodalField *
    unknowns_at_start() const
    {
      return has_mean ? &start_unknowns : nullptr;
    }

    /** Take the points as they are at the start of the step; the acceleration
     * is to be that of stresses and loads, or of the points. @p takes_mean: in
     * both cases these are what forces give, and the step is to take the mean
     * of them and those at its end. Collective. */
    void
    start_step(const StepContext<dim> &step,
               const Conditions       &conditions,
               MaterialPoints<dim>    &points,
               const bool              from_stresses,
               const bool              takes_mean);

    /**
     * Give the unknowns held by @p constraints the velocity and acceleration
     * that a @p smooth start with their motion_of_step() needs, and project to
     * the others. Has to be called whenever other unknowns are held than
     * before. @p with_projection: find @ref projected, too. Collective.
     */
    void
    prescribe(const StepContext<dim> &step,
              const Conditions       &conditions,
              const NodalConstraints &constraints,
              const SmoothStart      &smooth,
              const bool              with_projection);

    /** Let @p acceleration be what @p load, with the entries of all unknowns,
     * gives to the nodes; 0 if it is empty. Collective. */
    void
    accelerate(const StepContext<dim> &step,
               const NodalField       &load,
               NodalField             &acceleration);

    /** The root mean square over the mass of the body of a_{n+1} - a_n (m/s²)
     * where it isn't held, by @p scheme with the nodal @p unknowns. Collective.
     */
    double
    acceleration_change(const StepContext<dim> &step,
                        const NodalField       &unknowns,
                        const TimeIntegrator   &scheme) const;

    /** With the velocities of the nodes (J), this rank's part. */
    double
    kinetic_energy(const StepContext<dim> &step) const;

    MassMatrix<dim> mass;
    /** Both with dim components per node. */
    NodalField velocity, acceleration;
    /** The projection of v_p without constraints. */
    NodalField projected;
    /** Prescribed entries, of local nodes. */
    std::vector<unsigned char> held;
    /** Whether prescribe() has been called in this step. */
    bool prescribed = false;
    /** The error that the projections have left in this step, of the size of
     * what is projected. */
    double worst_projection = 0;

  private:
    /** What holds at the places of a motion_of_step(). */
    using Places = std::array<NodalConstraints, n_motion_places>;

    /** Dead loads minus internal forces at the start of the step, from the
     * stresses of the points. Collective. */
    void
    collect_forces(const StepContext<dim> &step,
                   const Conditions       &conditions,
                   MaterialPoints<dim>    &points);
    /** Add the forces that @p conditions assemble, if they are to be added, and
     * tell the conditions what there is. Collective. */
    void
    collect_boundary_forces(const StepContext<dim> &step,
                            const Conditions       &conditions);
    /** M x = load at the entries not held, from the lumped solution. */
    void
    project(const StepContext<dim>    &step,
            const NodalField          &load,
            const Followers           &followers,
            const std::vector<double> &given,
            NodalField                &solution,
            const bool                 with_domains = false);
    /** Project the accelerations of the points, or find what forces give at the
     * start of the step, where @p start holds. Collective. */
    void
    project_acceleration(const StepContext<dim> &step,
                         const Conditions       &conditions,
                         const NodalConstraints &start);
    /** What the @p conditions and @p ties demand of the unknowns a @p part of
     * the step after its start. */
    static NodalConstraints
    constraints_at(const StepContext<dim> &step,
                   const Conditions       &conditions,
                   const NodalTies        &ties,
                   const double            part);
    /** Velocities and accelerations that the followers of displacements start
     * with, by what they follow @p at the places of the step's motion. */
    static std::vector<std::pair<double, double>>
    starts_of_followers(const Places      &at,
                        const unsigned int n_components,
                        const double       dt,
                        const SmoothStart &smooth);

    bool by_stresses = false; ///< in this step
    bool has_mean    = false; ///< takes_mean
    /** Σ_p m_p N_I v_p and M a_n, with dim components per node. */
    NodalField momentum, force;
    /** The unknowns at the start of the step: no increments. */
    NodalField start_unknowns;
    /** Of velocities and accelerations. */
    Followers followers;
    /** What is given to them by prescribed motions, see MassMatrix::solve(). */
    std::vector<double> given_velocity, given_acceleration;
  };

  /** Σ N_I f_I of a point, of a @p field with dim components per node. */
  template <int dim>
  Tensor<1, dim>
  interpolate(const StepContext<dim>                   &step,
              const typename PointArrays<dim>::Stencil &stencil,
              const NodalField                         &field);
} // namespace isochor

#endif
