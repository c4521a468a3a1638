/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/contact_checks.h>
#include <isochor/boundary_condition/early_contact.h>
#include <isochor/boundary_condition/wall_gaps.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** What the nodes of a wall do, and of those whose gap is known. */
    struct Forces
    {
      double all = 0, ///< Σ |F_I| (N)
        pull     = 0, ///< Σ max(-F_I, 0) (N), of these
        gap      = 0, ///< Σ max(-F_I, 0) g_I (N m)
        cells    = 0; ///< Σ max(-F_I, 0) g_I / h (N)
    };



    template <int dim>
    std::vector<Forces>
    forces_of(const std::vector<WallContacts<dim>> &walls,
              const WallGaps                       &gaps,
              const MPI_Comm                        comm)
    {
      std::vector<Forces> forces(walls.size());
      unsigned int        i = 0;
      for (unsigned int w = 0; w < walls.size(); ++w)
        for (const auto &node : walls[w].nodes)
          {
            const bool   is_known = gaps.gap[i] != WallGaps::unknown;
            const double pull     = is_known ? std::max(-node.force, 0.) : 0.,
                         g        = is_known ? std::max(gaps.gap[i], 0.) : 0.;
            forces[w].all += std::abs(node.force);
            forces[w].pull += pull;
            forces[w].gap += pull * g;
            forces[w].cells += pull * g / gaps.cell_size[i];
            ++i;
          }
      const ArrayView<double> all(&forces[0].all,
                                  sizeof(Forces) / sizeof(double) *
                                    forces.size());
      Utilities::MPI::sum(ArrayView<const double>(all), comm, all);
      return forces;
    }



    template <int dim>
    void
    warn_of_pull_across_gaps(const StepContext<dim>               &step,
                             const std::vector<WallContacts<dim>> &walls,
                             const WallGaps                       &gaps)
    {
      // of a cell: less may be how domains show a surface that is curved, and
      // points without domains know it roughly; and of the forces: a body that
      // is pressed by a boundary which holds is pulled at single nodes beside
      // the contact
      constexpr double considerable = 0.3, no_force = 1e-3;
      const double     much = Utilities::MPI::max(step.points.domain.size(),
                                              step.grid.communicator()) > 0 ?
                                0.25 :
                                0.35;
      const auto forces     = forces_of(walls, gaps, step.grid.communicator());
      double     most       = 0;
      for (const Forces &of_wall : forces)
        most = std::max(most, of_wall.all);
      for (unsigned int w = 0; w < walls.size(); ++w)
        if (const Forces &F = forces[w];
            walls[w].holds && F.all > no_force * most &&
            F.pull > considerable * F.all && F.cells > much * F.pull)
          step.warnings.add(
            "a boundary that pulls across a gap",
            "At t = " + rounded(step.time) + " s the held boundary <" +
              walls[w].boundary + "> (<" + walls[w].parameter +
              ">) pulls the body with " + rounded(F.pull) +
              " N, but in the mean of this force the body ends " +
              rounded(F.gap / F.pull) + " m, " + rounded(F.cells / F.pull) +
              " cells, away from it: nodes of the grid are held as soon as a "
              "cell around them holds material, and so the body is glued to "
              "the boundary across the empty part of the cells. If it is "
              "fastened there let it end on the boundary, or hold its own "
              "surface (<Interaction: name - place>); if it isn't, write <= or >= "
              "in place of =, or leave the condition out.");
    }



    /** Whether distances from the body to its walls matter after the first
     * step: there is a one-sided wall, or a held one that presses. */
    template <int dim>
    bool
    gaps_matter(const std::vector<WallContacts<dim>> &walls,
                const MPI_Comm                        comm)
    {
      bool is_one_sided = false;
      // of each wall: Σ max(F_I, 0), Σ |F_I|
      std::vector<std::array<double, 2>> sums(walls.size());
      for (unsigned int w = 0; w < walls.size(); ++w)
        {
          is_one_sided = is_one_sided || !walls[w].holds;
          for (const auto &node : walls[w].nodes)
            {
              sums[w][0] += std::max(node.force, 0.);
              sums[w][1] += std::abs(node.force);
            }
        }
      const ArrayView<double> all(sums[0].data(), 2 * sums.size());
      Utilities::MPI::sum(ArrayView<const double>(all), comm, all);
      return is_one_sided ||
             std::any_of(sums.begin(), sums.end(), [](const auto &sum) {
               return presses(sum[0], sum[1]);
             });
    }
  } // namespace



  template <int dim>
  void
  check_contacts(const StepContext<dim>               &step,
                 const NodalField                     &unknowns,
                 const std::vector<WallContacts<dim>> &walls,
                 Statistics                           &statistics)
  {
    const bool is_first = step.old_time <= 0;
    if (walls.empty() ||
        (!is_first && !gaps_matter(walls, step.grid.communicator())))
      return;
    const WallGaps gaps = find_wall_gaps(step, &unknowns, walls, true);
    check_early_contact(step, unknowns, walls, gaps, statistics);
    // later a surface may have come to that by what the body does
    if (is_first)
      warn_of_pull_across_gaps(step, walls, gaps);
  }



  template void
  check_contacts(const StepContext<2> &,
                 const NodalField &,
                 const std::vector<WallContacts<2>> &,
                 Statistics &);
  template void
  check_contacts(const StepContext<3> &,
                 const NodalField &,
                 const std::vector<WallContacts<3>> &,
                 Statistics &);
} // namespace isochor
