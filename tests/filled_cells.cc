/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Cells without points and cells at the surface: what the quadratures put into
// them, and what is said where points are too far apart for the grid.

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Confined compression of a full square, with a hole, on a grid that is
   * kept: the stress of a homogeneous elastic state, also with friction. */
  void
  test_friction_on_kept_grid()
  {
    const auto problem = test::run_scene<2>(
      "Grid/Subdivisions = 6, 6\n"
      "Material points/Points per cell = 1\n"
      "Material points/Region = (x-0.6111)^2+(y-0.5556)^2 > 0.0004\n"
      "Quadrature/Type = cell-filled\n"
      "Grid reset/Steps between resets = 10\n"
      "Grid reset/Smallest element quality = 0\n"
      "Material/Model = Mohr-Coulomb\nMaterial/Young modulus = 1e5\n"
      "Material/Poisson ratio = 0.3\n"
      "Material/Mohr-Coulomb/Cohesion = 10\n"
      "Material/Mohr-Coulomb/Friction angle = 30\n"
      "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0; "
      "top: y=-0.04*t\n"
      "Time/Step size = 0.1\n");
    // Hencky: σ_yy = (K + 4/3 G) ln(0.96) / 0.96
    const double exact = 1e5 * 0.7 / (1.3 * 0.4) * std::log(0.96) / 0.96;
    double       error = 0;
    const auto  &l     = problem->material_points().layout();
    for (const auto &particle : problem->material_points().handler())
      {
        const double *stress = &particle.get_properties()[l.stress];
        test::add_error(error, std::abs(stress[1] - exact));
        test::add_error(error, std::abs(stress[3]));
      }
    test::check_error("friction, hole on a kept grid: homogeneous stress",
                      error / std::abs(exact),
                      1e-8);
  }

  /** A block of J2 plasticity that slides over its foot; coordinates b and c
   * change places with @p exchanged. */
  std::vector<double>
  sheared_block(const bool exchanged)
  {
    const std::string y       = exchanged ? "z" : "y";
    const auto        problem = test::run_scene<3>(
      std::string("Grid/Upper corner = ") +
      (exchanged ? "1, 0.5, 1" : "1, 1, 0.5") +
      "\nGrid/Subdivisions = " + (exchanged ? "4, 2, 4" : "4, 4, 2") +
      "\nMaterial points/Points per cell = 4\n"
             "Material points/Region = x < 0.67 && " +
      y +
      " < 0.67\nQuadrature/Type = cell-filled\n"
             "Material/Model = J2\nMaterial/Young modulus = 100\n"
             "Material/Poisson ratio = 0.4\nMaterial/Density = 1\n"
             "Material/J2/Yield stress = 2\nMaterial/J2/Hardening modulus = 20\n"
             "Boundary conditions/Displacement = left: x = 0.1*t*" +
      y +
      (exchanged ? "; front: z = 0; bottom: y = 0; top: y = 0\n" :
                          "; bottom: y = 0; front: z = 0; back: z = 0\n") +
      "Boundary conditions/Gravity = " +
      (exchanged ? "0, 0, -5*t" : "0, -5*t, 0") +
      "\nTime/Step size = 0.1\nPostprocess/Reactions = left\n"
             "Postprocess/Point probes = P: " +
      (exchanged ? "0.55, 0.25, 0.55" : "0.55, 0.55, 0.25") + '\n');
    const Statistics &s = problem->last_statistics();
    return {s.get("Displacement x of P (m)"),
            s.get("Pressure at P (Pa)"),
            s.get("Displacement " + y + " of P (m)"),
            s.get("Smallest J"),
            s.get("Largest J"),
            s.get("Volume in the grid (m^3)")};
  }

  void
  test_exchanged_axes()
  {
    const auto a = sheared_block(false), b = sheared_block(true);
    double     error = 0;
    for (unsigned int i = 0; i < a.size(); ++i)
      test::add_error(error, std::abs(a[i] / b[i] - 1));
    test::check_error("holes don't depend on the order of axes", error, 1e-9);
  }

  /** What is said of a bar of height 1 that is pulled, with points on a
   * lattice. */
  void
  test_sparse_points()
  {
    const auto warned = [](const std::string &spacing,
                           const std::string &quadrature) {
      const auto problem = test::run_scene<2>(
        "Grid/Upper corner = 4, 1.5\nGrid/Subdivisions = 16, 6\n"
        "Material points/Region = y < 1.03\n"
        "Material points/Lattice spacing = " +
        spacing + "\nQuadrature/Type = " + quadrature +
        "\nMaterial/Young modulus = 1000\n"
        "Boundary conditions/Displacement = left: x=0, y=0; right: "
        "x=0.1*t\nTime/Step size = 1\n");
      for (const auto &warning : problem->all_warnings().all())
        if (warning.subject == "material points too far apart for the grid")
          return warning.text;
      return std::string();
    };
    const std::string dense = warned("0.1", "points");
    test::check("no warning for a dense lattice", dense.empty(), dense);
    for (const std::string type : {"points", "cell-filled"})
      {
        const std::string sparse = warned("0.17", type);
        test::check("warning for a sparse lattice, " + type,
                    sparse.find("<Lattice spacing>") != std::string::npos &&
                      sparse.find("at t = 0 ") == 0 &&
                      // 0.17² over half of 0.25²
                      sparse.find("has 0.9248 times the volume of its cell") !=
                        std::string::npos,
                    sparse);
      }
    const auto pulled = test::run_scene<2>(
      "Grid/Upper corner = 4, 1.5\nGrid/Subdivisions = 16, 6\n"
      "Material points/Region = x < 2 && y < 1\n"
      "Material points/Lattice spacing = 0.125\nQuadrature/Type = points\n"
      "Material/Young modulus = 0.01\nMaterial/Poisson ratio = 0\n"
      "Material/Density = 1\nDynamics/Inertia = true\n"
      "Dynamics/Initial velocity = 0.75*x, 0\n"
      "Grid reset/Steps between resets = 1\n"
      "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
      "Time/Step size = 0.05\n");
    std::string later;
    for (const auto &warning : pulled->all_warnings().all())
      if (warning.subject == "material points too far apart for the grid")
        later = warning.text;
    test::check("the same at a reset",
                later.find("at t = 0.") == 0 &&
                  later.find("% of its volume, hold no points") !=
                    std::string::npos,
                later);
    std::string message;
    try
      {
        warned("0.6", "points");
      }
    catch (const std::exception &exc)
      {
        message = test::one_line(exc.what());
      }
    test::check("a body that falls apart is an error",
                message.find("falls apart") != std::string::npos,
                message);
    test::check("its pieces",
                message.find("into 14 pieces that share no face, with the "
                             "empty cells 1.") != std::string::npos,
                message);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_friction_on_kept_grid();
  test_exchanged_axes();
  test_sparse_points();
  return 0;
}
