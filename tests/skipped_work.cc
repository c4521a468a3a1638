/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What a scene doesn't need is left out, is counted, and leaves the result as
// it is: bitwise where the same numbers are added in the same order.

#include <algorithm>

#include "run_scene.h"

using namespace isochor;

/** A block, compressed by its own weight. */
const std::string block =
  "Grid/Subdivisions = 4, 4\n"
  "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.3\n"
  "Material/Density = 1\n"
  "Boundary conditions/Displacement = bottom: x=0, y=0\n"
  "Boundary conditions/Gravity = 0, -20*t\n"
  "Time/Step size = 0.125\nTime/Growth factor = 1\n"
  "Newton/Reuse factorisation = 0\n"
  "Postprocess/Reactions = bottom\n"
  "Postprocess/Point probes = P: 0.4, 0.9\n";

/** What is compared: numbers that hold all the nodes' and points' motion. */
std::vector<double>
numbers_of(const MaterialPointMethod<2> &problem)
{
  std::vector<double> numbers;
  for (const char *name : {"Reaction y on bottom (N)",
                           "Displacement x of P (m)",
                           "Displacement y of P (m)",
                           "Material volume (m^2)"})
    numbers.push_back(test::get(problem, name));
  return numbers;
}

std::string
written(const WorkTally &work)
{
  std::ostringstream text;
  work.print(text, {});
  return text.str();
}

/** The largest difference of two results, relative to the first. */
double
difference(const std::vector<double> &a, const std::vector<double> &b)
{
  double worst = 0;
  for (unsigned int i = 0; i < a.size(); ++i)
    test::add_error(worst, std::abs(a[i] - b[i]) / (std::abs(a[i]) + 1e-300));
  return worst;
}

/** A block drawn by clamps so far at once that the step fails. */
void
test_cut_steps()
{
  const std::string scene =
    "Grid/Subdivisions = 4, 4\nGrid/Stretch = y: 0 -> 0, 1 -> 0.6*t\n"
    "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.3\n"
    "Formulation/Type = u\n"
    "Boundary conditions/Displacement = bottom: x=0, y=0; top: x=0, y=0.6*t\n"
    "Newton/Reuse factorisation = 0\nNewton/Predictor = none\n"
    "Newton/Maximum iterations = 3\nTime/Growth factor = 1\n"
    "Postprocess/Reactions = bottom\n"
    "Postprocess/Point probes = P: 0.4, 0.5\n";
  const auto         cut = test::run_scene<2>(scene + "Time/Step size = 1\n");
  const double       n_cuts = test::get(*cut, "Step cuts");
  const double       size   = test::get(*cut, "Step size (s)");
  std::ostringstream small;
  small.precision(17);
  small << scene << "Time/Step size = " << size << '\n';
  const auto uncut = test::run_scene<2>(small.str());
  const auto done  = test::work(*cut).row("searches for all points");
  test::check("after a step that failed nothing is set up again",
              n_cuts > 0 && done.skipped == n_cuts &&
                done.done == test::get(*cut, "Step"),
              written(test::work(*cut)));
  test::check("which changes nothing, bitwise",
              test::get(*uncut, "Step cuts") == 0 &&
                difference(numbers_of(*uncut), numbers_of(*cut)) == 0,
              "");
}

void
test_kept_grid()
{
  const auto kept =
    test::run_scene<2>(block + "Grid reset/Steps between resets = 1000\n");
  const WorkTally &work = test::work(*kept);
  test::check(
    "a kept grid: one search for the points, one pattern, one analysis",
    work.row("searches for all points").done == 1 &&
      work.row("searches for all points").skipped == 7 &&
      work.row("patterns of the matrix").done == 1 &&
      work.row("analyses of the matrix").done == 1,
    written(work));
}

/** Each checkpoint makes the run forget what a resumed one wouldn't have, the
 * pattern and the analysis. */
void
test_analysis()
{
  const auto once  = test::run_scene<2>(block);
  const auto again = test::run_scene<2>(block + "Checkpoint/Interval = 1\n");
  test::check("the pattern and its analysis serve as long as the nodes do",
              test::work(*once).row("analyses of the matrix").done == 1 &&
                test::work(*once).row("patterns of the matrix").skipped == 7 &&
                test::work(*again).row("analyses of the matrix").done > 4,
              written(test::work(*once)) + written(test::work(*again)));
  test::check("which changes nothing, bitwise",
              difference(numbers_of(*once), numbers_of(*again)) == 0,
              "");
}

void
test_factorisations()
{
  const auto each = test::run_scene<2>(block + "Newton/Tolerance = 1e-11\n");
  const auto kept = test::run_scene<2>(
    block + "Newton/Tolerance = 1e-11\nNewton/Reuse factorisation = 0.1\n");
  const auto row = test::work(*kept).row("factorisations");
  test::check("factorisations are kept",
              row.skipped > 0 &&
                row.done < test::work(*each).row("factorisations").done,
              written(test::work(*kept)));
  test::check_error("with the same result",
                    difference(numbers_of(*each), numbers_of(*kept)),
                    1e-8);
}

void
test_output()
{
  const auto all  = test::run_scene<2>(block);
  const auto last = test::run_scene<2>(block + "Time/Output interval = 1\n");
  test::check("fields are written where asked for",
              test::work(*all).row("outputs of fields").done == 8 &&
                test::work(*last).row("outputs of fields").done == 1 &&
                test::work(*last).row("outputs of fields").skipped == 7,
              written(test::work(*last)));
  test::check("which changes nothing, bitwise",
              difference(numbers_of(*all), numbers_of(*last)) == 0,
              "");
}

/** The same body in the lower part of a grid of 16 times its height: cells,
 * nodes and unknowns without material don't exist for the equations. */
void
test_empty_cells()
{
  const std::string body  = block + "Material points/Region = if(y < 1, 1, 0)\n"
                                    "Boundary conditions/Gravity = 0, 2*t\n";
  const auto        small = test::run_scene<2>(
    body + "Grid/Upper corner = 1, 2\nGrid/Subdivisions = 4, 8\n");
  const auto large = test::run_scene<2>(
    body + "Grid/Upper corner = 1, 16\nGrid/Subdivisions = 4, 64\n");
  const auto cells = test::work(*large).row("cells of the grid, at last");
  const auto nodes = test::work(*large).row("nodes of the grid, at last");
  test::check("cells and nodes without material are left out",
              cells.done ==
                  test::work(*small).row("cells of the grid, at last").done &&
                cells.done + cells.skipped == 2 * 4 * 64 && cells.done < 50 &&
                nodes.done ==
                  test::work(*small).row("nodes of the grid, at last").done,
              written(test::work(*large)));
  test::check("the result is the same, bitwise",
              difference(numbers_of(*small), numbers_of(*large)) == 0,
              "");
}

bool
lacks(const MaterialPointMethod<2> &problem, const std::string &phrase)
{
  const auto list = test::not_needed(problem);
  return std::find(list.begin(), list.end(), phrase) != list.end();
}

void
test_features()
{
  const auto displacements =
    test::run_scene<2>(block + "Formulation/Type = u\n");
  const auto mixed = test::run_scene<2>(block + "Formulation/Type = u-p\n");
  test::check("the u form has no pressures, statics no masses, and this law a "
              "symmetric matrix",
              lacks(*displacements, "pressures at the nodes") &&
                lacks(*displacements, "stabilisation of the pressure") &&
                lacks(*displacements, "masses and inertia") &&
                lacks(*displacements, "lower triangle of the matrix") &&
                3 * test::get(*displacements, "Equations") <
                  2.5 * test::get(*mixed, "Equations"),
              "");
  const auto plain = test::run_scene<2>(
    block + "Formulation/Stabilisation = none\nFormulation/Type = u-p\n");
  const auto zero = test::run_scene<2>(
    block + "Formulation/PPP coefficient = 0\nFormulation/Type = u-p\n");
  test::check("a stabilisation by 0 is none, bitwise",
              lacks(*zero, "stabilisation of the pressure") &&
                !lacks(*mixed, "stabilisation of the pressure") &&
                difference(numbers_of(*plain), numbers_of(*zero)) == 0,
              "");
  // strengths that nothing reaches: the elastic answer, with a history
  const std::string strong = block + "Material/Model = Mohr-Coulomb\n"
                                     "Formulation/Type = u-p\n"
                                     "Material/Mohr-Coulomb/Cohesion = 1e9\n";
  const auto        general =
    test::run_scene<2>(strong + "Material/Mohr-Coulomb/Friction angle = 30\n");
  const auto symmetric =
    test::run_scene<2>(strong + "Newton/Tolerance = 1e-10\n");
  test::check("a law with a history and an unsymmetric tangent gets both",
              !lacks(*general, "history of the points") &&
                !lacks(*general, "lower triangle of the matrix") &&
                lacks(*symmetric, "lower triangle of the matrix"),
              "");
  test::check_error("half of a symmetric matrix gives the same result",
                    difference(numbers_of(*general), numbers_of(*symmetric)),
                    1e-7);
  const auto moving =
    test::run_scene<2>(block + "Dynamics/Inertia = true\n"
                               "Material/Density = 1\nTime/End time = 0.25\n");
  test::check("dynamics has masses", !lacks(*moving, "masses and inertia"), "");
}

int
main(int argc, char *argv[])
{
  test::MPISession mpi(argc, argv);
  test_cut_steps();
  test_kept_grid();
  test_analysis();
  test_factorisations();
  test_output();
  test_empty_cells();
  test_features();
  return 0;
}
