/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Stiff bodies whose vibrations the steps don't resolve, where the grid, its
// free nodes or the points change: no force is the answer, and energies are
// those of statics.

#include <map>

#include "scene.h"

using namespace isochor;

/** Columns of the statistics by step, of the scene run last. */
std::vector<std::map<std::string, double>> rows;

/** The largest error of the acceleration of the points, which is to be this. */
double expected_acceleration = 0, worst_acceleration = 0;

namespace isochor
{
  template <int dim>
  class Rows : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      const PointLayout &l = result.points.layout();
      for (const auto &particle : result.points.handler())
        for (unsigned int d = 0; d < dim; ++d)
          test::add_error(worst_acceleration,
                          std::abs(
                            particle.get_properties()[l.acceleration + d] -
                            (d == 1 ? expected_acceleration : 0.)));
      std::map<std::string, double> row;
      row["time"] = result.step.time;
      for (const char *const column : {"Reaction x on left (N)",
                                       "Reaction y on bottom (N)",
                                       "Strain energy (J)",
                                       "Energy lost by the scheme (J)"})
        try
          {
            row[column] = statistics.get(column);
          }
        catch (const std::exception &)
          {}
      rows.push_back(row);
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Rows, "Z: after all others")
} // namespace isochor

const std::string stiff = "Quadrature/Type = CPDI\n"
                          "Dynamics/Inertia = true\n"
                          "Material/Density = 100\n"
                          "Time/Step size = 0.01\n";
/** The weight comes within 0.2 s, so slowly that it is at rest. */
const std::string slowly = "*if(t<0.2, (1 - cos(pi*t/0.2))/2, 1)";

/** A block under its weight: the largest error of what holds it, over that,
 * after t = 0.2, and where energies don't add up, over the strain energy. */
template <int dim>
void
test_weight(const std::string &name,
            const std::string &settings,
            const std::string &column,
            const double       tolerance,
            const bool         with_energy = true)
{
  rows.clear();
  const auto   problem = test::run_scene<dim>(stiff + settings);
  const double weight  = 10 * test::get(*problem, "Mass (kg)");
  double       worst = 0, lost = 0;
  for (const auto &row : rows)
    if (row.at("time") > 0.205)
      test::add_error(worst, std::abs(row.at(column) / weight - 1));
    else if (row.at("time") > 0.195)
      test::add_error(lost,
                      std::abs(row.at("Energy lost by the scheme (J)")) /
                        row.at("Strain energy (J)"));
  test::check_error(name + ": force", worst, tolerance);
  if (with_energy)
    test::check_error(name + ": energy", lost, 2e-3);
}

/** Of a block on an adaptive grid with cells of a size that jumps. */
std::string
changing(const std::string &before, const std::string &after)
{
  return "Grid/Type = adaptive\nAdaptive grid/Hysteresis = 0\n"
         "Adaptive grid/Maximum level = 3\nAdaptive grid/Cell size = "
         "if(t < 0.245, " +
         before + ", " + after + ")\nTime/End time = 0.35\n";
}

void
test_changing_grids()
{
  const std::string plane = "Grid/Upper corner = 4, 4\n"
                            "Grid/Subdivisions = 4, 4\n"
                            "Material points/Region = x < 1.1 && y < 1.1\n"
                            "Material points/Points per cell = 3\n"
                            "Postprocess/Reactions = bottom, left\n",
                    along_y =
                      "Boundary conditions/Displacement = bottom: y=0; "
                      "left: x=0\nBoundary conditions/Gravity = 0, -10" +
                      slowly + '\n',
                    along_x = "Boundary conditions/Displacement = bottom: y=0; "
                              "left: x=0\nBoundary conditions/Gravity = -10" +
                              slowly + ", 0\n";
  const std::string finer   = changing("0.5", "0.25"),
                    coarser = changing("0.25", "0.5");
  const std::string y       = "Reaction y on bottom (N)",
                    x       = "Reaction x on left (N)",
                    E       = "Material/Young modulus = 1e9\n";
  test_weight<2>("finer", plane + E + along_y + finer, y, 1e-3);
  test_weight<2>("finer, along x", plane + E + along_x + finer, x, 1e-3);
  test_weight<2>("finer, nearly incompressible",
                 plane + E + along_y + finer +
                   "Material/Poisson ratio = 0.499\n",
                 y,
                 1e-3);
  test_weight<2>("finer, u",
                 plane + E + along_y + finer + "Formulation/Type = u\n",
                 y,
                 1e-3);
  test_weight<2>("coarser", plane + E + along_y + coarser, y, 1e-3);
  test_weight<3>("finer in space",
                 "Grid/Upper corner = 2, 2, 2\nGrid/Subdivisions = 2, 2, 2\n"
                 "Material points/Region = x < 1.1 && y < 1.1 && z < 1.1\n"
                 "Postprocess/Reactions = bottom\n" +
                   E +
                   "Boundary conditions/Displacement = bottom: y=0; left: x=0; "
                   "back: z=0\nBoundary conditions/Gravity = 0, -10" +
                   slowly + ", 0\n" + finer,
                 y,
                 1e-3);
}

/** A disc slides over the ground, so that its nodes become free and are tied:
 * with the forces that this makes its weight was wrong by 3e-3. */
void
test_free_nodes()
{
  test_weight<2>("sliding disc",
                 "Grid/Upper corner = 4, 2\nGrid/Subdivisions = 16, 8\n"
                 "Material points/Region = "
                 "(x-0.8)*(x-0.8)+(y-0.3)*(y-0.3) < 0.3\n"
                 "Material points/Points per cell = 9\n"
                 "Material/Young modulus = 1e10\n"
                 "Boundary conditions/Displacement = bottom: y=0\n"
                 "Boundary conditions/Gravity = 0, -10" +
                   slowly +
                   "\nDynamics/Initial velocity = 3, 0\n"
                   "Postprocess/Reactions = bottom\nTime/End time = 0.6\n",
                 "Reaction y on bottom (N)",
                 3e-4,
                 false);
}

/** What is written as the acceleration of the points is all of it. */
void
test_acceleration_of_points()
{
  expected_acceleration = -10;
  worst_acceleration    = 0;
  test::run_scene<2>(stiff + "Grid/Lower corner = 0, -2\n"
                             "Grid/Upper corner = 2, 2\n"
                             "Grid/Subdivisions = 8, 16\n"
                             "Material points/Region = x > 0.5 && x < 1.5 && "
                             "y > 0.5 && y < 1.5\n"
                             "Boundary conditions/Gravity = 0, -10\n"
                             "Newton/Tolerance = 1e-10\n"
                             "Time/End time = 0.5\n");
  test::check_error("acceleration in free fall", worst_acceleration, 1e-6);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_changing_grids();
  test_free_nodes();
  test_acceleration_of_points();
  return 0;
}
