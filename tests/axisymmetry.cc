/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies of revolution against closed forms: a cylinder that is compressed
// between smooth plates, thick-walled cylinders and spheres under pressure, an
// incompressible cylinder that is inflated, free fall and vibration.

#include <cmath>

#include "../doc/plugins/annulus.cc"
#include "scene.h"

using namespace isochor;
using namespace isochor::test;

namespace
{
  double
  get(const test::ProblemPointer<2> &problem, const std::string &column)
  {
    return problem->last_statistics().get(column);
  }

  const std::string axisymmetric = "Formulation/Geometry = axisymmetric\n";



  /** F = diag(λ_r, λ, λ_r) with σ_r = 0; the axial Cauchy stress. */
  double
  uniaxial_stress(const double G, const double K, const double lambda)
  {
    const auto stresses = [&](const double lambda_r) {
      const double J     = lambda_r * lambda_r * lambda;
      const double scale = G / J / std::cbrt(J * J);
      const double mean  = (2 * lambda_r * lambda_r + lambda * lambda) / 3;
      const double p     = K * (J - 1);
      return std::make_pair(scale * (lambda_r * lambda_r - mean) + p,
                            scale * (lambda * lambda - mean) + p);
    };
    double low = 0.5, high = 2;
    for (unsigned int i = 0; i < 200; ++i)
      {
        const double middle                       = (low + high) / 2;
        (stresses(middle).first > 0 ? high : low) = middle;
      }
    return stresses(low).second * low * low; // per area at t = 0
  }



  void
  test_compression()
  {
    const double E = 1e6, lambda = 0.7;
    // of the body: radius .9, height 1; its side lies inside of cells
    const std::string scene =
      axisymmetric +
      "Grid/Upper corner = 1.6, 1\nGrid/Subdivisions = 8, 5\n"
      "Grid/Diagonals = alternating\n"
      "Material points/Lattice spacing = 0.1\n"
      "Material points/Region = x < 0.9\n"
      "Boundary conditions/Displacement = bottom: y = 0; top: y = -0.3*t\n"
      "Grid/Stretch = y: 0 -> 0, 1 -> -0.3*t\n"
      "Time/Step size = 0.25\nPostprocess/Reactions = top\n"
      "Postprocess/Point probes = side: 0.9, 0.5\n";
    for (const std::string form : {"u", "u-p"})
      for (const std::string grid : {"CPDI", "CPDI, kept"})
        {
          const double nu = form == "u" ? 0.3 : 0.45;
          const double G = E / 2 / (1 + nu), K = E / 3 / (1 - 2 * nu);
          const auto   problem = run_scene<2>(
            scene + "Formulation/Type = " + form +
            "\nMaterial/Poisson ratio = " + std::to_string(nu) +
            "\nQuadrature/Type = CPDI\n" +
            (grid == "CPDI" ? "" :
                                "Grid reset/Steps between resets = 0\n"
                                "Grid/Stretch =\n"));
          const double force = pi * 0.81 * uniaxial_stress(G, K, lambda);
          check_error("compression, " + form + ", " + grid,
                      std::abs(get(problem, "Reaction y on top (N)") / force -
                               1),
                      1e-8);
        }
    for (const std::string type : {"points", "CPDI"})
      {
        const auto problem =
          run_scene<2>(scene +
                       "Formulation/Type = u-p\nMaterial/Poisson ratio = 0.5\n"
                       "Grid reset/Steps between resets = 0\nGrid/Stretch =\n"
                       "Grid/Upper corner = 0.9, 1\nGrid/Subdivisions = 4, 4\n"
                       "Material points/Lattice spacing = 0\n"
                       "Material points/Points per cell = 4\n"
                       "Quadrature/Type = " +
                       type + "\n");
        const double force =
          pi * 0.81 * 1e6 / 3 * (lambda - 1 / lambda / lambda);
        double error =
          std::abs(get(problem, "Reaction y on top (N)") / force - 1);
        add_error(error,
                  std::abs(get(problem, "Displacement x of side (m)") / 0.9 -
                           (1 / std::sqrt(lambda) - 1)));
        add_error(error,
                  std::abs(get(problem, "Material volume (m^3)") / pi / 0.81 -
                           1));
        check_error("incompressible compression, kept grid, " + type,
                    error,
                    1e-8);
      }
  }



  /** Thick-walled cylinder (1 to 2 m) and sphere (the same radii), Lamé. */
  void
  test_lame()
  {
    const double E = 1e6, p = 1;
    struct Case
    {
      std::string body, form;
      double      nu;
    };
    for (const Case &c : {Case{"cylinder", "u", 0.3},
                          Case{"cylinder", "u-p", 0.5},
                          Case{"sphere", "u", 0.3},
                          Case{"sphere", "u-p", 0.5}})
      {
        const bool   sphere = c.body == "sphere";
        const double a = 1, b = 2, n = c.nu;
        const double exact =
          sphere ? p * a * a * a / (b * b * b - a * a * a) / E *
                     ((1 - 2 * n) * a + (1 + n) / 2 * b * b * b / a / a) :
                   p * a * a / (b * b - a * a) * (1 + n) / E *
                     ((1 - 2 * n) * a + b * b / a);
        std::vector<double> errors;
        for (const unsigned int cells : {8, 16})
          {
            const std::string k       = std::to_string(cells);
            const auto        problem = run_scene<2>(
              axisymmetric + "Formulation/Type = " + c.form +
              "\nMaterial/Poisson ratio = " + std::to_string(n) +
              "\nGrid/Subdivisions = " + k + ", " +
              (sphere ? k : std::to_string(cells / 4)) +
              "\nGrid/Diagonals = alternating\n"
                     "Material points/Points per cell = 6\n"
                     "Postprocess/Point probes = inside: 1, 0\n" +
              (sphere ?
                        "Grid/Type = annulus\nGrid/Radii = 1, 2\n"
                        "Boundary conditions/Displacement = bottom: y = 0\n"
                        "Boundary conditions/Traction = left: x*t, y*t\n" :
                        "Grid/Lower corner = 1, 0\nGrid/Upper corner = 2, 0.25\n"
                        "Boundary conditions/Displacement = bottom: y = 0; top: "
                        "y = 0\nBoundary conditions/Traction = left: t, 0\n"));
            errors.push_back(std::abs(
              get(problem, "Displacement x of inside (m)") / exact - 1));
          }
        std::ostringstream details;
        details << errors[0] << " and " << errors[1];
        check("Lame's " + c.body + ", " + c.form,
              errors[1] < 0.005 && errors[1] < 0.3 * errors[0],
              details.str());
      }
  }



  /** An incompressible cylinder (radii A and B) whose inner surface moves to
   * a: with k = a² - A², dσ_r/dr = (σ_θ - σ_r)/r gives
   *   p/G = ln(B a / (A b)) + k/2 (1/a² - 1/b²),  b² = B² + k. */
  void
  test_inflation()
  {
    const double A = 1, B = 2, a = 1.5, k = a * a - A * A,
                 b = std::sqrt(B * B + k);
    const double exact =
      std::log(B * a / A / b) + k / 2 * (1 / a / a - 1 / b / b);
    std::vector<double> errors;
    for (const std::string n : {"8", "16"})
      {
        const auto problem = run_scene<2>(
          axisymmetric +
          "Formulation/Type = u-p\nMaterial/Poisson ratio = 0.5\n"
          "Grid/Lower corner = 1, 0\nGrid/Upper corner = 2, 0.25\n"
          "Grid/Subdivisions = " +
          n +
          ", 2\n"
          "Material points/Points per cell = 6\n"
          "Grid reset/Steps between resets = 0\n"
          "Boundary conditions/Displacement = bottom: y = 0; top: y = 0; "
          "left: x = 0.5*t\n"
          "Time/Step size = 0.25\nPostprocess/Reactions = left\n");
        const double G = 1e6 / 3;
        errors.push_back(std::abs(get(problem, "Reaction x on left (N)") /
                                    (2 * pi * a * 0.25) / G / exact -
                                  1));
      }
    std::ostringstream details;
    details << errors[0] << " and " << errors[1];
    check("inflation of a cylinder, nu = 1/2",
          errors[1] < 0.003 && errors[1] < 0.4 * errors[0],
          details.str());
  }



  /** The same by a pressure that follows the body: consistent with the
   * displacement (closed form above), and quadratic convergence. */
  void
  test_pressure()
  {
    const double A = 1, B = 2, a = 1.25, k = a * a - A * A,
                 b = std::sqrt(B * B + k);
    const double pressure =
      1e6 / 3 * (std::log(B * a / A / b) + k / 2 * (1 / a / a - 1 / b / b));
    const auto problem = run_scene<2>(
      axisymmetric +
      "Formulation/Type = u-p\nMaterial/Poisson ratio = 0.5\n"
      "Grid/Lower corner = 1, 0\nGrid/Upper corner = 2, 0.25\n"
      "Grid/Subdivisions = 16, 4\nMaterial points/Points per cell = 6\n"
      "Grid reset/Steps between resets = 0\n"
      "Boundary conditions/Surfaces of body = inner: x < 1 + 1e-9\n"
      "Boundary conditions/Pressure on body = inner: " +
      std::to_string(pressure) +
      "*t\nBoundary conditions/Displacement = bottom: y = 0; top: y = 0\n"
      "Time/Step size = 0.25\nPostprocess/Point probes = in: 1, 0.125\n");
    check_error("inflation by a pressure",
                std::abs(get(problem, "Displacement x of in (m)") / 0.25 - 1),
                0.01);
    unsigned int most = 0;
    for (const NewtonReport &report : recorded().newton)
      most = std::max<unsigned int>(most, report.n_iterations());
    check("Newton's method with a pressure", most <= 6, std::to_string(most));
  }



  /** Weight, dead loads and free fall of a cylinder with radius 1 and height
   * 1: π ρ g in all. */
  void
  test_loads()
  {
    const std::string scene =
      axisymmetric +
      "Grid/Subdivisions = 4, 4\nBoundary conditions/Displacement = bottom: "
      "x = 0, y = 0\nPostprocess/Reactions = bottom\n";
    const auto weight =
      run_scene<2>(scene + "Boundary conditions/Gravity = 0, -10*t\n");
    const double g_rho = 10 * 1000;
    double       error =
      std::abs(get(weight, "Reaction y on bottom (N)") / (pi * g_rho) - 1);
    add_error(error, std::abs(get(weight, "Mass (kg)") / (1000 * pi) - 1));
    const auto load =
      run_scene<2>(scene + "Boundary conditions/Traction = top: 0, -1e3*t\n");
    add_error(error,
              std::abs(get(load, "Reaction y on bottom (N)") / (pi * 1e3) - 1));
    check_error("weight and traction of a disc", error, 1e-8);

    for (const std::string type : {"points", "CPDI"})
      {
        const auto fall = run_scene<2>(
          axisymmetric +
          "Grid/Lower corner = 0, -1\nGrid/Upper corner = 1.5, 1.5\n"
          "Grid/Subdivisions = 6, 10\nMaterial points/Region = x < 1 && y > "
          "0.5\nBoundary conditions/Gravity = 0, -1\nDynamics/Inertia = "
          "true\nTime/Step size = 0.125\nQuadrature/Type = " +
          type +
          "\nMaterial points/Points per cell = 4\n"
          "Cut cells/Extension = never\n"
          "Postprocess/Point probes = middle: 0.3, 0.9\n");
        error = std::abs(get(fall, "Displacement y of middle (m)") + 0.5);
        add_error(error,
                  std::abs(
                    get(fall, "Kinetic energy (J)") / (1000 * pi * 1 / 2) - 1));
        check_error("free fall, " + type, error, 1e-8);
      }

    // energy of a cylinder that rings
    const auto ring = run_scene<2>(
      axisymmetric +
      "Grid/Lower corner = 0, 0\nGrid/Upper corner = 1.25, 1\n"
      "Grid/Subdivisions = 5, 4\nMaterial points/Region = x < 1\n"
      "Material points/Points per cell = 4\nQuadrature/Type = CPDI\n"
      "Formulation/Type = u\nBoundary conditions/Displacement = bottom: y = "
      "0; top: y = 0\nDynamics/Inertia = true\nDynamics/Initial velocity = "
      "x, 0\nTime/End time = 0.1\nTime/Step size = 0.002\n");
    const double energy = 1000 * 2 * pi / 4 / 2; // ∫ ρ r²/2 dv
    check_error("energy of a cylinder that rings",
                std::abs(get(ring, "Energy lost by the scheme (J)") / energy),
                0.01);
  }



  /** A tube between rough plates, pressed by a fifth of its height: a section
   * and a quarter in space, in cells of the same size. */
  void
  test_tube_in_3d()
  {
    const std::string scene =
      "Grid/Diagonals = alternating\nMaterial/Poisson ratio = 0.49\n"
      "Grid reset/Steps between resets = 0\n"
      "Material points/Points per cell = 4\nTime/Step size = 0.25\n";
    const auto section =
      run_scene<2>(axisymmetric + scene +
                   "Grid/Lower corner = 1, 0\nGrid/Upper corner = 2, 1\n"
                   "Grid/Subdivisions = 6, 6\n"
                   "Boundary conditions/Displacement = bottom: x = 0, y = 0; "
                   "top: x = 0, y = -0.2*t\nPostprocess/Reactions = top\n");
    const auto quarter = run_scene<3>(
      scene +
      "Grid/Type = annulus\nGrid/Radii = 1, 2\nGrid/Subdivisions = 6, 12, 6\n"
      "Boundary conditions/Displacement = bottom: y = 0; top: x = 0; "
      "front: x = 0, y = 0, z = 0; back: x = 0, y = 0, z = -0.2*t\n"
      "Postprocess/Reactions = back\n");
    check_error("tube between rough plates, section and quarter",
                std::abs(
                  4 * quarter->last_statistics().get("Reaction z on back (N)") /
                    section->last_statistics().get("Reaction y on top (N)") -
                  1),
                0.003);
  }



  void
  test_errors()
  {
    const auto message = [](const std::string &settings) -> std::string {
      try
        {
          run_scene<2>(settings);
        }
      catch (const std::exception &exception)
        {
          return one_line(exception.what());
        }
      return "no error";
    };
    const auto expect = [&](const std::string              &what,
                            const std::string              &text,
                            const std::vector<std::string> &parts) {
      for (const std::string &part : parts)
        if (text.find(part) == std::string::npos)
          return check(what, false, text);
      check(what, true, "");
    };
    expect("grid beyond the axis",
           message(axisymmetric + "Grid/Lower corner = -0.5, 0\n"),
           {"distance from the axis", "-0.5"});
    expect("gravity across the axis",
           message(axisymmetric + "Boundary conditions/Gravity = 1, 0\n"),
           {"Boundary conditions/Gravity", "along the axis"});
    try
      {
        run_scene<3>(axisymmetric);
        check("in 3D", false, "no error");
      }
    catch (const std::exception &exception)
      {
        expect("in 3D", one_line(exception.what()), {"Dimension = 2"});
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_compression();
  test_lame();
  test_inflation();
  test_pressure();
  test_loads();
  test_tube_in_3d();
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    test_errors();
  return 0;
}
