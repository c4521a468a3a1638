/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/linear_solver/trilinos_export.h>

#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <Epetra_MpiComm.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace isochor
{
  namespace
  {
    /** The maps are made by functions as Epetra's have no default. */
    Epetra_Map
    make_map(const std::vector<int> &numbers, const MPI_Comm comm)
    {
      return Epetra_Map(
        -1, numbers.size(), numbers.data(), 0, Epetra_MpiComm(comm));
    }

    std::vector<bool>
    is_in_field(const SparseSystem &A, const SparseSystem::Field field)
    {
      std::vector<bool> is_member(A.field.size());
      for (std::size_t i = 0; i < is_member.size(); ++i)
        is_member[i] = (A.field[i] == field);
      return is_member;
    }
  } // namespace

  EquationSubset::EquationSubset(const SparseSystem &A)
    : EquationSubset(A, std::vector<bool>(A.global_equation.size(), true), 1)
  {}

  EquationSubset::EquationSubset(const SparseSystem       &A,
                                 const SparseSystem::Field field,
                                 const bool                padded)
    : EquationSubset(A, is_in_field(A, field), padded ? A.dim : 1)
  {
    Assert(!padded || field == SparseSystem::Field::displacement,
           ExcInternalError());
  }

  EquationSubset::EquationSubset(const SparseSystem      &A,
                                 const std::vector<bool> &is_member,
                                 const unsigned int       block_size)
    : owned_map(0, 0, Epetra_MpiComm(A.comm))
    , local_map(0, 0, Epetra_MpiComm(A.comm))
  {
    AssertThrow(block_size * A.n_equations <
                  static_cast<types::global_dof_index>(
                    std::numeric_limits<int>::max()),
                ExcMessage("Epetra numbers equations by 32-bit integers."));
    lay_out_rows(A, is_member, block_size);

    const int n_owned = std::count(is_owned.begin(), is_owned.end(), true);
    int       begin   = 0;
    const int ierr = MPI_Exscan(&n_owned, &begin, 1, MPI_INT, MPI_SUM, A.comm);
    AssertThrowMPI(ierr);
    locally_owned.set_size(Utilities::MPI::sum(n_owned, A.comm));
    locally_owned.add_range(begin, begin + n_owned);

    // The owners tell the others the new numbers.
    std::vector<int> owned_equations, all_equations;
    for (const types::global_dof_index equation : A.global_equation)
      {
        all_equations.push_back(equation);
        if (A.locally_owned.is_element(equation))
          owned_equations.push_back(equation);
      }
    AssertThrow(owned_equations.size() == A.locally_owned.n_elements(),
                ExcMessage("A rank owns equations that its cells don't "
                           "touch."));
    const Epetra_Map system_owned = make_map(owned_equations, A.comm);
    const Epetra_Map system_local = make_map(all_equations, A.comm);
    Epetra_IntVector number_of_owned(system_owned);
    Epetra_IntVector number_of_local(system_local);
    for (std::size_t i = 0; i < owned_row.size(); ++i)
      number_of_owned[owned_position[i]] = begin + owned_row[i];
    const Epetra_Import to_local(system_local, system_owned);
    check_trilinos(number_of_local.Import(number_of_owned, to_local, ::Insert),
                   "Import");

    std::vector<int> local_numbers(is_owned.size()), owned_numbers;
    for (std::size_t i = 0; i < row_of.size(); ++i)
      if (row_of[i] != numbers::invalid_unsigned_int)
        {
          const unsigned int c     = (block_size == 1 ? 0 : A.component[i]);
          const unsigned int first = row_of[i] - c;
          for (unsigned int k = 0; k < block_size; ++k)
            local_numbers[first + k] = number_of_local[i] - c + k;
        }
    for (std::size_t row = 0; row < is_owned.size(); ++row)
      if (is_owned[row])
        owned_numbers.push_back(local_numbers[row]);
    owned_map = make_map(owned_numbers, A.comm);
    local_map = make_map(local_numbers, A.comm);
  }

  void
  EquationSubset::lay_out_rows(const SparseSystem      &A,
                               const std::vector<bool> &is_member,
                               const unsigned int       block_size)
  {
    constexpr unsigned int invalid = numbers::invalid_unsigned_int;
    row_of.assign(is_member.size(), invalid);
    unsigned int node = invalid, first_row = 0, n_owned_equations = 0,
                 first_owned_row = 0, n_owned_rows = 0;
    std::vector<unsigned int> equation_at; // by row, of the present node
    const auto                pad = [&]() {
      const auto any =
        std::find_if(equation_at.begin(),
                     equation_at.end(),
                     [](unsigned int e) { return e != invalid; });
      for (unsigned int k = 0; k < equation_at.size(); ++k)
        if (equation_at[k] == invalid)
          padding.emplace_back(first_row + k, *any);
    };
    for (std::size_t i = 0; i < is_member.size(); ++i)
      {
        const bool owned = A.locally_owned.is_element(A.global_equation[i]);
        const unsigned int position = n_owned_equations;
        n_owned_equations += owned;
        if (!is_member[i])
          continue;
        if (block_size == 1 || node != A.node[i])
          {
            pad();
            node            = A.node[i];
            first_row       = is_owned.size();
            first_owned_row = n_owned_rows;
            is_owned.insert(is_owned.end(), block_size, owned);
            n_owned_rows += owned ? block_size : 0;
            equation_at.assign(block_size, invalid);
          }
        const unsigned int k = (block_size == 1 ? 0 : A.component[i]);
        equation_at[k]       = i;
        row_of[i]            = first_row + k;
        if (owned)
          {
            owned_row.push_back(first_owned_row + k);
            owned_position.push_back(position);
          }
      }
    pad();
  }

  void
  EquationSubset::extract(const TrilinosWrappers::MPI::Vector &whole,
                          TrilinosWrappers::MPI::Vector       &part) const
  {
    if (owned_row.size() < locally_owned.n_elements())
      std::fill(part.begin(), part.end(), 0.);
    const auto from = whole.begin();
    auto       to   = part.begin();
    for (std::size_t i = 0; i < owned_position.size(); ++i)
      to[owned_row[i]] = from[owned_position[i]];
  }

  void
  EquationSubset::insert(const TrilinosWrappers::MPI::Vector &part,
                         TrilinosWrappers::MPI::Vector       &whole) const
  {
    const auto from = part.begin();
    auto       to   = whole.begin();
    for (std::size_t i = 0; i < owned_position.size(); ++i)
      to[owned_position[i]] = from[owned_row[i]];
  }

  TrilinosBlock::TrilinosBlock(const SparseSystem   &A,
                               const EquationSubset &rows,
                               const EquationSubset &columns)
    : rows(rows)
    , columns(columns)
  {
    const LocalPattern local = local_pattern(A);
    if (Utilities::MPI::n_mpi_processes(A.comm) > 1)
      exchange = std::make_unique<EntryExchange>(
        local,
        EntryExchange::Names{rows.local_map, rows.owned_map},
        EntryExchange::Names{columns.local_map, columns.owned_map},
        A.comm,
        block);
    else
      block = zero_matrix(local,
                          rows.local_map,
                          columns.local_map,
                          columns.owned_map,
                          rows.owned_map);
    copy_values(A);
  }

  template <typename Action>
  void
  TrilinosBlock::for_each_entry(const SparseSystem &A,
                                const Action       &action) const
  {
    constexpr unsigned int invalid = numbers::invalid_unsigned_int;
    for (unsigned int i = 0; i + 1 < A.row_start.size(); ++i)
      {
        const unsigned int row    = rows.row_of[i];
        const unsigned int column = (A.symmetric ? columns.row_of[i] : invalid);
        if (row == invalid && column == invalid)
          continue;
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            const unsigned int j = A.column[k];
            if (row != invalid && columns.row_of[j] != invalid)
              action(row, columns.row_of[j], k);
            if (column != invalid && i != j && rows.row_of[j] != invalid)
              action(rows.row_of[j], column, k);
          }
      }
    if (&rows == &columns)
      for (const auto &[row, equation] : rows.padding)
        for (std::size_t k = A.row_start[equation];
             k < A.row_start[equation + 1];
             ++k)
          if (A.column[k] == equation)
            action(row, row, k);
  }

  template <typename Action>
  void
  TrilinosBlock::for_each_value(const SparseSystem &A,
                                const Action       &action) const
  {
    int    *offsets, *indices;
    double *values;
    check_trilinos(block->ExtractCrsDataPointers(offsets, indices, values),
                   "ExtractCrsDataPointers");
    std::vector<int> next(offsets, offsets + rows.is_owned.size());
    for_each_entry(A, [&](unsigned int r, unsigned int, std::size_t k) {
      action(values[next[r]++], k);
    });
  }

  LocalPattern
  TrilinosBlock::local_pattern(const SparseSystem &A) const
  {
    const std::size_t n_rows = rows.is_owned.size();
    LocalPattern      local;
    local.start.assign(n_rows + 1, 0);
    for_each_entry(A, [&](unsigned int r, unsigned int, std::size_t) {
      ++local.start[r + 1];
    });
    std::partial_sum(local.start.begin(),
                     local.start.end(),
                     local.start.begin());
    local.column.resize(local.start.back());
    std::vector<int> next(local.start);
    for_each_entry(A, [&](unsigned int r, unsigned int c, std::size_t) {
      local.column[next[r]++] = c;
    });
    return local;
  }

  void
  TrilinosBlock::copy_values(const SparseSystem &A)
  {
    if (exchange)
      {
        std::vector<double *> next(exchange->first_entries());
        for_each_entry(A, [&](unsigned int r, unsigned int, std::size_t k) {
          *next[r]++ = A.values[k];
        });
        exchange->finish();
        return;
      }
    for_each_value(A, [&](double &value, const std::size_t k) {
      value = A.values[k];
    });
  }

  void
  TrilinosBlock::restore_values(SparseSystem &A) const
  {
    AssertThrow(!exchange, ExcInternalError());
    for_each_value(A, [&](const double value, const std::size_t k) {
      A.values[k] = value;
    });
  }

  const Epetra_CrsMatrix &
  TrilinosBlock::matrix() const
  {
    return *block;
  }

  Epetra_CrsMatrix &
  TrilinosBlock::matrix()
  {
    return *block;
  }

  void
  TrilinosBlock::vmult(TrilinosWrappers::MPI::Vector       &dst,
                       const TrilinosWrappers::MPI::Vector &src) const
  {
    check_trilinos(matrix().Multiply(false,
                                     src.trilinos_vector(),
                                     dst.trilinos_vector()),
                   "Multiply");
  }

  void
  TrilinosBlock::Tvmult(TrilinosWrappers::MPI::Vector       &dst,
                        const TrilinosWrappers::MPI::Vector &src) const
  {
    check_trilinos(matrix().Multiply(true,
                                     src.trilinos_vector(),
                                     dst.trilinos_vector()),
                   "Multiply");
  }
} // namespace isochor
