/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// One-sided walls on grids that are put back: a body touches a wall when it is
// there, not when it is in the cells next to it.

#include <fstream>

#include "scene.h"

using namespace isochor;

namespace
{
  /** By step: a column of the statistics. */
  std::map<std::string, std::vector<double>> history;
} // namespace

namespace isochor
{
  template <int dim>
  class Watch : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &, Statistics &statistics) override
    {
      for (auto &column : history)
        column.second.push_back(statistics.get(column.first));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Watch, "Z: after all others")
} // namespace isochor

template <int dim>
std::vector<double>
reactions(const std::string &settings)
{
  const std::string column = "Reaction y on bottom (N)";
  history                  = {{column, {}}};
  test::run_scene<dim>(
    "Quadrature/Type = CPDI\nMaterial points/Points per cell = " +
    std::string(dim == 2 ? "4" : "8") +
    "\nNewton/Tolerance = 1e-10\nPostprocess/Reactions = bottom\n" + settings);
  return history[column];
}

/** A mesh in gmsh's format, of vertices and triangles. */
void
write_mesh(const std::string                              &name,
           const std::vector<Point<2>>                    &vertices,
           const std::vector<std::array<unsigned int, 3>> &triangles)
{
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ofstream file(name);
      file.precision(16);
      file << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
           << vertices.size() << '\n';
      for (unsigned int v = 0; v < vertices.size(); ++v)
        file << v + 1 << ' ' << vertices[v] << " 0\n";
      file << "$EndNodes\n$Elements\n" << triangles.size() << '\n';
      for (unsigned int e = 0; e < triangles.size(); ++e)
        file << e + 1 << " 2 2 1 1 " << triangles[e][0] + 1 << ' '
             << triangles[e][1] + 1 << ' ' << triangles[e][2] + 1 << '\n';
      file << "$EndElements\n";
    }
  MPI_Barrier(MPI_COMM_WORLD);
}

/** A block half a cell above the floor comes down by this and by @p squeezed
 * more: as if it had stood there. */
template <int dim>
void
test_block(const std::string &name, const std::string &floor)
{
  const bool        in_3D = (dim == 3);
  const std::string material =
    "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
    "Formulation/Type = u\nGrid/Subdivisions = 4, 4" +
    std::string(in_3D ? ", 4\nGrid/Upper corner = 1, 1, 1\n" : "\n");
  const auto falls =
    reactions<dim>(material +
                   "Material points/Region = y > 0.125\n"
                   "Grid/Stretch = y: 0 -> 0, 1 -> -0.15*t\n"
                   "Boundary conditions/Displacement = top: x=0, " +
                   (in_3D ? "z=0, " : "") + "y = -0.15*t" + floor +
                   "\nTime/Step size = 0.2\n");
  // free to move sideways, without Poisson's effect: uniaxial
  const std::string what   = std::to_string(dim) + "D, " + name;
  double            before = 0;
  for (unsigned int step = 0; step < 4; ++step) // until 0.12 m
    before = std::max(before, std::abs(falls[step]));
  test::check_error("no force before the body is at the wall, " + what,
                    before,
                    1e-6);
  // 0.025 m of 0.875 m
  const double stretch = 0.85 / 0.875;
  // Neo-Hookean with K = E/3, G = E/2, held sideways by nothing but 0 strain is
  // the solution to first order only: 3 %
  test::check_error("force of the squeezed body, " + what,
                    std::abs(falls[4] / (1e4 * (1 - stretch)) - 1),
                    0.05);
}

/** A long rubber seal, a disc of 10 mm, between smooth plates: Hertz's theory
 * of line contact (Johnson, Contact Mechanics, 1985, 5.6) says that two plates
 * come nearer by 2 d, d = 2 P (1 - ν²) / (π E) (ln(4 R/a) - 1/2),  a² = 4 P R
 * (1 - ν²) / (π E).
 */
void
test_seal(const std::string &name, const std::string &plate)
{
  const double       R = 0.005, E = 5e6, nu = 0.4995, d = 0.00015;
  const unsigned int n_rings = 14, n_sectors = 26;
  double             P = 0;
  for (double step = 1000; step > 1e-6; step /= 2)
    {
      const double p = P + step, c = p * (1 - nu * nu) / (numbers::PI * E),
                   a = std::sqrt(4 * c * R);
      if (2 * c * (std::log(4 * R / a) - 0.5) < d)
        P = p;
    }
  std::vector<Point<2>>                    vertices = {Point<2>()};
  std::vector<std::array<unsigned int, 3>> triangles;
  for (unsigned int ring = 1; ring <= n_rings; ++ring)
    for (unsigned int s = 0; s <= n_sectors; ++s)
      {
        const double angle = numbers::PI / 2 * s / n_sectors,
                     r     = R * ring / n_rings;
        vertices.emplace_back(s == n_sectors ? 0. : r * std::cos(angle),
                              s == 0 ? 0. : r * std::sin(angle));
      }
  const auto at = [&](const unsigned int ring, const unsigned int s) {
    return ring == 0 ? 0 : 1 + (ring - 1) * (n_sectors + 1) + s;
  };
  for (unsigned int ring = 1; ring <= n_rings; ++ring)
    for (unsigned int s = 0; s < n_sectors; ++s)
      {
        triangles.push_back({{at(ring - 1, s), at(ring, s), at(ring, s + 1)}});
        if (ring > 1)
          triangles.push_back(
            {{at(ring - 1, s), at(ring, s + 1), at(ring - 1, s + 1)}});
      }
  write_mesh("disc.msh", vertices, triangles);
  const auto force = reactions<2>(
    "Grid/Upper corner = 0.0075, 0.005\nGrid/Subdivisions = 30, 20\n"
    "Grid/Stretch = y: 0 -> 0, 0.005 -> -0.00015*t\n"
    "Material points/Body mesh = disc.msh\n"
    "Material/Young modulus = 5e6\nMaterial/Poisson ratio = 0.4995\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0" +
    plate + "\nTime/Step size = 0.5\n");
  test::check_error("Hertz's force, " + name,
                    std::abs(2 * force.back() / P - 1),
                    0.05);
}

/** A wedge comes down with its edge between two vertices of the floor, 0.125
 * apart, above which its sides are higher than the edge. */
void
test_wedge()
{
  // its edge is at 0.04 over the floor
  std::vector<Point<2>>                    vertices;
  std::vector<std::array<unsigned int, 3>> triangles;
  const unsigned int                       n = 6;
  // a square on its tip, 0.04 above the floor
  for (unsigned int j = 0; j <= n; ++j)
    for (unsigned int i = 0; i <= n; ++i)
      vertices.emplace_back(0.53 + 0.4 * i / n - 0.4 * j / n,
                            0.04 + 0.4 * (i + 1. * j) / n);
  for (unsigned int j = 0; j < n; ++j)
    for (unsigned int i = 0; i < n; ++i)
      {
        const unsigned int v = j * (n + 1) + i;
        triangles.push_back({{v, v + 1, v + n + 2}});
        triangles.push_back({{v, v + n + 2, v + n + 1}});
      }
  write_mesh("wedge.msh", vertices, triangles);
  const auto force = reactions<2>(
    "Grid/Subdivisions = 8, 8\nMaterial points/Body mesh = wedge.msh\n"
    "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0\n"
    "Formulation/Type = u\n"
    "Boundary conditions/Surfaces of body = up: y > 0.439\n"
    "Boundary conditions/Mesh of body surfaces = wedge.msh\n"
    "Boundary conditions/Displacement of body = up: x=0, y=-0.05*t\n"
    "Boundary conditions/Displacement = bottom: y >= 0\n"
    "Time/Step size = 0.25\n");
  test::check_error("no force before an edge is at the wall",
                    std::abs(force[2]), // after 0.0375 m
                    1e-3);
  test::check("force of an edge at the wall",
              force[3] > 1, // after 0.05 m
              std::to_string(force[3]));
}

/** A wall that pushes a block by a third of a cell, of a grid that does not
 * follow: the vertices are behind the wall then, which stands where its formula
 * says. What is left is the error of vertices that lose the body. */
void
test_pushing_wall()
{
  const std::string block = "Grid/Subdivisions = 4, 4\n"
                            "Material/Young modulus = 1e4\n"
                            "Time/Step size = 0.25\n"
                            "Boundary conditions/Displacement = top: x=0, y=0; "
                            "bottom: y ";
  const double      kept =
    reactions<2>(block +
                 "= 0.02 + 0.06*t\nGrid reset/Steps between resets = 0\n")
      .back();
  const double linear = reactions<2>(block + ">= 0.02 + 0.06*t\n").back(),
               root   = reactions<2>(block + ">= 0.08*sqrt(t)\n").back();
  test::check_error("a pushing wall", std::abs(linear / kept - 1), 0.095);
  test::check_error("a pushing wall, steps of other sizes",
                    std::abs(root / linear - 1),
                    2e-3);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_block<2>("a displacement", "; bottom: y >= 0");
  test_block<2>("a wall", "\nBoundary conditions/Walls = bottom: n >= 0");
  test_block<3>("a displacement", "; bottom: y >= 0");
  test_seal("a displacement", "; top: y <= -0.00015*t");
  test_seal("a wall", "\nBoundary conditions/Walls = top: n >= 0.00015*t");
  test_wedge();
  test_pushing_wall();
}
