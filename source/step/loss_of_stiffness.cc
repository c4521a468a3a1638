/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// How much the body has lost of its stiffness, by the steps that converge.
#include <deal.II/base/mpi.h>

#include <isochor/base/explanation.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/smallest_cell.h>
#include <isochor/step/failure_report.h>

#include <algorithm>
#include <array>
#include <cmath>

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
    /** Directions in which loads change are the same up to this cosine (25
     * degrees). */
    constexpr double alike = 0.9;
    /** A body that doesn't yield gives way only by what its geometry does: if
     * it is strained, or parts of it are turned, by more than this. */
    constexpr double much_distorted = 0.02;



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



    /** The largest |F - 1| of all material points. Collective. */
    template <int dim>
    double
    largest_distortion(const StepContext<dim>    &step,
                       const MaterialPoints<dim> &points)
    {
      double largest = 0;
      for (const auto &particle : points.handler())
        {
          Tensor<2, dim> F =
            deformation_gradient<dim>(particle.get_properties().data(),
                                      points.layout());
          for (unsigned int d = 0; d < dim; ++d)
            F[d][d] -= 1;
          largest = std::max(largest, F.norm());
        }
      return Utilities::MPI::max(largest, step.grid.communicator());
    }
  } // namespace



  template <int dim>
  double
  FailureReport<dim>::yielded_share(const MaterialPoints<dim> &points,
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
  bool
  FailureReport<dim>::Softness::is_of_other_loading() const
  {
    return loads.size > 0 && loads.likeness < alike;
  }



  template <int dim>
  double
  FailureReport<dim>::largest_prescribed(const StepContext<dim> &step,
                                         const Drive            &drive)
  {
    double largest = 0;
    for (const double increment : drive.constraints.increment)
      largest = std::max(largest, std::abs(increment));
    for (const double value : drive.constraints.followers.value)
      largest = std::max(largest, std::abs(value));
    return Utilities::MPI::max(largest, step.grid.communicator());
  }



  template <int dim>
  bool
  FailureReport<dim>::is_dragged(const StepContext<dim> &step,
                                 const Drive            &drive)
  {
    return Utilities::MPI::max(drive.dragged ? 1 : 0,
                               step.grid.communicator()) == 1;
  }



  template <int dim>
  typename FailureReport<dim>::Softness
  FailureReport<dim>::softness(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Drive            &drive) const
  {
    const double u = Utilities::MPI::max(largest_displacement(step, unknowns),
                                         step.grid.communicator());
    const double h = smallest_cell(step);
    // what holds a node in place may be rounding, and a body at rest moves by
    // what Newton's method leaves
    constexpr double negligible = 0.01, rounding = 1e-9;
    Softness         result;
    const double     told    = largest_prescribed(step, drive);
    const bool       dragged = is_dragged(step, drive);
    if (!std::isfinite(u) || u < rounding * h || told > negligible * u ||
        dragged)
      return result;
    result.per_time = u / step.step_size();
    result.in_cells = u / h;
    result.loads    = drive.change_of_loads(loading);
    if (result.loads.size > 0)
      result.per_load = u / result.loads.size;
    return result;
  }



  template <int dim>
  void
  FailureReport<dim>::take_yardstick(const TimeInterval &step)
  {
    if (last.is_of_other_loading())
      {
        loading  = step;
        stiffest = Softness();
      }
    stiffest.take_smaller(last);
  }



  template <int dim>
  void
  FailureReport<dim>::remember(const StepContext<dim>    &step,
                               const NodalField          &unknowns,
                               const MaterialPoints<dim> &points,
                               const Drive               &drive)
  {
    last = softness(step, unknowns, drive);
    take_yardstick({step.old_time, step.time});
    if (!(last.growth(stiffest) > large_growth))
      {
        soft_since = -1;
        n_soft     = 0;
        soft_way   = 0;
        told       = false;
        return;
      }
    if (soft_since < 0)
      soft_since = step.old_time;
    ++n_soft;
    soft_way += last.in_cells;
    // with CPDI points that change cells don't move a body at rest
    const MPI_Comm comm    = step.grid.communicator();
    const int      is_cpdi = step.points.has_stencils();
    const bool     moves =
      soft_way > far || Utilities::MPI::max(is_cpdi, comm) == 1;
    if (told || n_soft < many_steps || !moves)
      return;
    const double yielded = yielded_share(points, step.kernel, comm);
    if (yielded <= 0 && largest_distortion(step, points) < much_distorted)
      return;
    told = true;
    warn(step, yielded);
  }



  template <int dim>
  void
  FailureReport<dim>::warn(const StepContext<dim> &step,
                           const double            plastic_share) const
  {
    step.warnings.add(
      "the body gives way",
      "since t = " + rounded(soft_since) + " the displacement per " +
        last.measure(stiffest) + " is more than " + rounded(large_growth) +
        " times that of the stiffest step (" + rounded(last.growth(stiffest)) +
        " at t = " + rounded(step.time) + "): " +
        (plastic_share > 0 ?
           "the limit load of this grid is reached. Prescribe displacements" :
           "no point has yielded, the body buckles, snaps or is deformed far. "
           "Take smaller steps") +
        ", or set <Dynamics/Inertia = true>.");
  }



  ISOCHOR_EXPLAIN(
    gives_way,
    "the body gives way",
    ISOCHOR_ESSENTIAL,
    "statics: in five steps in succession the largest displacement per "
    "time, and per change of the loads where they change, was more than ten"
    " times that of the stiffest step of the same loading (with other "
    "quadratures than CPDI, whose forces jump when points change cells, the"
    " body has also gone more than a fiftieth of the smallest cell in "
    "them). A loading lasts as long as the loads change in one direction "
    "(all forces on the nodes together, up to 25 degrees). Where nothing "
    "has yielded it is issued only if a point is also strained or turned by"
    " more than 2 %: such a body buckles, snaps or is deformed far, and "
    "there is no limit load. Steps don't count in which the body rests "
    "(less than 1e-9 of a cell), or is moved by what is prescribed (more "
    "than 1 % of the largest displacement). The time is a bracket: the "
    "limit load lies between the one there (last step before the growth) "
    "and the last equilibrium that is found. Measured: blocks and strip "
    "loads that yield within a few steps, 0 to 7 % above the time given; a "
    "sphere under inner pressure, where the plastic zone grows bit by bit, "
    "12 to 15 % above it, while the last equilibrium is 0.5 % below. A grid"
    " that is too coarse raises both (a slope, φ = ψ = 20° at 45°: by 5 % "
    "with 16 cells over its height)",
    "look at the time given. Prescribe displacements, or `Dynamics/Inertia "
    "= true` to follow it")



  template double
  FailureReport<2>::Softness::growth(const FailureReport<2>::Softness &) const;
  template std::string
  FailureReport<2>::Softness::measure(const FailureReport<2>::Softness &) const;
  template void
  FailureReport<2>::Softness::take_smaller(const FailureReport<2>::Softness &);
  template bool
  FailureReport<2>::Softness::is_of_other_loading() const;
  template double
  FailureReport<3>::Softness::growth(const FailureReport<3>::Softness &) const;
  template std::string
  FailureReport<3>::Softness::measure(const FailureReport<3>::Softness &) const;
  template void
  FailureReport<3>::Softness::take_smaller(const FailureReport<3>::Softness &);
  template bool
  FailureReport<3>::Softness::is_of_other_loading() const;
  template double
  FailureReport<2>::largest_prescribed(const StepContext<2> &, const Drive &);
  template bool
  FailureReport<2>::is_dragged(const StepContext<2> &, const Drive &);
  template double
  FailureReport<2>::yielded_share(const MaterialPoints<2> &,
                                  const MixedKernel<2> &,
                                  const MPI_Comm);
  template void
  FailureReport<2>::remember(const StepContext<2> &,
                             const NodalField &,
                             const MaterialPoints<2> &,
                             const Drive &);
  template typename FailureReport<2>::Softness
  FailureReport<2>::softness(const StepContext<2> &,
                             const NodalField &,
                             const Drive &) const;
  template double
  FailureReport<3>::largest_prescribed(const StepContext<3> &, const Drive &);
  template bool
  FailureReport<3>::is_dragged(const StepContext<3> &, const Drive &);
  template double
  FailureReport<3>::yielded_share(const MaterialPoints<3> &,
                                  const MixedKernel<3> &,
                                  const MPI_Comm);
  template void
  FailureReport<3>::remember(const StepContext<3> &,
                             const NodalField &,
                             const MaterialPoints<3> &,
                             const Drive &);
  template typename FailureReport<3>::Softness
  FailureReport<3>::softness(const StepContext<3> &,
                             const NodalField &,
                             const Drive &) const;
} // namespace isochor
