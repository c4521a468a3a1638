/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/smallest_cell.h>
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
    /** So many steps one after the other that are this fast are worth a
     * warning. */
    constexpr unsigned int many_steps = 5;
    /** And so far, in cells: where points change cells, a body at rest moves a
     * little in each step, by more or less. */
    constexpr double far = 0.02;



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



    /** The share of the reference volume that has yielded so far; negative if
     * no material has a plastic strain. */
    template <int dim>
    double
    plastic_share(const MaterialPoints<dim> &points,
                  const MixedKernel<dim>    &kernel,
                  const MPI_Comm             comm)
    {
      constexpr unsigned int    none = numbers::invalid_unsigned_int;
      std::vector<unsigned int> index;
      for (const auto &material : kernel.materials)
        {
          const auto names = material->history_names();
          const auto found =
            std::find(names.begin(), names.end(), "equivalent_plastic_strain");
          index.push_back(found == names.end() ? none : found - names.begin());
        }
      if (std::all_of(index.begin(), index.end(), [](const unsigned int i) {
            return i == none;
          }))
        return -1;
      const PointLayout    &l = points.layout();
      std::array<double, 2> volumes{};
      for (const auto &particle : points.handler())
        {
          const auto         values = particle.get_properties();
          const unsigned int i =
            index[static_cast<unsigned int>(values[l.material])];
          volumes[0] += values[l.volume];
          if (i != none && values[l.history + i] > 0)
            volumes[1] += values[l.volume];
        }
      sum_over_ranks(volumes, comm);
      return volumes[1] / volumes[0];
    }



    /** The largest displacement of the step (m) on this rank. */
    template <int dim>
    double
    largest_displacement(const StepContext<dim> &step,
                         const NodalField       &unknowns)
    {
      double largest = 0;
      for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
        {
          double square = 0;
          for (unsigned int a = 0; a < dim; ++a)
            square +=
              std::pow(unknowns.local_element(node * step.n_components + a), 2);
          // also of what is no number
          if (!(square <= largest))
            largest = square;
        }
      return std::sqrt(largest);
    }



    /** What is prescribed in a step (m), on this rank. */
    double
    largest_prescribed(const NodalConstraints &constraints)
    {
      double largest = 0;
      for (const double increment : constraints.increment)
        largest = std::max(largest, std::abs(increment));
      for (const double value : constraints.followers.value)
        largest = std::max(largest, std::abs(value));
      return largest;
    }



    /** The number of pressure equations over all ranks. */
    long
    n_pressures(const SparseSystem &matrix)
    {
      long n = 0;
      for (unsigned int i = 0; i < matrix.global_equation.size(); ++i)
        n += matrix.field[i] == SparseSystem::Field::pressure &&
             matrix.locally_owned.is_element(matrix.global_equation[i]);
      return Utilities::MPI::sum(n, matrix.comm);
    }
  } // namespace



  template <int dim>
  double
  FailureReport<dim>::Softness::growth(const Softness &stiffest) const
  {
    if (!(per_time > 0) || !(stiffest.per_time > 0))
      return -1;
    const double by_time = per_time / stiffest.per_time;
    return per_load > 0 && stiffest.per_load > 0 ?
             std::min(by_time, per_load / stiffest.per_load) :
             by_time;
  }



  template <int dim>
  std::string
  FailureReport<dim>::Softness::measure(const Softness &stiffest) const
  {
    return per_load > 0 && stiffest.per_load > 0 ? "load" : "time";
  }



  template <int dim>
  void
  FailureReport<dim>::Softness::take_smaller(const Softness &other)
  {
    const auto take = [](double &mine, const double theirs) {
      if (theirs > 0)
        mine = mine > 0 ? std::min(mine, theirs) : theirs;
    };
    take(per_time, other.per_time);
    take(per_load, other.per_load);
  }



  template <int dim>
  typename FailureReport<dim>::Softness
  FailureReport<dim>::softness(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Drive            &drive)
  {
    const MPI_Comm comm = step.grid.communicator();
    const double   u =
      Utilities::MPI::max(largest_displacement(step, unknowns), comm);
    const double h = smallest_cell(step);
    const double told =
      Utilities::MPI::max(largest_prescribed(drive.constraints), comm);
    const bool dragged = Utilities::MPI::max(drive.dragged ? 1 : 0, comm) == 1;
    // what holds a node in place may be rounding, and a body at rest moves by
    // what Newton's method leaves
    constexpr double negligible = 0.01, rounding = 1e-9;
    Softness         result;
    if (!std::isfinite(u) || u < rounding * h || told > negligible * u ||
        dragged)
      return result;
    result.per_time = u / step.step_size();
    result.in_cells = u / h;
    if (const double change = drive.change_of_loads(); change > 0)
      result.per_load = u / change;
    return result;
  }



  template <int dim>
  void
  FailureReport<dim>::remember(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Drive            &drive)
  {
    last = softness(step, unknowns, drive);
    stiffest.take_smaller(last);
    const double growth = last.growth(stiffest);
    if (!(growth > large_growth))
      {
        soft_since = -1;
        n_soft     = 0;
        soft_way   = 0;
        return;
      }
    if (soft_since < 0)
      soft_since = step.old_time;
    // with CPDI points that change cells don't move a body at rest
    const int  is_cpdi = step.points.has_stencils();
    const bool must_move =
      Utilities::MPI::max(is_cpdi, step.grid.communicator()) == 0;
    const auto gives_way = [&]() {
      return n_soft >= many_steps && (!must_move || soft_way > far);
    };
    const bool gave_way_before = gives_way();
    ++n_soft;
    soft_way += last.in_cells;
    if (gives_way() && !gave_way_before)
      step.warnings.add(
        "the body gives way",
        "Since t = " + rounded(soft_since) + " the displacement per " +
          last.measure(stiffest) + " is more than " + rounded(large_growth) +
          " times that of the stiffest step so far (" + rounded(growth) +
          " times at t = " + rounded(step.time) +
          "). If loads drive the body, they are beyond what it can carry as it "
          "is: it flows or falls, and without inertia its speed means nothing. "
          "The limit load is the one at t = " +
          rounded(soft_since) +
          "; what is carried beyond is so by the body as it has been deformed, "
          "or by a grid that is too coarse. To follow the body beyond, use "
          "<Dynamics/Inertia = true>.");
  }



  template <int dim>
  typename FailureReport<dim>::Evidence
  FailureReport<dim>::collect(const Failure &failure) const
  {
    const MPI_Comm comm = failure.step.grid.communicator();
    Evidence       evidence;
    // an iterate moves as far as it is told where displacements are prescribed
    const Softness trial =
      softness(failure.step, failure.unknowns, failure.drive);
    evidence.growth     = last.growth(stiffest);
    evidence.soft_since = soft_since;
    // nor does an iterate say anything where the step before doesn't
    evidence.growth_of_trial =
      evidence.growth < 0 ? -1. : trial.growth(stiffest);
    evidence.measure = last.measure(stiffest);
    evidence.plastic_share =
      isochor::plastic_share(failure.points, failure.step.kernel, comm);
    for (const auto &material : failure.step.kernel.materials)
      evidence.is_associated =
        evidence.is_associated && material->is_associated();
    if (failure.solver.knows_pivots)
      evidence.n_negative_pivots =
        std::max(0l,
                 static_cast<long>(failure.solver.n_negative_pivots) -
                   n_pressures(failure.system.matrix()));
    return evidence;
  }



  template <int dim>
  std::string
  FailureReport<dim>::write_points(const StepContext<dim>    &step,
                                   const MaterialPoints<dim> &points,
                                   const std::string         &directory)
  {
    FieldPatches<0, dim> fields = point_fields(points, step.kernel);
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
  std::string
  FailureReport<dim>::explain(const Failure &failure) const
  {
    const StepContext<dim> &step     = failure.step;
    const LoadStepping     &time     = failure.time;
    const Evidence          evidence = collect(failure);

    std::string text = "The step from t = " + rounded(time.time) + " of size " +
                       rounded(time.next_time() - time.time) +
                       " failed and can't be cut back further (<Time/Minimum "
                       "step size>): " +
                       failure.newton.failure + ".\n";
    if (time.step == 0)
      text += "It is the very first step, so that the scene is to be looked "
              "at: are all bodies held, the loads in the units of the "
              "stiffness (<Material/Young modulus>, <Material/Density>), and "
              "<Time/Step size> small enough for what happens in it? A "
              "displacement that is prescribed by a constant acts in this step "
              "as a whole, however small the step: let it grow with t.";
    else if (failure.dynamic)
      text += "In dynamics there is a solution if the step is small enough: "
              "lower <Time/Minimum step size>, or look at the files for what "
              "goes wrong.";
    else if (!failure.loaded)
      text += "Only displacements are prescribed, so that this is no limit "
              "load, which they could pass, but a step that is too large for "
              "what happens in it, or a grid that is too coarse (" +
              evidence.text() +
              "). Lower <Time/Minimum step size>, look for what happens at "
              "the place of the residual, or use <Dynamics/Inertia = true> "
              "where the body snaps." +
              evidence.advice_on_flow();
    else if (evidence.has_lost_stiffness() && evidence.plastic_share <= 0)
      text +=
        "No equilibrium found near t = " + rounded(time.time) +
        (evidence.plastic_share < 0 ?
           ", and the material is elastic" :
           ", where no material point has yielded yet") +
        ". Evidence: " + evidence.text() + ". " +
        (evidence.plastic_share < 0 ?
           "An elastic body may buckle or snap: " :
           "If the stresses are just below the strength, the body yields all "
           "at once, and this is its limit load; if they are not, it buckles "
           "or snaps as an elastic one: ") +
        "to follow it, prescribe displacements instead of loads, or give it "
        "inertia (<Dynamics/Inertia = true>). " +
        (failure.forces_jump ?
           "But with this quadrature forces jump where points change cells, "
           "which alone can end a run: try <Quadrature/Type = CPDI> first." :
           "It may also be a cell that has folded: try a finer grid, more "
           "points or smaller steps.");
    else if (evidence.has_lost_stiffness())
      text += "No equilibrium found: limit load " +
              evidence.limit(time.time, time.next_time()) +
              ". Evidence: " + evidence.text() +
              ". To follow the body beyond, prescribe displacements instead of "
              "loads, or give it inertia (<Dynamics/Inertia = true>)." +
              evidence.advice_on_flow();
    else if (evidence.growth < 0 && evidence.plastic_share > 0)
      text += "Whether this is the limit of what the body can carry, or a bad "
              "step, can't be told (" +
              evidence.text() +
              "). Look for what happens at the place of the residual, use a "
              "finer grid or more points there, or lower <Time/Minimum step "
              "size>." +
              evidence.advice_on_flow();
    else
      text += "The body has not lost its stiffness (" + evidence.text() +
              "), so that this is hardly a limit load, but a bad step: look "
              "for what happens at the place of the residual, use a finer "
              "grid or more points there, or lower <Time/Minimum step size>.";

    return text + "\nThe largest residual force was " +
           largest_residual(step, failure.system) + ". " + write_files(failure);
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
