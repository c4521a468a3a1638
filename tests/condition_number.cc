/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The condition number of scaled matrices whose eigenvalues are known.

#include <deal.II/base/mpi.h>

#include <isochor/linear_solver/condition_number.h>

#include <cmath>
#include <iomanip>
#include <iostream>

using namespace isochor;

namespace
{
  /** The tridiagonal matrix (b, a, b) scaled as S_i A_ij S_j from both sides,
   * on one rank. */
  SparseSystem
  tridiagonal(const unsigned int n, const double a, const double b)
  {
    SparseSystem A;
    A.comm          = MPI_COMM_SELF;
    A.n_equations   = n;
    A.locally_owned = complete_index_set(n);
    const auto s    = [](const unsigned int i) { return std::pow(10., i % 7); };
    A.row_start.push_back(0);
    for (unsigned int i = 0; i < n; ++i)
      {
        A.global_equation.push_back(i);
        A.column.push_back(i);
        A.values.push_back(a * s(i) * s(i));
        if (i + 1 < n)
          {
            A.column.push_back(i + 1);
            A.values.push_back(b * s(i) * s(i + 1));
          }
        A.row_start.push_back(A.column.size());
      }
    return A;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::cout << std::setprecision(9);
  std::cout << "diagonal: " << scaled_condition_number(tridiagonal(9, 2., 0.))
            << std::endl;
  std::cout << "(1 + b) / (1 - b) = 3: "
            << scaled_condition_number(tridiagonal(2, -2., 1.)) << std::endl;
  // Eigenvalues 2 - 2 cos(k pi / (n+1)): condition cot^2(pi / (2 (n+1))).
  const unsigned int n   = 50;
  const double       tan = std::tan(numbers::PI / (2 * (n + 1)));
  std::cout << "Laplacian, relative to the exact: "
            << scaled_condition_number(tridiagonal(n, 2., -1.)) * tan * tan
            << std::endl;
  return 0;
}
