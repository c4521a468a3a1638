/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Inertia: free fall, conservation of momentum, the axial vibration of a bar.

#include <isochor/base/mpi_sums.h>

#include <algorithm>

#include "scene.h"

using namespace isochor;

/** Momentum, centre of mass and the amplitude of the bar's first mode after
 * each step. */
struct Motion
{
  std::vector<Tensor<1, 2>> momentum, centre;
  std::vector<double>       amplitude;
  double                    mass = 0;
};

Motion &
motion()
{
  static Motion m;
  return m;
}

namespace isochor
{
  /** Fills motion(). */
  template <int dim>
  class MotionRecorder : public Postprocessor<dim>
  {
  public:
    void
    initialize(const BackgroundGrid<dim> &) override
    {
      motion() = {};
    }

    void
    evaluate_points(const StepResult<dim> &result, Statistics &) override
    {
      const PointLayout &l = result.points.layout();
      if (!l.dynamic)
        return;
      std::array<double, 6> sum{};
      for (const auto &point : result.points.handler())
        {
          const auto   data = point.get_properties();
          const double m    = data[l.mass];
          const double X    = point.get_location()[0] - data[l.displacement];
          sum[0] += m;
          sum[1] += m * std::sin(numbers::PI / 2 * X) * data[l.displacement];
          for (unsigned int a = 0; a < 2; ++a)
            {
              sum[2 + a] += m * data[l.velocity + a];
              sum[4 + a] += m * point.get_location()[a];
            }
        }
      sum_over_ranks(sum, MPI_COMM_WORLD);
      motion().mass = sum[0];
      motion().amplitude.push_back(sum[1]);
      motion().momentum.push_back(Tensor<1, 2>({sum[2], sum[3]}));
      motion().centre.push_back(Tensor<1, 2>({sum[4], sum[5]}) / sum[0]);
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, MotionRecorder, "Motion")
} // namespace isochor

const std::vector<std::pair<std::string, std::string>> formulations = {
  {"u",
   "Formulation/Type = u\nDynamics/Inertia = true\n"
   "Grid reset/Steps between resets = 1\n"},
  {"u-p + PPP",
   "Formulation/Type = u-p\nDynamics/Inertia = true\n"
   "Grid reset/Steps between resets = 1\n"}};

/** v = g t, u = g t²/2: exact for Newmark's scheme. Several cells are crossed
 * and the body is cut by cells in all ways. */
template <int dim>
void
test_free_fall()
{
  for (const auto &formulation : formulations)
    {
      const auto problem = test::run_scene<dim>(
        formulation.second +
        (dim == 2 ? "Grid/Lower corner = 0, -1.1\n"
                    "Grid/Subdivisions = 5, 12\n"
                    "Boundary conditions/Gravity = 1, -10\n" :
                    "Grid/Lower corner = 0, -1.1, 0\n"
                    "Grid/Subdivisions = 3, 8, 3\n"
                    "Material points/Points per cell = 4\n"
                    "Boundary conditions/Gravity = 1, -10, 0\n") +
        "Material points/Region = y > 0.3 && x < 0.8\nNewton/Tolerance = 1e-13\n"
        "Time/End time = 0.5\nTime/Step size = 0.1\n");
      double             error = 0;
      const PointLayout &l     = problem->material_points().layout();
      for (const auto &point : problem->material_points().handler())
        {
          const auto data = point.get_properties();
          test::add_error(error, std::abs(data[l.velocity] - 0.5));
          test::add_error(error, std::abs(data[l.velocity + 1] + 5));
          test::add_error(error, std::abs(data[l.displacement] - 0.125));
          test::add_error(error, std::abs(data[l.displacement + 1] + 1.25));
          test::add_error(error, std::abs(data[l.F] - 1));
        }
      test::check_error("free fall, " + formulation.first + ", dim " +
                          std::to_string(dim),
                        Utilities::MPI::max(error, MPI_COMM_WORLD),
                        2e-10);
    }
}

/** A free body that turns, stretches and moves through the grid: momentum is
 * constant, its centre of mass moves uniformly. */
void
test_momentum()
{
  for (const auto &formulation : formulations)
    {
      test::run_scene<2>(
        formulation.second +
        "Grid/Upper corner = 2, 2\nGrid/Subdivisions = 14, 13\n"
        "Material points/Region = (x-0.8)^2 + (y-0.8)^2 < 0.2\n"
        "Dynamics/Initial velocity = 1 - 4*(y-0.8) + 2*(x-0.8), "
        "0.5 + 3*(x-0.8)\n"
        "Newton/Tolerance = 1e-11\nTime/End time = 0.4\n"
        "Time/Step size = 0.01\n");
      const Motion &m        = motion();
      double        momentum = 0, centre = 0;
      const auto    steady = m.momentum.back() / m.mass;
      for (unsigned int step = 1; step < m.momentum.size(); ++step)
        {
          test::add_error(momentum,
                          (m.momentum[step] - m.momentum[0]).norm() / m.mass);
          test::add_error(
            centre,
            (m.centre[step] - m.centre[0] - 0.01 * step * steady).norm());
        }
      const bool moved = m.momentum.size() == 40 && m.centre[39][0] > 1.1;
      test::check("the free body moved, " + formulation.first,
                  moved,
                  std::to_string(m.momentum.size()) + " steps");
      test::check_error("momentum, " + formulation.first, momentum, 1e-9);
      test::check_error("centre of mass, " + formulation.first, centre, 1e-9);
    }
}

/** Bar clamped at x = 0 and free at x = 1, ν = 0, E = 1e4 Pa, ρ = 1000 kg/m³:
 * ω_1 = π/2 √(E/ρ) = 4.9673 rad/s, in Newmark's scheme with Δt = 0.01 s
 * 2/Δt atan(ω_1 Δt/2). An amplitude q of a mode in Newmark's
 * scheme with β = 1/4, γ = 1/2 obeys q_{n+1} + q_{n-1} = 2 cos(ω Δt) q_n, from
 * which ω is found by least squares. */
double
vibration(const unsigned int n_cells, const double step_size)
{
  test::run_scene<2>(
    formulations[0].second +
    "Dynamics/Spectral radius = 1\nGrid/Upper corner = 1, 0.1\n" +
    "Grid/Subdivisions = " + std::to_string(n_cells) +
    ", 2\nGrid/Diagonals = alternating\nMaterial points/Points per cell = 1\n"
    "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
    "Dynamics/Initial velocity = 1e-6*sin(pi/2*x), 0\n"
    "Newton/Tolerance = 1e-10\nTime/End time = 2.6\nTime/Step size = " +
    std::to_string(step_size) +
    "\nBoundary conditions/Displacement = left: x = 0; bottom: y = 0; "
    "top: y = 0\n");
  const auto &q       = motion().amplitude;
  double      product = 0, square = 0;
  for (unsigned int n = 1; n + 1 < q.size(); ++n)
    {
      product += (q[n - 1] + q[n + 1]) * q[n];
      square += q[n] * q[n];
    }
  const auto extremes = std::minmax_element(q.begin(), q.end());
  test::check("the bar swings",
              *extremes.first < 0 && *extremes.second > 0,
              std::to_string(*extremes.first));
  return std::acos(product / square / 2) / step_size;
}

/** Linear elements with the mass at one point each cost an error of second
 * order in the size of the cells. */
void
test_vibration()
{
  const double        dt = 0.01, discrete_omega = 4.966273151829484;
  std::vector<double> omega, error;
  for (const unsigned int n_cells : {8, 16, 32})
    {
      omega.push_back(vibration(n_cells, dt));
      error.push_back(std::abs(omega.back() / discrete_omega - 1));
    }
  test::check_error("frequency, 32 cells", error[2], 5e-4);
  test::check_error("frequency, second order",
                    std::max(std::abs(std::log2(error[0] / error[1]) - 2),
                             std::abs(std::log2(error[1] / error[2]) - 2)),
                    0.2);
  test::check_error("frequency, extrapolated",
                    std::abs((4 * omega[2] - omega[1]) / 3 / discrete_omega -
                             1),
                    1e-4);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // the energy that the scheme loses is no matter here, see the test of
  // energies
  std::ostringstream    printed;
  std::streambuf *const terminal = std::cerr.rdbuf(printed.rdbuf());
  test_free_fall<2>();
  test_free_fall<3>();
  test_momentum();
  test_vibration();
  std::cerr.rdbuf(terminal);
  return 0;
}
