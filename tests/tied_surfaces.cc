/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Surfaces of bodies by their names: tied to places, to rigid bodies and to
// other bodies; beside closed forms. And what is said of names that can't be
// meant.

#include <filesystem>

#include "scene_messages.h"

namespace
{
  const std::string surfaces = "Boundary conditions/Surfaces of body = ",
                    held     = "Quadrature/Type = CPDI\n"
                               "Boundary conditions/Displacement = ",
                    rubber   = "Material/Young modulus = 3\n"
                               "Material/Poisson ratio = 0.5\n";

  double
  force(const MaterialPointMethod<2> &problem,
        const std::string            &surface,
        const std::string            &axis = "y")
  {
    return test::get(problem, "Force " + axis + " on " + surface + " (N)");
  }

  /** A ring of radii 1 m and 2 m in plane strain, in a grid that knows nothing
   * of it, is widened at its bore by 1e-4 m. With u = A r + B/r and no stress
   * outside the pressure inside is 2 G B (1 - 1/4), and the force on the
   * quarter of the bore in a direction is that times 1 m. */
  void
  test_widened_bore()
  {
    const double nu = 0.3, G = 0.5 / (1 + nu), w = 1e-4;
    const double B = w / (1 + (1 - 2 * nu) / 4), exact = 2 * G * B * 0.75;
    for (const std::string cells : {"18", "36"})
      {
        const auto ring = test::run_scene<2>(
          "Grid/Upper corner = 2.2, 2.2\nGrid/Subdivisions = " + cells + ", " +
          cells + "\nFormulation/Type = u\nMaterial points/Points per cell = " +
          (cells == "18" ? "4" : "16") +
          "\nMaterial points/Body mesh = " SOURCE_DIR "/quarter_ring.msh\n"
          "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n" +
          held + "left: x=0; bottom: y=0\n" + surfaces +
          "bore: x^2+y^2 < 1.01\n"
          "Interaction: bore - place/Displacement = x=1e-4*t*x, y=1e-4*t*y\n"
          "Grid reset/Steps between resets = 0\n"
          "Postprocess/Write energies = always\n");
        test::check_error("bore of a ring, " + cells + " cells",
                          test::relative(force(*ring, "bore by place", "x"),
                                         exact),
                          cells == "18" ? 0.02 : 0.007);
        test::check_error("its energy, " + cells + " cells",
                          test::relative(test::get(*ring, "Strain energy (J)"),
                                         exact * w * test::pi / 4),
                          0.01);
      }
  }

  /** The force of a nearly incompressible block between smooth walls is its
   * modulus M times the strain: M/G is 500. */
  void
  test_confined()
  {
    const double nu = 0.499, G = 0.5 / (1 + nu),
                 M   = 2 * G * (1 - nu) / (1 - 2 * nu);
    const auto block = test::run_scene<2>(
      "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 16, 24\n"
      "Material points/Region = y < 1\n" +
      held + "left: x=0; right: x=0; bottom: y=0\n" + surfaces +
      "top: y > 0.999\nInteraction: top - place/Displacement = y=-1e-6*t\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.499\n");
    test::check_error("confined rubber",
                      test::relative(force(*block, "top by place"), -1e-6 * M),
                      2e-6);
  }

  /** An incompressible block between smooth surfaces that is pressed to 0.8 of
   * its height and let go to 0.9, with a restart in between: the force per
   * undeformed area is G (λ - λ^-3) in the plane, G (λ - λ^-2) in space and of
   * a cylinder. */
  template <int dim>
  void
  test_pressed(const std::string &geometry)
  {
    const bool        round = geometry == "axisymmetric", plane = dim == 2;
    const std::string up = plane ? "y" : "z";
    const std::string block =
      std::string(plane ? "Grid/Upper corner = 1.5, 1\n"
                          "Grid/Subdivisions = 12, 8\n"
                          "Material points/Region = x < 1\n" :
                          "Grid/Upper corner = 1.5, 1.5, 1\n"
                          "Grid/Subdivisions = 6, 6, 4\n"
                          "Material points/Region = x < 1 && y < 1\n") +
      held + (round ? "bottom: y=0\n" : "left: x=0; bottom: y=0") +
      (plane ? "\n" : "; front: z=0\n") + surfaces + "top: " + up +
      " > 0.999\nInteraction: top - place/Displacement = " + up +
      "=-0.2*min(t, 1.5-0.5*t)\nFormulation/Geometry = " + geometry + '\n' +
      rubber + "Time/Step size = 0.1\n";
    const auto check = [&](const MaterialPointMethod<dim> &pressed,
                           const double                    lambda) {
      const double exact =
        (lambda - std::pow(lambda, plane && !round ? -3 : -2)) *
        (round ? test::pi : 1.);
      test::check_error(std::to_string(dim) + "D, " + geometry +
                          ", a block pressed to " + test::in_short(lambda),
                        test::relative(test::get(pressed,
                                                 "Force " + up +
                                                   " on top by place (N)"),
                                       exact),
                        1e-5);
    };
    check(*test::run_scene<dim>(block + "Time/End time = 1\n"
                                        "Checkpoint/Interval = 10\n"),
          0.8);
    check(*test::run_scene<dim>(block + "Time/End time = 2\n"
                                        "Checkpoint/Resume = true\n"),
          0.9);
  }

  /** Two rings, one in the other and tied to it, widened on a grid that is not
   * reset: a run that is resumed goes on as if not interrupted. */
  void
  test_resumed()
  {
    const std::string rings =
      "Grid/Upper corner = 3, 3\nGrid/Subdivisions = 15, 15\n"
      "Material points/Region = x^2 + y^2 > 1 && x^2 + y^2 < 4\n"
      "Material points/Bodies = inner: x^2 + y^2 < 2.25; "
      "outer: x^2 + y^2 > 2.25\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.4\n" +
      held + "left: x=0; bottom: y=0\n" + surfaces +
      "bore: x^2 + y^2 < 1.5 && x > 1e-9 && y > 1e-9\n"
      "Interaction: bore - place/Displacement = x=t*x, y=t*y\n"
      "Grid reset/Steps between resets = 0\nTime/Step size = 0.02\n"
      "Checkpoint/Interval = 3\n"; // a factorisation isn't kept there
    const auto force = [&](const std::string &settings) {
      return test::get(*test::run_scene<2>(rings + settings),
                       "Force x on bore by place (N)");
    };
    const double whole = force("Time/End time = 0.12\n");
    force("Time/End time = 0.06\n");
    test::check_error(
      "tied rings on a grid that is not reset, resumed",
      test::relative(force("Time/End time = 0.12\nCheckpoint/Resume = true\n"),
                     whole),
      1e-11);
  }

  /** Tied at one end and loaded at the other. */
  void
  test_held()
  {
    const auto bar = test::run_scene<2>(
      "Grid/Upper corner = 3, 1\nGrid/Subdivisions = 24, 8\n"
      "Material points/Region = x > 0.5 && x < 2.5\nFormulation/Type = u\n"
      "Material/Young modulus = 1\nMaterial/Poisson ratio = 0.3\n" +
      held + "bottom: y=0\n" + surfaces +
      "left: x < 0.501; right: x > 2.499\n"
      "Interaction: left - place/Displacement = x=0\n"
      "Boundary conditions/Traction on body = right: 1e-6*t, 0\n"
      "Postprocess/Point probes = P: 2.4999, 0.5\n");
    test::check_error("a bar that hangs from its end",
                      test::relative(test::get(*bar, "Displacement x of P (m)"),
                                     2e-6 * 0.91),
                      1e-4);
  }

  /** A surface is a boundary of the grid at t = 0, or where a condition holds,
   * also when the grid is refined: the same faces. */
  void
  test_places_of_surfaces()
  {
    const auto pull = [](const std::string &place, const std::string &grid) {
      return force(*test::run_scene<2>(
                     grid + "Material points/Region = x > 0.3 && x < 0.7\n" +
                     held + "bottom: y=0, x=0\n" + surfaces + "top: " + place +
                     "\nInteraction: top - place/Displacement = x=0.01*t, "
                     "y=-0.1*t\nTime/Step size = 0.25\n"),
                   "top by place");
    };
    const std::string box      = "Grid/Subdivisions = 10, 10\n",
                      adaptive = "Grid/Type = adaptive\n"
                                 "Grid/Coarse cells = box\n"
                                 "Grid/Subdivisions = 10, 10\n"
                                 "Adaptive grid/Maximum level = 1\n"
                                 "Adaptive grid/Cell size = "
                                 "if(t > 0.3, 0.05, 0.1)\n";
    for (const std::string &grid : {box, adaptive})
      test::check_error("a boundary of the grid and a condition",
                        test::relative(pull("top", grid),
                                       pull("y > 0.999", grid)),
                        1e-12);
  }

  /** Faces between bodies belong to no surface that has a name. */
  void
  test_layers()
  {
    std::ostringstream    printed;
    std::streambuf *const original = std::cout.rdbuf(printed.rdbuf());
    test::run_scene<2>(
      "Grid/Upper corner = 1, 1.25\nGrid/Subdivisions = 8, 10\n"
      "Material points/Region = y < 1\n"
      "Material points/Points per cell = 1\n"
      "Material points/Materials in zones = 2: y > 0.5\n"
      "Material/Young modulus = 1e6\nMaterial 2/Young modulus = 1e8\n" +
      held + "bottom: y=0\n" + surfaces +
      "rest: y > 0.01\nInteraction: rest - place/Displacement = x=0\n"
      "Output/Terminal = progress\n");
    std::cout.rdbuf(original);
    test::check(
      "faces between bodies belong to no surface",
      test::this_rank() != 0 ||
        printed.str().find(
          "<Interaction: rest - place>: 24 faces, 3 m in [0, 1] x [0, "
          "1]\n") != std::string::npos,
      printed.str());
  }

  /** Two blocks, one on the other: apart from the left half, which may part,
   * they are tied; their surfaces are tied to a rigid body and to places. */
  void
  test_partners()
  {
    const std::string blocks =
      "Grid/Upper corner = 1, 1.25\nGrid/Subdivisions = 8, 10\n"
      "Material points/Region = y < 1\n"
      "Material points/Materials in zones = 2: y > 0.5\n"
      "Material points/Bodies = lower: y < 0.5; upper: y > 0.5\n"
      "Material/Young modulus = 1e6\nMaterial 2/Young modulus = 1e6\n"
      "Rigid body: lid/Shape = half plane\nRigid body: lid/Point = 0, 1\n"
      "Rigid body: lid/Normal = 0, -1\nRigid body: lid/Motion = y=1e-3*t\n" +
      held + "bottom: y=0; left: x=0; right: x=0\n" + surfaces +
      "half: y > 0.49 && y < 0.51 && x < 0.5; top: y > 0.999\n"
      "Interaction: top - lid/Law = tie\n";
    const auto pulled = [&](const std::string &law) {
      const auto problem = test::run_scene<2>(blocks + law);
      test::check_error("equilibrium, " + law.substr(0, law.find('/')),
                        test::relative(force(*problem, "lower by upper"),
                                       force(*problem, "top by lid")),
                        1e-8);
      return force(*problem, "top by lid");
    };
    const double tied  = pulled(""),
                 apart = pulled("Interaction: half - upper/Law = unilateral\n"),
                 all   = pulled("Interaction: half - upper/Law = tie\n"
                                "Interaction: lower - upper/Law = unilateral\n");
    test::check("a half of the joint opens",
                apart > 0.4 * tied && apart < 0.9 * tied,
                std::to_string(apart) + " of " + std::to_string(tied));
    test::check_error("the law of a part goes before that of the body",
                      test::relative(all, apart),
                      0.1);
  }

  void
  test_messages()
  {
    const std::string tie = "/Displacement = y=0.01*t\n";
    const auto        of  = [&](const std::string &text) {
      return messages<2>(good + text, false);
    };
    expect("a name of neither a body nor a surface",
           of(surfaces + "top: top\nInteraction: roof - place" + tie),
           {"ERROR", "<Interaction: roof - place>", "no body", "Surfaces of"},
           2); // and a surface that nothing names
    expect("a name of both",
           of(surfaces + "body: top\nInteraction: body - place" + tie),
           {"ERROR", "<body>", "is a body and a surface"});
    expect("a surface without a face",
           of(surfaces + "top: y > 2\nInteraction: top - place" + tie),
           {"ERROR",
            "acts on nothing",
            "<Boundary conditions/Surfaces of body = top: y > 2>"});
    expect("no such boundary",
           of(surfaces + "top: roof\nInteraction: top - place" + tie),
           {"ERROR", "names the boundary <roof>"});
    expect("faces that are tied twice",
           of(surfaces + "top: top; upper: y > 0.7\nInteraction: top - place" +
              tie + "Interaction: upper - place" + tie),
           {"ERROR",
            "<Interaction: top - place> and <Interaction: upper - place> tie "
            "the same faces"});
    expect("a place that could be left",
           of(surfaces +
              "top: top\nInteraction: top - place/Law = unilateral\n"
              "Interaction: top - place" +
              tie),
           {"ERROR", "must be 'tie'"});
    expect("nowhere to go",
           of(surfaces + "top: top\nInteraction: top - place/Law = tie\n"),
           {"ERROR", "<Interaction: top - place/Displacement>", "must say"});
    expect("a name without a partner",
           of(surfaces + "top: top\nInteraction: top/Displacement = y=0\n"),
           {"ERROR", "name - partner"});
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  test_widened_bore();
  test_confined();
  test_pressed<2>("plane strain");
  test_pressed<2>("axisymmetric");
  test_pressed<3>("plane strain");
  test_resumed();
  test_held();
  test_places_of_surfaces();
  test_layers();
  test_partners();
  test_messages();
  return 0;
}
