/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/material_points/point_domain.h>

#include <algorithm>
#include <array>

namespace isochor
{
  namespace
  {
    /** From this share of their cells on, domains have hardly more corners than
     * the grid has nodes around them: those in rows of cells move all corners
     * alike when every other row of nodes goes too far and the next not far
     * enough. That is no harm as long as corners lie on nodes but for this
     * weight. */
    constexpr double as_large_as_cells = 0.9, on_node = 0.02;
    /** Of the body, in such domains. */
    constexpr double tolerated_share = 0.01;

    /** Those that the corners of a domain with this stencil lie between. */
    template <typename Stencil>
    unsigned int
    n_nodes_felt(const Stencil &stencil)
    {
      return std::count_if(stencil.shape,
                           stencil.shape + stencil.n_nodes,
                           [](const double N) { return N > on_node; });
    }
  } // namespace



  /** CPDI: domains that are longer than their cells, or as large as these and
   * beside their nodes. */
  template <int dim>
  class LongDomains : public Diagnosis<dim>
  {
  public:
    void
    grid_reset(const Scene<dim> & /*scene*/,
               const StepContext<dim> &step,
               const ElementNodes & /*elements*/,
               const bool /*is_kept*/) override
    {
      const PointArrays<dim> &points = step.points;
      const MPI_Comm          comm   = step.grid.communicator();
      if (Utilities::MPI::max(points.domain_corners.cells.size(), comm) == 0)
        return;
      const auto           &geometry = step.grid.geometry();
      double                longest  = 0;
      std::array<double, 2> volumes{}; // of long domains, of all
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            typename PointDomain<dim>::Corners corners;
            for (unsigned int c = 0; c <= dim; ++c)
              corners[c] = Point<dim>(points.F[q] * points.domain[q][c]);
            const double length =
              length_in_cells<dim>(corners, geometry, points.cell[k]);
            const double V = determinant(points.F[q]) * points.volume[q];
            volumes[1] += V;
            if (length > tolerated_length ||
                (V > as_large_as_cells * geometry.measure(points.cell[k]) &&
                 n_nodes_felt(points.stencil(geometry, k, q)) > dim + 1))
              volumes[0] += V;
            longest = std::max(longest, length);
          }
      longest = Utilities::MPI::max(longest, comm);
      sum_over_ranks(volumes, comm);
      if (volumes[0] <= tolerated_share * volumes[1])
        return;
      this->warn("at t = " + rounded(step.old_time) + " the domains of " +
                 rounded(100 * volumes[0] / volumes[1]) +
                 " % of the body are longer than their cells, by up to " +
                 rounded(longest) +
                 " times: displacements of nodes between their corners are "
                 "arbitrary. Use more <Points per cell>, or <Split at share "
                 "of cell = 0.1>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    LongDomains,
    "domains longer than the cells",
    ISOCHOR_ESSENTIAL,
    "CPDI: at a reset of the grid more than 1 % of the body consist of points "
    "whose deformed domains have edges longer than 1.2 times their cell and "
    "its neighbours in the same direction, or of points with at least 0.9 of "
    "its volume (one point per cell) that have moved off the nodes; nodes "
    "between the corners of a domain then feel nothing, and displacements of "
    "the grid and of probes become arbitrary while forces, stresses and points "
    "stay right for a while (a bar with 4 points per cell: from a stretch of "
    "2.4 on)",
    "more points per cell, `Split at share of cell = 0.1` (0.2 halves each "
    "domain of 4 points per cell once), or fewer resets")
} // namespace isochor
