/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

#include <array>

namespace isochor
{
  /** CPDI: what a boundary has drawn out of the grid. */
  template <int dim>
  class OutsideOfGrid : public Diagnosis<dim>
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
      // domains stand for what a held boundary has left of them in the grid
      if (Utilities::MPI::max(points.domain_corners.cells.size(), comm) == 0)
        return;
      std::array<double, 2> volumes{}; // in the grid, of the points
      for (unsigned int q = 0; q < points.n_points(); ++q)
        {
          const double J = determinant(points.F[q]);
          volumes[0] += J * points.weight[q];
          volumes[1] += J * points.volume[q];
        }
      sum_over_ranks(volumes, comm);
      constexpr double       tolerated_part = 0.01;
      constexpr unsigned int n_tolerated    = 5; // resets in succession
      const double           outside        = 1 - volumes[0] / volumes[1];
      n_resets = outside > tolerated_part ? n_resets + 1 : 0;
      if (n_resets >= n_tolerated)
        this->warn("at t = " + rounded(step.old_time) + " " +
                   rounded(100 * outside) +
                   " % of the body are outside of the grid and carry no "
                   "stress: forces along the boundary are wrong by as much. "
                   "Let the grid follow (<Grid/Stretch>), or keep it (<Grid "
                   "reset/Steps between resets>).");
    }

  private:
    unsigned int n_resets = 0; ///< at which it was so, one after the other
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    OutsideOfGrid,
    "a body in part outside of the grid",
    ISOCHOR_ESSENTIAL,
    "`Quadrature/Type = CPDI`: more than 1 % of the volume of the points are "
    "outside of the grid at five resets in succession, where a Dirichlet "
    "condition has drawn the body out of a grid that is reset. This part "
    "carries no stress: forces along the boundary are wrong by as much, those "
    "across it by about half",
    "`Grid/Stretch`, a grid without resets, or a larger grid and `Interaction: "
    "name - place`")
} // namespace isochor
