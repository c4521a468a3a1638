/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The numerical inf-sup test of Chapelle and Bathe (Comput. Struct. 47, 1993,
// 537-545) on the program's own matrices: with [[A, B], [B^T, -C]] at rest and
// the mass matrix M of the pressure, the smallest eigenvalue β² of
//   (B^T A^-1 B + C) q = β² M q
// must stay away from zero as the grid is refined. It does so with PPP, and
// doesn't without.

#include <deal.II/lac/lapack_full_matrix.h>

#include <isochor/linear_solver/condition_number.h>
#include <isochor/linear_solver/linear_solver.h>

#include <cstdint>
#include <fstream>
#include <iomanip>
#include <map>

#include "scene.h"

using namespace isochor;

namespace
{
  /** The first matrix of a scene, dense, by field. */
  struct Blocks
  {
    FullMatrix<double> A, B, C;
    double             condition_number;
  };
  Blocks blocks;
  bool   finds_condition_number = false;

  struct MatrixTaken
  {};

  /** Keeps the blocks of the first matrix and ends the run. */
  class KeepMatrix : public LinearSolver
  {
  public:
    static void
    declare_parameters(ParameterHandler &)
    {}
    void
    parse_parameters(ParameterHandler &) override
    {}

    LinearSolverReport
    factorise(const SparseSystem &system) override
    {
      if (finds_condition_number)
        blocks.condition_number = scaled_condition_number(system);
      std::vector<unsigned int> number(system.field.size());
      unsigned int              n[2] = {0, 0};
      for (unsigned int i = 0; i < number.size(); ++i)
        number[i] = n[system.field[i] == SparseSystem::Field::pressure]++;
      blocks.A.reinit(n[0], n[0]);
      blocks.B.reinit(n[0], n[1]);
      blocks.C.reinit(n[1], n[1]);
      for (unsigned int i = 0; i < number.size(); ++i)
        for (std::size_t k = system.row_start[i]; k < system.row_start[i + 1];
             ++k)
          {
            const unsigned int j = system.column[k];
            enter(system, number, i, j, system.values[k]);
            if (system.symmetric && i != j)
              enter(system, number, j, i, system.values[k]);
          }
      throw MatrixTaken();
    }

    LinearSolverReport
    solve(const TrilinosWrappers::MPI::Vector &,
          TrilinosWrappers::MPI::Vector &) override
    {
      return {};
    }

  private:
    void
    enter(const SparseSystem              &system,
          const std::vector<unsigned int> &number,
          const unsigned int               i,
          const unsigned int               j,
          const double                     value) const
    {
      const bool row_p = system.field[i] == SparseSystem::Field::pressure;
      const bool col_p = system.field[j] == SparseSystem::Field::pressure;
      if (!row_p && !col_p)
        blocks.A(number[i], number[j]) += value;
      else if (!row_p && col_p)
        blocks.B(number[i], number[j]) += value;
      else if (row_p && col_p)
        blocks.C(number[i], number[j]) -= value;
    }
  };
  ISOCHOR_REGISTER(LinearSolver, KeepMatrix, "Keep matrix")



  /** Vertices and triangles of the unit square in n x n squares, as a gmsh file
   * with named sides. @p kind: "/", "criss-cross" or "jittered". */
  std::string
  write_mesh(const std::string &kind, const unsigned int n)
  {
    std::vector<Point<2>>                    vertices;
    std::vector<std::array<unsigned int, 3>> cells;
    std::uint32_t                            state  = 12345;
    const auto                               random = [&state]() { // in [-1, 1]
      state = state * 1664525u + 1013904223u;
      return (state >> 8) / 8388608. - 1.;
    };
    for (unsigned int j = 0; j <= n; ++j)
      for (unsigned int i = 0; i <= n; ++i)
        {
          Point<2> x(double(i) / n, double(j) / n);
          if (kind == "jittered")
            for (unsigned int d = 0; d < 2; ++d)
              if (x[d] > 1e-12 && x[d] < 1 - 1e-12)
                x[d] += 0.25 * random() / n;
          vertices.push_back(x);
        }
    for (unsigned int j = 0; j < n; ++j)
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int a = j * (n + 1) + i, b = a + 1, c = b + n + 1,
                             d = c - 1;
          if (kind == "criss-cross")
            {
              const unsigned int m = vertices.size();
              vertices.emplace_back((i + 0.5) / n, (j + 0.5) / n);
              cells.insert(
                cells.end(),
                {{{a, b, m}}, {{b, c, m}}, {{c, d, m}}, {{d, a, m}}});
            }
          else
            cells.insert(cells.end(), {{{a, b, c}}, {{a, c, d}}});
        }

    const std::string name = "square-" + std::to_string(n) + ".msh";
    std::ofstream     file(name);
    file << std::setprecision(17);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n"
            "1 1 \"bottom\"\n1 2 \"right\"\n1 3 \"top\"\n1 4 \"left\"\n"
            "2 5 \"body\"\n$EndPhysicalNames\n$Nodes\n"
         << vertices.size() << '\n';
    for (unsigned int v = 0; v < vertices.size(); ++v)
      file << v + 1 << ' ' << vertices[v] << " 0\n";
    file << "$EndNodes\n$Elements\n" << cells.size() + 4 * n << '\n';
    unsigned int number = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int top = n * (n + 1), row = n + 1;
        const unsigned int sides[4][2] = {{i, i + 1},
                                          {i * row + n, (i + 1) * row + n},
                                          {top + i, top + i + 1},
                                          {i * row, (i + 1) * row}};
        for (unsigned int s = 0; s < 4; ++s)
          file << ++number << " 1 2 " << s + 1 << ' ' << s + 1 << ' '
               << sides[s][0] + 1 << ' ' << sides[s][1] + 1 << '\n';
      }
    for (const auto &cell : cells)
      file << ++number << " 2 2 5 1 " << cell[0] + 1 << ' ' << cell[1] + 1
           << ' ' << cell[2] + 1 << '\n';
    file << "$EndElements\n";
    return name;
  }



  /** Take the first matrix of a block with the given compressibility. */
  template <int dim>
  void
  take_matrix(const std::string &settings)
  {
    try
      {
        test::run_scene<dim>(
          "Linear solver/Solver = Keep matrix\n"
          "Formulation/Type = u-p\n"
          "Material/Density = 1\n"
          "Boundary conditions/Displacement = bottom: x=0, "
          "y=0; left: x=0; right: x=0" +
          std::string(dim == 3 ? "; front: z=0; back: z=0" : "") +
          "\nBoundary conditions/Gravity = 0, -1e-6*t" +
          (dim == 3 ? ", 0" : "") +
          "\n"
          "Dynamics/Inertia = false\n" +
          settings);
      }
    catch (const MatrixTaken &)
      {}
  }

  LAPACKFullMatrix<double>
  lapack(const FullMatrix<double> &matrix)
  {
    LAPACKFullMatrix<double> copy(matrix.m(), matrix.n());
    copy = matrix;
    return copy;
  }

  /** β of the scene, with G = 1. */
  template <int dim = 2>
  double
  inf_sup_constant(const std::string &settings,
                   const double       alpha,
                   const std::string &stabilisation = "PPP")
  {
    // without stabilisation, C is M / K: E = 2.6, ν = 0.3, G = 1
    take_matrix<dim>(
      "Formulation/Stabilisation = none\n"
      "Material/Young modulus = 2.6\nMaterial/Poisson ratio = 0.3\n" +
      settings);
    FullMatrix<double> M = blocks.C;
    M *= 2.6 / (3 * (1 - 0.6));

    take_matrix<dim>(
      (alpha == 0 ? std::string("Formulation/Stabilisation = none\n") :
                    "Formulation/Stabilisation = " + stabilisation +
                      "\n"
                      "Formulation/PPP coefficient = " +
                      std::to_string(alpha) + '\n') +
      "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n" + settings);
    LAPACKFullMatrix<double> inverse = lapack(blocks.A);
    inverse.invert();
    FullMatrix<double> A_inverse(inverse.m(), inverse.n());
    A_inverse = inverse;
    FullMatrix<double> A_inverse_B(A_inverse.m(), blocks.B.n());
    A_inverse.mmult(A_inverse_B, blocks.B);
    FullMatrix<double> S = blocks.C;
    blocks.B.Tmmult(S, A_inverse_B, true);
    S.symmetrize();
    M.symmetrize();

    LAPACKFullMatrix<double>    left = lapack(S), right = lapack(M);
    std::vector<Vector<double>> vectors;
    Vector<double>              values;
    left.compute_generalized_eigenvalues_symmetric(
      right, -1e-8, 1e8, 1e-14, values, vectors);
    return std::sqrt(std::max(0., values.size() ? values[0] : 0.));
  }

  /** A square or cube of n coarse cells a side, of which @p n_levels are halved
   * here and there: "sparsely" or "densely", no direction preferred. */
  template <int dim>
  std::string
  closure(const std::string &how,
          const unsigned int n,
          const unsigned int n_levels)
  {
    const std::string number = std::to_string(n), times = number + "*";
    // where the product of waves is large, in spots of one to a few coarse
    // cells
    const std::string is_fine =
      dim == 2 ?
        "sin(" + times + "(2.9*x + 1.3*y) + 1) * sin(" + times +
          "(3.1*y - 1.7*x) + 2) > " + (how == "sparsely" ? "0.8" : "0.3") :
        "(x - 0.3)^2 + (y - 0.4)^2 + (z - 0.6)^2 < " +
          std::string(how == "sparsely" ? "0.01" : "0.1");
    return "Quadrature/Type = CPDI\n"
           "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
           "Grid/Subdivisions = " +
           number + ", " + number + (dim == 3 ? ", " + number : "") +
           "\nAdaptive grid/Maximum level = " + std::to_string(n_levels) +
           "\nAdaptive grid/Cell size = if(" + is_fine + ", 0.001, 1)\n";
  }

  std::string
  grid(const std::string &kind, const unsigned int n)
  {
    if (kind == "criss-cross" || kind == "jittered")
      return "Grid/Type = gmsh\nGrid/File = " + write_mesh(kind, n) + '\n';
    return "Grid/Upper corner = 1, 1\nGrid/Subdivisions = " +
           std::to_string(n) + ", " + std::to_string(n) +
           "\nGrid/Diagonals = " + kind + '\n';
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const bool                       print = argc > 1; // the constants themselves

  const auto refine = [&](const std::string &kind,
                          const double       alpha,
                          const unsigned int finest) {
    std::vector<double> beta;
    for (unsigned int n = 4; n <= finest; n *= 2)
      beta.push_back(
        inf_sup_constant("Quadrature/Type = points\n" + grid(kind, n), alpha));
    if (print)
      {
        std::cout << kind << ", alpha = " << alpha << ':';
        for (const double b : beta)
          std::cout << ' ' << b;
        std::cout << std::endl;
      }
    return beta;
  };
  for (const std::string kind : {"/", "alternating", "criss-cross", "jittered"})
    {
      // criss-cross has twice the nodes: dense matrices get too large
      const auto   beta  = refine(kind, 1, kind == "criss-cross" ? 16 : 32);
      const double slope = std::log2(beta[beta.size() - 2] / beta.back());
      test::check("with PPP, beta > 0.5 and does not fall with h, " + kind,
                  beta.back() > 0.5 && slope < 0.1,
                  std::to_string(beta.back()) + ", slope " +
                    std::to_string(slope));
    }
  for (const std::string kind : {"/", "jittered"})
    {
      const auto beta = refine(kind, 0, 16);
      test::check("without, beta vanishes, " + kind,
                  beta[2] < 0.01,
                  std::to_string(beta[2]));
    }

  // Conforming closures of forests.
  for (const std::string how : {"sparsely", "densely"})
    {
      std::vector<double> beta;
      for (unsigned int n = 2; n <= 8; n *= 2)
        beta.push_back(
          inf_sup_constant("Quadrature/Type = points\n" + closure<2>(how, n, 2),
                           1));
      const double beta_3d = inf_sup_constant<3>("Quadrature/Type = points\n" +
                                                   closure<3>(how, 2, 1),
                                                 1);
      const double slope   = std::log2(beta[1] / beta[2]);
      test::check("closure, refined " + how + ": beta > 0.5, does not fall",
                  beta[2] > 0.5 && slope < 0.1 && beta_3d > 0.4,
                  std::to_string(beta[2]) + ", slope " + std::to_string(slope) +
                    ", in 3D " + std::to_string(beta_3d));
      if (print)
        std::cout << "closure, " << how << ": " << beta[0] << ' ' << beta[1]
                  << ' ' << beta[2] << ", in 3D " << beta_3d << std::endl;
    }
  finds_condition_number  = true;
  const std::string block = "Quadrature/Type = points\n"
                            "Formulation/Stabilisation = PPP\n"
                            "Material/Young modulus = 3\n"
                            "Material/Poisson ratio = 0.5\n";
  take_matrix<2>(block + grid("alternating", 16));
  const double uniform = blocks.condition_number;
  take_matrix<2>(block + closure<2>("densely", 4, 2));
  const double graded = blocks.condition_number;
  test::check("condition number of a closure, that of its finest cells alone",
              graded < 1.5 * uniform,
              std::to_string(graded) + " instead of " +
                std::to_string(uniform));
  if (print)
    std::cout << "condition numbers: closure " << graded << ", uniform "
              << uniform << std::endl;
  finds_condition_number = false;

  for (const std::string kind : {"/", "alternating", "criss-cross", "jittered"})
    {
      std::vector<double> beta;
      for (unsigned int n = 4; n <= 16; n *= 2)
        beta.push_back(inf_sup_constant(
          "Quadrature/Type = points\n" + grid(kind, n), 1, "OSS"));
      const double slope = std::log2(beta[1] / beta[2]);
      test::check(
        "orthogonal subscales, beta > 0.4 and does not fall with h, " + kind,
        beta[2] > 0.4 && slope < 0.1,
        std::to_string(beta[2]) + ", slope " + std::to_string(slope));
      if (print)
        std::cout << "OSS, " << kind << ": " << beta[0] << ' ' << beta[1] << ' '
                  << beta[2] << std::endl;
    }

  // The uppermost row of cells is cut at the fraction f of its height.
  double smallest = 1e9, whole = 0;
  for (const double f : {1., 0.8, 0.3, 0.1, 1e-2, 1e-4, 1e-6, 1e-8})
    {
      const unsigned int n = 8;
      const double       h = 1 / (n - 1 + f);
      std::ostringstream settings;
      settings << std::setprecision(17) << "Grid/Upper corner = 1, " << n * h
               << "\nGrid/Subdivisions = 8, " << n
               << "\nMaterial points/Points per cell = 4\n"
               << "Material points/Body mesh = " << write_mesh("/", 8)
               << "\nQuadrature/Type = CPDI\n";
      const double beta = inf_sup_constant(settings.str(), 1);
      if (f == 1)
        whole = beta;
      smallest = std::min(smallest, beta);
      if (print)
        std::cout << "cut " << f << ": " << beta << std::endl;
    }
  test::check("no cut takes more than a tenth of beta",
              smallest > 0.9 * whole,
              std::to_string(smallest) + " of " + std::to_string(whole));
  return 0;
}
