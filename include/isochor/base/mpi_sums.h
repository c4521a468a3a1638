/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mpi_sums_h
#define isochor_mpi_sums_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

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

  /** The numbers of all ranks, each once and in order. */
  inline std::vector<unsigned int>
  union_over_ranks(const std::vector<unsigned int> &numbers,
                   const MPI_Comm                   comm)
  {
    std::vector<unsigned int> all;
    // packing, which compresses, took 2 % of a run on an adaptive grid
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      all = numbers;
    else
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, numbers))
        all.insert(all.end(), of_rank.begin(), of_rank.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }



  /** Replace each value by its sum over the ranks. */
  template <std::size_t n>
  void
  sum_over_ranks(std::array<double, n> &values, const MPI_Comm comm)
  {
    Utilities::MPI::sum(ArrayView<const double>(values.data(), n),
                        comm,
                        ArrayView<double>(values.data(), n));
  }
} // namespace isochor

#endif
