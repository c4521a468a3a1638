/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/trilinos_export.h>

#include <Epetra_Import.h>
#include <Epetra_IntVector.h>
#include <Epetra_MpiComm.h>

#include <algorithm>
#include <limits>

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

    void
    check(const int error, const char *call)
    {
      AssertThrow(error >= 0,
                  ExcMessage(std::string("Trilinos: ") + call + " returned " +
                             std::to_string(error) + "."));
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
    : EquationSubset(A, std::vector<bool>(A.global_equation.size(), true))
  {}

  EquationSubset::EquationSubset(const SparseSystem       &A,
                                 const SparseSystem::Field field)
    : EquationSubset(A, is_in_field(A, field))
  {}

  EquationSubset::EquationSubset(const SparseSystem      &A,
                                 const std::vector<bool> &is_member)
    : owned_map(0, 0, Epetra_MpiComm(A.comm))
    , local_map(0, 0, Epetra_MpiComm(A.comm))
  {
    AssertThrow(A.n_equations < static_cast<types::global_dof_index>(
                                  std::numeric_limits<int>::max()),
                ExcMessage("Epetra numbers equations by 32-bit integers."));
    index_of.assign(is_member.size(), numbers::invalid_unsigned_int);
    std::vector<int> owned_equations, all_equations;
    for (std::size_t i = 0; i < is_member.size(); ++i)
      {
        const int  equation = A.global_equation[i];
        const bool owned    = A.locally_owned.is_element(equation);
        all_equations.push_back(equation);
        if (is_member[i])
          {
            index_of[i] = local_equation.size();
            local_equation.push_back(i);
            is_owned.push_back(owned);
            if (owned)
              owned_position.push_back(owned_equations.size());
          }
        if (owned)
          owned_equations.push_back(equation);
      }
    AssertThrow(owned_equations.size() == A.locally_owned.n_elements(),
                ExcMessage("A rank owns equations that its cells don't "
                           "touch."));

    const int n_owned = owned_position.size();
    int       begin   = 0;
    const int ierr = MPI_Exscan(&n_owned, &begin, 1, MPI_INT, MPI_SUM, A.comm);
    AssertThrowMPI(ierr);
    locally_owned.set_size(Utilities::MPI::sum(n_owned, A.comm));
    locally_owned.add_range(begin, begin + n_owned);

    // The owners tell the others the new numbers.
    const Epetra_Map system_owned = make_map(owned_equations, A.comm);
    const Epetra_Map system_local = make_map(all_equations, A.comm);
    Epetra_IntVector number_of_owned(system_owned);
    Epetra_IntVector number_of_local(system_local);
    for (int i = 0; i < n_owned; ++i)
      number_of_owned[owned_position[i]] = begin + i;
    const Epetra_Import to_local(system_local, system_owned);
    check(number_of_local.Import(number_of_owned, to_local, ::Insert),
          "Import");

    std::vector<int> owned_numbers, local_numbers;
    for (std::size_t i = 0; i < local_equation.size(); ++i)
      {
        local_numbers.push_back(number_of_local[local_equation[i]]);
        if (is_owned[i])
          owned_numbers.push_back(local_numbers.back());
      }
    owned_map = make_map(owned_numbers, A.comm);
    local_map = make_map(local_numbers, A.comm);
  }

  void
  EquationSubset::extract(const TrilinosWrappers::MPI::Vector &whole,
                          TrilinosWrappers::MPI::Vector       &part) const
  {
    const auto from = whole.begin();
    auto       to   = part.begin();
    for (std::size_t i = 0; i < owned_position.size(); ++i)
      to[i] = from[owned_position[i]];
  }

  void
  EquationSubset::insert(const TrilinosWrappers::MPI::Vector &part,
                         TrilinosWrappers::MPI::Vector       &whole) const
  {
    const auto from = part.begin();
    auto       to   = whole.begin();
    for (std::size_t i = 0; i < owned_position.size(); ++i)
      to[owned_position[i]] = from[i];
  }

  TrilinosBlock::TrilinosBlock(const SparseSystem   &A,
                               const EquationSubset &rows,
                               const EquationSubset &columns)
    : rows(rows)
    , columns(columns)
  {
    make_local_pattern(A);
    if (Utilities::MPI::n_mpi_processes(A.comm) > 1)
      {
        to_owners =
          std::make_unique<Epetra_Export>(rows.local_map, rows.owned_map);
        summed = std::make_unique<Epetra_CrsMatrix>(Copy, rows.owned_map, 0);
        check(summed->Export(*local, *to_owners, ::Add), "Export");
        check(summed->FillComplete(columns.owned_map, rows.owned_map),
              "FillComplete");
      }
    copy_values(A);
  }

  void
  TrilinosBlock::make_local_pattern(const SparseSystem &A)
  {
    const std::size_t n_rows = rows.local_equation.size();
    place.assign(A.column.size(), none);
    mirrored_place.assign(A.symmetric ? A.column.size() : 0, none);

    // As rows ascend, a row gets its mirrored entries before its own ones,
    // and thus its columns in ascending order.
    const auto for_each_entry = [&](const auto &action) {
      for (unsigned int i = 0; i + 1 < A.row_start.size(); ++i)
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            const unsigned int j   = A.column[k];
            const auto is_in_block = [&](unsigned int r, unsigned int c) {
              return rows.index_of[r] != numbers::invalid_unsigned_int &&
                     columns.index_of[c] != numbers::invalid_unsigned_int;
            };
            if (is_in_block(i, j))
              action(rows.index_of[i], columns.index_of[j], place[k]);
            if (A.symmetric && i != j && is_in_block(j, i))
              action(rows.index_of[j], columns.index_of[i], mirrored_place[k]);
          }
    };

    std::vector<int> length(n_rows, 0), start(n_rows + 1, 0);
    for_each_entry([&](unsigned int r, unsigned int, int &) { ++length[r]; });
    for (std::size_t r = 0; r < n_rows; ++r)
      start[r + 1] = start[r] + length[r];
    std::vector<int> column(start[n_rows]), next(start.begin(), start.end());
    for_each_entry([&](unsigned int r, unsigned int c, int &entry_place) {
      entry_place         = next[r]++;
      column[entry_place] = c;
    });

    local = std::make_unique<Epetra_CrsMatrix>(
      Copy, rows.local_map, columns.local_map, length.data(), true);
    const std::vector<double> zeros(start[n_rows], 0.);
    for (std::size_t r = 0; r < n_rows; ++r)
      if (length[r] > 0)
        check(local->InsertMyValues(
                r, length[r], &zeros[start[r]], &column[start[r]]),
              "InsertMyValues");
    check(local->FillComplete(columns.owned_map, rows.owned_map),
          "FillComplete");
    check(local->OptimizeStorage(), "OptimizeStorage");
  }

  void
  TrilinosBlock::copy_values(const SparseSystem &A)
  {
    int    *offsets, *indices;
    double *values;
    check(local->ExtractCrsDataPointers(offsets, indices, values),
          "ExtractCrsDataPointers");
    for (std::size_t k = 0; k < place.size(); ++k)
      if (place[k] != none)
        values[place[k]] = A.values[k];
    for (std::size_t k = 0; k < mirrored_place.size(); ++k)
      if (mirrored_place[k] != none)
        values[mirrored_place[k]] = A.values[k];

    if (summed)
      {
        check(summed->PutScalar(0.), "PutScalar");
        check(summed->Export(*local, *to_owners, ::Add), "Export");
      }
  }

  const Epetra_CrsMatrix &
  TrilinosBlock::matrix() const
  {
    return summed ? *summed : *local;
  }

  Epetra_CrsMatrix &
  TrilinosBlock::matrix()
  {
    return summed ? *summed : *local;
  }

  void
  TrilinosBlock::vmult(TrilinosWrappers::MPI::Vector       &dst,
                       const TrilinosWrappers::MPI::Vector &src) const
  {
    check(matrix().Multiply(false,
                            src.trilinos_vector(),
                            dst.trilinos_vector()),
          "Multiply");
  }

  void
  TrilinosBlock::vmult_add(TrilinosWrappers::MPI::Vector       &dst,
                           const TrilinosWrappers::MPI::Vector &src) const
  {
    TrilinosWrappers::MPI::Vector product;
    product.reinit(dst, true);
    vmult(product, src);
    dst += product;
  }
} // namespace isochor
