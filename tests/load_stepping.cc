/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Steps that fail are cut back, output times are hit, nothing unconverged is
// accepted, and a run that can't go on ends with an error.

#include <algorithm>

#include "scene.h"

using namespace isochor;

/** A block between clamps drawn by 0.6 of its height. */
const std::string scene =
  "Grid/Subdivisions = 4, 4\nGrid/Stretch = y: 0 -> 0, 1 -> 0.6*t\n"
  "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.3\n"
  "Formulation/Type = u\n"
  "Boundary conditions/Displacement = bottom: x=0, y=0; top: x=0, y=0.6*t\n"
  "Newton/Reuse factorisation = 0\n"
  "Postprocess/Reactions = top\n";

void
test_cuts()
{
  const auto   easy = test::run_scene<2>(scene + "Time/Step size = 0.02\n");
  const double reference = easy->last_statistics().get("Reaction y on top (N)");

  const auto problem = test::run_scene<2>(
    scene + "Newton/Predictor = none\nNewton/Maximum iterations = 3\n"
            "Time/Step size = 1\n"
            "Time/Output interval = 0.5\n");
  const auto &recorded = test::recorded();
  test::check("a large step is cut",
              problem->last_statistics().get("Step cuts") > 0,
              "no cut");
  bool hit = true, converged = true, forward = true;
  for (const double time : {0.5, 1.})
    hit = hit && std::any_of(recorded.times.begin(),
                             recorded.times.end(),
                             [&](const double t) {
                               return std::abs(t - time) <= 1e-15;
                             });
  for (unsigned int i = 0; i < recorded.newton.size(); ++i)
    {
      converged = converged && recorded.newton[i].converged &&
                  recorded.newton[i].n_iterations() <= 3 &&
                  recorded.newton[i].iterations.back().displacement <= 1e-8;
      forward =
        forward && (i == 0 || recorded.times[i] > recorded.times[i - 1]);
    }
  std::ostringstream times;
  for (const double t : recorded.times)
    times << t << ' ';
  test::check("output times are hit", hit, times.str());
  test::check("time goes on to its end",
              forward && recorded.times.back() == 1,
              times.str());
  test::check("every step accepted has converged", converged, times.str());
  // the resets of the grid depend on the steps
  test::check_error(
    "the result is that of small steps",
    std::abs(
      problem->last_statistics().get("Reaction y on top (N)") / reference - 1),
    0.03);
}

void
test_failure()
{
  std::string message;
  try
    {
      test::run_scene<2>(scene +
                         "Newton/Maximum iterations = 1\nTime/Step size = 1\n"
                         "Time/Minimum step size = 0.2\n");
    }
  catch (const std::exception &exc)
    {
      message = exc.what();
    }
  test::check("a run that can't go on says so",
              message.find("can't be cut") != std::string::npos &&
                test::recorded().newton.empty(),
              message);
}

/** From wherever a step begins it may be halved to exactly the smallest. */
void
test_smallest_step()
{
  ParameterHandler prm;
  LoadStepping::declare_parameters(prm);
  test::set_parameters(prm,
                       "Time/End time = 10\nTime/Step size = 0.1\n"
                       "Time/Minimum step size = 0.0125\n");
  bool reached = true, ended = true;
  for (unsigned int n_steps = 0; n_steps < 90; ++n_steps)
    {
      LoadStepping time;
      time.parse_parameters(prm);
      for (unsigned int n = 0; n < n_steps; ++n)
        time.accept(1);
      for (unsigned int n = 0; n < 3; ++n)
        {
          reached = reached && time.can_be_cut();
          if (time.can_be_cut())
            time.reject("");
        }
      ended = ended && !time.can_be_cut();
    }
  test::check("a step is cut down to the smallest", reached, "");
  test::check("and no further", ended, "");
}

/** At the start, at the multiples of the interval and at the end, however long
 * the interval is. */
void
test_output()
{
  for (const double interval : {0.25, 1e9, 1e-9})
    {
      ParameterHandler prm;
      LoadStepping::declare_parameters(prm);
      prm.enter_subsection("Time");
      prm.set("End time", std::min(1., 8 * interval));
      prm.set("Step size", std::min(0.125, interval));
      prm.set("Output interval", interval);
      prm.leave_subsection();
      LoadStepping time;
      time.parse_parameters(prm);
      unsigned int n = time.output_due();
      while (!time.finished())
        {
          time.accept(1);
          n += time.output_due();
        }
      const unsigned int expected =
        interval > 1 ? 2 : (interval == 0.25 ? 5 : 9);
      test::check("outputs with an interval of " +
                    Utilities::to_string(interval),
                  n == expected,
                  std::to_string(n));
    }
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_cuts();
  test_failure();
  test_smallest_step();
  test_output();
  return 0;
}
