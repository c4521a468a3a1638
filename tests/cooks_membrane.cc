/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Cook's membrane with one point per cell against an independent P1 program,
// all formulations and Poisson ratios, on any number of ranks; and how fast
// Newton's method converges there.

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include "run_scene.h"

using namespace isochor;

struct Variant
{
  std::string formulation, stabilisation;
  double      ppp_coefficient, poisson_ratio;

  std::string
  label() const
  {
    std::ostringstream text;
    text << formulation;
    if (stabilisation == "PPP")
      text << " + PPP, alpha = " << ppp_coefficient;
    text << ", nu = " << poisson_ratio;
    return text.str();
  }

  std::string
  scene(const unsigned int n, const double tolerance) const
  {
    std::ostringstream text;
    text << "Grid/Type = trapezoid\n"
         << "Grid/Corners = 0, 0; 48, 44; 48, 60; 0, 44\n"
         << "Grid/Subdivisions = " << n << ", " << n << '\n'
         << "Material points/Points per cell = 1\n"
         << "Formulation/Type = " << formulation << '\n'
         << "Formulation/Stabilisation = " << stabilisation << '\n'
         << "Formulation/PPP coefficient = " << ppp_coefficient << '\n'
         << "Material/Young modulus = 70\n"
         << "Material/Poisson ratio = " << poisson_ratio << '\n'
         << "Boundary conditions/Displacement = left: x = 0, y = 0\n"
         << "Boundary conditions/Traction = right: 0, 1/16\n"
         << "Postprocess/Point probes = A: 48, 60\n"
         << "Newton/Tolerance = " << tolerance << '\n';
    return text.str();
  }
};

/** The displacement of A is known to what Newton's method and the linear
 * solver leave: ν -> 1/2 magnifies rounding errors in the u form. */
void
test_displacements(const Variant                     &variant,
                   const boost::property_tree::ptree &mesh_sizes,
                   const boost::property_tree::ptree &values)
{
  std::ostringstream details;
  bool               ok       = true;
  unsigned int       n_tested = 0;
  auto               n        = mesh_sizes.begin();
  for (const auto &reference : values)
    {
      const unsigned int n_cells = (n++)->second.get_value<unsigned int>();
      if (n_cells > 16)
        break;
      const auto   problem  = test::run_scene<2>(variant.scene(n_cells, 1e-10));
      const double u        = test::get(*problem, "Displacement y of A (m)");
      const double expected = reference.second.get_value<double>();
      ok                    = ok && std::abs(u - expected) <= 1e-9 * expected;
      details.precision(12);
      details << "n = " << n_cells << ": " << u << ", not " << expected << "; ";
      ++n_tested;
    }
  test::check("displacement of A, " + variant.label(),
              ok && n_tested == 4,
              details.str());
}

/** From zero to @p tolerance in at most five iterations, and quadratic: after
 * the first of them r_{k+1} <= 10 r_k^2 down to rounding. */
void
test_newton(const Variant &variant, const double tolerance)
{
  test::run_scene<2>(variant.scene(64, tolerance) +
                     "Newton/Reuse factorisation = 0\n");
  const NewtonReport &newton = test::recorded().newton.at(0);
  std::vector<double> r;
  std::ostringstream  details;
  for (const NewtonIteration &iteration : newton.iterations)
    {
      r.push_back(std::max(iteration.displacement, iteration.pressure));
      details << r.back() << ' ';
    }
  bool quadratic = r.size() > 3;
  for (unsigned int k = 1; k + 1 < r.size(); ++k)
    quadratic = quadratic && r[k + 1] <= std::max(10 * r[k] * r[k], tolerance);
  test::check("Newton's method in five iterations, " + variant.label(),
              newton.n_iterations() <= 5 && r.back() <= tolerance &&
                test::recorded().times.size() == 1,
              details.str());
  test::check("Newton's method is quadratic, " + variant.label(),
              quadratic,
              details.str());
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);

  boost::property_tree::ptree reference;
  boost::property_tree::read_json(SOURCE_DIR
                                  "/../prm/cooks_membrane/reference.json",
                                  reference);
  unsigned int n_variants = 0;
  for (const auto &run : reference.get_child("independent_p1.runs"))
    {
      const Variant variant{run.second.get<std::string>("formulation"),
                            run.second.get<std::string>("stabilisation"),
                            run.second.get<double>("ppp_coefficient", 1.),
                            run.second.get<double>("poisson_ratio")};
      test_displacements(variant,
                         reference.get_child("n"),
                         run.second.get_child("u_y"));
      ++n_variants;
    }
  test::check("all variants of the reference",
              n_variants == 15,
              std::to_string(n_variants));

  test_newton({"u", "none", 1., 0.33}, 1e-10);
  // the rounding of J times K limits what can be reached
  test_newton({"u", "none", 1., 0.499}, 1e-9);
  test_newton({"u-p", "none", 1., 0.499}, 1e-10);
  test_newton({"u-p", "PPP", 1., 0.499}, 1e-10);
  test_newton({"u-p", "PPP", 8., 0.5}, 1e-10);
  return 0;
}
