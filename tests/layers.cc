/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Two layers, one on the other, between smooth sides: the mean stress jumps
// between them, which the pressures of the mixed form can't. Their error is of
// first order in the size of cells, and told of; the u form has none.

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

  struct Result
  {
    double settlement; ///< of the interface (m)
    bool   told;
  };

  Result
  settle(const std::string &form,
         const unsigned int n_rows,
         const double       nu_below,
         const double       nu_above)
  {
    std::ostringstream scene;
    scene << "Grid/Upper corner = 0.5, 1\nGrid/Subdivisions = 2, " << n_rows
          << "\nMaterial points/Materials in zones = 2: y > 0.5\n"
          << "Material/Young modulus = " << E_below
          << "\nMaterial/Poisson ratio = " << nu_below
          << "\nMaterial 2/Young modulus = " << E_above
          << "\nMaterial 2/Poisson ratio = " << nu_above
          << "\nFormulation/Type = " << form
          << "\nBoundary conditions/Displacement = left: x=0; right: x=0; "
             "bottom: y=0\nBoundary conditions/Traction = top: 0, "
          << -load << "*t\nPostprocess/Point probes = middle: 0.25, 0.5\n";
    const auto problem = test::run_scene<2>(scene.str());
    Result result{test::get(*problem, "Displacement y of middle (m)"), false};
    for (const auto &warning : problem->all_warnings().all())
      result.told = result.told || warning.subject == subject;
    return result;
  }

  /** Of the settlement of the interface, if Poisson's ratios are 0.3 and 0.499.
   */
  double
  error(const std::string &form, const unsigned int n_rows, const bool told)
  {
    const Result result = settle(form, n_rows, 0.3, 0.499);
    test::check("told of the interface, " + form + ", " +
                  std::to_string(n_rows) + " rows",
                result.told == told,
                result.told ? "it is" : "it isn't");
    return result.settlement / (-load / 2 / modulus(0.3)) - 1;
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  // strains are below 1e-5
  test::check_error("u", std::abs(error("u", 8, false)), 2e-4);
  const double coarse = error("u-p", 8, true), fine = error("u-p", 32, true);
  test::check("u-p is of first order",
              std::abs(coarse / fine - 4) < 1 && std::abs(coarse) > 0.05,
              std::to_string(coarse) + ", " + std::to_string(fine));
  test::check("not told where both are nearly incompressible",
              !settle("u-p", 8, 0.49, 0.499).told,
              "it is");
}
