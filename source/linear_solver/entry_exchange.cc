/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/linear_solver/entry_exchange.h>

#include <Epetra_Map.h>

#include <map>
#include <numeric>
#include <utility>

namespace isochor
{
  namespace
  {
    /** A matrix in compressed-row form. */
    struct Rows
    {
      explicit Rows(const Epetra_CrsMatrix &A)
      {
        const int error = A.ExtractCrsDataPointers(start, column, value);
        AssertThrow(error == 0, ExcMessage("Trilinos: storage of a matrix."));
      }

      /** Where the entry of a row and a column, by local numbers, is. */
      unsigned int
      find(const int row, const int col) const
      {
        const int *const begin = column + start[row];
        const int *const end   = column + start[row + 1];
        const int *const found = std::lower_bound(begin, end, col);
        AssertThrow(found != end && *found == col, ExcInternalError());
        return found - column;
      }

      int    *start, *column;
      double *value;
    };

    bool
    are_consecutive(const std::vector<unsigned int> &numbers)
    {
      for (std::size_t i = 1; i < numbers.size(); ++i)
        if (numbers[i] != numbers[i - 1] + 1)
          return false;
      return true;
    }
  } // namespace



  EntryExchange::EntryExchange(const Epetra_CrsMatrix &local,
                               Epetra_CrsMatrix       &sum,
                               const MPI_Comm          comm)
    : comm(comm)
  {
    const Rows from(local), to(sum);
    values   = to.value;
    n_values = sum.NumMyNonzeros();

    // (RemoteIDList() of Epetra writes numbers that are no ranks where a rank
    // has no rows.)
    std::vector<int> end = Utilities::MPI::all_gather(comm, sum.NumMyRows());
    std::partial_sum(end.begin(), end.end(), end.begin());
    const auto owner = [&](const int row) {
      const auto found = std::upper_bound(end.begin(), end.end(), row);
      AssertThrow(found != end.end(), ExcInternalError());
      return static_cast<unsigned int>(found - end.begin());
    };
    const int        n_rows = local.NumMyRows();
    std::vector<int> column_here(local.NumMyCols());
    for (unsigned int c = 0; c < column_here.size(); ++c)
      column_here[c] = sum.ColMap().LID(local.ColMap().GID(c));

    // entries of other ranks' rows: their numbers, and the global numbers of
    // their rows and columns
    std::map<unsigned int, std::vector<unsigned int>>        entries;
    std::map<unsigned int, std::vector<std::pair<int, int>>> names;
    std::vector<unsigned int>                                places;
    for (int r = 0; r < n_rows; ++r)
      {
        const int row  = local.RowMap().GID(r);
        const int here = sum.RowMap().LID(row);
        places.clear();
        for (int k = from.start[r]; k < from.start[r + 1]; ++k)
          if (here >= 0)
            places.push_back(to.find(here, column_here[from.column[k]]));
          else
            {
              entries[owner(row)].push_back(target.size() + places.size());
              names[owner(row)].emplace_back(
                row, local.ColMap().GID(from.column[k]));
              places.push_back(0); // is set below
            }
        if (here >= 0 && are_consecutive(places))
          {
            first_entry.push_back(places.empty() ? 0 : places.front());
            continue;
          }
        first_entry.push_back(n_values + target.size());
        target.insert(target.end(), places.begin(), places.end());
      }
    unsigned int n_to_send = 0;
    for (const auto &of_rank : entries)
      {
        outgoing.push_back({static_cast<int>(of_rank.first),
                            n_to_send,
                            {},
                            static_cast<unsigned int>(of_rank.second.size())});
        for (const unsigned int k : of_rank.second)
          target[k] = n_values + n_to_send++;
      }
    to_send.resize(n_to_send);

    unsigned int n_received = 0;
    for (const auto &of_rank : Utilities::MPI::some_to_some(comm, names))
      {
        Message message{static_cast<int>(of_rank.first), n_received, {}, 0};
        for (const auto &[row, column] : of_rank.second)
          message.places.push_back(
            to.find(sum.RowMap().LID(row), sum.ColMap().LID(column)));
        message.size = message.places.size();
        n_received += message.size;
        incoming.push_back(message);
      }
    received.resize(n_received);
  }



  void
  EntryExchange::finish()
  {
    constexpr int            tag = 5931;
    std::vector<MPI_Request> requests(incoming.size() + outgoing.size());
    auto                     request = requests.begin();
    for (const Message &message : incoming)
      {
        const int ierr = MPI_Irecv(received.data() + message.begin,
                                   message.size,
                                   MPI_DOUBLE,
                                   message.rank,
                                   tag,
                                   comm,
                                   &*request++);
        AssertThrowMPI(ierr);
      }
    for (const Message &message : outgoing)
      {
        const int ierr = MPI_Isend(to_send.data() + message.begin,
                                   message.size,
                                   MPI_DOUBLE,
                                   message.rank,
                                   tag,
                                   comm,
                                   &*request++);
        AssertThrowMPI(ierr);
      }
    const int ierr =
      MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    AssertThrowMPI(ierr);
    // in the order of the ranks, whichever came first
    for (const Message &message : incoming)
      for (unsigned int i = 0; i < message.size; ++i)
        values[message.places[i]] += received[message.begin + i];
  }
} // namespace isochor
