/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A block between a rigid floor and a rigid lid, both without friction. The lid
// is free to move up and down and loaded by a force: it sinks until the block
// carries the force, in a homogeneous state with a closed form. The block lies
// anywhere in the grid's cells.

#include <fstream>
#include <functional>
#include <iterator>

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double E = 1000;

  /** Neo-Hookean in plane strain: the nominal stress along y for the stretches
   * @p y and @p x; the same along x with the arguments swapped. */
  double
  stress(const double nu, const double y, const double x)
  {
    const double G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu)), J = x * y;
    return (K * J * (J - 1) +
            G * std::pow(J, -2. / 3) * (y * y - (x * x + y * y + 1) / 3)) /
           y;
  }

  double
  root(const std::function<double(const double)> &f, double low, double high)
  {
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle          = (low + high) / 2;
        (f(middle) < 0 ? low : high) = middle;
      }
    return low;
  }

  /** The stretch along y under the nominal pressure @p p, free along x. */
  double
  exact(const double nu, const double p)
  {
    return root(
      [&](const double y) {
        const double x =
          root([&](const double x) { return stress(nu, x, y); }, 0.5, 2.);
        return stress(nu, y, x) + p;
      },
      0.5,
      1.);
  }

  void
  test_lid(const std::string &what,
           const double       nu,
           const std::string &settings)
  {
    std::ostringstream scene;
    scene
      << "Quadrature/Type = CPDI\nGrid/Lower corner = -0.53, -0.31\n"
         "Grid/Upper corner = 1.97, 1.99\nGrid/Subdivisions = 20, 18\n"
         "Material points/Lattice spacing = 0.05\n"
         "Material points/Region = x > 0.02 && x < 1.02 && y > -0.01 && y < 0.99\n"
         "Material/Young modulus = "
      << E << "\nMaterial/Poisson ratio = " << nu
      << "\nRigid body: floor/Shape = half plane\n"
         "Rigid body: floor/Point = 0, -0.01\n"
         "Rigid body: lid/Shape = box\n"
         "Rigid body: lid/Lower corner = -0.2, 0.99\n"
         "Rigid body: lid/Upper corner = 1.2, 1.2\n"
         "Rigid body: lid/Free = y\nRigid body: lid/Force = y=-200*t\n"
         "Interaction: body - floor/Law = unilateral\n"
         "Interaction: body - lid/Law = unilateral\n"
         "Boundary conditions/Surfaces of body = side: x < 0.03\n"
         "Interaction: side - place/Displacement = x=0\n"
         "Newton/Tolerance = 1e-10\nTime/Step size = 0.25\n"
      << settings;
    const auto problem = test::run_scene<2>(scene.str());
    test::check_error(
      what + ": the block carries the force",
      std::abs(test::get(*problem, "Force y on body by floor (N)") / 200 - 1),
      1e-8);
    test::check_error(
      what + ": the lid sinks",
      std::abs(test::get(*problem, "Translation y of rigid body lid (m)") /
                 (exact(nu, 200) - 1) -
               1),
      1e-6);
  }

  /** The pictures of the last scene: in one file, whatever the number of ranks,
   * of @p n_facets facets. */
  void
  check_picture(const std::string &what, const unsigned int n_facets)
  {
    const auto contents = [](const std::string &name) {
      std::ifstream file(name);
      return std::string{std::istreambuf_iterator<char>(file),
                         std::istreambuf_iterator<char>()};
    };
    const std::string list   = contents("rigid_bodies-00001.pvtu"),
                      facets = contents("rigid_bodies-00001.0000.vtu");
    const auto piece         = list.find("<Piece");
    test::check("picture of " + what,
                piece != std::string::npos && piece == list.rfind("<Piece") &&
                  facets.find("NumberOfCells=\"" + std::to_string(n_facets) +
                              "\"") != std::string::npos &&
                  !contents("rigid_bodies.pvd").empty(),
                list);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_lid("u", 0.3, "Formulation/Type = u\n");
  test_lid("u-p", 0.3, "");
  test_lid("u-p, nearly incompressible", 0.4999, "");
  check_picture("a floor and a lid", 1 + 4);
  test::run_scene<3>("Quadrature/Type = CPDI\nGrid/Subdivisions = 2, 2, 2\n"
                     "Rigid body: lid/Shape = box\n"
                     "Rigid body: lid/Lower corner = 0, 1, 0\n"
                     "Rigid body: lid/Upper corner = 1, 1.2, 1\n"
                     "Boundary conditions/Surfaces of body = top: y > 0.99\n"
                     "Interaction: top - lid/Law = tie\n");
  check_picture("a box in space", 12);
  return 0;
}
