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

    /** For each row of @p local the number of its first entry, for add(). Those
     * of a row are numbered one after the other. */
    const std::vector<unsigned int> &
    first_entries() const
    {
      return first_entry;
    }

    /** Add @p value to entry @p k of the contribution, see first_entries().
     * Each entry at most once. */
    void
    add(const unsigned int k, const double value)
    {
      if (k < n_values)
        {
          values[k] += value;
          return;
        }
      const unsigned int to = target[k - n_values];
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

    /** Rows that stand in the sum as they are, which are nearly all, have the
     * numbers of their places there: without a list in between adding takes
     * half the time. The entries of others have larger numbers. */
    std::vector<unsigned int> first_entry;
    /** By number of such an entry, less n_values: its place in the sum or,
     * behind those, in to_send. */
    std::vector<unsigned int> target;
    std::vector<Message>      outgoing, incoming;
    std::vector<double>       to_send, received;
  };
} // namespace isochor

#endif
