/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/surface_gap.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace isochor
{
  template <int dim>
  std::array<double, dim>
  SurfaceGap<dim>::Motion::scale() const
  {
    // less than this of the largest motion is what formulas leave of nothing
    constexpr double rounding = 1e-10;
    const double     largest =
      std::max(*std::max_element(deformation.begin(), deformation.end()),
               *std::max_element(way.begin(), way.end()));
    std::array<double, dim> result;
    for (unsigned int a = 0; a < dim; ++a)
      result[a] = deformation[a] > rounding * largest ? deformation[a] : way[a];
    return result;
  }



  template <int dim>
  auto
  SurfaceGap<dim>::motion_at_end(const StepContext<dim>       &step,
                                 const NodalField             &unknowns,
                                 const BoundaryPoints<dim>    &points,
                                 const SurfaceForces<dim>     &forces,
                                 const SurfaceConditions<dim> &conditions) const
    -> Motion
  {
    Motion result = motion;
    // by component: largest ū, largest -ū, largest increment of a node
    constexpr double    lowest = std::numeric_limits<double>::lowest();
    std::vector<double> largest(3 * dim, lowest);
    for (unsigned int b = 0; b < points.size(); ++b)
      for (unsigned int a = 0; a < dim; ++a)
        if (!conditions.surfaces[points.surface(b)].displacement[a].empty())
          {
            const double u   = forces.target(step, b, a);
            largest[a]       = std::max(largest[a], u);
            largest[dim + a] = std::max(largest[dim + a], -u);
          }
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      for (unsigned int a = 0; a < dim; ++a)
        largest[2 * dim + a] = std::max(largest[2 * dim + a],
                                        std::abs(unknowns.local_element(
                                          node * step.n_components + a)));
    Utilities::MPI::max(largest, step.grid.communicator(), largest);
    for (unsigned int a = 0; a < dim; ++a)
      {
        result.way[a] += largest[2 * dim + a];
        if (largest[a] == lowest)
          continue; // prescribed nowhere
        const double range = largest[a] + largest[dim + a];
        result.deformation[a] =
          std::max(result.deformation[a],
                   range > 0 ? range : std::abs(largest[a]));
      }
    return result;
  }



  template <int dim>
  std::array<double, dim>
  SurfaceGap<dim>::scale(const StepContext<dim>       &step,
                         const NodalField             &unknowns,
                         const BoundaryPoints<dim>    &points,
                         const SurfaceForces<dim>     &forces,
                         const SurfaceConditions<dim> &conditions) const
  {
    return motion_at_end(step, unknowns, points, forces, conditions).scale();
  }



  template <int dim>
  void
  SurfaceGap<dim>::check(const StepContext<dim>       &step,
                         const NodalField             &unknowns,
                         const BoundaryPoints<dim>    &points,
                         const SurfaceForces<dim>     &forces,
                         const SurfaceConditions<dim> &conditions,
                         const std::string            &penalty_parameter)
  {
    if (step.has_inertia || !conditions.prescribe_displacements())
      return;
    motion = motion_at_end(step, unknowns, points, forces, conditions);
    const std::array<double, dim> moved = motion.scale();
    // by surface: its area, and by component the integral of the gap squared
    constexpr unsigned int stride = 1 + dim;
    std::vector<double>    sums(stride * conditions.surfaces.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const unsigned int   s = points.surface(b);
        const double         A = points.reference_area(b).norm();
        const Tensor<1, dim> u = forces.displacement(step, unknowns, b);
        sums[stride * s] += A;
        for (unsigned int a = 0; a < dim; ++a)
          if (!conditions.surfaces[s].displacement[a].empty())
            sums[stride * s + 1 + a] +=
              A * Utilities::fixed_power<2>(u[a] - forces.target(step, b, a));
      }
    Utilities::MPI::sum(sums, step.grid.communicator(), sums);
    // where the body hardly moves in a direction, a gap counts that is
    // something against its motion in others
    constexpr double considerable = 0.03, sideways = 1. / 3;
    // a penalty that is stiff against everything but the grid itself
    constexpr double enough  = 100;
    const double     largest = *std::max_element(moved.begin(), moved.end());
    for (unsigned int s = 0; s < conditions.surfaces.size(); ++s)
      for (unsigned int a = 0; a < dim; ++a)
        {
          const double gap =
            std::sqrt(sums[stride * s + 1 + a] / sums[stride * s]);
          if (!(gap > considerable * std::max(moved[a], sideways * largest)))
            continue;
          step.warnings.add(
            "a surface stays behind its displacement",
            "At t = " + rounded(step.time) + " s the surface <" +
              conditions.surfaces[s].place.name + "> is " + rounded(gap) +
              " m (root mean square) away from the "
              "displacement " +
              "xyz"[a] + " that is prescribed there, " +
              rounded(100 * gap / moved[a]) +
              " % of what deforms the body. Its mean place is corrected: "
              "another condition holds the surface, too, which is to be left "
              "out of one of them, or forces that differ from place to place "
              "stretch the springs of <" +
              penalty_parameter + ">" +
              (conditions.penalty(false) < enough ?
                 ", which are too soft then: set it to " +
                   rounded(10 * conditions.penalty(false)) +
                   ", or use smaller cells." :
                 ". They are stiff enough: use smaller cells, whose nodes can "
                 "follow what is prescribed."));
        }
    check_work(step,
               find_work(step, unknowns, points, forces, conditions),
               conditions,
               penalty_parameter);
  }



  template <int dim>
  typename SurfaceGap<dim>::SpringWork
  SurfaceGap<dim>::find_work(const StepContext<dim>       &step,
                             const NodalField             &unknowns,
                             const BoundaryPoints<dim>    &points,
                             const SurfaceForces<dim>     &forces,
                             const SurfaceConditions<dim> &conditions) const
  {
    // displacements that are rounding, as those of max(t - 1, 0) at t = 1, do
    // no work that could be compared with anything, nor do such along which
    // nothing resists the body
    constexpr double       rounding       = 1e-6;
    double                 largest_target = 0, largest_gap = 0;
    constexpr unsigned int stride = 3 + dim;
    std::vector<double>    sums(stride * conditions.surfaces.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        double *const        of_surface = &sums[stride * points.surface(b)];
        const Tensor<1, dim> u = forces.displacement(step, unknowns, b),
                             t = forces.penalty_force(step, unknowns, b);
        for (unsigned int a = 0; a < dim; ++a)
          if (!conditions.surfaces[points.surface(b)].displacement[a].empty())
            {
              const double target = forces.target(step, b, a);
              largest_target      = std::max(largest_target, std::abs(target));
              largest_gap = std::max(largest_gap, std::abs(target - u[a]));
              of_surface[0] += t[a] * target;
              of_surface[1] += t[a] * (target - u[a]);
              of_surface[2] += std::abs(t[a] * target);
              of_surface[3 + a] += t[a];
            }
      }
    Utilities::MPI::sum(sums, step.grid.communicator(), sums);
    largest_target =
      Utilities::MPI::max(largest_target, step.grid.communicator());
    largest_gap = Utilities::MPI::max(largest_gap, step.grid.communicator());
    SpringWork         result;
    std::vector<Work> &work = result.by_surface;
    work.resize(conditions.surfaces.size());
    if (largest_target <= rounding * largest_gap)
      return result;
    // surfaces that are held do none, but if nothing else acts on the body what
    // their springs take up is from the others
    Tensor<1, dim> force;
    double         size = 0;
    for (unsigned int s = 0; s < work.size(); ++s)
      for (unsigned int a = 0; a < dim; ++a)
        {
          force[a] += sums[stride * s + 3 + a];
          size += std::abs(sums[stride * s + 3 + a]);
        }
    constexpr double in_balance = 1e-3;
    result.alone =
      force.norm() < in_balance * size &&
      std::all_of(conditions.surfaces.begin(),
                  conditions.surfaces.end(),
                  [](const auto &surface) {
                    return surface.traction.empty() && surface.pressure.empty();
                  });
    for (unsigned int s = 0; s < work.size(); ++s)
      if (const double *const of_surface = &sums[stride * s];
          result.alone || std::abs(of_surface[0]) > rounding * of_surface[2])
        work[s] = {of_surface[0], of_surface[1]};
    return result;
  }



  template <int dim>
  void
  SurfaceGap<dim>::check_work(const StepContext<dim>       &step,
                              const SpringWork             &spring_work,
                              const SurfaceConditions<dim> &conditions,
                              const std::string            &penalty_parameter)
  {
    const std::vector<Work> &work = spring_work.by_surface;
    // up to this they do not lock
    constexpr double considerable = 0.03, soft_penalty = 10;
    double           all = 0;
    for (const Work &of_surface : work)
      all += of_surface.of_targets;
    largest_work         = std::max(largest_work, std::abs(all));
    double       of_gaps = 0;
    unsigned int worst   = 0;
    for (unsigned int s = 0; s < work.size(); ++s)
      {
        of_gaps += work[s].of_gaps;
        if (work[s].of_gaps > work[worst].of_gaps)
          worst = s;
      }
    if (!(largest_work > 0 && of_gaps > considerable * largest_work))
      return;
    const std::string taken =
      "At t = " + rounded(step.time) +
      " s the springs that prescribe displacements of the body, most of all "
      "those of its surface <" +
      conditions.surfaces[worst].place.name + ">, take up " +
      rounded(100 * of_gaps / largest_work) +
      " % of the work of these displacements: its forces are too ";
    const std::string yielding =
      "They yield to forces that differ from place to place, as of an "
      "incompressible layer between two surfaces.";
    const double penalty = conditions.penalty(false);
    if (penalty > soft_penalty)
      step.warnings.add(
        "springs that are too stiff for a surface",
        taken +
          "large by about as much, if the surface goes through cells in which "
          "the body can't follow what is prescribed; else too small: " +
          yielding + " Compare a fifth of <" + penalty_parameter +
          "> and five "
          "times as much, or use smaller cells.");
    else if (spring_work.alone)
      step.warnings.add("springs that are too soft for a surface",
                        taken + "small by about as much. " + yielding +
                          " Set <" + penalty_parameter + "> to " +
                          rounded(10 * penalty) + ", or use smaller cells.");
  }



  template <int dim>
  std::string
  SurfaceGap<dim>::save_state() const
  {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (unsigned int a = 0; a < dim; ++a)
      text << motion.deformation[a] << ' ' << motion.way[a] << ' ';
    text << largest_work << '\n';
    return text.str();
  }



  template <int dim>
  void
  SurfaceGap<dim>::load_state(const std::string &state)
  {
    std::istringstream text(state);
    for (unsigned int a = 0; a < dim; ++a)
      text >> motion.deformation[a] >> motion.way[a];
    text >> largest_work;
  }



  template class SurfaceGap<2>;
  template class SurfaceGap<3>;
} // namespace isochor
