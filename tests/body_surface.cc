/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Loads and displacements on the surface of the body: they follow it, act on
// what it covers of faces, and depend neither on the numbering of cells nor on
// where the origin is.

#include <isochor/grid/nearest_cells.h>

#include <random>

#include "scene.h"

using namespace isochor;

namespace
{
  std::map<std::string, std::vector<double>> history;
}

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

const std::vector<std::string> quadratures = {"points", "CPDI"};

/** What the simplex is away from x, by samples of it: an upper bound that is
 * too large by a small part of its size. */
template <int dim>
double
sampled_distance(const SimplexGeometry<dim> &geometry,
                 const unsigned int          cell,
                 const Point<dim>           &x)
{
  const unsigned int n    = 40;
  double             best = 1e300;
  for (unsigned int i = 0; i <= n; ++i)
    for (unsigned int j = 0; i + j <= n; ++j)
      for (unsigned int k = 0; i + j + k <= n; ++k)
        {
          if (dim == 2 && k > 0)
            break;
          const std::array<unsigned int, 4> part = {{n - i - j - k, i, j, k}};
          Point<dim>                        y;
          for (unsigned int v = 0; v <= dim; ++v)
            y += geometry.vertices()[geometry.vertex_indices(cell)[v]] *
                 (part[v] / static_cast<double>(n));
          best = std::min(best, (y - x).norm());
        }
  return best;
}

template <int dim>
void
test_distance(const std::string &size)
{
  BackgroundGrid<dim> grid(MPI_COMM_SELF);
  ParameterHandler    prm;
  BackgroundGrid<dim>::declare_parameters(prm);
  test::set_parameters(prm, "Grid/Subdivisions = " + size);
  grid.parse_parameters(prm);
  grid.create();
  std::mt19937                           random(1);
  std::uniform_real_distribution<double> coordinate(-0.5, 1.5);
  double                                 below = 0, above = 0;
  bool                                   nearest = true;
  for (unsigned int i = 0; i < 40; ++i)
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = coordinate(random);
      double least = 1e300;
      for (unsigned int cell = 0; cell < grid.geometry().n_cells(); ++cell)
        {
          const double d = distance_to_cell(grid.geometry(), cell, x);
          const double s = sampled_distance(grid.geometry(), cell, x);
          least          = std::min(least, d);
          below          = std::max(below, d - s);
          above          = std::max(above, s - d);
        }
      for (const unsigned int cell : nearest_cells<dim>(
             grid.geometry(),
             x,
             i % grid.geometry().n_cells(),
             [](const unsigned int) { return true; },
             1e300))
        nearest =
          nearest && distance_to_cell(grid.geometry(), cell, x) <= least + 1e-8;
    }
  const std::string where = " in " + std::to_string(dim) + "D";
  test::check_error("no sample of a cell is nearer than the cell" + where,
                    below,
                    1e-14);
  test::check_error("but nearly as near" + where, above, 0.03);
  test::check("the search finds the nearest cells" + where, nearest, "");
}

/** The load stays with the body when its points leave the cells at the
 * boundary: the column is pressed to half of its height. */
void
test_load_follows()
{
  const std::string scene =
    "Grid/Subdivisions = 4, 10\nMaterial points/Points per cell = 4\n"
    "Formulation/Type = u\nMaterial/Young modulus = 1e4\n"
    "Material/Poisson ratio = 0\nBoundary conditions/Displacement = left: x=0; "
    "right: x=0; bottom: y=0\n"
    "Boundary conditions/Traction = top: 0, -4000*t\n"
    "Time/Step size = 0.05\nPostprocess/Reactions = bottom\n";
  for (const std::string &type : quadratures)
    {
      const std::string column = "Reaction y on bottom (N)";
      history                  = {{column, {}}};
      test::run_scene<2>(scene + "Quadrature/Type = " + type + '\n');
      double worst = 0;
      for (unsigned int i = 0; i < history[column].size(); ++i)
        test::add_error(worst,
                        std::abs(history[column][i] / (200. * (i + 1)) - 1));
      test::check("the column's load is carried to the end, " + type,
                  history[column].size() == 20,
                  std::to_string(history[column].size()));
      test::check_error("and none is lost on the way, " + type, worst, 1e-7);
    }
  history.clear();
}

double
reaction_under_load(const std::string &settings)
{
  return test::run_scene<2>(
           "Grid/Subdivisions = 5, 10\nFormulation/Type = u\n"
           "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
           "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
           "Boundary conditions/Traction = top: 0, -10*t\n"
           "Postprocess/Reactions = bottom\n" +
           settings)
    ->last_statistics()
    .get("Reaction y on bottom (N)");
}

void
test_partly_covered_faces()
{
  for (const std::string &type : quadratures)
    test::check_error("a body of 0.45 in cells of 0.2, lattice, " + type,
                      std::abs(reaction_under_load(
                                 "Material points/Lattice spacing = 0.05\n"
                                 "Material points/Region = x < 0.45\n"
                                 "Quadrature/Type = " +
                                 type + '\n') /
                                 4.5 -
                               1),
                      1e-7);
  test::check_error("a body of 0.53, points in cells",
                    std::abs(reaction_under_load(
                               "Material points/Points per cell = 16\n"
                               "Material points/Region = x < 0.53\n") /
                               5.3 -
                             1),
                    1e-7);
  test::check_error("a hole of 0.1 in the loaded surface",
                    std::abs(
                      reaction_under_load(
                        "Material points/Points per cell = 16\n"
                        "Material points/Region = x < 0.33 || x > 0.43\n") /
                        9 -
                      1),
                    1e-7);
  test::check_error("boundary name as the place of a surface",
                    std::abs(
                      reaction_under_load(
                        "Material points/Lattice spacing = 0.05\n"
                        "Material points/Region = x < 0.45\n"
                        "Boundary conditions/Traction =\n"
                        "Boundary conditions/Surfaces of body = up: top\n"
                        "Boundary conditions/Traction on body = up: 0, "
                        "-10*t\n") /
                        4.5 -
                      1),
                    1e-7);
  const auto in_space = [](const std::string &region) {
    return test::run_scene<3>(
             "Grid/Subdivisions = 5, 2, 5\nFormulation/Type = u\n"
             "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
             "Material points/Points per cell = 8\nMaterial points/Region = " +
             region +
             "\nBoundary conditions/Displacement = bottom: x=0, y=0, z=0\n"
             "Boundary conditions/Traction = top: 0, -10*t, 0\n"
             "Postprocess/Reactions = bottom\n")
      ->last_statistics()
      .get("Reaction y on bottom (N)");
  };
  test::check_error("a prism of 0.53 in space",
                    std::abs(in_space("x < 0.53") / 5.3 - 1),
                    1e-7);
  test::check_error("a quarter of a cylinder in space",
                    std::abs(
                      in_space("x^2 + z^2 < 0.5") / (10 * numbers::PI / 8) - 1),
                    2e-3);
  std::string message;
  try
    {
      reaction_under_load("Material points/Region = y < 0.5\n");
    }
  catch (const ExceptionBase &exc)
    {
      std::ostringstream text;
      exc.print_info(text);
      message = test::one_line(text.str());
    }
  test::check("a load where there is no body is an error",
              message.find("does not touch the boundary <top>") !=
                std::string::npos,
              message);
}

/** A block on a held boundary of the grid, loaded on 'side', moved by (@p X, @p
 * Y), or with x and y exchanged; the forces of the boundary, along it and
 * across. */
std::array<double, 2>
forces_on_block(const std::string &type,
                const double       X,
                const double       Y,
                const bool         exchanged)
{
  const auto number = [](const double value) {
    return '(' + Utilities::to_string(value, 17) + ')';
  };
  const std::string  x = "(x-" + number(X) + ')', y = "(y-" + number(Y) + ')';
  const std::string &along = exchanged ? y : x, &across = exchanged ? x : y;
  const std::string  region =
    along + ">0 && " + along + "<1 && " + across + ">0 && " + across + "<1";
  const auto corner = [&](const double by_along, const double by_across) {
    return Utilities::to_string(X + (exchanged ? by_across : by_along), 17) +
           ", " +
           Utilities::to_string(Y + (exchanged ? by_along : by_across), 17) +
           '\n';
  };
  const std::string base    = exchanged ? "left" : "bottom";
  const auto        problem = test::run_scene<2>(
    "Grid/Lower corner = " + corner(-0.5, 0) +
    "Grid/Upper corner = " + corner(1.5, 1.5) +
    "Grid/Subdivisions = " + (exchanged ? "9, 12" : "12, 9") +
    "\nMaterial/Young modulus = 100\n"
           "Material/Poisson ratio = 0.45\nTime/Step size = 0.2\n"
           "Newton/Tolerance = 1e-12\n"
           "Material points/Points per cell = 4\nQuadrature/Type = " +
    type + "\nMaterial points/Region = " + region +
    "\nBoundary conditions/Surfaces of body = side: " + along +
    ">0.99\nBoundary conditions/Displacement = " + base +
    ": x=0, y=0\nPostprocess/Reactions = " + base +
    "\nBoundary conditions/Pressure on body = side: 10*t*(1+" + across + ")\n");
  const auto  &statistics = problem->last_statistics();
  const double fx         = statistics.get("Reaction x on " + base + " (N)");
  const double fy         = statistics.get("Reaction y on " + base + " (N)");
  return exchanged ? std::array<double, 2>{{fy, fx}} :
                     std::array<double, 2>{{fx, fy}};
}

void
test_ties()
{
  for (const std::string &type : quadratures)
    {
      const auto reference = forces_on_block(type, 0, 0, false);
      const auto error     = [&](const std::array<double, 2> &forces) {
        double worst = 0;
        for (unsigned int d = 0; d < 2; ++d)
          test::add_error(worst,
                          std::abs(forces[d] - reference[d]) /
                            std::abs(reference[0]));
        return worst;
      };
      test::check("the pressure is carried, " + type,
                  reference[0] > 10,
                  std::to_string(reference[0]));
      test::check_error("moved by 1e3, " + type,
                        error(forces_on_block(type, 1000, -2000, false)),
                        1e-10);
      test::check_error("x and y exchanged, " + type,
                        error(forces_on_block(type, 0, 0, true)),
                        1e-10);
    }
}

/** A quarter of a block is pulled at two sides until boundary points are beyond
 * its corner, equally near to the two cells there. It stays symmetric to the
 * diagonal. */
void
test_corner()
{
  for (const std::string &type : quadratures)
    {
      const auto problem = test::run_scene<2>(
        "Grid/Upper corner = 1.5, 1.5\nGrid/Subdivisions = 9, 9\n"
        "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
        "Formulation/Type = u\nTime/Step size = 0.25\n"
        "Newton/Tolerance = 1e-12\nMaterial points/Points per cell = 4\n"
        "Material points/Region = x<1 && y<1\nQuadrature/Type = " +
        type +
        "\nBoundary conditions/Displacement = left: x=0; bottom: y=0\n"
        "Boundary conditions/Surfaces of body = right: x>0.99; up: y>0.99\n"
        "Boundary conditions/Pressure on body = right: -8*t*y; up: -8*t*x\n"
        "Postprocess/Point probes = A: 0.95, 0.95\n");
      const double u =
        problem->last_statistics().get("Displacement x of A (m)");
      const double v =
        problem->last_statistics().get("Displacement y of A (m)");
      test::check("boundary points leave the corner's cells, " + type,
                  u > 0.02,
                  std::to_string(u));
      test::check_error("symmetric to the diagonal, " + type,
                        std::abs(u - v) / u,
                        1e-10);
    }
}

/** A condition holds also on the last faces of the sides: what is loaded is
 * told. */
void
test_loaded_area()
{
  const std::string block =
    "Output/Terminal = progress\nGrid/Upper corner = 1.2, 0.2\n"
    "Grid/Subdivisions = 96, 16\nMaterial points/Region = x < 1\n"
    "Boundary conditions/Displacement = left: x=0, y=0\n"
    "Boundary conditions/Surfaces of body = tip: x > 0.99\n"
    "Material/Young modulus = 1e9\nFormulation/Type = u\n";
  std::ostringstream    printed;
  std::streambuf *const original = std::cout.rdbuf(printed.rdbuf());
  const auto            drawn    = test::run_scene<2>(
    block + "Boundary conditions/Traction on body = tip: 1000*t, 200\n");
  std::cout.rdbuf(original);
  const bool is_first = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
  test::check("the loaded area is told",
              !is_first ||
                printed.str().find(
                  "Surface <tip> of <Boundary conditions/Surfaces "
                  "of body>: 18 faces, 0.225 m in [0.9875, 1] x [0, 0.2]\n") !=
                  std::string::npos,
              printed.str());
  test::check_error("the load of a traction",
                    std::abs(test::get(*drawn, "Load x on tip (N)") - 225) +
                      std::abs(test::get(*drawn, "Load y on tip (N)") - 45),
                    1e-9);
  // on the sides it has no resultant
  const auto pressed = test::run_scene<2>(
    block + "Output/Terminal = quiet\n"
            "Boundary conditions/Pressure on body = tip: 1000*t\n");
  test::check_error("the load of a pressure",
                    std::abs(test::get(*pressed, "Load x on tip (N)") + 200) +
                      std::abs(test::get(*pressed, "Load y on tip (N)")),
                    1e-3);
}

/** A bar that has gone nine times its length, and is stretched by 1e-8 of it:
 * half a unit of the last digit of its displacement is, times γ of its faces,
 * 1e-6 of its force, with which Newton's method is content. Exact for plane
 * strain without holding the sides: E/(1 - ν²) times strain and height. */
void
test_stretched_after_a_long_way()
{
  const auto bar = test::run_scene<2>(
    "Grid/Upper corner = 12, 2\nGrid/Subdivisions = 48, 8\n"
    "Material points/Region = x>0.5 && x<1.5 && y>0.5 && y<1\n"
    "Material/Young modulus = 1e12\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Surfaces of body = left: x<0.5001; "
    "right: x>1.4999; corner: x<0.7501 && y<0.5001\n"
    "Quadrature/Type = CPDI\n"
    "Interaction: left - place/Displacement = x=9*t\n"
    "Interaction: right - place/Displacement = x=9*t+1e-8*t\n"
    "Interaction: corner - place/Displacement = y=0\n"
    "Time/Step size = 0.05\nOutput/Terminal = quiet\n");
  const double left      = test::get(*bar, "Force x on left by place (N)"),
               right     = test::get(*bar, "Force x on right by place (N)");
  const std::string what = "a bar stretched by 1e-8 after a long way";
  test::check(what + ": no step is cut",
              test::get(*bar, "Step") == 20,
              std::to_string(test::get(*bar, "Step")));
  test::check_error(what + ": balance",
                    std::abs(left + right) / std::abs(right),
                    5e-4);
  test::check_error(what + ": force",
                    test::relative(right, 1e12 / 0.91 * 0.5 * 1e-8),
                    2e-3);
}

/** Loads as sections of their own are what the parameters of <Boundary
 * conditions> are short for; on a body they act on all of its surface. */
void
test_sections()
{
  const auto run = [](const std::string &loads) {
    return test::run_scene<2>(
      "Grid/Upper corner = 1.5, 1.5\nGrid/Subdivisions = 9, 9\n"
      "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
      "Time/Step size = 0.25\nNewton/Tolerance = 1e-12\n"
      "Quadrature/Type = CPDI\n"
      "Material points/Region = x<1 && y<1\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
      "Boundary conditions/Surfaces of body = right: x>0.99\n"
      "Postprocess/Point probes = A: 0.95, 0.9\n" +
      loads);
  };
  const auto in_short =
    run("Boundary conditions/Pressure on body = right: 8*t*y\n"
        "Boundary conditions/Traction on body = right: 0, -2*t\n");
  const auto sections = run("Interaction: right - load/Pressure = 8*t*y\n"
                            "Interaction: right - load/Traction = 0, -2*t\n");
  for (const std::string column : {"Load x on right (N)",
                                   "Load y on right (N)",
                                   "Displacement x of A (m)"})
    test::check_error(
      "as a section of its own: " + column,
      std::abs(test::get(*sections, column) / test::get(*in_short, column) - 1),
      1e-12);
  const auto of_body = run("Interaction: body - load/Pressure = 8*t\n");
  test::check_error("a pressure all around is in balance",
                    std::abs(test::get(*of_body, "Load x on body (N)")) +
                      std::abs(test::get(*of_body, "Load y on body (N)")),
                    1e-10);
  test::check_error("and shrinks it alike in both directions",
                    std::abs(test::get(*of_body, "Displacement x of A (m)") /
                               test::get(*of_body, "Displacement y of A (m)") -
                             0.95 / 0.9),
                    1e-9);
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_distance<2>("2, 2");
  test_distance<3>("1, 1, 2");
  test_load_follows();
  test_partly_covered_faces();
  test_ties();
  test_corner();
  test_loaded_area();
  test_sections();
  test_stretched_after_a_long_way();
  return 0;
}
