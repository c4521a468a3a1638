/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Quadratures of the body: convergence of the stress in a settling column whose
// exact stress follows from equilibrium alone, exactness for homogeneous
// states, and the condition number with small cuts.

#include <deal.II/base/mpi.h>

#include <isochor/linear_solver/condition_number.h>

#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>

#include "scene.h"

using namespace isochor;

namespace
{
  /** The matrix of the last iteration: its condition number. */
  template <int dim>
  class ConditionProbe : public Postprocessor<dim>
  {
  public:
    static double last;
    static bool   enabled;

    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      if (enabled)
        last = scaled_condition_number(result.system.matrix());
    }
  };
  template <int dim>
  double ConditionProbe<dim>::last = 0;
  template <int dim>
  bool ConditionProbe<dim>::enabled = false;
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, ConditionProbe, "Condition")

  std::string
  common(const std::string &quadrature, const std::string &formulation)
  {
    return "Quadrature/Type = " + quadrature +
           "\nFormulation/Type = " + formulation +
           "\nFormulation/PPP coefficient = 0.1\n"
           "Postprocess/Write grid = false\n"
           "Postprocess/Write material points = false\n";
  }

  /** Relative L2 error of the vertical stress of a column of height 50. */
  template <int dim>
  double
  column_error(const std::string &quadrature,
               const std::string &formulation,
               const unsigned int n,
               const unsigned int points_per_cell)
  {
    std::ostringstream scene;
    scene << common(quadrature, formulation) << "Grid/Upper corner = 6.25, "
          << (dim == 2 ? "" : "6.25, ") << "50\n"
          << "Grid/Subdivisions = " << n / 8 << ", "
          << (dim == 2 ? "" : std::to_string(n / 8) + ", ") << n << '\n'
          << "Material points/Points per cell = " << points_per_cell << '\n'
          << "Material/Young modulus = 1e4\nMaterial/Density = 80\n"
          << "Material/Poisson ratio = " << (formulation == "u" ? 0. : 0.33)
          << "\nTime/Step size = 0.025\n"
          << "Boundary conditions/Displacement = left: x=0; right: x=0; "
          << (dim == 2 ? "bottom: y=0\n" :
                         "bottom: y=0; top: y=0; front: z=0\n")
          << "Boundary conditions/Gravity = 0, " << (dim == 2 ? "" : "0, ")
          << "-10*t\n"
          << (dim == 2 ? "Postprocess/Exact stress = yy: -800*t*(50-y)\n" :
                         "Postprocess/Exact stress = zz: -800*t*(50-z)\n");
    const auto problem = test::run_scene<dim>(scene.str());
    return problem->last_statistics().get(dim == 2 ? "L2 error of stress yy" :
                                                     "L2 error of stress zz");
  }

  void
  test_column(const std::string &quadrature,
              const std::string &formulation,
              const unsigned int points_per_cell,
              const double       largest_error)
  {
    const double coarse =
      column_error<2>(quadrature, formulation, 8, points_per_cell);
    const double fine =
      column_error<2>(quadrature, formulation, 32, points_per_cell);
    const double       order = std::log(coarse / fine) / std::log(4.);
    std::ostringstream details;
    details << "errors " << coarse << ' ' << fine << ", order " << order;
    test::check("stress in the column, " + quadrature + ", " + formulation,
                quadrature == "points" ? order < 0.3 && fine > largest_error :
                                         order > 1. && fine < largest_error,
                details.str());
  }

  /** Write a mesh of the body 0 < x < 0.8, 0 < y < 0.75 with a layer all over
   * its top. */
  void
  write_layered_body(const std::string &file_name, const double height)
  {
    constexpr unsigned int nx = 16, ny = 13;
    std::ofstream          file(file_name);
    file.precision(16);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << (nx + 1) * (ny + 1) << '\n';
    for (unsigned int j = 0; j <= ny; ++j)
      for (unsigned int i = 0; i <= nx; ++i)
        file << j * (nx + 1) + i + 1 << ' ' << 0.05 * i << ' '
             << (j == ny ? 0.75 + height : 0.0625 * j) << " 0\n";
    file << "$EndNodes\n$Elements\n" << 2 * nx * ny << '\n';
    unsigned int element = 0;
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
        {
          const unsigned int v = j * (nx + 1) + i + 1, w = v + nx + 1;
          file << ++element << " 2 2 0 1 " << v << ' ' << v + 1 << ' ' << w + 1
               << '\n';
          file << ++element << " 2 2 0 1 " << v << ' ' << w + 1 << ' ' << w
               << '\n';
        }
    file << "$EndElements\n";
  }

  /** Write a mesh of the body 0 < x < 0.8, 0 < y < 0.75 with a needle on top,
   * ten times as high as wide. */
  void
  write_needled_body(const std::string &file_name, const double height)
  {
    constexpr unsigned int nx = 16, ny = 12;
    const double           x = 0.3750001, y = 0.75, width = 0.1 * height;
    std::ofstream          file(file_name);
    file.precision(16);
    file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
         << (nx + 1) * (ny + 1) + 3 << '\n';
    for (unsigned int j = 0; j <= ny; ++j)
      for (unsigned int i = 0; i <= nx; ++i)
        file << j * (nx + 1) + i + 1 << ' ' << 0.05 * i << ' ' << 0.0625 * j
             << " 0\n";
    const unsigned int tip = (nx + 1) * (ny + 1) + 1;
    file << tip << ' ' << x << ' ' << y << " 0\n"
         << tip + 1 << ' ' << x + width << ' ' << y + height << " 0\n"
         << tip + 2 << ' ' << x << ' ' << y + height << " 0\n";
    file << "$EndNodes\n$Elements\n" << 2 * nx * ny + 1 << '\n';
    unsigned int element = 0;
    for (unsigned int j = 0; j < ny; ++j)
      for (unsigned int i = 0; i < nx; ++i)
        {
          const unsigned int v = j * (nx + 1) + i + 1, w = v + nx + 1;
          file << ++element << " 2 2 0 1 " << v << ' ' << v + 1 << ' ' << w + 1
               << '\n';
          file << ++element << " 2 2 0 1 " << v << ' ' << w + 1 << ' ' << w
               << '\n';
        }
    file << ++element << " 2 2 0 1 " << tip << ' ' << tip + 1 << ' ' << tip + 2
         << "\n$EndElements\n";
  }

  /** What a body is made of: elastic, or flowing in a part of it under its
   * weight, the upright side being free. */
  struct CutMaterial
  {
    std::string name, parameters;
    double      plastic_share; ///< of the points, at least
  };

  // The body is a vertical cut of height H = 0.75 in a soil of weight γ = 100.
  // It must not be above its own collapse load: γ H/c = 3.78 without friction
  // (here 3.1, c = 42/sqrt(3)), 5.4 with 20 degrees (here 5).
  const CutMaterial elastic  = {"Neo-Hookean", "", 0.};
  const CutMaterial j2       = {"J2", "Material/J2/Yield stress = 42\n", 0.15};
  const CutMaterial friction = {"Mohr-Coulomb",
                                "Material/Mohr-Coulomb/Cohesion = 15\n"
                                "Material/Mohr-Coulomb/Friction angle = 20\n",
                                0.03};

  /** Share of the points with plastic strain. */
  double
  plastic_share(const MaterialPointMethod<2> &problem)
  {
    const PointLayout &layout = problem.material_points().layout();
    double             n = 0, n_plastic = 0;
    for (const auto &point : problem.material_points().handler())
      {
        // the equivalent plastic strain is the last of the history
        const unsigned int alpha = layout.history + layout.n_history - 1;
        n += 1;
        n_plastic +=
          layout.n_history > 0 && point.get_properties()[alpha] > 1e-6;
      }
    return n_plastic / n;
  }

  /** A body that fills one cell more, both of whose upper nodes it alone
   * holds, by a part of its height from 0.8 to 1e-8: a volume down to 1e-17;
   * or a whole row of cells by such a part. */
  void
  test_cut(const std::string &quadrature,
           const std::string &formulation,
           const CutMaterial &material,
           const bool         layer)
  {
    double             smallest = 1e300, largest = 0, least_plastic = 1;
    unsigned int       fewest = 1000, most = 0;
    std::ostringstream details;
    for (const double fraction :
         layer ?
           std::vector<double>{
             0.8, 0.2, 0.1, 0.05, 0.02, 1e-2, 1e-4, 1e-6, 1e-8} :
           std::vector<double>{0.8, 1e-2, 1e-4, 1e-6, 1e-8})
      {
        if (layer)
          write_layered_body("body.msh", 0.125 * fraction);
        else
          write_needled_body("body.msh", 0.125 * fraction);
        std::ostringstream scene;
        scene << common(quadrature, formulation) << "Grid/Subdivisions = 8, 8\n"
              << "Material points/Body mesh = body.msh\n"
              // the needle shares no node of the mesh with the rest
              << "Material points/Bodies = one\n"
              << "Material points/Points per cell = 4\n"
              << "Material/Model = " << material.name << '\n'
              << material.parameters << "Material/Young modulus = 1e4\n"
              << "Material/Poisson ratio = 0.3\nMaterial/Density = 1\n"
              << "Boundary conditions/Displacement = left: x=0; bottom: "
                 "x=0, y=0\n"
              << "Boundary conditions/Gravity = 0, -100\n";
        ConditionProbe<2>::enabled = true;
        ConditionProbe<2>::last    = std::numeric_limits<double>::infinity();
        // deal.II's timer reports an exception on its way
        std::streambuf *const cerr = std::cerr.rdbuf(nullptr);
        try
          {
            const auto problem = test::run_scene<2>(scene.str());
            least_plastic = std::min(least_plastic, plastic_share(*problem));
          }
        catch (const std::exception &)
          {
            std::cerr.rdbuf(cerr);
            details << fraction << ": failed ";
            largest = std::numeric_limits<double>::infinity();
            continue;
          }
        std::cerr.rdbuf(cerr);
        ConditionProbe<2>::enabled = false;
        const double       c       = ConditionProbe<2>::last;
        const unsigned int n       = test::recorded().newton[0].n_iterations();
        smallest                   = std::min(smallest, c);
        largest                    = std::max(largest, c);
        fewest                     = std::min(fewest, n);
        most                       = std::max(most, n);
        details << fraction << ": " << c << " (" << n << ") ";
      }
    details << "plastic share " << least_plastic;
    test::check("condition number and iterations with " +
                  std::string(layer ? "thin layers, " : "small cuts, ") +
                  quadrature + ", " + formulation + ", " + material.name,
                quadrature == "points" ?
                  largest > 1e3 * smallest :
                  largest < 300 && most <= fewest + 1 &&
                    least_plastic >= material.plastic_share,
                details.str());
  }

  /** Tension with a grid that follows and a body that ends inside of cells.
   * The exact stress: plane strain, free to contract along x, from a root
   * finder on the closed form of the law. */
  void
  test_tension(const std::string &quadrature,
               const double       stretch,
               const double       exact,
               const double       smallest_error,
               const double       largest_error)
  {
    const std::string  elongation = std::to_string(stretch - 1) + "*t";
    std::ostringstream scene;
    scene << common(quadrature, "u-p") << "Grid/Subdivisions = 16, 16\n"
          << "Grid/Stretch = y: 0 -> 0, 1 -> " << elongation << '\n'
          << "Material points/Lattice spacing = 0.025\n"
          << "Material points/Region = if(x<0.7, 1, 0)\n"
          << "Material/Young modulus = 70\nMaterial/Poisson ratio = 0.499\n"
          << "Boundary conditions/Displacement = left: x=0; bottom: y=0; "
             "top: y="
          << elongation << "\nTime/Step size = 0.05\n"
          << "Postprocess/Exact stress = yy: " << std::setprecision(12) << exact
          << '\n';
    const auto   problem = test::run_scene<2>(scene.str());
    const double error =
      problem->last_statistics().get("L2 error of stress yy");
    std::ostringstream details;
    details << "error " << error;
    test::check("homogeneous tension, stretch " +
                  Utilities::to_string(stretch) + ", " + quadrature,
                error >= smallest_error && error <= largest_error,
                details.str());
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  test_column("points", "u", 6, 0.1);
  test_column("CPDI", "u", 4, 0.01);
  test_column("CPDI", "u-p", 4, 0.01);
  test_tension("points", 1.5, 42.0152039363, 0.1, 1.);
  test_tension("CPDI", 1.5, 42.0152039363, 0., 1e-10);
  // further on steps of this quadrature converge by chance
  test_tension("points", 2.5, 141.080477033, 0.4, 2.);
  test_tension("CPDI", 3., 205.299981029, 0., 1e-9);
  for (const std::string formulation : {"u", "u-p"})
    {
      test_cut("points", formulation, elastic, false);
      for (const CutMaterial &material : {elastic, j2, friction})
        {
          test_cut("CPDI", formulation, material, false);
        }
      // a layer makes the body higher: plastic zones would grow with it
      test_cut("CPDI", formulation, elastic, true);
    }
  return 0;
}
