/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A block between a rigid floor and a rigid lid, both without friction. The lid
// is free to move up and down and loaded by a force: it sinks until the block
// carries the force, in a homogeneous state with a closed form. The block lies
// anywhere in the grid's cells.

#include <functional>

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
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_lid("u", 0.3, "Formulation/Type = u\n");
  test_lid("u-p", 0.3, "");
  test_lid("u-p, nearly incompressible", 0.4999, "");
}
