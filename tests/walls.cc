/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Prescribed displacements are positions, not rates, on the grid and on the
// body; one-sided walls stand where their formulas say.

#include "scene.h"

using namespace isochor;
using test::relative;

namespace
{
  /** By step: columns of the statistics that the tests want to see. */
  std::map<std::string, std::vector<double>> history;

} // namespace

namespace isochor
{
  template <int dim>
  class Watch : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &, Statistics &statistics) override
    {
      for (auto &column : history)
        column.second.push_back(statistics.get(column.first));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Watch, "Z: after all others")
} // namespace isochor

const std::string never = "Grid reset/Steps between resets = 0\n"
                          "Grid reset/Smallest element quality = 0\n";

/** A square block in the u form, without Poisson effect. */
const std::string block =
  "Grid/Subdivisions = 4, 4\nFormulation/Type = u\n"
  "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
  "Newton/Tolerance = 1e-10\nPostprocess/Reactions = bottom, top\n";

/** By step, of one column of the statistics. */
std::vector<double>
values(const std::string &settings, const std::string &column)
{
  history = {{column, {}}};
  test::run_scene<2>(block + settings);
  return history[column];
}

std::vector<double>
reactions(const std::string &settings, const std::string &boundary = "top")
{
  return values(settings, "Reaction y on " + boundary + " (N)");
}

void
test_positions()
{
  const std::string bottom = "Boundary conditions/Displacement = bottom: x=0, "
                             "y=0; top: y = ";
  const double      ramp   = reactions(bottom + "0.01*t\n").back();
  test::check("a ramp loads the body", ramp > 99, std::to_string(ramp));
  test::check_error("a constant does the same",
                    relative(reactions(bottom + "0.01\n").back(), ramp),
                    1e-9);

  const auto steps =
    reactions(bottom + "0.01\nTime/Step size = 0.25\n" + never);
  test::check("a constant acts once",
              steps.size() == 4 && relative(steps[0], ramp) < 1e-9 &&
                relative(steps[3], ramp) < 1e-9,
              std::to_string(steps.back()));

  const std::string large = "0.05 + 0.6*t\n";
  const double      whole = reactions(bottom + large + never).back();
  const double      cut =
    reactions(bottom + large + never +
              "Newton/Maximum iterations = 4\nNewton/Reuse factorisation = 0\n")
      .back();
  test::check("a step was cut",
              test::recorded().times.size() > 1,
              std::to_string(test::recorded().times.size()));
  test::check_error("a constant in a step that is cut",
                    relative(cut, whole),
                    1e-8);

  const auto on_body = [&](const std::string &formula) {
    const auto problem =
      test::run_scene<2>(block +
                         "Boundary conditions/Displacement = bottom: x=0, y=0\n"
                         "Boundary conditions/Surfaces of body = up: top\n"
                         "Quadrature/Type = CPDI\n"
                         "Interaction: up - place/Displacement = y = " +
                         formula + "\nNewton/Tolerance = 1e-8\n");
    return problem->last_statistics().get("Reaction y on bottom (N)");
  };
  test::check_error("the same on the body",
                    relative(-on_body("0.01"), ramp),
                    1e-4);
  test::check_error("a ramp on the body",
                    relative(-on_body("0.01*t"), ramp),
                    1e-4);
}

void
test_walls()
{
  const std::string of_wall = "Force y on body by boundary bottom (N)";
  const double      pushed =
    reactions("Boundary conditions/Displacement = top: x=0, y=0; bottom: y = "
              "0.02\nQuadrature/Type = CPDI\n",
              "bottom")
      .back();
  // strains vary, as the top is held
  test::check_error(
    "a wall that stands in the body pushes it out",
    relative(values("Boundary conditions/Displacement = top: x=0, y=0\n"
                    "Boundary conditions/Walls = bottom: n >= 0.02\n"
                    "Quadrature/Type = CPDI\n",
                    of_wall)
               .back(),
             pushed),
    1e-5);

  // the body comes down by 0.0102 m onto a wall 0.01 m below: it touches in the
  // third of four steps
  const std::string fall =
    "Boundary conditions/Surfaces of body = up: y > 0.999\nInteraction: up - "
    "place/Displacement = x=0, y = "
    "-0.0196*t*(t<0.6) - (0.01+0.0004*(t-0.5))*(t>0.6)\nBoundary conditions/Walls = bottom: n >= "
    "-0.01\nTime/Step size = 0.25\nQuadrature/Type = CPDI\n";
  const double expected =
    reactions("Boundary conditions/Displacement = top: x=0, y=-0.0002; "
              "bottom: y=0\n",
              "bottom")
      .back();
  for (const std::string &grid : {never, std::string()})
    {
      const auto        found = values(fall + grid, of_wall);
      const std::string name =
        grid.empty() ? ", grid reset in each step" : ", kept grid";
      test::check("no force before the wall" + name,
                  found.size() == 4 && found[0] == 0 && found[1] == 0,
                  std::to_string(found[1]));
      test::check_error("the wall half way" + name,
                        relative(found[2], expected / 2),
                        1e-3);
      test::check_error("a wall at a distance" + name,
                        relative(found[3], expected),
                        1e-3);
    }
  history.clear();
}

void
test_conflicts()
{
  const std::string top  = "top: y=0.01";
  const auto        side = [&](const std::string &conditions) {
    return test::run_scene<2>(block + "Postprocess/Reactions = left\n" +
                              "Boundary conditions/Displacement = " +
                              conditions + "; bottom: y=0; " + top + '\n')
      ->last_statistics()
      .get("Reaction x on left (N)");
  };
  std::string message;
  try
    {
      side("left: x=0; left: x=0.1");
    }
  catch (const ExceptionBase &exc)
    {
      std::ostringstream text;
      exc.print_info(text);
      message = test::one_line(text.str());
    }
  test::check("a component prescribed twice is an error",
              message.find("on the boundary <left> twice") != std::string::npos,
              message);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_positions();
  test_walls();
  test_conflicts();
  return 0;
}
