/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <isochor/linear_solver/condition_number.h>

#include <cmath>
#include <limits>
#include <vector>

namespace isochor
{
  namespace
  {
    /** The sum of the ranks' contributions, row by row. */
    std::vector<double>
    dense_matrix(const SparseSystem &A)
    {
      AssertThrow(A.values.size() == A.column.size(),
                  ExcMessage("The linear solver has freed the values of the "
                             "matrix."));
      const std::size_t   n = A.n_equations;
      std::vector<double> local(n * n, 0.), total(n * n);
      for (std::size_t r = 0; r + 1 < A.row_start.size(); ++r)
        for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
          {
            const auto i = A.global_equation[r];
            const auto j = A.global_equation[A.column[k]];
            local[i * n + j] += A.values[k];
            if (A.symmetric && i != j)
              local[j * n + i] += A.values[k];
          }
      Utilities::MPI::sum(local, A.comm, total);
      return total;
    }
  } // namespace

  double
  scaled_condition_number(const SparseSystem &A)
  {
    const std::size_t n         = A.n_equations;
    const std::size_t n_maximum = 3000;
    AssertThrow(n > 0 && n <= n_maximum,
                ExcMessage("The condition number of a system of " +
                           std::to_string(n) +
                           " equations was asked for; 1 to " +
                           std::to_string(n_maximum) + " are allowed."));
    const std::vector<double> a = dense_matrix(A);

    std::vector<double> d(n, 1.);
    for (std::size_t i = 0; i < n; ++i)
      if (a[i * n + i] != 0.)
        d[i] = 1. / std::sqrt(std::abs(a[i * n + i]));
    LAPACKFullMatrix<double> scaled(n, n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j)
        scaled(i, j) = d[i] * a[i * n + j] * d[j];

    scaled.compute_svd(); // descending
    const double smallest = scaled.singular_value(n - 1);
    return smallest > 0. ? scaled.singular_value(0) / smallest :
                           std::numeric_limits<double>::infinity();
  }
} // namespace isochor
