/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Two layers, one on the other, between smooth sides: the mean stress jumps
// between them, which the pressures of the mixed form can't. Their error is of
// first order in the size of cells, and told of, whatever Poisson's ratios are;
// the u form has none.

#include "scene.h"

using namespace isochor;

namespace
{
  constexpr double  E_below = 1e7, E_above = 1e5, load = 100;
  const std::string subject = "materials that share pressures";

  /** Of the oedometer, below. */
  double
  modulus(const double nu)
  {
    return E_below * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
  }

  /** Of ν = 0.499 as that of the lower layer with ν = 0.49. */
  const std::string same_shear_modulus =
    "Material 2/Young modulus = " + std::to_string(E_below * 1.499 / 1.49) +
    "\n";

  struct Result
  {
    double      settlement; ///< of the interface (m)
    std::string told;       ///< the warning
  };

  const std::string lying = "Material points/Materials in zones = 2: y > 0.5\n";

  Result
  settle(const std::string &form,
         const unsigned int n_rows,
         const double       nu_below,
         const double       nu_above,
         const std::string &settings = lying)
  {
    std::ostringstream scene;
    scene << "Grid/Upper corner = 0.5, 1\nGrid/Subdivisions = 2, " << n_rows
          << "\nMaterial/Young modulus = " << E_below
          << "\nMaterial/Poisson ratio = " << nu_below
          << "\nMaterial 2/Young modulus = " << E_above
          << "\nMaterial 2/Poisson ratio = " << nu_above
          << "\nFormulation/Type = " << form
          << "\nBoundary conditions/Displacement = left: x=0; right: x=0; "
             "bottom: y=0\nBoundary conditions/Traction = top: 0, "
          << -load << "*t\nPostprocess/Point probes = middle: 0.25, 0.5\n"
          << settings;
    const auto problem = test::run_scene<2>(scene.str());
    Result     result{test::get(*problem, "Displacement y of middle (m)"), ""};
    for (const auto &warning : problem->all_warnings().all())
      if (warning.subject == subject)
        result.told = warning.text;
    return result;
  }

  /** Of the settlement of the interface, if Poisson's ratios are 0.3 and 0.499.
   */
  double
  error(const std::string &form,
        const unsigned int n_rows,
        const bool         told,
        const std::string &settings = "")
  {
    const Result result = settle(form, n_rows, 0.3, 0.499, lying + settings);
    test::check("told of the interface, " + form + ", " +
                  std::to_string(n_rows) + " rows",
                result.told.empty() != told,
                result.told);
    return result.settlement / (-load / 2 / modulus(0.3)) - 1;
  }

  /** What is told of a stiff layer on a soft one that settles by 6 % of a cell,
   * so that cells at the interface hold both. */
  std::string
  told_of_moving(const std::string &settings)
  {
    const auto problem = test::run_scene<2>(
      "Grid/Upper corner = 0.25, 1\nGrid/Subdivisions = 2, 8\n"
      "Material points/Materials in zones = 2: y > 0.5\n"
      "Material/Young modulus = 1e5\nMaterial 2/Young modulus = 1e7\n"
      "Formulation/Type = u\nQuadrature/Type = CPDI\n"
      "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
      "Boundary conditions/Traction = top: 0, -2000*t\n"
      "Time/Step size = 0.25\n" +
      settings);
    for (const auto &warning : problem->all_warnings().all())
      if (warning.subject == "materials that meet within cells")
        return warning.text;
    return "";
  }

  void
  test_moving_interface()
  {
    const std::string told = told_of_moving("");
    test::check("told of an interface that moves into cells",
                told.find("differ by up to 100 to 1") != std::string::npos &&
                  told.find("At t = 0.25 s") == 0,
                told);
    const auto test_silence = [](const std::string &settings) {
      const std::string not_told = told_of_moving(settings);
      test::check("not told, " + settings, not_told.empty(), not_told);
    };
    test_silence("Grid reset/Steps between resets = 0");
    test_silence("Quadrature/Type = cell-filled + boundary");
    test_silence("Boundary conditions/Traction = top: 0, -2*t");
    test_silence("Material 2/Young modulus = 1.2e5");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // strains are below 1e-5
  test::check_error("u", std::abs(error("u", 8, false)), 2e-5);
  const double coarse = error("u-p", 8, true), fine = error("u-p", 32, true);
  test::check("u-p is of first order",
              std::abs(coarse / fine - 4) < 1 && std::abs(coarse) > 0.05,
              std::to_string(coarse) + ", " + std::to_string(fine));
  // corners of soft domains lie a hair inside of stiff cells
  const std::string domains = "Quadrature/Type = CPDI\nTime/Step size = 0.5\n";
  const double      by_domains = error("u-p", 8, true, domains);
  test::check("the same with CPDI",
              std::abs(by_domains / coarse - 1) < 0.05,
              std::to_string(by_domains) + ", " + std::to_string(coarse));
  const double across            = error("u-p", 7, true),
               across_by_domains = error("u-p", 7, true, domains);
  test::check("the same where the interface goes through cells",
              std::abs(across_by_domains / across - 1) < 0.05 &&
                std::abs(across) < 0.17,
              std::to_string(across_by_domains) + ", " +
                std::to_string(across));

  test_moving_interface();

  // the lower layer lets the upper one give way: as wrong as above
  const Result incompressible = settle("u-p", 8, 0.49, 0.499);
  const double K_error =
    incompressible.settlement / (-load / 2 / modulus(0.49)) - 1;
  test::check("told where both are nearly incompressible",
              !incompressible.told.empty() && std::abs(K_error) > 0.05,
              std::to_string(K_error) + incompressible.told);
  const Result bulk = settle("u-p", 8, 0.49, 0.499, lying + same_shear_modulus);
  test::check("told of bulk moduli", !bulk.told.empty(), bulk.told);
  const Result alike =
    settle("u-p", 8, 0.49, 0.49, lying + "Material 2/Young modulus = 1.3e7\n");
  test::check("not told where moduli are alike",
              alike.told.empty(),
              alike.told);

  // 9 of 27 nodes, wherever ranks meet
  const Result upright = settle(
    "u-p", 8, 0.3, 0.499, "Material points/Materials in zones = 2: x > 0.25\n");
  test::check("the nodes between materials",
              upright.told.find("meet at 33.33 % of the nodes") !=
                std::string::npos,
              upright.told);

  // steel on the ground, which does not touch the rubber above
  const Result apart =
    settle("u-p",
           8,
           0.49,
           0.499,
           "Material points/Materials in zones = 2: y < 0.25\n"
           "Material points/Region = y < 0.25 || y > 0.5\n"
           "Boundary conditions/Displacement = left: x=0; right: x=0; "
           "bottom: y=0; top: y=0\nBoundary conditions/Traction = \n"
           "Boundary conditions/Gravity = 0, -1*t\n"
           "Postprocess/Point probes = middle: 0.25, 0.6\n"
           "Material 2/Young modulus = 1e9\nMaterial 2/Poisson ratio = 0.3\n");
  test::check("not told of one that does not meet the other",
              apart.told.empty(),
              apart.told);
}
