/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_entry_exchange_h
#define isochor_entry_exchange_h

#include <deal.II/base/mpi.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <array>
#include <map>
#include <memory>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Throw if @p error, which Trilinos' @p call returned, is one. */
  void
  check_trilinos(const int error, const char *call);

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

    /** For each local row where its contribution is to be written before
     * finish(): the entries one after the other, all of them. */
    const std::vector<double *> &
    first_entries() const
    {
      return first_entry;
    }

    /** Sum up what has been written: hand over what other ranks own, and add
     * what they have. Collective. */
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
    using Entries = std::map<unsigned int, std::vector<std::array<int, 2>>>;

    /** Let @p sum have the entries of @p local in owned rows and those of
     * @p received. Returns the columns of @p sum by local columns, and sets
     * @p as_it_is for the local rows that are rows of @p sum, entry by entry.
     */
    static std::vector<int>
    lay_out(const LocalPattern                &local,
            const Names                       &rows,
            const Names                       &columns,
            const Entries                     &received,
            std::unique_ptr<Epetra_CrsMatrix> &sum,
            std::vector<bool>                 &as_it_is);

    /** Find where the entries of @p local go, see lay_out(). */
    void
    find_places(const LocalPattern      &local,
                const Names             &rows,
                const std::vector<int>  &column_in_sum,
                const Epetra_CrsMatrix  &sum,
                const std::vector<bool> &as_it_is);

    MPI_Comm comm;
    double  *values; ///< of the sum

    /** Rows that stand in the sum as they are, which are nearly all, are
     * written there: without a list of places in between that takes half the
     * time. Those of other ranks are written to to_send, the others to
     * scattered. */
    std::vector<double *> first_entry;
    /** The entries of the other owned rows, and their places in the sum. */
    std::vector<double>       scattered;
    std::vector<unsigned int> place;
    /** Those rows in the sum: from where to where. */
    std::vector<std::pair<unsigned int, unsigned int>> scattered_rows;
    std::vector<Message>                               outgoing, incoming;
    std::vector<double>                                to_send, received;
  };
} // namespace isochor

#endif
