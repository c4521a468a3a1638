/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/linear_solver/saddle_point_matrix.h>

#include <Epetra_Export.h>
#include <Epetra_Vector.h>

#include <array>
#include <cmath>
#include <vector>

namespace isochor
{
  SaddlePointMatrix::SaddlePointMatrix(const SparseSystem   &A,
                                       const EquationSubset &displacements,
                                       const EquationSubset &pressures)
    : K(A, displacements, displacements)
    , B(A, displacements, pressures)
    , minus_C(A, pressures, pressures)
    , force(displacements.locally_owned, A.comm)
    , volume(pressures.locally_owned, A.comm)
    , scaled_pressure(volume)
  {
    if (!A.symmetric)
      B_star = std::make_unique<TrilinosBlock>(A, pressures, displacements);
    find_scale();
  }

  void
  SaddlePointMatrix::copy_values(const SparseSystem &A)
  {
    for (TrilinosBlock *block :
         std::array<TrilinosBlock *, 4>{{&K, &B, B_star.get(), &minus_C}})
      if (block != nullptr)
        block->copy_values(A);
    find_scale();
  }

  void
  SaddlePointMatrix::restore_values(SparseSystem &A) const
  {
    A.values.resize(A.column.size());
    for (const TrilinosBlock *block :
         std::array<const TrilinosBlock *, 4>{{&K, &B, B_star.get(), &minus_C}})
      if (block != nullptr)
        block->restore_values(A);
  }

  void
  SaddlePointMatrix::vmult(TrilinosWrappers::MPI::BlockVector       &dst,
                           const TrilinosWrappers::MPI::BlockVector &src) const
  {
    scaled_pressure.equ(scale, src.block(1));
    K.vmult(dst.block(0), src.block(0));
    B.vmult(force, scaled_pressure);
    dst.block(0) += force;

    minus_C.vmult(dst.block(1), scaled_pressure);
    if (B_star)
      B_star->vmult(volume, src.block(0));
    else
      B.Tvmult(volume, src.block(0));
    dst.block(1).sadd(scale, scale, volume);
  }

  double
  SaddlePointMatrix::memory_consumption() const
  {
    double n_entries = 0.;
    for (const TrilinosBlock *block :
         std::array<const TrilinosBlock *, 4>{{&K, &B, B_star.get(), &minus_C}})
      if (block != nullptr)
        n_entries += block->matrix().NumMyNonzeros();
    return n_entries * (sizeof(double) + sizeof(int));
  }

  void
  SaddlePointMatrix::find_scale()
  {
    Epetra_Vector diagonal(K.matrix().RowMap());
    K.matrix().ExtractDiagonalCopy(diagonal);
    double mean = 0.;
    diagonal.MeanValue(&mean);
    const double n     = K.matrix().NumGlobalRows();
    const double row_B = B.matrix().NormFrobenius() / std::sqrt(n);
    scale              = (mean > 0 && row_B > 0 ? mean / row_B : 1.);
  }

  TrilinosWrappers::MPI::Vector
  schur_complement_diagonal(const SaddlePointMatrix &A,
                            const EquationSubset    &pressures,
                            const SparseSystem      &system)
  {
    const Epetra_CrsMatrix &K = A.K.matrix(), &B = A.B.matrix(),
                           &minus_C = A.minus_C.matrix();
    Epetra_Vector K_diagonal(K.RowMap()), C_diagonal(minus_C.RowMap()),
      columns(B.ColMap()), sums(B.DomainMap());
    K.ExtractDiagonalCopy(K_diagonal);
    minus_C.ExtractDiagonalCopy(C_diagonal);
    for (int i = 0; i < B.NumMyRows(); ++i)
      {
        int     n_entries;
        double *values;
        int    *indices;
        B.ExtractMyRowView(i, n_entries, values, indices);
        for (int k = 0; k < n_entries; ++k)
          columns[indices[k]] += values[k] * values[k] / K_diagonal[i];
      }
    sums.Export(columns, Epetra_Export(B.ColMap(), B.DomainMap()), ::Add);

    TrilinosWrappers::MPI::Vector diagonal(pressures.locally_owned,
                                           system.comm);
    const double factor = system.dim == 2 || system.may_yield ? 2. : 3.;
    for (int i = 0; i < sums.MyLength(); ++i)
      diagonal.begin()[i] = factor * (sums[i] - C_diagonal[i]);
    return diagonal;
  }

  Epetra_MultiVector
  near_null_space(const SparseSystem &A, const EquationSubset &displacements)
  {
    const unsigned int dim = A.dim, n_modes = (dim == 2 ? 3 : dim);
    Epetra_MultiVector modes(displacements.owned_map, n_modes, true);
    // all rows of a node have its motions, also those without an equation
    std::vector<unsigned int> equation(displacements.is_owned.size(),
                                       numbers::invalid_unsigned_int);
    for (std::size_t i = 0; i < displacements.row_of.size(); ++i)
      {
        const unsigned int row = displacements.row_of[i];
        if (row != numbers::invalid_unsigned_int)
          for (unsigned int k = 0; k < dim; ++k)
            equation[row - row % dim + k] = i;
      }
    const double origin[3] = {0, 0, 0};
    int          owned     = 0;
    for (std::size_t row = 0; row < equation.size(); ++row)
      if (displacements.is_owned[row])
        {
          for (unsigned int mode = 0; mode < n_modes; ++mode)
            modes[mode][owned] =
              A.rigid_motion(equation[row], row % dim, mode, origin);
          ++owned;
        }
    return modes;
  }
} // namespace isochor
