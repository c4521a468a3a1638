/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Periodic cells: homogeneous states in closed form, and a cell with an
// inclusion that is cut out of the periodic body elsewhere.

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string u  = "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n";
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.5\n";
  const std::string keep = test::keep_grid + "Time/Step size = 0.25\n";

  template <int dim>
  std::string
  cell(const std::string &pairs)
  {
    return std::string(dim == 2 ? "Grid/Subdivisions = 4, 4\n" :
                                  "Grid/Subdivisions = 3, 3, 3\n") +
           "Material/Young modulus = 3e4\nNewton/Tolerance = 1e-11\n"
           "Boundary conditions/Hold periodic corner = true\n"
           "Boundary conditions/Periodic sides = " +
           pairs + '\n';
  }

  template <int dim>
  double
  force(const MaterialPointMethod<dim> &problem,
        const std::string              &axis,
        const std::string              &names)
  {
    return test::get(problem, "Force " + axis + " through " + names + " (N)");
  }
} // namespace

/** Simple shear by γ: σ_xy = G γ. (With ν = 1/2 pressures would be unknown but
 * for a constant.) */
void
test_shear()
{
  const std::string u_p   = up + "Material/Poisson ratio = 0.45\n";
  const double      G     = 3e4 / 2.9;
  const std::string pairs = "left: right; bottom: top, x = 0.3*t";
  const auto        check = [&](const std::string &name,
                         const std::string &settings,
                         const double       G) {
    const auto problem = test::run_scene<2>(cell<2>(pairs) + settings);
    test::check_error("shear, " + name,
                      std::abs(
                        force(*problem, "x", "bottom and top") / (0.3 * G) - 1),
                      1e-8);
    // P e_x with P = τ F^-T and τ_yy = -G γ²/3
    test::check_error(
      "shear on the other side, " + name,
      std::abs(force(*problem, "y", "left and right") / (0.3 * 1.03 * G) - 1),
      1e-8);
  };
  check("u", u, 3e4 / 2.6);
  check("u, kept grid", u + keep, 3e4 / 2.6);
  for (const std::string quadrature : {"points", "CPDI"})
    check("u-p, " + quadrature,
          u_p + "Quadrature/Type = " + quadrature + '\n',
          G);
  check("u-p, Block FGMRES", u_p + "Linear solver/Solver = Block FGMRES\n", G);
  const auto in_space =
    test::run_scene<3>(cell<3>("left: right; bottom: top, x = 0.3*t; front: "
                               "back") +
                       u_p + "Quadrature/Type = CPDI\n");
  test::check_error("shear, 3D",
                    std::abs(
                      force(*in_space, "x", "bottom and top") / (0.3 * G) - 1),
                    1e-8);
}

/** Tension with free contraction: an incompressible cube, σ = G (λ² - 1/λ²) in
 * plane strain. */
void
test_tension()
{
  const auto problem = test::run_scene<2>(
    cell<2>("left: right, x = 0.5*t; bottom: top, force y = 0") + up);
  const double lambda = 1.5;
  test::check_error("tension with a free jump",
                    std::abs(force(*problem, "x", "left and right") /
                               (1e4 * (lambda - std::pow(lambda, -3))) -
                             1),
                    1e-8);
  test::check_error("the jump",
                    std::abs(
                      test::get(*problem, "Jump y between bottom and top (m)") -
                      (1 / lambda - 1)),
                    1e-8);
}

/** The same periodic body, another cell of it. */
void
test_shift()
{
  for (const std::string &form : {u, up})
    {
      std::vector<double> forces;
      for (const std::string inclusion :
           {"max(abs(x-0.5), abs(y-0.5)) < 0.25",
            "max(abs(abs(x-0.5)-0.5), abs(abs(y-0.5)-0.5)) < 0.25",
            "max(abs(abs(x-0.5)-0.5), abs(y-0.5)) < 0.25"})
        {
          const auto problem = test::run_scene<2>(
            cell<2>("left: right, x = 0.1*t; bottom: top, x = 0.2*t, force y "
                    "= 100*t") +
            "Grid/Subdivisions = 8, 8\nMaterial 2/Young modulus = "
            "3e5\nMaterial 2/Poisson ratio = 0.3\nMaterial points/Materials in "
            "zones = 2: " +
            inclusion + '\n' + form);
          forces.push_back(force(*problem, "x", "left and right"));
          forces.push_back(force(*problem, "x", "bottom and top"));
          forces.push_back(
            test::get(*problem, "Jump y between bottom and top (m)"));
        }
      double worst = 0;
      for (unsigned int k = 3; k < forces.size(); ++k)
        worst = std::max(worst, std::abs(forces[k] / forces[k % 3] - 1));
      test::check_error(form == u ? "a shifted cell, u" : "a shifted cell, u-p",
                        worst,
                        1e-7);
    }
}

/** Two layers, sheared: what meets across the sides, another material or the
 * same one that is not connected otherwise, is one body. */
void
test_layers()
{
  const std::string pairs = cell<2>("left: right; bottom: top, x = 1e-4*t");
  const std::string layers =
    pairs +
    "Quadrature/Type = CPDI\nGrid/Subdivisions = 4, 8\nMaterial points/Materials in zones = 2: "
    "y > 0.5\nMaterial 2/Young modulus = 3e3\n";
  const double G = 3e4 / 2.6;
  test::check_error(
    "layers",
    std::abs(force(*test::run_scene<2>(layers), "x", "bottom and top") /
               (1e-4 * 2 / (1 / G + 10 / G)) -
             1),
    1e-6);
  const auto weight = [](const std::string &settings) {
    return test::get(
      *test::run_scene<2>(
        "Quadrature/Type = CPDI\nGrid/Subdivisions = 8, 8\n"
        "Boundary conditions/Periodic sides = left: "
        "right\nBoundary conditions/Displacement = bottom: x=0, y=0\n"
        "Boundary conditions/Gravity = 1*t, 0\nPostprocess/Point probes = a: "
        "0.2, 0.999\nMaterial/Young modulus = 3e4\n"
        "Material 2/Young modulus = 3e4\n" +
        settings),
      "Displacement x of a (m)");
  };
  test::check_error("zones of one modulus, sheared by their weight",
                    test::relative(weight("Material points/Materials in zones "
                                          "= 2: x > 0.25 && x < 0.75\n"),
                                   weight("")),
                    2e-3); // a tie is not the same as common nodes
}

void
test_error(const std::string &name,
           const std::string &settings,
           const std::string &text)
{
  std::string message;
  try
    {
      test::run_scene<2>(settings);
    }
  catch (const std::exception &exc)
    {
      message = test::one_line(exc.what());
    }
  test::check(name, message.find(text) != std::string::npos, message);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_shear();
  test_tension();
  test_shift();
  test_layers();
  test_error("sides that don't match",
             "Grid/Subdivisions = 4, 3\nBoundary conditions/Periodic sides = "
             "left: top\n",
             "the sides <left> and <top> of <Boundary conditions/Periodic "
             "sides> don't match");
  test_error(
    "bodies that meet across sides",
    cell<2>("left: right") +
      "Quadrature/Type = CPDI\nMaterial points/Bodies = a: x < 0.5; b: x > 0.5\n",
    "The bodies <b> and <a> meet across <Boundary conditions/Periodic "
    "sides>");
  return 0;
}
