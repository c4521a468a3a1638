/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_entry_exchange_h
#define isochor_entry_exchange_h

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <algorithm>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Which entries a rank contributes to a matrix: row r has those from
   * start[r] up to start[r + 1], their columns ascending. Rows and columns by
   * local numbers, of which larger ones stand for larger global ones. */
  struct LocalPattern
  {
    std::vector<int> start, column;
  };

  /** A matrix of zeros with the entries of @p pattern, filled, storage
   * optimised. */
  std::unique_ptr<Epetra_CrsMatrix>
  zero_matrix(const LocalPattern &pattern,
              const Epetra_Map   &rows,
              const Epetra_Map   &columns,
              const Epetra_Map   &domain,
              const Epetra_Map   &range);

  /**
   * Sums matrices over ranks, again and again with the same pattern: where each
   * entry of a rank's contribution goes is found once. (Epetra_Export would
   * search for each entry each time, which takes longer than an iteration of a
   * Krylov method.)
   */
  class EntryExchange
  {
  public:
    /** What the rows or the columns of a matrix are called: the global numbers
     * of the local ones, and of those that the rank owns, which are numbered
     * rank by rank. */
    struct Names
    {
      const Epetra_Map &local, &owned;
    };

    /** @p local is this rank's contribution. @p sum becomes the matrix that
     * has the entries of all contributions, filled, storage optimised, its
     * owned columns before the others; it has to outlive the object.
     * Collective. */
    EntryExchange(const LocalPattern                &local,
                  const Names                       &rows,
                  const Names                       &columns,
                  const MPI_Comm                     comm,
                  std::unique_ptr<Epetra_CrsMatrix> &sum);

    /** Let the sum be zero. */
    void
    start()
    {
      std::fill(values, values + n_values, 0.);
    }

    /** For each local row the number of its first entry, for add(). Those of a
     * row are numbered one after the other. */
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

    /** The entries that a rank has for others, and those that it gets, by
     * rank: global numbers of rows and columns. */
    using Entries = std::map<unsigned int, std::vector<std::pair<int, int>>>;

    /** Let @p sum have the entries of @p local in owned rows and those of
     * @p received. */
    static void
    lay_out(const LocalPattern                &local,
            const Names                       &rows,
            const Names                       &columns,
            const Entries                     &received,
            std::unique_ptr<Epetra_CrsMatrix> &sum);

    /** Number the entries of @p local. */
    void
    number_entries(const LocalPattern     &local,
                   const Names            &rows,
                   const Names            &columns,
                   const Epetra_CrsMatrix &sum);

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
