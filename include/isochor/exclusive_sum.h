/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_exclusive_sum_h
#define isochor_exclusive_sum_h

#include <deal.II/base/mpi.h>

#include <utility>

namespace isochor
{
  using namespace dealii;

  /** The sum of @p n over the ranks before this one, and over all ranks. */
  inline std::pair<types::global_dof_index, types::global_dof_index>
  exclusive_and_total_sum(const types::global_dof_index n, const MPI_Comm comm)
  {
    const auto              all    = Utilities::MPI::all_gather(comm, n);
    const auto              rank   = Utilities::MPI::this_mpi_process(comm);
    types::global_dof_index before = 0, total = 0;
    for (unsigned int r = 0; r < all.size(); ++r)
      {
        if (r < rank)
          before += all[r];
        total += all[r];
      }
    return {before, total};
  }
} // namespace isochor

#endif
