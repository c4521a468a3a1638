/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What is told of small mistakes: places of probes, before anything is run,
// loads that go into a support.

#include <filesystem>

#include "scene_messages.h"

using namespace isochor;

namespace
{
  void
  test_probes()
  {
    const std::string low = good + "Material points/Region = y < 0.5\n"
                                   "Postprocess/Point probes = a: ";
    for (const std::string place : {"0.5, 0.8", "0.5, 1.6", "-3, 0.2"})
      expect("--validate with a probe at " + place,
             messages<2>(low + place + "\n"),
             {"ERROR", "<a>", "no cell that holds material", "Point probes"});
    for (const std::string place : {"0.5, 0.2", "0, 0", "1, 0.5"})
      expect("--validate with a probe at " + place,
             messages<2>(low + place + "\n"),
             {});
  }

  void
  test_hidden_zones()
  {
    expect("a zone that a later one covers",
           messages<2>(good +
                         "Material points/Materials in zones = 2: y < 0.5; 1: "
                         "y < 0.75\n",
                       true,
                       2),
           {"WARNING no effect of <Material 2>", "later zone"});
  }

  /** What is printed at the start of a body of several materials. */
  void
  test_list_of_materials()
  {
    const auto printed = [](const std::string &settings,
                            const unsigned int n_materials) {
      std::ostringstream    out;
      std::streambuf *const original = std::cout.rdbuf(out.rdbuf());
      messages<2>(good + settings + "Output/Terminal = progress\n",
                  true,
                  n_materials);
      std::cout.rdbuf(original);
      return out.str();
    };
    const std::string three =
      printed("Material points/Materials in zones = 2: y < 0.5\n"
              "Material 2/Density = 1800\nMaterial 2/Poisson ratio = 0.499\n"
              "Material 2/Model = J2\n",
              3);
    test::check("the materials are listed",
                three.find("  Material: 64 points, 0.5 m^2, 1000 kg/m^3, "
                           "Neo-Hookean, E = 1e+06 Pa, nu = 0.3\n"
                           "  Material 2: 64 points, 0.5 m^2, 1800 kg/m^3, "
                           "J2, E = 1e+06 Pa, nu = 0.499, yield stress = "
                           "1e+04 Pa\n"
                           "  Material 3: no points\n") != std::string::npos,
                three);
    const std::string soil =
      printed("Material/Model = Mohr-Coulomb\nMaterial/Mohr-Coulomb/Cohesion = "
              "2e3\nMaterial/Mohr-Coulomb/Friction angle = 30\n"
              "Material/Poisson ratio = 0\nFormulation/Geometry = "
              "axisymmetric\n",
              1);
    test::check(
      "... with their strength",
      soil.find("nu = 0, cohesion = 2000 Pa, friction angle = 30 degrees\n") !=
        std::string::npos,
      soil);
    const std::string one = printed("Material/Poisson ratio = 0.5\n", 1);
    test::check("... a single one, too",
                one.find("Body: 1 m^2") != std::string::npos &&
                  one.find("  Material: Neo-Hookean, E = 1e+06 Pa, nu = "
                           "0.5\n") != std::string::npos,
                one);
  }

  void
  test_places_far_away()
  {
    expect("a boundary beside the body, far from the origin",
           messages<2>("Grid/Lower corner = 1000, 0\nGrid/Upper corner = "
                       "1001, 1\nGrid/Subdivisions = 4, 4\nMaterial "
                       "points/Region = x < 1000.75\nBoundary conditions/"
                       "Displacement = left: x=0, y=0; right: x=0\nBoundary "
                       "conditions/Gravity = 0, -1\n"),
           {"WARNING", "<right>", "[1000, 1000.75]", "[1001, 1001]"});
  }

  void
  test_loads_on_supports()
  {
    const std::string load = good + "Boundary conditions/Traction = ";
    expect("a load on a support",
           messages<2>(load + "bottom: 0, -1e4*t\n", false),
           {"WARNING",
            "a load on a support",
            "<bottom>",
            "acts in y where this component is prescribed"});
    expect("a load on a side of which another component is held",
           messages<2>(load + "left: 0, -1e2*t\nBoundary conditions/"
                              "Displacement = left: x=0; bottom: y=0\n",
                       false),
           {});
  }

  void
  test_bore()
  {
    expect(
      "a load on faces that the body covers in part",
      messages<2>(
        "Grid/Subdivisions = 8, 8\nMaterial points/Region = "
        "x*x+y*y > 0.16\nQuadrature/Type = points\nBoundary conditions/Displacement = "
        "left: x=0; bottom: y=0\nBoundary conditions/Surfaces "
        "of body = bore: x*x+y*y < 0.25\nBoundary "
        "conditions/Pressure on body = bore: 1e3*t\n"),
      {"WARNING surface in part off the body",
       "only 20 %",
       "its load acts on this part alone",
       "<Material points/Body mesh>"});
  }

  /** The bar of the tutorial, dropped: a vibration of 0.74 s. */
  void
  test_losses_at_start()
  {
    const auto dropped = [](const std::string &step_size) {
      return messages<2>(
        "Grid/Lower corner = 0, -0.5\nGrid/Upper corner = 1.1, 0.2\n"
        "Grid/Subdivisions = 44, 28\nMaterial points/Region = x < 1 && y > 0 "
        "&& y < 0.1\nMaterial/Young modulus = 5e6\nMaterial/Poisson ratio = "
        "0.499\nBoundary conditions/Displacement = left: x=0, y=0\n"
        "Boundary conditions/Gravity = 0, -9.81\nDynamics/Inertia = true\n"
        "Time/End time = 1.6\nTime/Step size = " +
          step_size + "\n",
        false);
    };
    expect("steps of a third of the vibration, a short run",
           dropped("0.25"),
           {"WARNING energy balance",
            "in the first steps",
            "<Time/Step size>"});
    const std::string fine = dropped("0.05");
    test::check("... of a fifteenth",
                fine.find("in the first steps") == std::string::npos,
                fine);
  }

  void
  test_hinge()
  {
    const std::string hinge =
      "Grid/Subdivisions = 4, 4\nQuadrature/Type = CPDI\n"
      "Boundary conditions/Gravity = 0, -0.1\n"
      "Rigid body: hinge/Shape = half plane\nRigid body: hinge/Point = 0, "
      "0.5\nRigid body: hinge/Normal = 1, 0\n"
      "Boundary conditions/Surfaces of body = side: x < 0.01\n"
      "Interaction: side - hinge/Law = tie\n";
    expect("a rigid body that is a hinge, under a load",
           messages<2>(hinge + "Rigid body: hinge/Free = rotation\n"),
           {"free in rotation about (0, 0.5) (the one"});
    expect("... that is held", messages<2>(hinge), {});
  }

  void
  test_materials()
  {
    const auto law = [](const std::string &settings) {
      return messages<2>(good + "Material/Young modulus = 1e6\n" + settings);
    };
    expect("a yield stress above Young's modulus",
           law("Material/Model = J2\nMaterial/J2/Yield stress = 1.01e6\n"),
           {"WARNING", "<J2/Yield stress> = 1.01e+06", "<Young modulus>"});
    expect("a high one",
           law("Material/Model = J2\nMaterial/J2/Yield stress = 0.99e6\n"),
           {});
    expect("a yield stress in MPa",
           law("Material/Model = J2\nMaterial/J2/Yield stress = 0.9\n"),
           {"WARNING doubtful units",
            "<J2/Yield stress> = 0.9 Pa is only 9e-07 of <Young modulus>",
            "MPa"});
    expect("a low one",
           law("Material/Model = J2\nMaterial/J2/Yield stress = 1.1\n"),
           {});
    const std::string clay = "Material/Model = Mohr-Coulomb\n"
                             "Material/Mohr-Coulomb/Cohesion = 0.5\n"
                             "Material/Mohr-Coulomb/Friction angle = ";
    expect("a cohesion in other units",
           law(clay + "0\n"),
           {"WARNING", "<Mohr-Coulomb/Cohesion> = 0.5 Pa is only 5e-07 of"});
    expect("a small one beside friction", law(clay + "30\n"), {});
    const std::string soil = "Material/Model = Mohr-Coulomb\n"
                             "Material/Mohr-Coulomb/Cohesion = 1e3\n"
                             "Material/Mohr-Coulomb/Friction angle = ";
    expect("an angle in radians",
           law(soil + "0.52\n"),
           {"WARNING", "in degrees", "29.79"});
    expect("one in degrees", law(soil + "20\n"), {});
    expect("a tolerance that is too large",
           messages<2>(good + "Newton/Tolerance = 0.1\n"),
           {"ERROR", "<Newton/Tolerance> is 0.1", "at most 0.01"});
    const std::string plain = "Formulation/Type = u\n";
    expect("the form u near the incompressible limit",
           law(plain + "Material/Poisson ratio = 0.49\n"),
           {"WARNING", "volumetric locking", "Poisson ratio", "u-p"});
    expect("... and far from it",
           law(plain + "Material/Poisson ratio = 0.45\n"),
           {});
    expect("... with a law that yields",
           law(plain + "Material/Model = J2\nMaterial/J2/Yield stress = 1e3\n"),
           {"WARNING", "volumetric locking", "yields", "u-p"});
  }

  /** A block that is pressed by a plate on a part of its top
   * (prm/compression_block, in the plane): its volumes are wrong where it is
   * sheared. */
  void
  test_wandering_volumes()
  {
    const auto pressed = [](const std::string &way) {
      return messages<2>(
        "Grid/Subdivisions = 8, 8\nGrid reset/Steps between resets = 0\n"
        "Material/Poisson ratio = 0.499\nMaterial points/Points per cell = 1\n"
        "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
        "Boundary conditions/Surfaces of body = plate: y > 0.99 && x < 0.5\n"
        "Interaction: plate - place/Displacement = x=0, y=-" +
          way + "*t\nTime/Step size = 0.125\n",
        false);
    };
    const std::string far = pressed("0.35");
    test::check("volumes that are wrong where the body is sheared",
                far.find("volume drift") != std::string::npos &&
                  far.find("weighted with the shear strain") !=
                    std::string::npos,
                far);
    const std::string near = pressed("0.02");
    test::check("... and right",
                near.find("volume drift") == std::string::npos,
                near);
  }

  /** Conditions on boundaries that the body, in the lower half, doesn't touch,
   * and formulas of a place where there is none. */
  void
  test_untouched()
  {
    const std::string low =
      good + "Material points/Region = y < 0.5\nBoundary conditions/";
    expect("a wall where no material is",
           messages<2>(low + "Walls = top: n = 0\n"),
           {"WARNING no material at <top>", "Boundary conditions/Walls"});
    const auto periodic = [](const std::string &region) {
      return messages<2>(
        "Grid/Subdivisions = 4, 4\n"
        "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
        "Boundary conditions/Gravity = 0, -1\n"
        "Boundary conditions/Periodic sides = left: right\n"
        "Material points/Region = " +
        region + "\n");
    };
    for (const std::string side : {"left", "right"})
      expect("periodic sides, none at the " + side,
             periodic(side == "left" ? "x > 0.5" : "x < 0.5"),
             {"WARNING no material at <" + side + ">",
              "Boundary conditions/Periodic sides"});
    expect("periodic sides, at both", periodic("y < 0.5"), {});
  }

  void
  test_summary()
  {
    Warnings   warnings;
    const auto test = [&](const std::string &what, const std::string &summary) {
      test::check("the last line, " + what,
                  warnings.summary() == summary,
                  warnings.summary());
    };
    test("no warning", "No warnings.");
    for (unsigned int i = 0; i < 7; ++i)
      warnings.add("a", "of a");
    test("one", "1 warning, see above: a (7 times).");
    warnings.add("b", "of b");
    test("two", "2 warnings, see above: a (7 times), b.");
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  test_probes();
  test_hidden_zones();
  test_list_of_materials();
  test_places_far_away();
  test_loads_on_supports();
  test_bore();
  test_losses_at_start();
  test_hinge();
  test_materials();
  test_wandering_volumes();
  test_untouched();
  test_summary();
  return 0;
}
