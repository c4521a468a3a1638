/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_saddle_point_matrix_h
#define isochor_saddle_point_matrix_h

#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <isochor/linear_solver/trilinos_export.h>

#include <Epetra_MultiVector.h>

#include <memory>

namespace isochor
{
  /**
   * [[K, c B], [c B*, -c^2 C]] by blocks, without assembling the whole. The
   * factor c gives forces and volumes, the residuals of the two fields, a
   * common unit. If A is symmetric, B* is the transpose of B.
   */
  class SaddlePointMatrix
  {
  public:
    /** @p displacements may be padded. Both subsets have to outlive the
     * matrix. */
    SaddlePointMatrix(const SparseSystem   &A,
                      const EquationSubset &displacements,
                      const EquationSubset &pressures);

    /** Take over new values; the pattern is that of the construction. */
    void
    copy_values(const SparseSystem &A);

    /** The reverse: give @p A the values that were copied last. Only without
     * other ranks. */
    void
    restore_values(SparseSystem &A) const;

    void
    vmult(TrilinosWrappers::MPI::BlockVector       &dst,
          const TrilinosWrappers::MPI::BlockVector &src) const;

    /** In bytes, on this rank. */
    double
    memory_consumption() const;

    TrilinosBlock                  K, B, minus_C;
    std::unique_ptr<TrilinosBlock> B_star;     ///< null if A is symmetric
    double                         scale = 1.; ///< c

  private:
    /** c = mean diagonal of K / mean norm of the rows of B: some G/h. */
    void
    find_scale();

    mutable TrilinosWrappers::MPI::Vector force, volume, scaled_pressure;
  };

  /**
   * The diagonal of C + B^T diag(K)^{-1} B times a factor, an approximation
   * of the Schur complement C + B* K^{-1} B. Up to a factor near one it is
   * the pressure mass matrix, lumped and divided by the shear modulus, plus
   * the diagonal of C: unlike the whole of that product, whose iteration
   * counts grow as cells shrink, it is spectrally equivalent to the Schur
   * complement of a Stokes-like system whatever the mesh size, and it needs
   * no material constants. The factor is an experiment's: two takes the
   * fewest iterations in 2D and where materials may yield, three in 3D.
   */
  TrilinosWrappers::MPI::Vector
  schur_complement_diagonal(const SaddlePointMatrix &A,
                            const EquationSubset    &pressures,
                            const SparseSystem      &system);

  /**
   * The rigid body modes of the padded displacements in 2D, the translations
   * in 3D (where the rotations cost more than they save).
   */
  Epetra_MultiVector
  near_null_space(const SparseSystem &A, const EquationSubset &displacements);
} // namespace isochor

#endif
