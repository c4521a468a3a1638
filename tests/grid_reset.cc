/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A grid that is kept for several steps is updated Lagrangian finite elements:
// what is elastic does not depend on the path. A bar in vibration neither gains
// nor loses, however often the grid is reset; and that is done when the
// parameters say so.

#include <isochor/base/mpi_sums.h>

#include <algorithm>

#include "scene.h"
#include "simple_shear.h"

using namespace isochor;

namespace isochor
{
  /** What the statistics held after each step. */
  struct History
  {
    std::vector<double>       step_of_grid, amplitude;
    std::vector<Tensor<1, 2>> velocity, centre; ///< of the mass
  };

  History &
  history()
  {
    static History h;
    return h;
  }

  /** A column of the statistics that only runs with a kept grid have. */
  bool with_steps_of_grid = false;

  /** Fills history(): of a bar along x, the amplitude of the first mode. */
  template <int dim>
  class HistoryRecorder : public Postprocessor<dim>
  {
  public:
    void
    initialize(const BackgroundGrid<dim> &) override
    {
      history() = {};
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      const PointLayout    &l = result.points.layout();
      std::array<double, 6> sum{};
      for (const auto &point : result.points.handler())
        {
          const auto   data = point.get_properties();
          const double u    = data[l.displacement];
          const double X    = point.get_location()[0] - u;
          sum[0] += data[l.mass] * std::sin(numbers::PI / 2 * X) * u;
          sum[1] += data[l.mass];
          for (unsigned int a = 0; l.dynamic && a < 2; ++a)
            {
              sum[2 + a] += data[l.mass] * data[l.velocity + a];
              sum[4 + a] += data[l.mass] * point.get_location()[a];
            }
        }
      sum_over_ranks(sum, MPI_COMM_WORLD);
      history().amplitude.push_back(sum[0]);
      history().velocity.push_back(Tensor<1, 2>({sum[2], sum[3]}) / sum[1]);
      history().centre.push_back(Tensor<1, 2>({sum[4], sum[5]}) / sum[1]);
      if (with_steps_of_grid)
        history().step_of_grid.push_back(statistics.get("Step of grid"));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, HistoryRecorder, "History")
} // namespace isochor

const std::string never = "Grid reset/Steps between resets = 0\n"
                          "Grid reset/Smallest element quality = 0\n";

/** Cook's membrane under @p load of its end, so large that the tip moves by
 * several metres: the displacement of A. */
double
cook(const std::string &load,
     const double       step_size,
     const std::string &settings,
     const unsigned int n = 8)
{
  const auto problem = test::run_scene<2>(
    "Grid/Type = trapezoid\nGrid/Corners = 0, 0; 48, 44; 48, 60; 0, 44\n"
    "Grid/Subdivisions = " +
    std::to_string(n) + ", " + std::to_string(n) +
    "\nMaterial/Young modulus = 70\n"
    "Boundary conditions/Displacement = left: x = 0, y = 0\n" +
    load + "Postprocess/Point probes = A: 48, 60\nNewton/Tolerance = 1e-11\n" +
    "Time/Step size = " + std::to_string(step_size) + '\n' + never + settings);
  return problem->last_statistics().get("Displacement y of A (m)");
}

const std::string dead_load = "Boundary conditions/Traction = right: 0, t/4\n";

/** Ten steps give what one step does. */
void
test_path_independence()
{
  const std::string surface =
    "Boundary conditions/Surfaces of body = end: right; top: top\n"
    "Boundary conditions/Traction on body = end: 0, t/4\n"
    "Boundary conditions/Pressure on body = top: -0.05*t\n";
  const std::vector<std::array<std::string, 3>> variants = {
    {{"u", dead_load, "Formulation/Type = u\nMaterial/Poisson ratio = 0.33\n"}},
    {{"u-p, nu = 0.33", dead_load, "Material/Poisson ratio = 0.33\n"}},
    {{"u-p, nu = 0.5", dead_load, "Material/Poisson ratio = 0.5\n"}},
    {{"u-p, no predictor",
      dead_load,
      "Material/Poisson ratio = 0.499\nNewton/Predictor = none\n"}},
    {{"CPDI",
      dead_load,
      "Material/Poisson ratio = 0.499\nMaterial points/Points per cell = 4\n"
      "Quadrature/Type = CPDI\n"}},
    {{"loads on the body", surface, "Material/Poisson ratio = 0.4\n"}},
    {{"loads on the body, CPDI",
      surface,
      "Material/Poisson ratio = 0.4\nMaterial points/Points per cell = 4\n"
      "Quadrature/Type = CPDI\n"}}};
  for (const auto &[name, load, settings] : variants)
    {
      const double one = cook(load, 1., settings);
      test::check_error("Cook in ten steps and in one, " + name,
                        std::abs(cook(load, 0.1, settings) / one - 1),
                        1e-9);
      test::check("the load is large, " + name, one > 0.7, std::to_string(one));
    }
  const auto cantilever = [](const std::string &settings) {
    return test::run_scene<3>(
             "Grid/Upper corner = 4, 1, 1\nGrid/Subdivisions = 8, 2, 2\n"
             "Material/Young modulus = 100\nMaterial/Poisson ratio = 0.5\n"
             "Boundary conditions/Displacement = left: x = 0, y = 0, z = 0\n"
             "Boundary conditions/Traction = right: 0, 0.5*t, 0.2*t\n"
             "Postprocess/Point probes = A: 4, 1, 1\n"
             "Newton/Tolerance = 1e-11\n" +
             never + settings)
      ->last_statistics()
      .get("Displacement y of A (m)");
  };
  const double straight = cantilever("");
  test::check_error("cantilever in space",
                    std::abs(cantilever("Time/Step size = 0.2\n") / straight -
                             1),
                    1e-9);
  test::check("the cantilever bends", straight > 0.5, std::to_string(straight));
  const double with_cuts =
    cook(dead_load,
         1.,
         "Newton/Maximum iterations = 3\nNewton/Reuse factorisation = 0\n");
  test::check("steps are cut",
              test::recorded().times.size() > 1,
              std::to_string(test::recorded().times.size()));
  test::check_error("Cook with steps cut back",
                    std::abs(with_cuts / cook(dead_load, 1., "") - 1),
                    1e-9);
}

/** A column of rubber under its weight: 4 n small steps with a reset after each
 * fourth give what n steps with a reset after each do, as each interval between
 * resets is independent of the path; ties of unsupported nodes included. */
void
test_column()
{
  for (const std::string type : {"points", "CPDI"})
    {
      const std::string scene =
        "Material/Young modulus = 1e4\n"
        "Boundary conditions/Displacement = left: x = 0; right: x = 0; "
        "bottom: y = 0\nQuadrature/Type = " +
        type +
        "\nNewton/Tolerance = 1e-11\n"
        "Grid reset/Smallest element quality = 0\n"
        "Grid/Upper corner = 6.25, 50\nGrid/Subdivisions = 2, 16\n"
        "Material/Poisson ratio = 0.33\n"
        "Material/Density = 80\nTime/End time = 0.7\n"
        "Boundary conditions/Gravity = 0, -10*t\n"
        "Postprocess/Point probes = P: 3, 44\n";
      const auto displacement = [&](const std::string &settings) {
        return test::run_scene<2>(scene + settings)
          ->last_statistics()
          .get("Displacement y of P (m)");
      };
      const double every_step =
        displacement("Time/Step size = 0.1\n"
                     "Grid reset/Steps between resets = 1\n");
      const double every_fourth =
        displacement("Time/Step size = 0.025\n"
                     "Grid reset/Steps between resets = 4\n");
      const std::string name = "standing column, " + type;
      test::check("moved far, " + name,
                  std::abs(every_step) > 10,
                  std::to_string(every_step));
      test::check_error("as many resets, " + name,
                        std::abs(every_fourth / every_step - 1),
                        1e-8);
    }
}

/** The independent high-order solution for ten times the paper's load, ν =
 * 0.499: u_y(A) = 2.63972 m. Linear triangles are too stiff by some per cent.
 */
void
test_cook_reference()
{
  const double u = cook("Boundary conditions/Traction = right: 0, 10*t/16\n",
                        0.2,
                        "Material/Poisson ratio = 0.499\n"
                        "Formulation/PPP coefficient = 8\n",
                        32);
  test::check_error("Cook's membrane under ten times the load",
                    std::abs(u / 2.63972 - 1),
                    0.02);
}

/** A block pulled far into the plastic range, homogeneously: on a grid that is
 * put back after each step to follow its top, and on one that is kept. */
void
test_plastic_tension()
{
  const std::string scene =
    "Grid/Subdivisions = 4, 4\nMaterial/Model = J2\n"
    "Material/Young modulus = 200\nMaterial/Poisson ratio = 0.3\n"
    "Material/J2/Yield stress = 1\nTime/Step size = 0.1\n"
    "Newton/Tolerance = 1e-11\n"
    "Boundary conditions/Displacement = left: x = 0; bottom: y = 0; "
    "top: y = 0.1*t\n";
  const auto stress = [](const MaterialPointMethod<2> &problem) {
    const PointLayout    &l = problem.material_points().layout();
    std::array<double, 5> sum{};
    for (const auto &point : problem.material_points().handler())
      {
        const auto data = point.get_properties();
        for (unsigned int i = 0; i < 4; ++i)
          sum[i] += data[l.stress + i];
        sum[4] += 1;
      }
    sum_over_ranks(sum, MPI_COMM_WORLD);
    for (double &s : sum)
      s /= sum[4];
    return sum;
  };
  const std::string stretch = "Grid/Stretch = y: 0 -> 0, 1 -> 0.1*t\n"
                              "Grid/Upper corner = 1, 1\n";
  for (const std::string formulation : {"u", "u-p"})
    {
      const std::string type = "Formulation/Type = " + formulation + '\n';
      const auto reset = stress(*test::run_scene<2>(scene + type + stretch));
      const auto kept  = stress(*test::run_scene<2>(scene + type + never));
      const auto both  = stress(*test::run_scene<2>(
        scene + type + stretch + "Grid reset/Steps between resets = 4\n"));
      double     error = 0;
      for (unsigned int i = 0; i < 4; ++i)
        {
          test::add_error(error, std::abs(kept[i] - reset[i]));
          test::add_error(error, std::abs(both[i] - reset[i]));
        }
      test::check_error("plastic tension, " + formulation, error, 1e-9);
      // plane strain limit 2/√3 σ_Y, of Kirchhoff stress; J - 1 is small
      test::check_error("plastic limit, " + formulation,
                        std::abs(kept[1] - kept[0] - 2 / std::sqrt(3.)),
                        0.01);
    }
}

/** A block is lifted by 0.1 from a base that only pushes, in ten steps, and
 * pressed down to -0.05 in fifteen: without stress until it is back, then
 * F_yy = 0.95. */
void
test_contact()
{
  const auto problem = test::run_scene<2>(
    "Grid/Subdivisions = 4, 4\nMaterial/Poisson ratio = 0.3\n"
    "Quadrature/Type = CPDI\nTime/Step size = 0.04\n"
    "Boundary conditions/Walls = bottom: n >= 0\n"
    "Boundary conditions/Displacement = left: x = 0; top: y = 0.1 - "
    "abs(t-0.4)/4\n" +
    never);
  const PointLayout &l     = problem->material_points().layout();
  double             error = 0;
  for (const auto &point : problem->material_points().handler())
    test::add_error(error, std::abs(point.get_properties()[l.F + 3] - 0.95));
  test::check_error("lifted and pressed",
                    Utilities::MPI::max(error, MPI_COMM_WORLD),
                    1e-9);
}

/** The bar of the test of dynamics: ω_1 = π/2 √(E/ρ), of linear elements
 * with lumped masses 2/h √(E/ρ) sin(π h/4) (with the mass at one point of each
 * cell it differs from that by 1e-4 here), in Newmark's scheme
 * 2/Δt atan(ω Δt/2) and
 * q_{n+1} + q_{n-1} = 2 cos(ω Δt) q_n,
 * A² = q_n² + ((q_{n+1} - q_{n-1}) / (2 sin(ω Δt)))². */
void
test_vibration(const unsigned int steps_between_resets)
{
  const unsigned int n  = 32;
  const double       dt = 0.01, c = std::sqrt(10.);
  const double       omega_h = 2. * n * c * std::sin(numbers::PI / 4. / n);
  const double       omega   = 2 / dt * std::atan(omega_h * dt / 2);
  const std::string  number  = std::to_string(steps_between_resets);
  test::run_scene<2>(
    "Formulation/Type = u\nDynamics/Inertia = true\n"
    "Dynamics/Spectral radius = 1\nGrid/Upper corner = 1, 0.1\nGrid/Subdivisions = 32, 2\n"
    "Material points/Points per cell = 1\nMaterial/Young modulus = 1e4\n"
    "Material/Poisson ratio = 0\n"
    "Dynamics/Initial velocity = 1e-6*sin(pi/2*x), 0\n"
    "Newton/Tolerance = 1e-10\nTime/End time = 7.6\nTime/Step size = 0.01\n"
    "Boundary conditions/Displacement = left: x = 0; bottom: y = 0; "
    "top: y = 0\nGrid reset/Steps between resets = " +
    number + '\n');
  const auto &q       = history().amplitude;
  double      product = 0, square = 0;
  for (unsigned int i = 1; i + 1 < q.size(); ++i)
    {
      product += (q[i - 1] + q[i + 1]) * q[i];
      square += q[i] * q[i];
    }
  test::check_error("frequency of the bar, resets after " + number,
                    std::abs(std::acos(product / square / 2) / dt / omega - 1),
                    1e-3);
  std::array<double, 2> mean{}; // of A² over the first and the last 130 steps
  for (unsigned int i = 1; i <= 130; ++i)
    for (const bool last : {false, true})
      {
        const unsigned int k = last ? q.size() - 1 - i : i;
        const double p = (q[k + 1] - q[k - 1]) / (2 * std::sin(omega * dt));
        mean[last] += q[k] * q[k] + p * p;
      }
  test::check_error("amplitude after six periods, resets after " + number,
                    std::abs(std::sqrt(mean[1] / mean[0]) - 1),
                    2e-3);
}

/** A body that turns and stretches flies through the grid under gravity: its
 * momentum changes by gravity alone, at resets and between them. */
void
test_momentum()
{
  for (const std::string type : {"points", "CPDI"})
    {
      const double dt = 0.01;
      test::run_scene<2>(
        "Dynamics/Inertia = true\nQuadrature/Type = " + type +
        "\nGrid/Upper corner = 2, 2\nGrid/Subdivisions = 14, 13\n"
        "Material points/Points per cell = 4\n"
        "Material points/Region = (x-0.8)^2 + (y-0.8)^2 < 0.2\n"
        "Dynamics/Initial velocity = 1 - 4*(y-0.8) + 2*(x-0.8), "
        "0.5 + 3*(x-0.8)\nBoundary conditions/Gravity = 0, -2\n"
        "Newton/Tolerance = 1e-11\nTime/End time = 0.4\n"
        "Time/Step size = 0.01\nGrid reset/Steps between resets = 4\n");
      const History &h        = history();
      double         momentum = 0, centre = 0;
      for (unsigned int i = 1; i < h.velocity.size(); ++i)
        {
          const Tensor<1, 2> g({0., -2.});
          test::add_error(momentum,
                          (h.velocity[i] - h.velocity[0] - i * dt * g).norm());
          test::add_error(centre,
                          (h.centre[i] - h.centre[0] - i * dt * h.velocity[0] -
                           i * dt * i * dt / 2 * g)
                            .norm());
        }
      test::check("the body flew, " + type,
                  h.centre.size() == 40 && h.centre.back()[0] > 1.1,
                  std::to_string(h.centre.size()));
      test::check_error("momentum, " + type, momentum, 1e-9);
      test::check_error("centre of mass, " + type, centre, 1e-9);
    }
}

/** Simple shear γ has the quality 2/(2 + γ²) below 1/2 from γ = √2 on, the
 * sixth step of γ = 1/4. Beyond a reset the body goes on as if nothing
 * happened. */
void
test_when()
{
  const std::string scene =
    "Grid/Upper corner = 6, 1\nGrid/Subdivisions = 24, 4\n"
    "Material points/Region = x < 1\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Shear = 4*t\nTime/Step size = 0.0625\n";
  with_steps_of_grid = true;
  const auto steps = [&](const std::string &name, const std::string &settings) {
    const auto         problem = test::run_scene<2>(scene + settings);
    double             error   = 0;
    const PointLayout &l       = problem->material_points().layout();
    for (const auto &point : problem->material_points().handler())
      {
        const auto data = point.get_properties();
        test::add_error(error, std::abs(data[l.F] - 1));
        test::add_error(error, std::abs(data[l.F + 1] - 4));
        test::add_error(error,
                        std::abs(data[l.displacement] -
                                 4 * point.get_location()[1]));
      }
    test::check_error("simple shear, " + name,
                      Utilities::MPI::max(error, MPI_COMM_WORLD),
                      1e-12);
    std::string sequence;
    for (const double step : history().step_of_grid)
      sequence += std::to_string(static_cast<unsigned int>(step));
    return sequence;
  };
  const auto expect = [](const std::string &name,
                         const std::string &found,
                         const std::string &expected) {
    test::check(name, found == expected, found + ", not " + expected);
  };
  expect("reset by quality",
         steps("quality",
               "Grid reset/Steps between resets = 0\n"
               "Grid reset/Smallest element quality = 0.5\n"),
         "1234561234561234");
  expect("reset by steps",
         steps("steps",
               "Grid reset/Steps between resets = 5\n"
               "Grid reset/Smallest element quality = 0\n"),
         "1234512345123451");
  expect("reset by both",
         steps("both",
               "Grid reset/Steps between resets = 5\n"
               "Grid reset/Smallest element quality = 0.8\n"),
         "1231231231231231");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_path_independence();
  test_column();
  test_cook_reference();
  test_plastic_tension();
  test_contact();
  for (const unsigned int steps : {0, 2, 10})
    test_vibration(steps);
  test_momentum();
  test_when();
  return 0;
}
