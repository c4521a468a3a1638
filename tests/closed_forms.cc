/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Textbook problems at small strains: a hole in a plate, what is left of the
// stresses in a tube once its pressure is gone, earth pressures.

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** A quarter of a ring, 1 <= r <= 2, as the grid, and its symmetries. */
  const std::string ring =
    "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/quarter_ring.msh\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n";

  /** (@p f) with r and the angle a spelt out. */
  std::string
  polar(std::string f)
  {
    const std::pair<std::string, std::string> names[] = {{"[r]",
                                                          "sqrt(x*x+y*y)"},
                                                         {"[a]", "atan2(y,x)"}};
    for (const auto &[name, meaning] : names)
      for (auto at = f.find(name); at != std::string::npos; at = f.find(name))
        f.replace(at, name.size(), meaning);
    return '(' + f + ')';
  }

  /** Kirsch (1898): a plate with a hole of radius 1, pulled along x, of which
   * the grid is a part. The hole widens as said, and the stress beside it is
   * three times the tension. Cells are coarse: displacements are wrong by 2 %
   * there (u: 3 %) and 6 % (8 %) at the ends. */
  void
  test_hole(const std::string &what,
            const std::string &settings,
            const double       nu,
            const double       coarse)
  {
    const double      E = 1, tension = 1e-5;
    const std::string xx = polar("1e-5*(1-1/[r]^2*(1.5*cos(2*[a])+cos(4*[a]))+"
                                 "1.5/[r]^4*cos(4*[a]))"),
                      yy = polar("1e-5*(-1/[r]^2*(0.5*cos(2*[a])-cos(4*[a]))-"
                                 "1.5/[r]^4*cos(4*[a]))"),
                      xy = polar("1e-5*(-1/[r]^2*(0.5*sin(2*[a])+sin(4*[a]))+"
                                 "1.5/[r]^4*sin(4*[a]))"),
                      nx = polar("x/[r]"), ny = polar("y/[r]");
    const auto problem = test::run_scene<2>(
      ring + "Material/Young modulus = 1\nMaterial/Poisson ratio = " +
      std::to_string(nu) + "\nBoundary conditions/Traction = outer: " + xx +
      '*' + nx + '+' + xy + '*' + ny + ", " + xy + '*' + nx + '+' + yy + '*' +
      ny + "\nPostprocess/Exact stress = xx: " + xx +
      "\nPostprocess/Point probes = side: 1, 0; end: 0, 1\n" + settings);
    const double of_plate = tension * (1 - nu * nu) / E;
    test::check_error(what + ", beside the hole",
                      test::relative(test::get(*problem,
                                               "Displacement x of side (m)"),
                                     3 * of_plate),
                      0.01 * coarse);
    test::check_error(what + ", at its end",
                      test::relative(test::get(*problem,
                                               "Displacement y of end (m)"),
                                     -of_plate),
                      0.03 * coarse);
    test::check_error(what + ", stress",
                      test::get(*problem, "L2 error of stress xx"),
                      0.02 * coarse);
  }

  /** A tube of radii 1 and 2 that has yielded up to c = 1.5 under its pressure,
   * which is then taken off (Hill 1950): the elastic stresses of the pressure
   * are subtracted from those of the flow. G = 1, incompressible.
   * What is left is a small difference, of stresses of which one has a bend at
   * c. */
  void
  test_unloaded_tube(const std::string &what, const std::string &settings)
  {
    const double k = 1e-5 / std::sqrt(3.), c = 1.5, a = 1, b = 2,
                 p = k * (2 * std::log(c / a) + 1 - c * c / b / b);
    std::ostringstream numbers;
    numbers.precision(16);
    numbers << "Boundary conditions/Pressure on body = bore: " << p
            << "*if(t<1, t, 2-t)\n";
    std::ostringstream difference; // of hoop and radial stress
    difference.precision(16);
    difference << "2*" << k << "*if([r]<" << c << ", 1, (" << c << "/[r])^2) - "
               << p * 2 * a * a * b * b / (b * b - a * a) << "/[r]^2";
    // shear stresses don't depend on the mean stress
    numbers << "Postprocess/Exact stress = xy: -x*y/(x*x+y*y)*"
            << polar(difference.str()) << '\n';
    const auto problem = test::run_scene<2>(
      ring + numbers.str() +
      "Boundary conditions/Surfaces of body = bore: inner\n"
      "Material/Model = J2\nMaterial/J2/Yield stress = 1e-5\n"
      "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
      "Material/Density = 0\nTime/End time = 2\nTime/Step size = 0.125\n"
      "Postprocess/Point probes = outside: 2, 0\n" +
      settings);
    const double loaded = k * c * c / 2 / b,
                 left   = loaded - p * a * a * b * b / (b * b - a * a) / 2 / b;
    test::check_error(what + ", what is left of the displacement",
                      test::relative(test::get(*problem,
                                               "Displacement x of outside (m)"),
                                     left),
                      1e-3);
    test::check_error(what + ", residual stress",
                      test::get(*problem, "L2 error of stress xy"),
                      0.2);
  }

  /** A layer between smooth walls, one of which is pushed or goes away: Rankine
   * (1857). Stiff, so that the strain does not matter. */
  void
  test_earth_pressure(const std::string &what,
                      const std::string &settings,
                      const double       friction,
                      const double       cohesion)
  {
    const double s = std::sin(friction * test::pi / 180), K = (1 + s) / (1 - s),
                 load = 1000;
    std::ostringstream soil;
    soil << "Material/Mohr-Coulomb/Friction angle = " << friction
         << "\nMaterial/Mohr-Coulomb/Cohesion = " << cohesion << '\n';
    for (const bool passive : {true, false})
      {
        const auto problem = test::run_scene<2>(
          "Grid/Subdivisions = 3, 3\nMaterial/Model = Mohr-Coulomb\n"
          "Material/Young modulus = 1e9\n"
          "Boundary conditions/Displacement = bottom: y=0; left: x=0; right: x=" +
          std::string(passive ? "-" : "") +
          "2e-5*max(t-1,0)\n"
          "Boundary conditions/Traction = top: 0, -1000*min(t,1)\n"
          "Time/End time = 3\nTime/Step size = 0.25\n"
          "Postprocess/Reactions = right\n" +
          soil.str() + settings);
        const double exact = passive ? load * K + 2 * cohesion * std::sqrt(K) :
                                       load / K - 2 * cohesion / std::sqrt(K);
        test::check_error(what + (passive ? ", passive" : ", active"),
                          test::relative(test::get(*problem,
                                                   "Reaction x on right (N)"),
                                         -exact),
                          1e-4);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession  mpi(argc, argv);
  const std::string cpdi = "Quadrature/Type = CPDI\n";
  test_hole("hole", cpdi, 0.3, 2.4);
  test_hole("incompressible", cpdi, 0.5, 2.4);
  test_hole("u", cpdi + "Formulation/Type = u\n", 0.3, 3.2);
  test_unloaded_tube("tube", cpdi);
  for (const std::string form : {"u", "u-p"})
    {
      const std::string with = cpdi + "Formulation/Type = " + form + '\n';
      test_earth_pressure("clay, " + form, with, 0, 100);
      test_earth_pressure("sand, " + form, with, 30, 0);
      test_earth_pressure("dilating, " + form,
                          with + "Material/Mohr-Coulomb/Dilation angle = 10\n",
                          20,
                          100);
    }
  return 0;
}
