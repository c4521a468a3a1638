/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_trilinos_export_h
#define isochor_trilinos_export_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/linear_solver/entry_exchange.h>
#include <isochor/linear_solver/sparse_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Map.h>

#include <memory>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * The equations of a SparseSystem, or those of one field of it, numbered
   * afresh and contiguously on each rank. Needs each rank's locally owned
   * equations to be among its local ones.
   *
   * Displacements may be *padded*: each node with an equation gets dim rows, of
   * which those without an equation are decoupled from all others. Algebraic
   * multigrid then sees nodes instead of equations.
   */
  class EquationSubset
  {
  public:
    /** All equations; their numbers are kept. */
    explicit EquationSubset(const SparseSystem &A);

    /** The equations of @p field, padded if asked (displacements only). */
    EquationSubset(const SparseSystem       &A,
                   const SparseSystem::Field field,
                   const bool                padded = false);

    /** Take this subset's entries out of a vector of the whole system. Both
     * are distributed by ownership. Rows without an equation become zero. */
    void
    extract(const TrilinosWrappers::MPI::Vector &whole,
            TrilinosWrappers::MPI::Vector       &part) const;

    /** The reverse of extract(); other entries of @p whole stay. */
    void
    insert(const TrilinosWrappers::MPI::Vector &part,
           TrilinosWrappers::MPI::Vector       &whole) const;

    /** Size, and this rank's range, of the new numbers. */
    IndexSet locally_owned;

    /** For each of the system's local equations its local row, or
     * numbers::invalid_unsigned_int for equations not in the subset. */
    std::vector<unsigned int> row_of;

    /** For each local row whether this rank owns it. */
    std::vector<bool> is_owned;

    /** The local rows without an equation, each with an equation of its node:
     * the diagonal entry of that one stands in the diagonal. */
    std::vector<std::pair<unsigned int, unsigned int>> padding;

    /** New numbers of the owned rows, and of all local ones. */
    Epetra_Map owned_map, local_map;

  private:
    /** @p block_size: 1 or, to pad, dim. */
    EquationSubset(const SparseSystem      &A,
                   const std::vector<bool> &is_member,
                   const unsigned int       block_size);

    /** Give the members their rows; fills in what isn't said by numbers. */
    void
    lay_out_rows(const SparseSystem      &A,
                 const std::vector<bool> &is_member,
                 const unsigned int       block_size);

    /** The owned members: their row among the owned rows, and their position
     * among the owned equations. */
    std::vector<unsigned int> owned_row, owned_position;
  };

  /**
   * The block of a SparseSystem with the rows and columns of two subsets, as a
   * Trilinos matrix: both triangles stored, the ranks' contributions summed to
   * the owners of the rows. The subsets have to outlive it.
   */
  class TrilinosBlock
  {
  public:
    /** Take over the pattern of @p A, and the values. */
    TrilinosBlock(const SparseSystem   &A,
                  const EquationSubset &rows,
                  const EquationSubset &columns);

    /** Take over new values; the pattern is that of the construction. */
    void
    copy_values(const SparseSystem &A);

    /** The reverse of copy_values(); values of other blocks stay. Only without
     * other ranks, whose contributions can't be told apart. */
    void
    restore_values(SparseSystem &A) const;

    const Epetra_CrsMatrix &
    matrix() const;

    /** Trilinos' solvers ask for a matrix that isn't const. */
    Epetra_CrsMatrix &
    matrix();

    /** dst = block * src. */
    void
    vmult(TrilinosWrappers::MPI::Vector       &dst,
          const TrilinosWrappers::MPI::Vector &src) const;

    /** dst = transpose of block * src. */
    void
    Tvmult(TrilinosWrappers::MPI::Vector       &dst,
           const TrilinosWrappers::MPI::Vector &src) const;

  private:
    /** This rank's contribution, without values. */
    LocalPattern
    local_pattern(const SparseSystem &A) const;

    /** Call @p action (row, column, index of the value in @p A) for all entries
     * of the block. As the system's rows ascend, a row gets its mirrored
     * entries before its own ones, and thus its columns in ascending order:
     * the n-th call for a row is about its n-th entry. */
    template <typename Action>
    void
    for_each_entry(const SparseSystem &A, const Action &action) const;

    /** Call @p action (value, index of the value in @p A) for all entries;
     * without other ranks. */
    template <typename Action>
    void
    for_each_value(const SparseSystem &A, const Action &action) const;

    const EquationSubset &rows, &columns;

    /** The sum over ranks. */
    std::unique_ptr<Epetra_CrsMatrix> block;
    /** If there are several: where this rank's contributions go. */
    std::unique_ptr<EntryExchange> exchange;
  };
} // namespace isochor

#endif
