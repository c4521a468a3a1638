/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A warning says that an equilibrium isn't stable, and says it of no other: a
// column that stays straight beyond the load of Euler's formula, and bodies
// that yield while they are held by what is prescribed.

#include <filesystem>

#include "scene_messages.h"

using namespace isochor;

namespace
{
  const std::string subject = "negative pivot(s) of displacements";

  /** Width (m) and height (m) of a column that is clamped below and free above,
   * E = 1e7 Pa, ν = 0.3, under a dead pressure of 4e4 t Pa. */
  constexpr double width = 0.1, height = 1;

  /** The time of its buckling load: π² E I/(4 H²), E/(1 - ν²) in plane strain
   * (Timoshenko & Gere, Theory of Elastic Stability, 1961, 2.1); its shear
   * lowers it by 0.6 %. */
  double
  time_of_buckling()
  {
    const double bending = 1e7 / (1 - 0.3 * 0.3) * std::pow(width, 3) / 12;
    return test::pi * test::pi * bending / (4 * height * height) /
           (4e4 * width);
  }

  std::string
  column(const std::string &type, const double end, const double step)
  {
    return "Formulation/Type = " + type +
           "\nGrid/Lower corner = -0.05, 0\nGrid/Upper corner = 0.15, 1.05\n"
           "Grid/Subdivisions = 16, 84\nGrid/Diagonals = alternating\n"
           "Material points/Region = x > 0 && x < 0.1 && y < 1\n"
           "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.3\n"
           "Boundary conditions/Displacement = bottom: x=0, y=0\n"
           "Boundary conditions/Surfaces of body = lid: y > 0.999\n"
           "Boundary conditions/Traction on body = lid: 0, -4e4*t\n"
           "Time/Step size = " +
           std::to_string(step) + "\nTime/End time = " + std::to_string(end) +
           "\n";
  }

  void
  test_column(const std::string &type)
  {
    // cells with linear functions are too stiff in bending: 8 of them over the
    // width by some 2 %
    constexpr double  step = 0.02, too_stiff = 0.04;
    const double      t     = time_of_buckling();
    const std::string text  = messages<2>(column(type, 0.66, step), false);
    const std::string start = "| up to t = ";
    const std::size_t place = text.find(start);
    const bool        told =
      place != std::string::npos && text.find(subject) != std::string::npos;
    const double found =
      told ? std::stod(text.substr(place + start.size())) : 0.;
    test::check("a straight column beyond Euler's load, " + type,
                found > 0.99 * t && found < (1 + too_stiff) * t + step,
                std::to_string(found) + " for " + std::to_string(t) + ": " +
                  text);
    expect("a column below it, " + type,
           messages<2>(column(type, 0.52, 0.13), false),
           {});
  }

  /** Bodies that flow while displacements are prescribed have a matrix that is
   * nearly singular. */
  void
  test_flow()
  {
    const std::string block =
      "Grid/Upper corner = 2, 1.25\nGrid/Subdivisions = 16, 10\n"
      "Material points/Region = y < 1 && x < 1.5\n"
      "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
      "Boundary conditions/Surfaces of body = lid: y > 0.99 && x < 0.5\n"
      "Interaction: lid - place/Displacement = x=0, y=-0.1*t\n"
      "Boundary conditions/Displacement = bottom: x=0, y=0; left: x=0\n"
      "Time/Step size = 0.05\n";
    for (const std::string material :
         {"Material/Model = J2\nMaterial/J2/Yield stress = 1e3\n",
          "Material/Model = Mohr-Coulomb\n"
          "Material/Mohr-Coulomb/Cohesion = 1e3\n"})
      for (const std::string type : {"u", "u-p"})
        {
          const std::string text =
            messages<2>(block + material + "Formulation/Type = " + type + "\n",
                        false);
          test::check("a body that flows, " + material.substr(17, 2) + ", " +
                        type,
                      text.find(subject) == std::string::npos,
                      text);
        }
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  test_column("u");
  test_column("u-p");
  test_flow();
  return 0;
}
