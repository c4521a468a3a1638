/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A joint that yields (J2) between blocks of its own moduli, sheared by a
// displacement of the top, periodic: the stress is the same everywhere, so that
// the force follows from the strength. The joint lies off the lines of the
// grid. It is the softest there, although its moduli are those of the blocks:
// counted as the stiffest, the force was up to 4.3 times as large.

#include <cmath>
#include <sstream>

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double E = 1e7, nu = 0.3, yield_stress = 1e3, hardening = 1e5,
                   width = 0.25, movement = 1e-3;

  /** Of a joint of @p thickness under the movement of the top of a body of
   * height 1. With τ the shear stress and γ_p the plastic shear of the joint,
   *   movement = τ/G + thickness γ_p,  √3 τ = σ_Y + H γ_p/√3. */
  double
  exact_force(const double thickness)
  {
    const double G = E / (2 * (1 + nu));
    // γ_p = (√3 τ - σ_Y) √3/H
    return width *
           (movement + thickness * std::sqrt(3.) * yield_stress / hardening) /
           (1 / G + 3 * thickness / hardening);
  }

  std::string told; ///< of the scene run last

  double
  error_of_force(const std::string &form,
                 const double       thickness,
                 const std::string &settings)
  {
    constexpr double   below = 7.5 / 16;
    std::ostringstream scene;
    scene
      << "Grid/Upper corner = " << width
      << ", 1\nGrid/Subdivisions = 4, 16\nFormulation/Type = " << form
      << "\nBoundary conditions/Periodic sides = left: right\n"
         "Boundary conditions/Displacement = bottom: x=0, y=0; top: y=0, x="
      << movement
      << "*t\nTime/Step size = 0.25\nPostprocess/Reactions = bottom\n"
         "Quadrature/Type = CPDI\nMaterial points/Materials in zones = 2: y > "
      << below << " && y < " << below + thickness
      << "\nMaterial/Young modulus = " << E
      << "\nMaterial/Poisson ratio = " << nu
      << "\nMaterial 2/Young modulus = " << E
      << "\nMaterial 2/Poisson ratio = " << nu
      << "\nMaterial 2/Model = J2\nMaterial 2/J2/Yield stress = "
      << yield_stress << "\nMaterial 2/J2/Hardening modulus = " << hardening
      << "\n"
      << settings;
    const auto problem = test::run_scene<2>(scene.str());
    told = test::warning_of(*problem, "material interface within cells");
    return -test::get(*problem, "Reaction x on bottom (N)") /
             exact_force(thickness) -
           1;
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  // finite shear by 1 %; one cell, over two halves, has no cell of its own
  constexpr double tolerance = 1.5e-3;
  for (const std::string form : {"u-p", "u"})
    for (const double cells : {1., 1.5, 2., 3.})
      {
        std::ostringstream name;
        name << form << ", " << cells << " cells thick";
        test::check_error(name.str(),
                          std::abs(error_of_force(form, cells / 16, "")),
                          cells == 1 ? 3e-3 : tolerance);
        test::check("... not told", told.empty(), told);
      }
  test::check_error("blocks that could yield later",
                    std::abs(error_of_force("u-p",
                                            1.5 / 16,
                                            "Material/Model = J2\n"
                                            "Material/J2/Yield stress = "
                                            "1e5\n")),
                    tolerance);
  // of one domain, whose corners are all those of the blocks
  const double thin =
    error_of_force("u-p", 0.5 / 16, "Material points/Points per cell = 4\n");
  test::check_error("half a cell thick", std::abs(thin), 3e-3);
  return 0;
}
