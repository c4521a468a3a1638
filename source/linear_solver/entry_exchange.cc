/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/linear_solver/entry_exchange.h>

#include <algorithm>
#include <functional>
#include <numeric>

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

    /** A rank's consecutive range of global numbers. */
    struct OwnedRange
    {
      explicit OwnedRange(const Epetra_Map &map)
        : n(map.NumMyElements())
        , begin(n > 0 ? map.MyGlobalElements()[0] : 0)
      {}

      bool
      contains(const int number) const
      {
        return number >= begin && number < begin + n;
      }

      int n, begin;
    };

    /** The columns of a sum of matrices: those that this rank owns, then those
     * of others, ascending. */
    struct SumColumns
    {
      OwnedRange       owned;
      std::vector<int> foreign;

      /** The local number of the column with a global one. */
      int
      number(const int name) const
      {
        return owned.contains(name) ?
                 name - owned.begin :
                 owned.n +
                   (std::lower_bound(foreign.begin(), foreign.end(), name) -
                    foreign.begin());
      }

      /** The global numbers. */
      std::vector<int>
      names() const
      {
        std::vector<int> all(owned.n + foreign.size());
        std::iota(all.begin(), all.begin() + owned.n, owned.begin);
        std::copy(foreign.begin(), foreign.end(), all.begin() + owned.n);
        return all;
      }
    };

    void
    sort_and_remove_copies(std::vector<int> &numbers)
    {
      std::sort(numbers.begin(), numbers.end());
      numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
    }
  } // namespace



  void
  check_trilinos(const int error, const char *call)
  {
    AssertThrow(error >= 0,
                ExcMessage(std::string("Trilinos: ") + call + " returned " +
                           std::to_string(error) + "."));
  }



  std::unique_ptr<Epetra_CrsMatrix>
  zero_matrix(const LocalPattern &pattern,
              const Epetra_Map   &rows,
              const Epetra_Map   &columns,
              const Epetra_Map   &domain,
              const Epetra_Map   &range)
  {
    Assert(!pattern.start.empty(), ExcInternalError());
    AssertDimension(pattern.start.size(),
                    static_cast<std::size_t>(rows.NumMyElements()) + 1);
    AssertDimension(static_cast<std::size_t>(pattern.start.back()),
                    pattern.column.size());
    const std::vector<int> &start = pattern.start;
    std::vector<int>        length(start.size() - 1);
    std::transform(start.begin() + 1,
                   start.end(),
                   start.begin(),
                   length.begin(),
                   std::minus<int>());
    auto matrix = std::make_unique<Epetra_CrsMatrix>(
      Copy, rows, columns, length.data(), true);
    const std::vector<double> zeros(
      length.empty() ? 0 : *std::max_element(length.begin(), length.end()), 0.);
    for (unsigned int row = 0; row < length.size(); ++row)
      if (length[row] > 0)
        check_trilinos(matrix->InsertMyValues(row,
                                              length[row],
                                              zeros.data(),
                                              pattern.column.data() +
                                                start[row]),
                       "InsertMyValues");
    check_trilinos(matrix->FillComplete(domain, range), "FillComplete");
    check_trilinos(matrix->OptimizeStorage(), "OptimizeStorage");
    return matrix;
  }



  EntryExchange::EntryExchange(const LocalPattern                &local,
                               const Names                       &rows,
                               const Names                       &columns,
                               const MPI_Comm                     comm,
                               std::unique_ptr<Epetra_CrsMatrix> &sum)
    : comm(comm)
  {
    // (RemoteIDList() of Epetra writes numbers that are no ranks where a rank
    // has no rows.)
    std::vector<int> end =
      Utilities::MPI::all_gather(comm, rows.owned.NumMyElements());
    std::partial_sum(end.begin(), end.end(), end.begin());
    const OwnedRange owned(rows.owned);
    Entries          to_others;
    for (int r = 0; r < rows.local.NumMyElements(); ++r)
      {
        const int row = rows.local.MyGlobalElements()[r];
        if (owned.contains(row) || local.start[r] == local.start[r + 1])
          continue;
        const auto owner = std::upper_bound(end.begin(), end.end(), row);
        AssertThrow(owner != end.end(), ExcInternalError());
        auto &entries = to_others[owner - end.begin()];
        for (int k = local.start[r]; k < local.start[r + 1]; ++k)
          entries.push_back(
            {{row, columns.local.MyGlobalElements()[local.column[k]]}});
      }
    const Entries from_others = Utilities::MPI::some_to_some(comm, to_others);

    std::vector<bool>      as_it_is;
    const std::vector<int> column_in_sum =
      lay_out(local, rows, columns, from_others, sum, as_it_is);
    for (const auto &[rank, entries] : to_others)
      {
        outgoing.push_back({static_cast<int>(rank),
                            static_cast<unsigned int>(to_send.size()),
                            {},
                            static_cast<unsigned int>(entries.size())});
        to_send.resize(to_send.size() + entries.size());
      }
    const Rows   to(*sum);
    unsigned int n_received = 0;
    for (const auto &[rank, entries] : from_others)
      {
        Message message{static_cast<int>(rank), n_received, {}, 0};
        for (const auto &[row, column] : entries)
          message.places.push_back(
            to.find(sum->RowMap().LID(row), sum->ColMap().LID(column)));
        message.size = message.places.size();
        n_received += message.size;
        incoming.push_back(message);
      }
    received.resize(n_received);
    values = to.value;
    find_places(local, rows, column_in_sum, *sum, as_it_is);
  }



  std::vector<int>
  EntryExchange::lay_out(const LocalPattern                &local,
                         const Names                       &rows,
                         const Names                       &columns,
                         const Entries                     &received,
                         std::unique_ptr<Epetra_CrsMatrix> &sum,
                         std::vector<bool>                 &as_it_is)
  {
    AssertDimension(local.start.size(),
                    static_cast<std::size_t>(rows.local.NumMyElements()) + 1);
    const OwnedRange owned_rows(rows.owned);
    SumColumns       in_sum{OwnedRange(columns.owned), {}};
    const int *const row_name    = rows.local.MyGlobalElements();
    const int *const column_name = columns.local.MyGlobalElements();

    // columns of others, and what the owned rows get from others
    std::vector<std::vector<int>> added(owned_rows.n);
    for (const auto &of_rank : received)
      for (const auto &[row, column] : of_rank.second)
        {
          added[row - owned_rows.begin].push_back(column);
          if (!in_sum.owned.contains(column))
            in_sum.foreign.push_back(column);
        }
    for (int c = 0; c < columns.local.NumMyElements(); ++c)
      if (!in_sum.owned.contains(column_name[c]))
        in_sum.foreign.push_back(column_name[c]);
    sort_and_remove_copies(in_sum.foreign);

    std::vector<int> column_in_sum(columns.local.NumMyElements());
    for (unsigned int c = 0; c < column_in_sum.size(); ++c)
      column_in_sum[c] = in_sum.number(column_name[c]);
    as_it_is.assign(rows.local.NumMyElements(), false);

    LocalPattern pattern;
    pattern.start.assign(owned_rows.n + 1, 0);
    pattern.column.reserve(local.column.size());
    std::vector<int> of_row;
    for (int r = 0; r < rows.local.NumMyElements(); ++r)
      {
        if (!owned_rows.contains(row_name[r]))
          continue;
        const int row = row_name[r] - owned_rows.begin;
        of_row.clear();
        for (int k = local.start[r]; k < local.start[r + 1]; ++k)
          of_row.push_back(column_in_sum[local.column[k]]);
        as_it_is[r] = std::is_sorted(of_row.begin(), of_row.end());
        for (const int name : added[row])
          of_row.push_back(in_sum.number(name));
        if (!as_it_is[r] || !added[row].empty())
          sort_and_remove_copies(of_row);
        if (static_cast<int>(of_row.size()) >
            local.start[r + 1] - local.start[r])
          as_it_is[r] = false;
        pattern.column.insert(pattern.column.end(),
                              of_row.begin(),
                              of_row.end());
        pattern.start[row + 1] = pattern.column.size();
      }

    const std::vector<int> names = in_sum.names();
    const Epetra_Map       column_map(
      -1, names.size(), names.data(), 0, rows.owned.Comm());
    sum =
      zero_matrix(pattern, rows.owned, column_map, columns.owned, rows.owned);
    return column_in_sum;
  }



  void
  EntryExchange::find_places(const LocalPattern      &local,
                             const Names             &rows,
                             const std::vector<int>  &column_in_sum,
                             const Epetra_CrsMatrix  &sum,
                             const std::vector<bool> &as_it_is)
  {
    AssertDimension(as_it_is.size(),
                    static_cast<std::size_t>(rows.local.NumMyElements()));
    Assert(!local.start.empty(), ExcInternalError());
    const Rows       to(sum);
    const OwnedRange owned(rows.owned);
    const int *const row_name = rows.local.MyGlobalElements();
    std::size_t      n_sent   = 0;
    for (unsigned int r = 0; r < as_it_is.size(); ++r)
      if (!as_it_is[r] && owned.contains(row_name[r]))
        {
          const int row = row_name[r] - owned.begin;
          scattered_rows.emplace_back(to.start[row], to.start[row + 1]);
          for (int k = local.start[r]; k < local.start[r + 1]; ++k)
            place.push_back(to.find(row, column_in_sum[local.column[k]]));
        }
    scattered.resize(place.size());

    // what goes to others stands in to_send in the order of the local rows
    double *next_scattered = scattered.data();
    for (unsigned int r = 0; r < as_it_is.size(); ++r)
      {
        const int n_entries = local.start[r + 1] - local.start[r];
        if (!owned.contains(row_name[r]))
          {
            first_entry.push_back(to_send.data() + n_sent);
            n_sent += n_entries;
          }
        else if (as_it_is[r])
          first_entry.push_back(values + to.start[row_name[r] - owned.begin]);
        else
          {
            first_entry.push_back(next_scattered);
            next_scattered += n_entries;
          }
      }
    AssertThrow(n_sent == to_send.size(), ExcInternalError());
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
    for (const auto &[begin, end] : scattered_rows)
      std::fill(values + begin, values + end, 0.);
    for (std::size_t i = 0; i < scattered.size(); ++i)
      values[place[i]] += scattered[i];
    // in the order of the ranks, whichever came first
    for (const Message &message : incoming)
      for (unsigned int i = 0; i < message.size; ++i)
        values[message.places[i]] += received[message.begin + i];
  }
} // namespace isochor
