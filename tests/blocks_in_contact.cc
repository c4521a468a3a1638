/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Two blocks with a gap between them, confined at their sides, are pushed
// together by a given way, with all defaults: no force until the gap has
// closed, then that of two confined layers in series. Apart again there is
// none, and when they come together once more it is the same.

#include <fstream>

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** The nominal axial stress (Pa) of a confined Neo-Hookean layer with the
   * stretch @p s: τ = K J (J - 1) + G dev b J^(-2/3), F = diag(1, s, 1). */
  double
  stress(const double E, const double nu, const double s)
  {
    const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
    return (K * s * (s - 1) +
            G * std::pow(s, -2. / 3) * (s * s - (2 + s * s) / 3)) /
           s;
  }

  /** The stretch of the layer with the stress @p p. */
  double
  stretch(const double E, const double nu, const double p)
  {
    double low = 0.2, high = 1;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle                      = (low + high) / 2;
        (stress(E, nu, middle) < p ? low : high) = middle;
      }
    return low;
  }

  /** The pressure (Pa) of layers 1 m and 0.75 m high that have become shorter
   * by @p way together. */
  double
  exact(const double lower,
        const double upper,
        const double nu,
        const double way)
  {
    if (way <= 0)
      return 0;
    double low = -0.5 * std::min(lower, upper), high = 0;
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double p = (low + high) / 2;
        const double shortened =
          1.75 - stretch(lower, nu, p) - 0.75 * stretch(upper, nu, p);
        (shortened > way ? low : high) = p;
      }
    return -low;
  }

  /** Blocks of 8 x 8 and 8 x 6 squares, one above the other. */
  void
  write_blocks(const std::string &name, const double gap)
  {
    std::ostringstream nodes, cells;
    unsigned int       n_nodes = 0, n_cells = 0;
    for (const auto &[rows, bottom] :
         {std::make_pair(8u, 0.), std::make_pair(6u, 1 + gap)})
      {
        const unsigned int first = n_nodes + 1;
        for (unsigned int j = 0; j <= rows; ++j)
          for (unsigned int i = 0; i <= 8; ++i)
            nodes << ++n_nodes << ' ' << i / 8. << ' ' << bottom + j / 8.
                  << " 0\n";
        for (unsigned int j = 0; j < rows; ++j)
          for (unsigned int i = 0; i < 8; ++i)
            {
              const unsigned int a = first + 9 * j + i, b = a + 1, c = a + 10,
                                 d = a + 9;
              cells << ++n_cells << " 2 2 1 1 " << a << ' ' << b << ' ' << c
                    << '\n';
              cells << ++n_cells << " 2 2 1 1 " << a << ' ' << c << ' ' << d
                    << '\n';
            }
      }
    std::ofstream mesh(name);
    mesh.precision(17);
    mesh << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << n_nodes << '\n'
         << nodes.str() << "$EndNodes\n$Elements\n"
         << n_cells << '\n'
         << cells.str() << "$EndElements\n";
  }

  void
  test_blocks(const std::string &what,
              const double       upper,
              const double       gap_in_cells,
              const std::string &settings)
  {
    constexpr double   lower = 1e5, nu = 0.3, h = 0.125;
    const double       gap = gap_in_cells * h;
    std::ostringstream scene;
    scene << "Quadrature/Type = CPDI\nGrid/Upper corner = 1, 2.5\n"
             "Grid/Subdivisions = 8, 20\n"
             "Material points/Body mesh = blocks.msh\n"
             "Material points/Materials in zones = 2: y > "
          << 1 + gap / 2 << "\nMaterial/Young modulus = " << lower
          << "\nMaterial/Poisson ratio = " << nu
          << "\nMaterial 2/Young modulus = " << upper
          << "\nMaterial 2/Poisson ratio = " << nu
          << "\nBoundary conditions/Displacement = left: x=0; right: x=0; "
             "bottom: y=0\n"
             "Boundary conditions/Surfaces of body = top: y > "
          << 1.75 + gap - 0.01
          << "\nInteraction: top - place/Displacement = x=0, y=-"
          << 2 * (gap + 0.1)
          << "*if(t<0.5, t, if(t<1, 1-t, t-1))\n"
             "Time/Step size = 0.05\nTime/End time = 1.5\n"
          << settings;
    write_blocks("blocks.msh", gap);
    const auto  problem = test::run_scene<2>(scene.str());
    const auto &forces =
      test::recorded().columns.at("Force y on body 1 by body 2 (N)");
    double worst = 0, where_apart = 0;
    for (unsigned int i = 0; i < forces.size(); ++i)
      {
        const double t = test::recorded().times[i];
        const double way =
          2 * (gap + 0.1) * (t < 0.5 ? t : (t < 1 ? 1 - t : t - 1)) - gap;
        // to 2 % of a cell
        if (way < -0.02 * h)
          where_apart = std::max(where_apart, std::abs(forces[i]));
        else if (way > 0.02 * h)
          worst =
            std::max(worst,
                     std::abs(-forces[i] / exact(lower, upper, nu, way) - 1));
      }
    test::check_error(what + ": no force across the gap", where_apart, 1e-6);
    test::check_error(what + ": force", worst, 0.01);
    test::check_error(what + ": all steps",
                      std::abs(test::recorded().times.back() - 1.5),
                      1e-9);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Force y on body 1 by body 2 (N)"});
  for (const double ratio : {1., 1.1, 2., 100., 1e4})
    test_blocks("1 : " + std::to_string(int(ratio * 10)) + "/10",
                ratio * 1e5,
                1,
                "");
  for (const double gap : {0.3, 3.})
    test_blocks("gap of " + std::to_string(int(gap * 10)) + "/10 cells",
                1e6,
                gap,
                "");
  test_blocks("u", 1e6, 1, "Formulation/Type = u\n");
  return 0;
}
