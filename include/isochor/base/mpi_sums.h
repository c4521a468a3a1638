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
#include <cstdint>
#include <limits>
#include <numeric>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Whether all ranks call this with the same number, for Assert: that ranks
   * are at the same place. Collective. */
  inline bool
  is_same_on_all_ranks(const long value, const MPI_Comm comm)
  {
    return Utilities::MPI::min(value, comm) == Utilities::MPI::max(value, comm);
  }

  /**
   * What each rank has, by rank. Collective.
   *
   * In place of Utilities::MPI::all_gather(), which packs and compresses, on
   * one rank, too: that took a fifth of the time in which points are split and
   * merged.
   *
   * @throws ExcMessage if there is more than MPI can count.
   */
  template <typename T>
  std::vector<std::vector<T>>
  all_gather_arrays(const MPI_Comm comm, const std::vector<T> &mine)
  {
    static_assert(std::is_same<T, double>::value ||
                    std::is_same<T, unsigned int>::value ||
                    std::is_same<T, std::uint64_t>::value,
                  "Add the type of MPI.");
    const MPI_Datatype type =
      (std::is_same<T, double>::value       ? MPI_DOUBLE :
       std::is_same<T, unsigned int>::value ? MPI_UNSIGNED :
                                              MPI_UINT64_T);
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm);
    if (n_ranks == 1)
      return {mine};
    const std::uint64_t        n = mine.size();
    std::vector<std::uint64_t> numbers(n_ranks);
    int                        ierr =
      MPI_Allgather(&n, 1, MPI_UINT64_T, numbers.data(), 1, MPI_UINT64_T, comm);
    AssertThrowMPI(ierr);
    AssertThrow(std::accumulate(numbers.begin(), numbers.end(), 0.) <=
                  std::numeric_limits<int>::max(),
                ExcMessage("The ranks have more to tell each other than MPI "
                           "can count. Make the scene smaller."));
    const std::vector<int> sizes(numbers.begin(), numbers.end());
    std::vector<int>       begins(n_ranks);
    std::partial_sum(sizes.begin(), sizes.end() - 1, begins.begin() + 1);
    std::vector<T> all(begins.back() + sizes.back());
    ierr = MPI_Allgatherv(mine.data(),
                          n,
                          type,
                          all.data(),
                          sizes.data(),
                          begins.data(),
                          type,
                          comm);
    AssertThrowMPI(ierr);
    std::vector<std::vector<T>> by_rank(n_ranks);
    for (unsigned int r = 0; r < n_ranks; ++r)
      by_rank[r].assign(all.begin() + begins[r],
                        all.begin() + begins[r] + sizes[r]);
    return by_rank;
  }



  /** The sum of @p n over the ranks before this one, and over all ranks. */
  inline std::pair<types::global_dof_index, types::global_dof_index>
  exclusive_and_total_sum(const types::global_dof_index n, const MPI_Comm comm)
  {
    const auto all  = all_gather_arrays<types::global_dof_index>(comm, {n});
    const auto rank = Utilities::MPI::this_mpi_process(comm);
    types::global_dof_index before = 0, total = 0;
    for (unsigned int r = 0; r < all.size(); ++r)
      {
        if (r < rank)
          before += all[r][0];
        total += all[r][0];
      }
    return {before, total};
  }

  /** The numbers of all ranks, each once and in order. */
  inline std::vector<unsigned int>
  union_over_ranks(const std::vector<unsigned int> &numbers,
                   const MPI_Comm                   comm)
  {
    std::vector<unsigned int> all;
    for (const auto &of_rank : all_gather_arrays(comm, numbers))
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
