/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_packed_columns_h
#define isochor_packed_columns_h

#include <isochor/linear_solver/sparse_system.h>

#include <vector>

namespace isochor
{
  /**
   * As long as this lives, the columns of a matrix take a third of their memory
   * or less and can't be read: SparseSystem::column is empty. The rows of a
   * node have the same columns, of which one row is kept.
   */
  class PackedColumns
  {
  public:
    explicit PackedColumns(SparseSystem &A);
    /** Gives the matrix its columns back. */
    ~PackedColumns();

    PackedColumns(const PackedColumns &) = delete;
    PackedColumns &
    operator=(const PackedColumns &) = delete;

    /** Numbers that are kept. */
    std::size_t
    size() const
    {
      return kept.size();
    }

  private:
    SparseSystem &A;
    /** Whether a row is the one before; of a symmetric matrix, which has the
     * upper triangle only, without its first column. */
    std::vector<bool>         repeats;
    std::vector<unsigned int> kept;
  };
} // namespace isochor

#endif
