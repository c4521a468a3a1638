/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

#include <array>

namespace isochor
{
  /** A body that no cell resolves. */
  template <int dim>
  class SmallBody : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> & /*scene*/,
                const StepContext<dim> &step,
                const SparseSystem & /*matrix*/) override
    {
      // a body that fills less than this part of the cells it is in isn't
      // resolved by them, whatever its shape
      constexpr double        smallest_share = 0.01;
      std::array<double, 3>   sums{}; // body, its cells, number of them
      const PointArrays<dim> &points = step.points;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        {
          sums[1] += step.grid.geometry().measure(points.cell[k]);
          sums[2] += 1;
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            sums[0] += points.volume[q];
        }
      sum_over_ranks(sums, step.grid.communicator());
      if (sums[0] < smallest_share * sums[1])
        this->warn("the body fills " + rounded(100 * sums[0] / sums[1]) +
                   " % of the " + rounded(sums[2]) + " cell(s) it is in (" +
                   rounded(sums[0]) + " of " + rounded(sums[1]) +
                   (dim == 2 ? " m^2" : " m^3") +
                   "). Are <Grid> and <Material points> in the same unit? Else "
                   "raise <Grid/Subdivisions>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SmallBody,
    "a body smaller than a cell",
    ISOCHOR_ESSENTIAL,
    "the body fills less than 1 % of the cells it is in",
    "the same units in `Grid` and `Material points`; a finer grid")
} // namespace isochor
