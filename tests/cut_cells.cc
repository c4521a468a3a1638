/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Nodes that hardly any material touches follow well filled cells: exact for
// linear fields, with prescribed and one-sided components, on kept grids; no
// load is carried, so that a vertical cut falls; and bodies thinner than a
// cell.

#include <cmath>

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** The largest value of a column over the steps of the scene run last; 0 if
   * there is none. */
  double
  largest(const std::string &column)
  {
    double most = 0;
    for (const double value : test::recorded().columns[column])
      most = std::max(most, value);
    return most;
  }

  double
  most_tied()
  {
    return largest("Tied nodes");
  }

  double
  largest_share()
  {
    return largest("Share of ties in internal work");
  }

  template <int dim>
  test::ProblemPointer<dim>
  run(const std::string &settings)
  {
    return test::run_scene<dim>("Postprocess/Write grid = false\n"
                                "Postprocess/Write material points = false\n" +
                                settings);
  }

  bool
  has_warned(const Warnings &warnings, const std::string &subject)
  {
    // rank 0 prints, all have them
    for (const auto &warning : warnings.all())
      if (warning.subject == subject)
        return true;
    return false;
  }

  /** Homogeneous tension of a body whose right side fills a column of cells by
   * 5 %: the nodes beyond are tied, but for the prescribed components of those
   * in the corners. Stress from a root finder on the law's closed form, see
   * quadrature.cc. The grid follows the body. */
  void
  test_linear_field(const std::string &formulation,
                    const unsigned int steps_between_resets)
  {
    const auto problem =
      run<2>("Grid/Upper corner = 1.075, 1\nGrid/Subdivisions = 16, 16\n"
             "Quadrature/Type = CPDI\n"
             "Formulation/Type = " +
             formulation +
             "\nGrid/Stretch = y: 0 -> 0, 1 -> 0.5*t\n"
             "Material points/Lattice spacing = 0.025\n"
             "Material points/Region = x < 0.675\n"
             "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.499\n"
             "Boundary conditions/Displacement = left: x=0; bottom: y=0; "
             "top: y=0.5*t\nTime/Step size = 0.1\n"
             "Grid reset/Steps between resets = " +
             std::to_string(steps_between_resets) +
             "\nPostprocess/Exact stress = yy: 42.0152039363\n");
    const double       error = test::get(*problem, "L2 error of stress yy");
    std::ostringstream details;
    details << "error " << error << ", tied " << most_tied() << ", share "
            << largest_share();
    test::check("linear field, " + formulation + ", reset after " +
                  std::to_string(steps_between_resets),
                error < 1e-9 && most_tied() > 5 && largest_share() < 1e-3,
                details.str());
  }

  /** A block in a box, pushed against its right wall, where it fills an eighth
   * of the uppermost cells: the wall carries it. Pulled away, it lets go. */
  template <int dim>
  void
  test_one_sided(const std::string &quadrature, const double push)
  {
    const std::string third   = dim == 2 ? "" : ", 0.5";
    const auto        problem = run<dim>(
      std::string("Grid/Subdivisions = 4, 4") + (dim == 2 ? "" : ", 2") +
      "\nGrid/Upper corner = 1, 1" + third +
      "\nQuadrature/Type = " + quadrature +
      "\nMaterial points/Lattice spacing = 0.03125\n"
             "Material points/Region = y < 0.5 || (y < 0.53125 && x > 0.5)\n"
             "Formulation/Type = u\nMaterial/Young modulus = 1e4\n"
             "Material/Poisson ratio = 0.3\nMaterial/Density = 1\n"
             "Boundary conditions/Displacement = bottom: y=0; " +
      (push > 0 ? "" : "left: x=0; ") + (dim == 2 ? "" : "front: z=0; ") +
      "\nBoundary conditions/Walls = right: n >= 0\n"
             "Postprocess/Reactions = left\n"
             "Boundary conditions/Gravity = " +
      test::in_short(push) + ", -1" + (dim == 2 ? "" : ", 0") + '\n');
    const Statistics &values = test::last_statistics(*problem);
    const double wall = values.get("Force x on body by boundary right (N)");
    const double left = values.get("Reaction x on left (N)");
    const double load = push * values.get("Mass (kg)");
    std::ostringstream details;
    details << "wall " << wall << ", left " << left << ", load " << load
            << ", tied " << most_tied();
    test::check("one-sided wall, " + quadrature + ", " + std::to_string(dim) +
                  "D, push " + test::in_short(push),
                std::abs((push > 0 ? wall : left) + load) < 1e-7 &&
                  (push > 0 || wall == 0) && most_tied() > 0,
                details.str());
  }

  /** A plate of some hundredth of a cell: nothing to tie to. It runs, and
   * says so. */
  void
  test_thin_body()
  {
    const auto problem =
      run<2>("Grid/Subdivisions = 4, 4\nQuadrature/Type = CPDI\n"
             "Material points/Lattice spacing = 0.005\n"
             "Material points/Region = y > 0.49 && y < 0.5\n"
             "Formulation/Type = u\nMaterial/Young modulus = 1e4\n"
             "Material/Poisson ratio = 0\n"
             "Boundary conditions/Displacement = left: x=0; right: x=0.01*t; "
             "bottom: y=0\nPostprocess/Reactions = right\n");
    const double       force = test::get(*problem, "Reaction x on right (N)");
    std::ostringstream details;
    details << "force " << force << ", tied " << most_tied();
    test::check("a body thinner than a cell",
                std::abs(force - 0.995) < 0.02 &&
                  has_warned(test::all_warnings(*problem),
                             "a part of the body too thin for the grid"),
                details.str());
  }

  /** A bar of a point over its height bends: its nodes outside hand on what
   * they carry. */
  void
  test_what_ties_carry()
  {
    const auto problem =
      run<2>("Grid/Lower corner = 0, -1\nGrid/Upper corner = 1.25, 0.5\n"
             "Grid/Subdivisions = 10, 12\nQuadrature/Type = CPDI\n"
             "Material points/Region = x < 1 && y > 0 && y < 0.125\n"
             "Material points/Points per cell = 1\n"
             "Material/Young modulus = 1e7\nMaterial/Poisson ratio = 0.499\n"
             "Material/Density = 1000\n"
             "Boundary conditions/Displacement = left: x=0, y=0\n"
             "Boundary conditions/Gravity = 0, -t\nTime/Step size = 0.5\n");
    std::string told;
    for (const auto &warning : test::all_warnings(*problem).all())
      if (warning.subject == "a part of the body too thin for the grid")
        told = warning.text;
    test::check("what ties carry",
                told.find("% of the internal work") != std::string::npos,
                told);
  }

  /** When the crest of a vertical cut of the height 4 m and the weight γ H/c =
   * 8 t starts to run, faster than ten times its speed at the start. Exact, for
   * φ = 20°: γ H/c = 5.4 to 5.5, t = 0.68; with eight cells over H the grid
   * adds some 10 %. */
  double
  collapse(const std::string &quadrature, const bool extends)
  {
    std::streambuf *const buffer = std::cerr.rdbuf(nullptr);
    try
      {
        run<2>("Grid/Upper corner = 12, 6\nGrid/Subdivisions = 24, 12\n"
               "Grid/Diagonals = backslash\n"
               "Material points/Region = y < 1 || (y < 5 && x < 5)\n"
               "Material points/Points per cell = 4\nQuadrature/Type = " +
               quadrature +
               "\nCut cells/Extension = " + (extends ? "auto" : "never") +
               "\nMaterial/Model = Mohr-Coulomb\nMaterial/Young modulus = 1e7\n"
               "Material/Poisson ratio = 0.49\nMaterial/Density = 2000\n"
               "Material/Mohr-Coulomb/Cohesion = 1e4\n"
               "Material/Mohr-Coulomb/Friction angle = 20\n"
               "Material/Mohr-Coulomb/Dilation angle = 20\n"
               "Boundary conditions/Displacement = left: x=0; right: x=0; "
               "bottom: x=0, y=0\nBoundary conditions/Gravity = 0, -10*t\n"
               "Newton/Reuse factorisation = 0\nNewton/Tolerance = 1e-5\n"
               "Time/Step size = 0.02\nTime/Minimum step size = 1e-3\n"
               "Postprocess/Point probes = crest: 4.99, 4.99\n");
      }
    catch (const std::exception &)
      {} // the end of the load
    std::cerr.rdbuf(buffer);
    const std::vector<double> &times   = test::recorded().times;
    auto                      &columns = test::recorded().columns;
    const auto crest = [&](const unsigned int n) { // how far it has moved
      return std::hypot(columns["Displacement x of crest (m)"].at(n),
                        columns["Displacement y of crest (m)"].at(n));
    };
    const double speed = crest(4) / times.at(4);
    for (unsigned int n = 1; n < times.size(); ++n)
      if (crest(n) - crest(n - 1) > 10 * speed * (times[n] - times[n - 1]))
        return times[n];
    return times.back();
  }

  void
  test_vertical_cut(const std::string &quadrature)
  {
    const double       with    = collapse(quadrature, true);
    const double       without = collapse(quadrature, false);
    std::ostringstream details;
    details << with << ", without extension " << without;
    test::check("collapse of a vertical cut, " + quadrature,
                std::abs(with - without) < 0.01 * without && with > 0.68 &&
                  with < 1.2 * 0.68,
                details.str());
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test::record_columns({"Tied nodes",
                        "Share of ties in internal work",
                        "Displacement x of crest (m)",
                        "Displacement y of crest (m)"});
  for (const std::string formulation : {"u-p"})
    for (const unsigned int steps : {1, 4})
      test_linear_field(formulation, steps);
  for (const double push : {1., -1.})
    test_one_sided<2>("CPDI", push);
  test_one_sided<3>("CPDI", 1.);
  test_thin_body();
  test_what_ties_carry();
  test_vertical_cut("CPDI");
  return 0;
}
