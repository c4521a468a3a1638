/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A boundary of the grid pushes the body, and the grid is put back: before the
// gap between them makes the force wrong by more than some 1 %, a warning says
// so. The force is that on a grid that is kept, on which the block stays
// homogeneous.

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string subject = "a boundary that leaves the body behind";

  struct Result
  {
    double      force;
    std::string warning;
  };

  /** A block between smooth sides, of which the upper one comes down. */
  template <int dim>
  Result
  push(const std::string &settings)
  {
    const auto problem = test::run_scene<dim>(
      std::string(dim == 2 ?
                    "Grid/Upper corner = 1.5, 1\nGrid/Subdivisions = 12, 8\n"
                    "Boundary conditions/Displacement = left: x = 0; bottom: "
                    "y = 0; top: y = -0.06*t\n" :
                    "Grid/Upper corner = 1.5, 1, 0.25\n"
                    "Grid/Subdivisions = 6, 4, 1\n"
                    "Boundary conditions/Displacement = left: x = 0; bottom: "
                    "y = 0; front: z = 0; back: z = 0; top: y = -0.06*t\n") +
      "Formulation/Type = u-p\nQuadrature/Type = CPDI\n"
      "Material points/Region = x < 1\nMaterial/Young modulus = 1e4\n"
      "Material/Poisson ratio = 0.499\nTime/Step size = 0.1\n"
      "Postprocess/Reactions = top\n" +
      settings);
    Result result{test::get(*problem, "Reaction y on top (N)"), ""};
    for (const auto &warning : test::all_warnings(*problem).all())
      if (warning.subject == subject)
        result.warning = warning.text;
    return result;
  }

  /** How much the force is wrong at @p time; whether there was a warning. */
  template <int dim>
  void
  test_force(const std::string &time, const double tolerance, const bool warned)
  {
    const std::string end  = "Time/End time = " + time + '\n',
                      what = std::to_string(dim) + "D, t = " + time;
    const Result kept      = push<dim>(test::keep_grid + end),
                 put_back  = push<dim>(end);
    test::check("told where it is wrong, " + what,
                put_back.warning.empty() != warned,
                put_back.warning);
    test::check("nothing to tell of a grid that is kept, " + what,
                kept.warning.empty(),
                kept.warning);
    const double error = test::relative(put_back.force, kept.force);
    test::check("the force, " + what,
                warned == (error > tolerance),
                std::to_string(error));
  }
} // namespace

/** The right side of a block draws it out of the grid by a part of a cell. The
 * stress is that of a grid that is kept, in the row of cells there as
 * elsewhere. */
template <int dim>
void
test_drawn_out(const std::string &material, const double tolerance)
{
  const auto draw = [&](const std::string &settings) {
    return test::run_scene<dim>(
      std::string(dim == 2 ?
                    "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 8, 12\n"
                    "Boundary conditions/Displacement = left: x=0; bottom: "
                    "y=0; right: x=0.015*t\n" :
                    "Grid/Upper corner = 1, 1.5, 0.5\n"
                    "Grid/Subdivisions = 4, 6, 2\n"
                    "Boundary conditions/Displacement = left: x=0; bottom: "
                    "y=0; front: z=0; right: x=0.03*t\n") +
      "Quadrature/Type = CPDI\nMaterial points/Region = y < 1\n"
      "Material/Young modulus = 1e4\nTime/Step size = 0.25\n"
      "Postprocess/Reactions = right\nPostprocess/Point probes = "
      "W: 0.95, 0.4" +
      (dim == 3 ? ", 0.3" : "") + '\n' + material + settings);
  };
  const auto               kept = draw(test::keep_grid), put_back = draw("");
  std::vector<std::string> columns = {"Reaction x on right (N)"};
  if (material.find("u-p") != std::string::npos)
    columns.push_back("Pressure at W (Pa)");
  for (const std::string &column : columns)
    test::check_error(std::to_string(dim) + "D, drawn out: " + column,
                      test::relative(test::get(*put_back, column),
                                     test::get(*kept, column)),
                      tolerance);
}

/** An incompressible strip is pulled to twice its length by the right side of a
 * grid that is kept, with room above it: that side goes along, and no contact
 * comes about. The force per undeformed area is G (λ - λ⁻³). */
void
test_strip()
{
  const auto strip = test::run_scene<2>(
    "Grid/Upper corner = 1, 0.6\nGrid/Subdivisions = 10, 6\n"
    "Material points/Region = y < 0.4\nMaterial/Young modulus = 3\n"
    "Material/Poisson ratio = 0.5\nQuadrature/Type = CPDI\n"
    "Formulation/Type = u-p\nTime/Step size = 0.1\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0; right: x=t\n"
    "Postprocess/Reactions = right\n" +
    test::keep_grid);
  test::check_error("a strip pulled by a boundary that takes it along",
                    test::relative(test::get(*strip, "Reaction x on right (N)"),
                                   0.4 * (2 - 1. / 8)),
                    1e-6);
}

void
test_outside()
{
  const auto told = [](const std::string &settings) {
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 8, 12\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0; right: "
      "x=0.018*min(4*t, 1)\nQuadrature/Type = CPDI\n"
      "Material points/Region = y < 1\nTime/Step size = 0.1\n" +
      settings);
    return test::warning_of(*problem, "a body in part outside of the grid");
  };
  const std::string text = told("");
  test::check("a body in part outside of the grid",
              text.find("1.7") != std::string::npos &&
                text.find("<Grid/Stretch>") != std::string::npos,
              text);
  test::check("... not of a grid that is kept",
              told(test::keep_grid).empty(),
              "");
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_force<2>("0.2", 0.015, false);
  test_force<2>("0.6", 0.015, true);
  test_force<3>("0.2", 0.015, false);
  test_force<3>("0.6", 0.015, true);

  test_drawn_out<2>("Formulation/Type = u\n", 0.01);
  test_drawn_out<2>("Formulation/Type = u-p\nMaterial/Poisson ratio = 0.499\n",
                    0.01);
  test_drawn_out<3>("Formulation/Type = u-p\n", 0.02);
  test_outside();
  test_strip();

  const Result told = push<2>("Time/End time = 0.3\n");
  test::check("way, cell and body are told",
              told.warning.find("until t = 0.2 ") == 0 &&
                told.warning.find("top: y = ...> has pushed the body by 0.012 "
                                  "m") != std::string::npos,
              told.warning);
  const Result stretched = push<2>("Grid/Stretch = y: 0 -> 0, 1 -> -0.06*t\n");
  test::check("a grid that follows", stretched.warning.empty(), "");
  const Result astray = push<2>("Grid/Stretch = y: 0 -> 0, 1 -> 0.06*t\n");
  test::check("a grid that goes the other way",
              astray.warning.find("until t = 0.1 ") == 0 &&
                astray.warning.find("by 0.012 m") != std::string::npos &&
                astray.warning.find("<Grid/Stretch>") != std::string::npos,
              astray.warning);
  const Result dynamic = push<2>(
    "Dynamics/Inertia = true\nMaterial/Density = 1\nTime/End time = 0.6\n"
    "Grid reset/Steps between resets = 1\n");
  test::check("in motion the body may go along",
              dynamic.warning.empty(),
              dynamic.warning);
  const Result flat = push<2>("Grid/Subdivisions = 4, 100\n"
                              "Boundary conditions/Displacement = left: x = 0; "
                              "bottom: y = 0; top: y = -0.02*t\n");
  test::check("the height of flat cells counts",
              flat.warning.find("a cell has 0.01 m") != std::string::npos &&
                flat.warning.find("loses the body, forces") !=
                  std::string::npos,
              flat.warning);
  const Result apart = push<2>("Material points/Region = x < 1 && y < 0.5\n");
  test::check("a body that the boundary doesn't touch",
              apart.warning.empty(),
              apart.warning);
  return 0;
}
