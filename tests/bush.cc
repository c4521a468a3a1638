/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A bonded rubber bush, incompressible, both of whose surfaces are tied to
// prescribed places: its pressure differs from place to place as a function of
// second order, and the ties must not yield to it. In small plane strain the
// inner surface needs, per length and displacement,
//   4 π G / (ln(b/a) - (b² - a²)/(b² + a²))
// to be moved sideways.

#include <fstream>

#include "run_scene.h"

using namespace isochor;

const double a = 3, b = 4;

/** The ring, in @p n_radial times @p n_around quadrilaterals of two triangles.
 */
void
write_ring(const std::string &name,
           const unsigned int n_radial,
           const unsigned int n_around)
{
  if (test::this_rank() == 0)
    {
      std::ofstream out(name);
      out.precision(17);
      out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n1\n"
             "2 1 \"ring\"\n$EndPhysicalNames\n$Nodes\n"
          << n_around * (n_radial + 1) << '\n';
      for (unsigned int i = 0; i < n_around; ++i)
        for (unsigned int j = 0; j <= n_radial; ++j)
          {
            const double r     = a + (b - a) * j / n_radial,
                         angle = 2 * test::pi * i / n_around;
            out << i * (n_radial + 1) + j + 1 << ' ' << r * std::cos(angle)
                << ' ' << r * std::sin(angle) << " 0\n";
          }
      out << "$EndNodes\n$Elements\n" << 2 * n_around * n_radial << '\n';
      unsigned int n    = 0;
      const auto   node = [&](const unsigned int i, const unsigned int j) {
        return std::to_string(i % n_around * (n_radial + 1) + j + 1) + ' ';
      };
      for (unsigned int i = 0; i < n_around; ++i)
        for (unsigned int j = 0; j < n_radial; ++j)
          {
            out << ++n << " 2 2 1 1 " << node(i, j) << node(i, j + 1)
                << node(i + 1, j + 1) << '\n';
            out << ++n << " 2 2 1 1 " << node(i, j) << node(i + 1, j + 1)
                << node(i + 1, j) << '\n';
          }
      out << "$EndElements\n";
    }
  test::wait_for_all_ranks();
}

void
test_bush(const std::string &displacement, const double tolerance)
{
  const double G = 1, d = 1e-4;
  const double exact = 4 * test::pi * G * d /
                       (std::log(b / a) - (b * b - a * a) / (b * b + a * a));
  const auto bush = test::run_scene<2>(
    "Grid/Lower corner = -4.05, -4.05\nGrid/Upper corner = 4.05, 4.05\n"
    "Grid/Subdivisions = 54, 54\nQuadrature/Type = CPDI\n"
    "Material points/Body mesh = ring.msh\n"
    "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
    "Boundary conditions/Surfaces of body = in: x^2+y^2 < 10; out: x^2+y^2 > "
    "15\nInteraction: in - place/Displacement = " +
    displacement + "\nInteraction: out - place/Displacement = x=0, y=0\n");
  const std::string along =
    displacement.find("x=1e-4") != std::string::npos ? "x" : "y";
  const double force =
    test::get(*bush, "Force " + along + " on in by place (N)");
  test::check_error("bush moved along " + along,
                    test::relative(force, exact),
                    tolerance);
  std::string told;
  for (const auto &warning : test::all_warnings(*bush).all())
    told += warning.subject + "; ";
  test::check("nothing to tell", told.empty(), told);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  write_ring("ring.msh", 7, 168);
  test_bush("x=1e-4*t, y=0", 0.003);
  test_bush("x=0, y=1e-4*t", 0.003);
}
