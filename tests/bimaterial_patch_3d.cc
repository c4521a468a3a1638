/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The patch test of bimaterial_patch.cc in space: a cube whose sides and whose
// slanted interface between two materials lie within the cells of the grid,
// under a stress that is the same everywhere.

#include <algorithm>
#include <array>
#include <fstream>
#include <iomanip>

#include "run_scene.h"

using namespace isochor;

namespace
{
  using Vector = std::array<double, 3>;
  using Matrix = std::array<Vector, 3>;

  // the interface: z = slope_x x + slope_y y, from the centre of the cube
  constexpr double slope_x = 0.2, slope_y = 0.1;

  double
  dot(const Vector &a, const Vector &b)
  {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
  }

  Vector
  cross(const Vector &a, const Vector &b)
  {
    return {{a[1] * b[2] - a[2] * b[1],
             a[2] * b[0] - a[0] * b[2],
             a[0] * b[1] - a[1] * b[0]}};
  }

  Vector
  unit(const Vector &a)
  {
    const double length = std::sqrt(dot(a, a));
    return {{a[0] / length, a[1] / length, a[2] / length}};
  }

  /** A cube of edge 1 about @p centre, @p n^3 parts of six tetrahedra each; the
   * planes of nodes at half its height are on the interface. */
  void
  write_mesh(const std::string &name,
             const Vector      &centre,
             const unsigned int n)
  {
    if (test::this_rank() == 0)
      {
        const unsigned int N = n + 1;
        std::ofstream      mesh(name);
        mesh << std::setprecision(16)
             << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
             << N * N * N << '\n';
        for (unsigned int k = 0; k < N * N * N; ++k)
          {
            Vector x{{double(k % N) / n - 0.5,
                      double(k / N % N) / n - 0.5,
                      double(k / N / N) / n - 0.5}};
            x[2] +=
              (slope_x * x[0] + slope_y * x[1]) * (1 - 2 * std::abs(x[2]));
            mesh << k + 1;
            for (unsigned int d = 0; d < 3; ++d)
              mesh << ' ' << centre[d] + x[d];
            mesh << '\n';
          }
        std::ostringstream            elements;
        unsigned int                  number  = 0;
        const std::array<unsigned, 3> stride  = {{1, N, N * N}};
        const auto                    element = [&](const std::string &line) {
          elements << ++number << ' ' << line << '\n';
        };
        for (unsigned int k = 0; k < n * n * n; ++k)
          {
            const unsigned int first =
              1 + k % n + k / n % n * N + k / n / n * N * N;
            std::array<unsigned int, 3> way = {{0, 1, 2}};
            do
              {
                std::string  nodes = std::to_string(first);
                unsigned int at    = first;
                for (const unsigned int d : way)
                  nodes += " " + std::to_string(at += stride[d]);
                element("4 2 1 1 " + nodes);
              }
            while (std::next_permutation(way.begin(), way.end()));
          }
        // the sides, split as the tetrahedra split them
        for (unsigned int d = 0; d < 3; ++d)
          for (unsigned int k = 0; k < 2 * n * n; ++k)
            {
              const unsigned int a = (d + 1) % 3, b = (d + 2) % 3;
              const unsigned int first = 1 + k % n * stride[a] +
                                         k / n % n * stride[b] +
                                         k / n / n * n * stride[d];
              const auto triangle = [&](const unsigned int middle) {
                element("2 2 1 1 " + std::to_string(first) + " " +
                        std::to_string(first + stride[middle]) + " " +
                        std::to_string(first + stride[a] + stride[b]));
              };
              triangle(a);
              triangle(b);
            }
        mesh << "$EndNodes\n$Elements\n"
             << number << '\n'
             << elements.str() << "$EndElements\n";
      }
    test::wait_for_all_ranks();
  }

  /** The error of the stress, largest of its components, relative to that. */
  double
  stress_error(const Vector &centre, const std::string &settings)
  {
    const std::string name = "patch_3d.msh";
    write_mesh(name, centre, 4);
    // no strain along the interface: across and shear (Pa)
    const double nu = 0.3, E = 1e6, across = -20, shear = 8,
                 along  = nu / (1 - nu) * across;
    const Vector normal = unit({{-slope_x, -slope_y, 1}}),
                 first  = unit(cross(normal, {{0.3, 0.5, 0.1}})),
                 second = cross(normal, first);
    Matrix stress;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < 3; ++j)
        stress[i][j] = along * (first[i] * first[j] + second[i] * second[j]) +
                       across * normal[i] * normal[j] +
                       shear * (normal[i] * first[j] + first[i] * normal[j]);
    // displacement of the lower material per distance from the interface
    Vector rate;
    for (unsigned int i = 0; i < 3; ++i)
      rate[i] = across * (1 + nu) * (1 - 2 * nu) / (1 - nu) / E * normal[i] +
                shear * 2 * (1 + nu) / E * first[i];

    std::ostringstream distance, scene;
    distance << std::setprecision(16) << "((x-" << centre[0] << ")*"
             << normal[0] << "+(y-" << centre[1] << ")*" << normal[1] << "+(z-"
             << centre[2] << ")*" << normal[2] << ')';
    const std::string axes = "xyz";
    scene << std::setprecision(16)
          << "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 2, 2\n"
             "Grid/Subdivisions = 10, 10, 10\nMaterial points/Body mesh = "
          << name
          << "\nMaterial points/Materials in zones = 2: " << distance.str()
          << " > 0\nMaterial points/Points per cell = 8\n"
          << "Material/Young modulus = " << E
          << "\nMaterial 2/Young modulus = 1e8\nTime/Step size = 0.5\n"
             "Boundary conditions/Mesh of body surfaces = "
          << name << "\nBoundary conditions/Surfaces of body = ";
    for (unsigned int d = 0; d < 3; ++d)
      scene << axes[d] << "0: " << axes[d] << " < " << centre[d] - 0.4999
            << "; " << axes[d] << "1: " << axes[d] << " > "
            << centre[d] + 0.4999 << (d < 2 ? "; " : "\n");
    scene << "Interaction: z0 - place/Displacement = ";
    for (unsigned int d = 0; d < 3; ++d)
      scene << (d ? ", " : "") << axes[d] << '=' << rate[d] << '*'
            << distance.str() << "*t";
    scene << "\nBoundary conditions/Traction on body = ";
    for (unsigned int d = 0; d < 3; ++d)
      for (const int sign : {-1, 1})
        if (d < 2 || sign > 0)
          {
            scene << (d > 0 || sign > 0 ? "; " : "") << axes[d]
                  << (sign > 0 ? 1 : 0) << ": ";
            for (unsigned int i = 0; i < 3; ++i)
              scene << (i ? ", " : "") << sign * stress[i][d] << "*t";
          }
    scene << "\nPostprocess/Exact stress = ";
    for (const std::string c : {"xx", "yy", "zz", "xz"})
      scene << (c == "xx" ? "" : "; ") << c << ": "
            << stress[axes.find(c[0])][axes.find(c[1])] << "*t";
    scene << '\n' << settings;
    const auto problem = test::run_scene<3>(scene.str());
    double     worst   = 0;
    for (const std::string component : {"xx", "yy", "zz", "xz"})
      test::add_error(worst,
                      test::get(*problem, "L2 error of stress " + component));
    const std::string told =
      test::warning_of(*problem, "the iterative linear solver failed");
    if (!told.empty())
      test::check("the solver", false, told);
    return worst;
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  const Vector     within_cells{{1.03, 0.98, 1.}};
  // 0.4 and more in earlier versions
  for (const std::string form : {"u", "u-p"})
    test::check_error(form,
                      stress_error(within_cells,
                                   "Formulation/Type = " + form + "\n"),
                      5e-3);
  // some nodes have no pressure, which an iterative solver doesn't survive
  // unless it is held
  test::check_error("u-p, iterative",
                    stress_error(within_cells,
                                 "Formulation/Type = u-p\n"
                                 "Linear solver/Solver = Block FGMRES\n"),
                    5e-3);
  return 0;
}
