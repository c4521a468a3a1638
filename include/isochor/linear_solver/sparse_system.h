/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_sparse_system_h
#define isochor_sparse_system_h

#include <deal.II/base/index_set.h>
#include <deal.II/base/mpi.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The linearised equations of one Newton iteration, as the assembly leaves
   * them: on each rank a compressed-row matrix over the equations that this
   * rank's cells touch, holding only this rank's contributions. The global
   * matrix is the sum over ranks, A = Σ_r R_r^T A_r R_r. Serially A_r is A.
   *
   * This form costs no communication to assemble, is what MUMPS takes as
   * distributed input, and what a Trilinos matrix is exported from.
   */
  struct SparseSystem
  {
    enum class Field : unsigned char
    {
      displacement,
      pressure
    };

    MPI_Comm comm = MPI_COMM_SELF;

    /** Number of equations over all ranks. Constrained and inactive degrees of
     * freedom have no equation. */
    types::global_dof_index n_equations = 0;

    /** This rank's contiguous range of equations. */
    IndexSet locally_owned;

    /** Global number of each local equation (owned and shared), ascending. */
    std::vector<types::global_dof_index> global_equation;

    /** The field each local equation belongs to. */
    std::vector<Field> field;

    /** The node of each local equation, counted in the order of the equations
     * (those of a node follow one another), and the component within it. */
    std::vector<unsigned int> node, component;

    /** Node coordinates of each local equation, dim values each. */
    std::vector<double> position;
    unsigned int        dim = 2;

    /** If set, A is symmetric and only entries with column >= row are stored.
     */
    bool symmetric = true;

    /** The entry of component @p c of the node of a displacement @p equation in
     * the rigid motion @p mode: the dim translations, then the rotations about
     * @p centre. */
    double
    rigid_motion(const unsigned int equation,
                 const unsigned int c,
                 const unsigned int mode,
                 const double      *centre) const
    {
      const bool         rotation = mode >= dim;
      const unsigned int axis     = dim == 2 ? 2 : mode - dim;
      const double arm = rotation_arm.empty() ? 0. : rotation_arm[equation];
      if (arm < 0)
        return 0.;
      if (arm > 0)
        return rotation && (dim == 2 ? c == 0 : c == axis) ? arm : 0.;
      if (!rotation)
        return c == mode ? 1. : 0.;
      // e_axis × x
      const double *const x = &position[dim * equation];
      const unsigned int  b = (axis + 1) % 3, a = (axis + 2) % 3;
      return c == a ? x[b] - centre[b] : c == b ? -(x[a] - centre[a]) : 0.;
    }

    /** Whether materials may yield, so that the stiffness changes much from one
     * matrix to the next and nearly vanishes in places. */
    bool may_yield = false;

    /** Rows, columns (local numbers, ascending in a row) and values. */
    std::vector<std::size_t>  row_start;
    std::vector<unsigned int> column;
    std::vector<double>       values;

    /** Changes whenever the pattern or the numbering does, on all ranks at
     * once: as long as it stays, a solver keeps its analysis. */
    unsigned long pattern_id = 0;

    /** If not empty: for each local equation the length by which a rotation
     * about its position is multiplied, of which it is the component (the first
     * one in 2D); 0 for displacements; negative for what is neither. */
    std::vector<double> rotation_arm;
  };
} // namespace isochor

#endif
