/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/early_contact.h>
#include <isochor/equations/final_state.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Of this rank's points at the end of the step: Σ_p V_p |τ:ε|, and
     * Σ_p V_p G (J). */
    template <int dim>
    std::array<double, 2>
    deformation_work(const StepContext<dim> &step, const NodalField &unknowns)
    {
      const PointArrays<dim>         &points = step.points;
      const NodalUnknowns<dim>        nodal(step, unknowns);
      std::array<double, max_history> history;
      std::array<double, 2>           sums{};
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const auto state =
              final_state<dim>(step, nodal, points, k, q, history.data());
            const Tensor<2, dim> b       = state.F * transpose(state.F);
            const Tensor<2, dim> inverse = invert(b);
            double               work    = 0;
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int c = 0; c < dim; ++c)
                work += state.cauchy_stress[a][c] * (b[a][c] - inverse[a][c]);
            const double hoop = Utilities::fixed_power<2>(
              step.kernel.hoop_stretch(history.data()));
            work += state.cauchy_stress[2][2] * (hoop - 1 / hoop);
            sums[0] += 0.25 * points.measure(q) * state.J * std::abs(work);
            sums[1] +=
              points.measure(q) *
              step.kernel.materials[points.material[q]]->shear_modulus();
          }
      return sums;
    }



    /** What a wall does through gaps. */
    struct Through
    {
      double force = 0, ///< N, of all of its nodes that press
        early      = 0, ///< N, of those that the body has not reached
        work       = 0, ///< Σ F_I g_I
        cells      = 0; ///< Σ F_I g_I / h
    };



    template <int dim>
    void
    warn(const StepContext<dim>  &step,
         const WallContacts<dim> &wall,
         const Through           &through,
         const double             share)
    {
      step.warnings.add(
        "a wall that acts before the body reaches it",
        "At t = " + rounded(step.time) + " s " +
          rounded(100 * through.early / through.force) +
          " % of the force of the " +
          (wall.holds ? "held boundary <" : "one-sided wall <") +
          wall.boundary + "> (<" + wall.parameter + ">), " +
          rounded(through.force) +
          " N, act at nodes of the grid that the surface of the body has not "
          "reached: in the mean of the force the body is " +
          rounded(through.work / through.force) + " m away from the wall, " +
          rounded(through.cells / through.force) +
          " cells, since a node is held as soon as a cell around it holds "
          "material. Where motions are given, forces of contact are therefore "
          "too large, by an estimated " +
          (share > 0.5 ?
             "half or more" :
             rounded(100 * share) + " to " + rounded(200 * share) + " %") +
          " by what the body is deformed by now; where forces are, it stays "
          "away from the wall by so much. That "
          "falls as the body is pressed further and with the cells. Use smaller "
          "cells at the wall (<Adaptive grid/Cell size at boundaries>), or put "
          "a flat side of the body on a line of the grid" +
          (step.grid_is_kept ?
             "" :
             "; or keep a grid that fits the surface of the body (<Grid "
             "reset/Steps between resets = 0>), if nothing comes to the wall "
             "that doesn't touch it at t = 0") +
          ". In statics a flat one-sided wall acts where the surface is, "
          "with <Quadrature/Type = CPDI> or 'cell-filled + boundary'.");
    }
  } // namespace



  template <int dim>
  void
  check_early_contact(const StepContext<dim>               &step,
                      const NodalField                     &unknowns,
                      const std::vector<WallContacts<dim>> &walls,
                      const WallGaps                       &gaps,
                      Statistics                           &statistics)
  {
    // smaller strains are rounding errors of a body that is carried along
    constexpr double considerable = 0.03, no_strain = 1e-8;
    // cells: loads that rest on a wall are right, and hardly strain a body
    constexpr double no_gap = 1e-3;
    const MPI_Comm   comm   = step.grid.communicator();
    // of each wall: F, F where there is a gap, F g, F g / h, Σ |F_I|
    std::vector<std::array<double, 5>> sums(walls.size());
    unsigned int                       i = 0;
    for (unsigned int w = 0; w < walls.size(); ++w)
      for (const auto &node : walls[w].nodes)
        {
          const double F = std::max(node.force, 0.),
                       g = gaps.gap[i] == WallGaps::unknown ?
                             0. :
                             std::max(gaps.gap[i], 0.);
          sums[w][0] += F;
          sums[w][1] += (g > 0 ? F : 0.);
          sums[w][2] += F * g;
          sums[w][3] += (g > 0 ? F * g / gaps.cell_size[i] : 0.);
          sums[w][4] += std::abs(node.force);
          ++i;
        }
    const ArrayView<double> all(sums[0].data(), 5 * sums.size());
    Utilities::MPI::sum(ArrayView<const double>(all), comm, all);
    for (auto &sum : sums)
      if (!presses(sum[0], sum[4]))
        sum.fill(0);
    double       work = 0, of_one_sided = 0;
    unsigned int most = 0, n_one_sided = 0;
    for (unsigned int w = 0; w < walls.size(); ++w)
      {
        work += sums[w][2];
        of_one_sided += (walls[w].holds ? 0. : sums[w][2]);
        n_one_sided += (walls[w].holds ? 0 : 1);
        if (sums[w][2] > sums[most][2])
          most = w;
      }
    // without a column to fill, what is no reason for a warning isn't measured
    const bool gaps_count = sums[most][3] > no_gap * sums[most][0];
    double     share      = 0;
    if (work > 0 && (gaps_count || n_one_sided > 0))
      {
        std::array<double, 2> of_body = deformation_work(step, unknowns);
        sum_over_ranks(of_body, comm);
        if (of_body[0] > no_strain * no_strain * of_body[1])
          share = work / of_body[0];
      }
    if (n_one_sided > 0)
      statistics.set("Share of gaps in contact",
                     work > 0 ? share * of_one_sided / work : 0.);
    if (share > considerable && gaps_count)
      warn(step,
           walls[most],
           {sums[most][0], sums[most][1], sums[most][2], sums[most][3]},
           share);
  }



  template void
  check_early_contact(const StepContext<2> &,
                      const NodalField &,
                      const std::vector<WallContacts<2>> &,
                      const WallGaps &,
                      Statistics &);
  template void
  check_early_contact(const StepContext<3> &,
                      const NodalField &,
                      const std::vector<WallContacts<3>> &,
                      const WallGaps &,
                      Statistics &);
} // namespace isochor
