/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_round_bar_h
#define isochor_tests_round_bar_h

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

using namespace dealii;

/** A round bar of radius 1/2 and length 1 along y, n x n cells over the
 * section, which the square is mapped to. */
inline std::string
round_bar(const unsigned int n)
{
  const std::string name = "bar_" + std::to_string(n) + ".msh";
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ofstream out(name);
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n3\n"
             "2 1 \"bottom\"\n2 2 \"top\"\n3 3 \"bar\"\n$EndPhysicalNames\n"
             "$Nodes\n"
          << (n + 1) * (n + 1) * (n + 1) << '\n';
      const auto number =
        [n](const unsigned int i, const unsigned int j, const unsigned int k) {
          return 1 + i + (n + 1) * (j + (n + 1) * k);
        };
      for (unsigned int k = 0; k <= n; ++k)
        for (unsigned int j = 0; j <= n; ++j)
          for (unsigned int i = 0; i <= n; ++i)
            {
              const double x = 2. * i / n - 1, z = 2. * k / n - 1;
              const double r = std::max(std::abs(x), std::abs(z));
              const double stretch =
                r > 0 ? (1 - r) + r * r / std::hypot(x, z) : 1;
              out << number(i, j, k) << ' ' << x * stretch / 2 << ' '
                  << double(j) / n << ' ' << z * stretch / 2 << '\n';
            }
      out << "$EndNodes\n$Elements\n" << 6 * n * n * n + 4 * n * n << '\n';
      unsigned int element = 0;
      const auto   write   = [&](const unsigned int type,
                             const unsigned int group) {
        out << ++element << ' ' << type << " 2 " << group << ' ' << group;
      };
      // Kuhn's six tetrahedra of each cell
      const unsigned int order[6][3] = {
        {0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
      for (unsigned int c = 0; c < n * n * n; ++c)
        for (const auto &axes : order)
          {
            unsigned int at[3] = {c % n, c / n % n, c / (n * n)};
            write(4, 3);
            out << ' ' << number(at[0], at[1], at[2]);
            for (const unsigned int a : axes)
              {
                ++at[a];
                out << ' ' << number(at[0], at[1], at[2]);
              }
            out << '\n';
          }
      for (const unsigned int j : {0u, n})
        for (unsigned int k = 0; k < n; ++k)
          for (unsigned int i = 0; i < n; ++i)
            for (const unsigned int other : {0, 1})
              {
                write(2, j == 0 ? 1 : 2);
                out << ' ' << number(i, j, k) << ' '
                    << number(i + 1 - other, j, k + other) << ' '
                    << number(i + 1, j, k + 1) << '\n';
              }
      out << "$EndElements\n";
    }
  MPI_Barrier(MPI_COMM_WORLD);
  return "Grid/Type = gmsh\nGrid/File = " + name + '\n';
}

#endif
