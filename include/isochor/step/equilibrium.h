/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_equilibrium_h
#define isochor_equilibrium_h

#include <isochor/base/terminal.h>
#include <isochor/equations/body_term.h>
#include <isochor/equations/orthogonal_subscales.h>
#include <isochor/nonlinear_solver/newton_solver.h>
#include <isochor/step/linear_step.h>
#include <isochor/step/residual.h>
#include <isochor/transfer/last_motion.h>

#include <functional>
#include <vector>

namespace isochor
{
  /**
   * The equations of a step and their solution: the terms of the equations,
   * what the boundary conditions prescribe, the nodal unknowns (displacement
   * increments of the step and pressures) and Newton's method. Changes nothing
   * of the points.
   */
  template <int dim>
  class Equilibrium
  {
  public:
    /** All arguments are kept by reference. */
    Equilibrium(Scene<dim> &scene, StepSetup<dim> &setup, Terminal &terminal);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Once, after Scene::create(). */
    void
    initialize()
    {
      residual.terms = {&body, &subscales, &scene.inertia};
      for (auto &condition : scene.boundary_conditions)
        residual.terms.push_back(condition.get());
    }

    /** Call @p look with the first step of a run that isn't resumed, and its
     * matrix, as soon as there is one. */
    void
    look_at_first_matrix(const std::function<void(const StepContext<dim> &,
                                                  const SparseSystem &)> &look)
    {
      look_at_matrix = look;
    }

    /** The equations: their terms and loads. */
    const Residual<dim> &
    equations() const
    {
      return residual;
    }

    /** The points are set up for the step: map what they know to the nodes, and
     * lay out the system. Collective. */
    void
    start_step();

    /**
     * In dynamics, where the run or a prescribed motion starts: give the points
     * the acceleration with which the body answers what acts on it then, so
     * that it satisfies the pressure equation, and the velocity of what has to
     * follow the motion at once. Newmark's scheme starts from them, and would
     * carry an error in them along. See InertiaTerm::start_trial(). In all
     * other steps a report of success. Collective.
     */
    NewtonReport
    find_initial_acceleration();

    /** Find the equilibrium at the end of the step, from a start that goes on
     * like the last step if the parameters ask for it, and if that fails, from
     * rest. Collective. */
    NewtonReport
    solve();

    /** Evaluate the equations with their matrix where the step starts, so that
     * mistakes in the scene show. Collective. */
    void
    evaluate()
    {
      at_start = true;
      assemble(true);
    }

    /** The step has converged, without inertia: in how many modes the body is
     * not stable in its equilibrium, -1 if that isn't known. Where the last
     * factorisation says that there are some, the matrix is assembled and
     * factorised here, since that one may be of an earlier iterate or step; or
     * if it @p is_old, as of an earlier step of a run that is over now.
     * Collective. */
    long
    n_unstable_modes(const bool is_old);

    /** The step has converged: what the next one may start from. */
    void
    remember_motion();

    /** The step is tried again with another size, for which the factorisation
     * is not to be trusted. */
    void
    discard_step()
    {
      last_try_converged = false;
    }

    const NodalField &
    nodal_unknowns() const
    {
      return unknowns;
    }
    /** After solve(): by what the residual with the mean forces of the step
     * differs from that with the forces at its end alone, see
     * InertiaTerm::finish_step(); empty if they are the same. Collective. */
    NodalField
    force_of_mean()
    {
      return setup.context().unknowns_at_start != nullptr &&
                 (scene.mixed() || !with_role<const ActsByAssembly<dim>>(
                                      scene.boundary_conditions)
                                      .empty()) ?
               residual.change_without_start(unknowns) :
               NodalField();
    }
    /** Of the stabilisation in dynamics (J). Collective. */
    double
    subscale_energy() const
    {
      return subscales.energy(setup.context(), unknowns);
    }
    const MixedSystem<dim> &
    mixed_system() const
    {
      return system;
    }
    const NodalConstraints &
    nodal_constraints() const
    {
      return constraints;
    }
    const LinearStep<dim> &
    linear() const
    {
      return linear_step;
    }
    /** What a run that is resumed needs of the last step. */
    LastMotion &
    motion()
    {
      return last_motion;
    }

  private:
    /** Put where Newton's method starts without a predictor into the unknowns.
     */
    void
    set_initial_pressure();
    /** Start from the last motion, if asked for. */
    bool
    predict();
    void
    start_from_rest();
    /** The first step from its start, with other equations. */
    void
    start_again()
    {
      for (unsigned int i = 0;
           i < setup.active_nodes().n_local() * scene.n_components;
           ++i)
        if (i % scene.n_components < dim)
          unknowns.local_element(i) = 0.;
      residual.set_loads();
      start_conditions(false);
    }
    /** Without inertia, the weight whose pressure PPP leaves out. */
    void
    set_weight();
    /** Whether the step starts with the acceleration that the points carry: the
     * first one, and where stresses made on another grid would excite what the
     * step does not resolve. Collective. */
    bool
    carries_acceleration() const
    {
      return !scene.inertia.is_from_stresses() || scene.time.step == 0 ||
             (setup.was_disturbed() && steps_over_waves(setup.context()));
    }
    /** One trial step of find_initial_acceleration(). */
    NewtonReport
    try_step(const TrialStep &trial);
    /** Constrain the nodes for the step, and lay out the system for it. */
    void
    start_conditions(const bool with_other_nodes);
    /** Newton's method for the step, of which it tells the terminal.
     * @p has_other_start: see NewtonSolver::Problem. */
    NewtonReport
    solve_from_start(const bool has_other_start = false);
    /** Constrain the nodes anew; whether that made a difference on any rank. */
    bool
    constrain_nodes();
    void
    lay_out_system(const bool with_other_nodes);

    NewtonReport
    find_root(const bool has_other_start = false);
    ResidualNorms
    assemble(const bool with_matrix);

    Scene<dim>     &scene;
    StepSetup<dim> &setup;
    Terminal       &terminal;

    BodyTerm<dim>            body;
    OrthogonalSubscales<dim> subscales;
    MixedSystem<dim>         system;
    NodalConstraints         constraints;
    Residual<dim>            residual;
    LinearStep<dim>          linear_step;
    NewtonSolver             newton_solver;
    LastMotion               last_motion;

    NodalField unknowns;
    /** Whether the iterate is where the step starts. */
    bool at_start           = true;
    bool last_try_converged = true;
    /** See look_at_first_matrix(); empty after that. */
    std::function<void(const StepContext<dim> &, const SparseSystem &)>
      look_at_matrix;
  };
} // namespace isochor

#endif
