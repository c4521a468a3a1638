/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/yielded_share.h>
#include <isochor/equations/invariants.h>
#include <isochor/postprocess/grid_fields.h>
#include <isochor/postprocess/point_fields.h>
#include <isochor/step/failure_report.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** Where the residual force is largest: "12 N at (1, 2)". Owned entries,
     * constrained ones don't count. */
    template <int dim>
    std::string
    largest_residual(const StepContext<dim> &step,
                     const MixedSystem<dim> &system)
    {
      const MPI_Comm          comm    = step.grid.communicator();
      double                  largest = -1;
      std::array<double, dim> place{};
      for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
        {
          double square = 0;
          for (unsigned int a = 0; a < dim; ++a)
            {
              const unsigned int entry = node * step.n_components + a;
              if (system.equation(entry) != numbers::invalid_unsigned_int)
                square += std::pow(system.residual.local_element(entry), 2);
            }
          if (!(square > largest))
            continue;
          largest = square;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = step.nodes.position(node)[d];
        }
      const double       all    = Utilities::MPI::max(largest, comm);
      const unsigned int rank   = Utilities::MPI::this_mpi_process(comm);
      const unsigned int winner = Utilities::MPI::min(
        largest == all ? rank : numbers::invalid_unsigned_int, comm);
      if (rank != winner)
        place.fill(0.);
      sum_over_ranks(place, comm);
      std::string text =
        rounded(std::sqrt(std::max(all, 0.))) + " N at the node (";
      for (unsigned int d = 0; d < dim; ++d)
        text += (d > 0 ? ", " : "") + rounded(place[d]);
      return text + ")";
    }
  } // namespace



  template <int dim>
  typename FailureReport<dim>::Evidence
  FailureReport<dim>::collect(const Failure &failure) const
  {
    Assert(invariants::fits(failure.unknowns,
                            failure.step.nodes,
                            failure.step.n_components),
           ExcOtherNodes());
    const MPI_Comm comm = failure.step.grid.communicator();
    Evidence       evidence;
    // an iterate moves as far as it is told where displacements are prescribed
    const Softness trial =
      softness(failure.step, failure.unknowns, failure.drive);
    // what is stiff against other loads says nothing
    if (!trial.is_of_other_loading())
      {
        evidence.growth     = last.growth(stiffest);
        evidence.soft_since = soft.since;
        evidence.measure    = last.measure(stiffest);
      }
    // nor does an iterate say anything where the step before doesn't, or which
    // throws the body far out of the grid
    constexpr double far  = 1000; // cells
    const bool       wild = trial.in_cells > far;
    if (evidence.growth >= 0 && !wild)
      evidence.growth_of_trial = trial.growth(stiffest);
    evidence.plastic_share =
      yielded_share(failure.points, failure.step.kernel, comm);
    for (const auto &material : failure.step.kernel.materials)
      evidence.is_associated =
        evidence.is_associated && material->is_associated();
    if (!wild)
      evidence.n_negative_pivots = failure.n_unstable_modes;
    return evidence;
  }



  template <int dim>
  std::string
  FailureReport<dim>::write_points(const StepContext<dim>    &step,
                                   const MaterialPoints<dim> &points,
                                   const std::string         &directory)
  {
    FieldPatches<0, dim> fields = point_fields<0>(points, step.kernel);
    try
      {
        OutputSeries("failure-points")
          .write(fields, step.old_time, directory, step.grid.communicator());
      }
    catch (const ExceptionBase &exc)
      {
        return plain_message(exc);
      }
    return "The last good state, at t = " + rounded(step.old_time) +
           ", is in <" + directory + "/failure-points.pvd>.";
  }



  template <int dim>
  bool
  FailureReport<dim>::only_prescribed_changes(const Failure &failure) const
  {
    const bool is_told = largest_prescribed(failure.step, failure.drive) > 0,
               dragged = is_dragged(failure.step, failure.drive);
    return (is_told || dragged) &&
           !(failure.drive.change_of_loads(loading).size > 0);
  }



  template <int dim>
  std::string
  FailureReport<dim>::explain(const Failure &failure) const
  {
    Assert(!failure.newton.converged, ExcMessage("There is no failure."));
    const LoadStepping &time = failure.time;
    return "The step from t = " + rounded(time.time) + " of size " +
           rounded(time.next_time() - time.time) +
           " failed and can't be cut back further (<Time/Minimum step size>): " +
           failure.newton.failure + ".\n" + failure.hints +
           verdict(failure, collect(failure)) +
           "\nThe largest residual force was " +
           largest_residual(failure.step, failure.system) + ". " +
           write_files(failure);
  }



  template <int dim>
  std::string
  FailureReport<dim>::verdict(const Failure  &failure,
                              const Evidence &evidence) const
  {
    const LoadStepping &time = failure.time;
    if (time.step == 0)
      return "It is the very first step, so that the scene is to be looked "
             "at: are all bodies supported, the loads in the units of the "
             "stiffness and the strength (<Material/Young modulus>, "
             "<Material/Density>, yield stress or cohesion), and <Time/Step "
             "size> small enough for what happens in it? A load or a "
             "displacement that is prescribed by a constant acts in this step "
             "as a whole, however small the step: let it grow with t.";
    if (failure.dynamic)
      return "In dynamics there is a solution if the step is small enough: "
             "lower <Time/Minimum step size>, or look at the files for what "
             "goes wrong.";
    if (!failure.loaded || only_prescribed_changes(failure))
      return verdict_without_loads(failure, evidence);
    if (evidence.has_lost_stiffness() && evidence.plastic_share <= 0)
      return verdict_while_elastic(failure, evidence);
    if (evidence.has_lost_stiffness())
      return "No equilibrium found: limit load " +
             evidence.limit(time.time, time.next_time()) +
             ". Evidence: " + evidence.text() +
             ". To follow the body beyond, prescribe displacements instead of "
             "loads, or give it inertia (<Dynamics/Inertia = true>)." +
             evidence.advice_on_flow();
    if (evidence.growth < 0)
      return "Whether this is the limit of what the body, or friction that "
             "holds it, can carry, or a bad step, is not known (" +
             evidence.text() +
             "). Look for what happens at the place of the residual, use a "
             "finer grid or more points there, or lower <Time/Minimum step "
             "size>." +
             evidence.advice_on_flow();
    return "The body has not lost its stiffness (" + evidence.text() +
           "), so that this is probably no limit load, but a bad step: look "
           "for what happens at the place of the residual, use a finer grid "
           "or more points there, or lower <Time/Minimum step size>.";
  }



  template <int dim>
  std::string
  FailureReport<dim>::verdict_without_loads(const Failure  &failure,
                                            const Evidence &evidence)
  {
    return std::string(failure.loaded ?
                         "No load changes in this step, only displacements "
                         "that are prescribed do" :
                         "Only displacements are prescribed") +
           ", so that this is no limit "
           "load, which they could pass, but a step that is too large for "
           "what happens in it, or a grid that is too coarse (" +
           evidence.text() +
           "). Lower <Time/Minimum step size>, look for what happens at "
           "the place of the residual, or use <Dynamics/Inertia = true> "
           "where the body snaps." +
           evidence.advice_on_flow();
  }



  template <int dim>
  std::string
  FailureReport<dim>::verdict_while_elastic(const Failure  &failure,
                                            const Evidence &evidence)
  {
    return "No equilibrium found near t = " + rounded(failure.time.time) +
           (evidence.plastic_share < 0 ?
              ", and the material is elastic" :
              ", where no material point has yielded yet") +
           ". Evidence: " + evidence.text() + ". " +
           (evidence.plastic_share < 0 ?
              "An elastic body may buckle or snap: " :
              "If the stresses are just below the strength, the body yields "
              "all at once, and this is its limit load; if they are not, it "
              "buckles or snaps as an elastic one: ") +
           "to follow it, prescribe displacements instead of loads, or give it "
           "inertia (<Dynamics/Inertia = true>). " +
           (failure.forces_jump ?
              "But with this quadrature forces jump where points change cells, "
              "which alone can end a run: try <Quadrature/Type = CPDI> first." :
              "It may also be a cell that has folded: try a finer grid, more "
              "points or smaller steps.");
  }



  template <int dim>
  std::string
  FailureReport<dim>::write_files(const Failure &failure)
  {
    const StepContext<dim> &step     = failure.step;
    NodalField              residual = failure.system.residual;
    for (unsigned int i = 0; i < step.nodes.n_owned() * step.n_components; ++i)
      if (failure.system.equation(i) == numbers::invalid_unsigned_int)
        residual.local_element(i) = 0.; // a reaction
    residual.update_ghost_values();
    FieldPatches<dim, dim> fields =
      grid_fields(step, failure.unknowns, &residual);
    try
      {
        OutputSeries("failure-grid")
          .write(fields,
                 step.time,
                 failure.directory,
                 step.grid.communicator());
      }
    catch (const ExceptionBase &exc)
      {
        // on all ranks; the failure itself is what matters
        return plain_message(exc);
      }
    return "The residuals of the step that failed are in <" +
           failure.directory + "/failure-grid.pvd>. " +
           write_points(step, failure.points, failure.directory);
  }



  template class FailureReport<2>;
  template class FailureReport<3>;
} // namespace isochor
