/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Motions that start, stop or change their acceleration at once while a run is
// on its way: a step begins where their formula changes its branch, and the
// body follows at once, as at t = 0. Forces are those of the motion from the
// next step on; without it they alternate by a mass times the jump over a step.

#include <isochor/base/formula_switches.h>

#include <map>

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** In each step: the time, the reaction, the energy that was lost. */
  struct Row
  {
    double time, force, lost;
  };

  /** Of the scene run last, with the reaction in @p column. */
  std::vector<Row>
  recorded_rows(const std::string &column)
  {
    test::Recorded  &recorded = test::recorded();
    std::vector<Row> rows;
    for (unsigned int n = 0; n < recorded.times.size(); ++n)
      rows.push_back({recorded.times[n],
                      recorded.columns[column].at(n),
                      recorded.columns["Energy lost by the scheme (J)"].at(n)});
    return rows;
  }

  struct Motion
  {
    std::string what, place;
    /** In steps that begin at its jumps or later. */
    double (*acceleration)(const double);
    std::vector<double> jumps;
    double              shortest_step = 0.005;
  };

  double
  none(const double /*time*/)
  {
    return 0;
  }

  const std::vector<Motion> motions = {
    {"starts", "max(0, t - 0.02)", none, {0.02}},
    {"stops", "min(t, 0.02)", none, {0.02}},
    {"starts and stops between steps",
     "if(t < 0.0213, 0, min(t - 0.0213, 0.0191))",
     none,
     {0.0213, 0.0404}},
    {"starts, and stops in the same step",
     "if(t < 0.021, 0, min(t - 0.021, 0.002) + 0.5*max(0, t - 0.023))",
     none,
     {0.021, 0.023}},
    {"starts for an eighth of a step",
     "max(0, min(t - 0.0213, 0.0006))",
     none,
     {0.0213, 0.0219},
     0.0006},
    {"starts shortly after a step", "max(0, t - 0.020001)", none, {0.020001}},
    {"starts shortly before a step's end",
     "max(0, t - 0.024999)",
     none,
     {0.024999}},
    {"no longer accelerates",
     "if(t < 0.02, 5*t^2, 0.002 + 0.2*(t - 0.02))",
     [](const double t) { return t <= 0.02 ? 10. : 0.; },
     {0.02}},
    {"steps smoothly",
     "0.1*if(t < 0.01, 0, if(t < 0.05, (3 - 50*(t - 0.01))*(t - 0.01)^2/0.0016, "
     "1))",
     [](const double t) {
       return t > 0.01 && t <= 0.05 ? 375 - 750 * (t - 0.01) / 0.04 : 0.;
     },
     {0.01, 0.05}}};

  enum class Of
  {
    boundary,
    body
  };

  /** A block of 0.5 kg (in space 0.25 kg), much stiffer than what the steps
   * resolve, is moved at its right end. */
  template <int dim>
  void
  test_block(const Motion &motion, const Of of, const std::string &settings)
  {
    const bool        solid = (dim == 3), body = (of == Of::body);
    const std::string sides = std::string("bottom: y=0; top: y=0") +
                              (solid ? "; front: z=0; back: z=0" : "");
    const std::string width = solid ? ", 0.5, 0.5" : ", 0.5";
    const std::string size =
      body ? "Grid/Upper corner = 1.5" + width +
               "\nGrid/Subdivisions = " + (solid ? "6, 2, 2" : "12, 4") +
               "\nMaterial points/Region = x < 1\nQuadrature/Type = CPDI\n" :
             "Grid/Upper corner = 1" + width +
               "\nGrid/Subdivisions = " + (solid ? "4, 2, 2" : "8, 4") + '\n' +
               test::keep_grid + "Postprocess/Reactions = right\n";
    const std::string is_moved =
      body ? "Boundary conditions/Displacement = " + sides +
               "\nBoundary conditions/Surfaces of body = tip: x > 0.999\n"
               "Interaction: tip - place/Displacement = x=" :
             "Boundary conditions/Displacement = " + sides + "; right: x=";
    const std::string name =
      body ? "surface of the body" : "boundary of the grid";
    const std::string column =
      body ? "Force x on tip by place (N)" : "Reaction x on right (N)";
    test::record_columns({column, "Energy lost by the scheme (J)"});
    test::run_scene<dim>(
      size + is_moved + motion.place +
      "\nMaterial/Young modulus = 1e10\nMaterial/Density = 1\n"
      "Dynamics/Inertia = true\nTime/Step size = 0.005\n"
      // of forces that the first iterations have
      "Newton/Tolerance = 1e-11\nTime/End time = 0.08\n" +
      settings);
    const std::vector<Row> rows = recorded_rows(column);

    const double mass  = solid ? 0.25 : 0.5;
    const double scale = mass / motion.shortest_step;
    double       worst = 0, lost = 0;
    bool         lands = true;
    for (const Row &row : rows)
      test::add_error(
        worst,
        std::abs(row.force - mass * motion.acceleration(row.time)) / scale);
    for (const double jump : motion.jumps)
      lands =
        lands && std::any_of(rows.begin(), rows.end(), [=](const Row &row) {
          return std::abs(row.time - jump) < 1e-12;
        });
    // what jumps of velocities do is all found; where accelerations jump the
    // work of one step goes by the mean of the forces before and after it
    const bool is_found = motion.acceleration == none;
    for (const Row &row : rows)
      if (is_found || row.time > motion.jumps.back() + 0.006)
        test::add_error(
          lost, std::abs(row.lost - (is_found ? 0. : rows.back().lost)) / mass);
    test::check(motion.what + ", " + name + ": a step ends there", lands, "");
    test::check_error("forces", worst, 1e-3);
    test::check_error("energy", lost, 1e-4);
  }

  /** The last row of the statistics of two separate bars, of which the left one
   * vibrates and the right one is moved by @p motion, and the number of steps.
   */
  std::map<std::string, double>
  two_bars(const std::string &motion)
  {
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 3, 0.25\nGrid/Subdivisions = 24, 2\n" +
      std::string(test::keep_grid) +
      "Material points/Region = x < 1 || x > 2\n"
      "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
      "Material/Density = 1\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = if(x < 1.5, sin(pi*x/2), 0), 0\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0; top: y=0; "
      "right: x=" +
      motion + "\nTime/Step size = 0.002\nTime/End time = 0.08\n");
    const Statistics &statistics = test::last_statistics(*problem);
    return {{"kinetic", statistics.get("Kinetic energy (J)")},
            {"strain", statistics.get("Strain energy (J)")},
            {"external", statistics.get("External work (J)")},
            {"steps", test::recorded().times.size()}};
  }

  /** A held body is strained by a motion that starts suddenly: all of the work
   * is there. Beside a wall that only pushes the run goes on.
   */
  void
  test_strained_body()
  {
    const std::string block =
      "Grid/Upper corner = 1, 0.5\nGrid/Subdivisions = 8, 4\n" +
      std::string(test::keep_grid) +
      "Material/Density = 1\nMaterial/Poisson ratio = 0.3\n"
      "Dynamics/Inertia = true\nTime/End time = 0.08\n"
      "Boundary conditions/Displacement = bottom: y=0; top: y=0; ";
    const auto a = test::run_scene<2>(
      block + "left: x=0; right: x=max(0, t - 0.0213)\n"
              "Material/Young modulus = 1e10\nTime/Step size = 0.005\n");
    const Statistics &at_end = test::last_statistics(*a);
    test::check_error("a strained body: external work",
                      test::relative(at_end.get("External work (J)"),
                                     at_end.get("Strain energy (J)") +
                                       at_end.get("Kinetic energy (J)")),
                      1e-3);
    const auto b = test::run_scene<2>(
      block + "right: x=-0.5*if(t < 0.0213, 0, min(t - 0.0213, 0.0191))\n"
              "Boundary conditions/Walls = left: n >= 0\n"
              "Quadrature/Type = CPDI\nMaterial/Young modulus = 1e3\n"
              "Time/Step size = 0.0005\n");
    test::check("a one-sided wall: to the end",
                test::get(*b, "Time (s)") == 0.08,
                std::to_string(test::get(*b, "Time (s)")));
  }

  /** A body that nothing touches feels nothing of another one's jumps. */
  void
  test_other_body()
  {
    auto at_rest = two_bars("0"), moved = two_bars("1e-6*max(0, t - 0.02)");
    for (const std::string energy : {"kinetic", "strain"})
      test::check_error("another body's jump: " + energy + " energy",
                        test::relative(moved[energy], at_rest[energy]),
                        1e-6);
    test::check_error("external work", std::abs(moved["external"]), 1e-9);
    // what has no switch is left alone, however fast; 40 steps
    for (const std::string smooth : {"1e-6*sin(100*t)",
                                     "1e-6*sin(12345*t)",
                                     "1e-6*(1 + tanh((t - 0.05)/0.006))",
                                     "1e-6*(1 - exp(-(t/0.01)^2))",
                                     "1e-6*exp(-((t - 0.04)/0.0003)^2)",
                                     "1e-6*((t + 1000)^2 - 1e6)"})
      {
        const double n_steps = two_bars(smooth)["steps"];
        test::check("no jump of " + smooth,
                    n_steps == 40,
                    std::to_string(n_steps));
      }
  }

  /** An acceleration that has no bounds at its start. */
  void
  test_unbounded_acceleration()
  {
    test::run_scene<2>(
      "Grid/Upper corner = 1, 0.5\nGrid/Subdivisions = 8, 4\n" +
      std::string(test::keep_grid) +
      "Material/Young modulus = 1e10\nMaterial/Density = 1\n"
      "Dynamics/Inertia = true\nTime/Step size = 0.005\n"
      "Time/End time = 0.04\nBoundary conditions/Displacement = bottom: y=0; "
      "top: y=0; right: x=0.1*max(0, t - 0.0213)^1.5\n");
    const auto &times = test::recorded().times;
    test::check("t^1.5: a step ends where it starts",
                std::any_of(times.begin(),
                            times.end(),
                            [](const double time) {
                              return std::abs(time - 0.0213) < 1e-12;
                            }),
                "");
  }


  /** What formulas say of when they change their branch. */
  void
  test_switches()
  {
    using Switches = std::vector<std::string>;
    for (const auto &[formula, expected] :
         std::vector<std::pair<std::string, Switches>>{
           {"0.1*t", {}},
           {"sin(t)^2 + x*t", {}},
           {"max(0, t - 0.02)", {"(0) - (t - 0.02)"}},
           {"if(t<0.1, 2*t, if(t>=0.3,1,0))", {"(t) - (0.1)", "(t) - (0.3)"}},
           {"x*(t > 1 && 2*(t - 1) <= 3)", {"(2*(t - 1)) - (3)", "(t) - (1)"}},
           {"t > 2 ? abs(t - 3) : 0", {"(t) - (2)", "t - 3"}},
           {"if(x > 0.5, t, 0)", {}},
           {"if(t > x, t, 0)", {}},
           {"min(t, 1, 2*exp(-t))",
            {"(1) - (2*exp(-t))", "(t) - (1)", "(t) - (2*exp(-t))"}}})
      {
        const Switches found = switches_in_time(formula);
        std::string    text;
        for (const std::string &one : found)
          text += one + "; ";
        test::check("switches of " + formula, found == expected, text);
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const Motion &motion : motions)
    for (const Of of : {Of::boundary, Of::body})
      test_block<2>(motion, of, "");
  test_block<2>(motions[1],
                Of::body,
                "Formulation/Type = u-p\nMaterial/Poisson ratio = 0.499\n");
  // a pressure on another surface
  test_block<2>(motions[2],
                Of::body,
                "Boundary conditions/Surfaces of body = tip: x > 0.999; back: "
                "left\nBoundary conditions/Pressure on body = back: 1e-9\n");
  for (const Of of : {Of::boundary, Of::body})
    test_block<3>(motions[2], of, "");
  test_strained_body();
  test_other_body();
  test_unbounded_acceleration();
  test_switches();
  return 0;
}
