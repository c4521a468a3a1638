/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Prescribed displacements are positions, not rates, on the grid and on the
// body; one-sided walls stand where their formulas say, and the set of nodes in
// contact is right when a step is accepted.

#include <isochor/base/mpi_sums.h>

#include <set>

#include "scene.h"

using namespace isochor;
using test::relative;

namespace
{
  /** By step: columns of the statistics that the tests want to see. */
  std::map<std::string, std::vector<double>> history;

  /** Of a one-sided condition at 'bottom', y >= wall(x, t), in a run of one
   * step: largest violations, over all ranks. */
  struct Contact
  {
    std::unique_ptr<Expression<2>> wall;
    double       pull = 0, penetration = 0, complementarity = 0, force = 0;
    unsigned int n_held = 0, n_free = 0;
  } contact;
} // namespace

namespace isochor
{
  template <int dim>
  class Watch : public Postprocessor<dim>
  {
  public:
    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      if constexpr (dim == 2)
        if (contact.wall)
          look_at_contact(result);
    }

    void
    evaluate_points(const StepResult<dim> &, Statistics &statistics) override
    {
      for (auto &column : history)
        column.second.push_back(statistics.get(column.first));
    }

  private:
    static void
    look_at_contact(const StepResult<dim> &result)
    {
      const auto            &step   = result.step;
      const auto            &bottom = step.grid.boundary_id("bottom", "");
      std::set<unsigned int> vertices;
      for (const BoundaryFace &face : step.grid.boundary_faces())
        for (unsigned int v = 0; v <= dim && face.id == bottom; ++v)
          if (v != face.opposite_vertex)
            vertices.insert(step.grid.geometry().vertex_indices(face.cell)[v]);
      std::array<double, 4> worst{};
      std::array<double, 2> counts{};
      for (const unsigned int v : vertices)
        {
          const unsigned int node = step.nodes.node(v);
          if (node >= step.nodes.n_owned())
            continue;
          const unsigned int entry = node * step.n_components + 1;
          const Point<dim>  &x     = step.grid.geometry().vertices()[v];
          const bool         free =
            result.system.equation(entry) != numbers::invalid_unsigned_int;
          const double r =
            free ? 0. : result.system.residual.local_element(entry);
          const double gap = result.unknowns.local_element(entry) -
                             (*contact.wall)(Point<2>(x[0], x[1]), step.time);
          worst[0] = std::max(worst[0], -r);
          worst[1] = std::max(worst[1], -gap);
          worst[2] = std::max(worst[2], std::abs(r * gap));
          worst[3] = std::max(worst[3], r);
          counts[free] += 1;
        }
      sum_over_ranks(counts, step.grid.communicator());
      const auto largest = [&](const double value) {
        return Utilities::MPI::max(value, step.grid.communicator());
      };
      contact.pull            = largest(worst[0]);
      contact.penetration     = largest(worst[1]);
      contact.complementarity = largest(worst[2]);
      contact.force           = largest(worst[3]);
      contact.n_held          = counts[0];
      contact.n_free          = counts[1];
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

std::vector<double>
reactions(const std::string &settings, const std::string &boundary = "top")
{
  const std::string column = "Reaction y on " + boundary + " (N)";
  history                  = {{column, {}}};
  test::run_scene<2>(block + settings);
  return history[column];
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
  const double pushed =
    reactions("Boundary conditions/Displacement = top: x=0, y=0; bottom: y = "
              "0.02\n",
              "bottom")
      .back();
  test::check_error(
    "a wall that stands in the body pushes it out",
    relative(reactions("Boundary conditions/Displacement = top: x=0, y=0; "
                       "bottom: y >= 0.02\n",
                       "bottom")
               .back(),
             pushed),
    1e-9);

  // the body comes down by 0.0102 m onto a wall 0.01 m below: it touches in the
  // third of four steps
  const std::string fall =
    "Boundary conditions/Displacement = top: x=0, y = -0.0196*t*(t<0.6) - "
    "(0.01+0.0004*(t-0.5))*(t>0.6); bottom: y >= -0.01\nTime/Step size = "
    "0.25\n";
  const auto   kept = reactions(fall + never, "bottom");
  const double expected =
    reactions("Boundary conditions/Displacement = top: x=0, y=-0.0002; "
              "bottom: y=0\n",
              "bottom")
      .back();
  test::check("no force before the wall",
              kept.size() == 4 && kept[0] == 0 && kept[1] == 0,
              std::to_string(kept[1]));
  test::check_error("the wall half way", relative(kept[2], expected / 2), 1e-3);
  test::check_error("a wall at a distance", relative(kept[3], expected), 1e-8);
  const auto reset = reactions(fall, "bottom");
  test::check("no force before the wall, grid reset in each step",
              reset.size() == 4 && reset[0] == 0 && reset[1] == 0,
              std::to_string(reset[1]));
  test::check_error("the wall half way, grid reset in each step",
                    relative(reset[2], expected / 2),
                    1e-3);
  test::check_error("a wall at a distance, grid reset in each step",
                    relative(reset[3], expected),
                    1e-3);
  history.clear();
}

/** A soft block is pressed on walls of several shapes in one step: the nodes
 * that touch are not known beforehand. */
void
test_contact_set()
{
  const std::vector<std::pair<std::string, std::string>> walls = {
    {"a hill", "-0.4*t*(x-0.5)^2"},
    {"waves", "0.03*t*cos(12*pi*x)"},
    {"a step", "-0.05*t*(x<0.4)"}};
  for (const std::string form : {"u", "u-p"})
    for (const auto &[name, wall] : walls)
      {
        contact      = {};
        contact.wall = std::make_unique<Expression<2>>(wall, "test");
        test::run_scene<2>(
          "Grid/Subdivisions = 24, 12\nMaterial/Young modulus = 100\n"
          "Material/Poisson ratio = 0.4\nNewton/Tolerance = 1e-10\n"
          "Newton/Maximum iterations = 40\nFormulation/Type = " +
          form +
          "\nBoundary conditions/Displacement = top: x=0, y=-0.03*t; bottom: "
          "y >= " +
          wall + '\n');
        const std::string what = name + ", " + form;
        test::check("one step, " + what,
                    test::recorded().times.size() == 1,
                    std::to_string(test::recorded().times.size()));
        test::check("some nodes touch, others don't, " + what,
                    contact.n_held > 1 && contact.n_free > 1 &&
                      contact.n_held + contact.n_free == 25,
                    std::to_string(contact.n_held));
        test::check_error("no node pulls, " + what,
                          contact.pull / contact.force,
                          1e-8);
        test::check_error("no node penetrates, " + what,
                          contact.penetration,
                          1e-10);
        test::check_error("forces only at the wall, " + what,
                          contact.complementarity / contact.force,
                          1e-12);
      }
  contact = {};
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
  // the later entry counts at common nodes, one-sided or not
  test::check("a later wall overrides",
              std::abs(side("everywhere: x=-0.01; left: x<=0; right: x=0")) <
                1e-6,
              "");
  test::check_error("a later displacement overrides",
                    relative(side("left: x<=0; everywhere: x=-0.01*x"), 100),
                    0.05);
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
  test_contact_set();
  test_conflicts();
}
