/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_trilinos_export_h
#define isochor_trilinos_export_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/sparse_system.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_Export.h>
#include <Epetra_Map.h>

#include <memory>
#include <vector>

namespace isochor
{
  /**
   * The equations of a SparseSystem, or those of one field of it, numbered
   * afresh and contiguously on each rank. Needs each rank's locally owned
   * equations to be among its local ones.
   */
  class EquationSubset
  {
  public:
    /** All equations; their numbers are kept. */
    explicit EquationSubset(const SparseSystem &A);

    /** The equations of @p field. */
    EquationSubset(const SparseSystem &A, const SparseSystem::Field field);

    /** Take this subset's entries out of a vector of the whole system. Both
     * are distributed by ownership. */
    void
    extract(const TrilinosWrappers::MPI::Vector &whole,
            TrilinosWrappers::MPI::Vector       &part) const;

    /** The reverse of extract(); other entries of @p whole stay. */
    void
    insert(const TrilinosWrappers::MPI::Vector &part,
           TrilinosWrappers::MPI::Vector       &whole) const;

    /** Size, and this rank's range, of the new numbers. */
    IndexSet locally_owned;

    /** The members among the system's local equations, ascending. */
    std::vector<unsigned int> local_equation;

    /** For each of the system's local equations its index in local_equation,
     * or numbers::invalid_unsigned_int for equations not in the subset. */
    std::vector<unsigned int> index_of;

    /** For each member whether this rank owns it. */
    std::vector<bool> is_owned;

    /** New numbers of the owned members, and of all local ones. */
    Epetra_Map owned_map, local_map;

  private:
    EquationSubset(const SparseSystem &A, const std::vector<bool> &is_member);

    /** Owned members by their position among the owned equations. */
    std::vector<unsigned int> owned_position;
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

    const Epetra_CrsMatrix &
    matrix() const;

    /** Trilinos' solvers ask for a matrix that isn't const. */
    Epetra_CrsMatrix &
    matrix();

    /** dst = block * src. */
    void
    vmult(TrilinosWrappers::MPI::Vector       &dst,
          const TrilinosWrappers::MPI::Vector &src) const;

    /** dst += block * src. */
    void
    vmult_add(TrilinosWrappers::MPI::Vector       &dst,
              const TrilinosWrappers::MPI::Vector &src) const;

  private:
    static constexpr int none = -1;

    void
    make_local_pattern(const SparseSystem &A);

    const EquationSubset &rows, &columns;

    /** This rank's contributions, and, if there are several ranks, the sum. */
    std::unique_ptr<Epetra_CrsMatrix> local, summed;
    std::unique_ptr<Epetra_Export>    to_owners;

    /** For each entry of the SparseSystem its place among the values of
     * `local`, and the place of its mirror image in symmetric systems. */
    std::vector<int> place, mirrored_place;
  };
} // namespace isochor

#endif
