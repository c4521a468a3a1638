/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_entry_exchange_h
#define isochor_entry_exchange_h

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Sums matrices over ranks, again and again with the same pattern: where each
   * entry of a rank's contribution goes is found once. (Epetra_Export would
   * search for each entry each time, which takes longer than an iteration of a
   * Krylov method.)
   */
  class EntryExchange
  {
  public:
    /** @p local is this rank's contribution, of which only the pattern counts,
     * @p sum the sum, whose rows are numbered rank by rank and whose pattern
     * has those of all contributions. @p sum has to outlive the object. Both
     * are filled, storage optimised. Collective. */
    EntryExchange(const Epetra_CrsMatrix &local,
                  Epetra_CrsMatrix       &sum,
                  const MPI_Comm          comm);

    /** Let the sum be zero. */
    void
    start()
    {
      std::fill(values, values + n_values, 0.);
    }

    /** Add @p value to entry @p k of the contribution, counted as it stands in
     * @p local. Each entry at most once. */
    void
    add(const std::size_t k, const double value)
    {
      const unsigned int to = target[k];
      if (to < n_values)
        values[to] += value;
      else
        to_send[to - n_values] = value;
    }

    /** Hand over what other ranks own, and add what they have. Collective. */
    void
    finish();

  private:
    /** The entries that go to or come from another rank. */
    struct Message
    {
      int                       rank;
      unsigned int              begin;  ///< in to_send, or in received
      std::vector<unsigned int> places; ///< in the sum; only of incoming ones
      unsigned int              size;
    };

    MPI_Comm     comm;
    double      *values;
    unsigned int n_values;

    /** By entry of the contribution: its place in the sum or, behind those, in
     * to_send. */
    std::vector<unsigned int> target;
    std::vector<Message>      outgoing, incoming;
    std::vector<double>       to_send, received;
  };
} // namespace isochor

#endif
