/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Linear equations in 3D: curved walls against the closed form of a hollow
// sphere, and a slab between periodic sides against the same body in plane
// strain.

#include <isochor/base/finite_rotation.h>
#include <isochor/base/parameter_file.h>
#include <isochor/boundary_condition/wall_surface.h>

#include "mesh_file.h"

using namespace isochor;
using test::get;
using test::get_vector;
using test::relative;

namespace
{
  using Vector3 = Tensor<1, 3>;

  /** An eighth of the hollow sphere 1 < r < 2, turned by @p R: n x n / 2 x n
   * prisms, each of three tetrahedra. */
  std::string
  sphere(const unsigned int n, const Tensor<2, 3> &R, const std::string &name)
  {
    struct Node
    {
      std::array<unsigned int, 4> at; // place in the triangle, and layer
      Point<3>                    x;
    };
    std::vector<Node>                                   nodes;
    std::map<std::array<unsigned int, 3>, unsigned int> number;
    for (unsigned int layer = 0; layer <= n; ++layer)
      for (unsigned int i = 0; i <= n; ++i)
        for (unsigned int j = 0; i + j <= n; ++j)
          {
            Vector3 d({double(i), double(j), double(n - i - j)});
            d *= (1 + double(layer) / n) / d.norm();
            number[{{i, j, layer}}] = nodes.size();
            nodes.push_back({{{i, j, n - i - j, layer}}, Point<3>(R * d)});
          }
    std::vector<std::array<unsigned int, 4>> cells;
    const auto add_prism = [&](std::array<std::array<unsigned int, 2>, 3> foot,
                               const unsigned int layer) {
      std::sort(foot.begin(), foot.end());
      const auto at = [&](const unsigned int k, const unsigned int up) {
        return number.at({{foot[k][0], foot[k][1], layer + up}});
      };
      cells.push_back({{at(0, 0), at(1, 0), at(2, 0), at(2, 1)}});
      cells.push_back({{at(0, 0), at(1, 0), at(1, 1), at(2, 1)}});
      cells.push_back({{at(0, 0), at(0, 1), at(1, 1), at(2, 1)}});
    };
    for (unsigned int layer = 0; layer < n; ++layer)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; i + j < n; ++j)
          {
            add_prism({{{{i, j}}, {{i + 1, j}}, {{i, j + 1}}}}, layer);
            if (i + j + 1 < n)
              add_prism({{{{i + 1, j}}, {{i + 1, j + 1}}, {{i, j + 1}}}},
                        layer);
          }
    std::vector<Point<3>>    vertices;
    std::vector<CellData<3>> tetrahedra;
    for (const Node &node : nodes)
      vertices.push_back(node.x);
    for (const auto &cell : cells)
      {
        CellData<3> data(4);
        data.vertices.assign(cell.begin(), cell.end());
        const auto x = [&](const unsigned int v) { return vertices[cell[v]]; };
        if (cross_product_3d(x(1) - x(0), x(2) - x(0)) * (x(3) - x(0)) < 0)
          std::swap(data.vertices[0], data.vertices[1]);
        tetrahedra.push_back(data);
      }
    // the planes x, y, z = 0, inside and outside
    return test::write_mesh<3>(name,
                               vertices,
                               tetrahedra,
                               {"yz", "zx", "xy", "inner", "outer"},
                               [&](const unsigned int v,
                                   const unsigned int side) {
                                 const auto &at = nodes[v].at;
                                 return side < 3 ? at[side] == 0 :
                                                   at[3] == (side - 3) * n;
                               });
  }

  Tensor<2, 3>
  no_turn()
  {
    return unit_symmetric_tensor<3>();
  }

  Tensor<2, 3>
  some_turn()
  {
    return FiniteRotation(Vector3({0.4, -0.7, 0.3})).matrix();
  }
} // namespace

/** The smooth surface that the faces of a sphere stand for. */
void
test_surface()
{
  double distance = 0, normal = 0;
  for (const unsigned int n : {5, 10})
    {
      ParameterHandler prm;
      BackgroundGrid<3>::declare_parameters(prm);
      test::set_parameters(prm, sphere(n, some_turn(), "surface.msh"));
      BackgroundGrid<3> grid(MPI_COMM_WORLD);
      grid.parse_parameters(prm);
      grid.create();
      WallSurface<3> outer;
      outer.initialize(grid, grid.boundary_id("outer", ""));
      const double coarse_distance = distance, coarse_normal = normal;
      distance = normal = 0;
      // away from the rim, where vertices know one side of the surface only
      for (double u = 0.25; u < 0.6; u += 0.03)
        for (double v = 0.25; u + v < 0.75; v += 0.03)
          for (const double r : {1.95, 2., 2.05})
            {
              const Vector3 d({u, v, 1 - u - v});
              const auto    x     = Point<3>(some_turn() * (r / d.norm() * d));
              const auto    place = outer.locate(x);
              distance = std::max(distance, std::abs(place.distance - (2 - r)));
              normal   = std::max(normal, (place.normal + x / r).norm());
            }
      if (n == 10)
        {
          test::check("distance from a sphere, of third order at least",
                      distance < 2e-3 && distance < coarse_distance / 6,
                      std::to_string(distance) + " after " +
                        std::to_string(coarse_distance));
          test::check("normals of a sphere, of first order at least",
                      normal < 2e-2 && normal < coarse_normal / 1.8,
                      std::to_string(normal) + " after " +
                        std::to_string(coarse_normal));
        }
    }
}

/** A hollow sphere is widened from inside by δ: the pressure p is
 * E δ (b³ - a³)/(a³ ((1 - 2ν) a + (1 + ν) b³/(2 a²))) (Lamé), the energy of an
 * eighth p δ/2 π a²/2. (Reactions at the rim belong to other walls, too.) */
void
test_sphere()
{
  const double E = 1e4, nu = 0.3, a = 1, b = 2, delta = 1e-4;
  const double pressure =
    E * delta * (b * b * b - a * a * a) /
    (a * a * a * ((1 - 2 * nu) * a + (1 + nu) * b * b * b / (2 * a * a)));
  const auto energy = [&](const unsigned int  n,
                          const Tensor<2, 3> &R,
                          const std::string  &inner,
                          const std::string  &more = "") {
    const auto problem = test::run_scene<3>(
      sphere(n, R, "sphere.msh") +
      "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
      "Formulation/Type = u\nPostprocess/Write energies = always\n"
      "Newton/Tolerance = 1e-9\nBoundary conditions/Walls = yz: n = 0; zx: n "
      "= 0; xy: n = 0; inner: " +
      inner + '\n' + more);
    return get(*problem, "Strain energy (J)");
  };
  const double coarse   = energy(4, no_turn(), "n = 1e-4*t"),
               fine     = energy(8, no_turn(), "n = 1e-4*t"),
               turned   = energy(4,
                               some_turn(),
                               "n >= 1e-4*t",
                               "Quadrature/Type = CPDI\n"),
               kept     = energy(4,
                             some_turn(),
                             "n >= 1e-4*t",
                             test::keep_grid + "Quadrature/Type = CPDI\n"
                                                   "Time/Step size = 0.5\n"),
               expected = pressure * delta / 2 * numbers::PI / 2 * a * a;
  test::check_error("a hollow sphere", relative(fine, expected), 0.05);
  test::check_error("extrapolated",
                    relative((4 * fine - coarse) / 3, expected),
                    0.01);
  // what lies between the nodes is pushed, too: cells of 0.4 of the radius
  test::check_error("turned, one-sided", relative(turned, coarse), 0.07);
  test::check_error("turned, on a kept grid", relative(kept, turned), 1e-3);
}

/** Cook's membrane in plane strain, and as one layer of tetrahedra with
 * periodic sides and no displacement in z: triangles and tetrahedra have the
 * same displacements and pressures. A pressure that is linear over a triangle
 * varies by 3/4 as much in the tetrahedra over it, in the mean square. */
void
test_slab()
{
  const auto membrane = [](const unsigned int dim) {
    return std::string("Grid/Type = trapezoid\nGrid/Corners = 0, 0; 48, 44; "
                       "48, 60; 0, 44\n"
                       "Material/Young modulus = 70\nFormulation/Type = u-p\n"
                       "Formulation/Stabilisation = PPP\n"
                       "Newton/Tolerance = 1e-11\n") +
           (dim == 2 ? "Grid/Diagonals = /\nGrid/Subdivisions = 6, 6\n"
                       "Formulation/PPP coefficient = 1\n"
                       "Boundary conditions/Displacement = left: x = 0, y = 0\n"
                       "Boundary conditions/Traction = right: 0, 1/16\n"
                       "Postprocess/Point probes = A: 48, 60\n" :
                       "Grid/Depth = 3\nGrid/Subdivisions = 6, 6, 1\n"
                       "Formulation/PPP coefficient = 1.333333333333333333\n"
                       "Boundary conditions/Displacement = left: x = 0, y = 0; "
                       "front: z = 0; back: z = 0\n"
                       "Boundary conditions/Periodic sides = front: back\n"
                       "Boundary conditions/Traction = right: 0, 1/16, 0\n"
                       "Postprocess/Point probes = A: 48, 60, 0\n");
  };
  const std::string column = "Displacement y of A (m)";
  const auto        check  = [&](const std::string &name,
                         const std::string &in_plane,
                         const std::string &in_space) {
    const double plane =
      get(*test::run_scene<2>(membrane(2) + in_plane), column);
    const double slab =
      get(*test::run_scene<3>(membrane(3) + in_space), column);
    test::check_error("a periodic slab in plane strain, " + name,
                      relative(slab, plane),
                      1e-9);
  };
  const std::string half = "Material/Poisson ratio = 0.5\nMaterial "
                           "points/Points per cell = 1\n";
  check("nu = 1/2", half, half);
  const std::string nearly = "Material/Poisson ratio = 0.499\n"
                             "Formulation/Type = u\nFormulation/Stabilisation "
                             "= none\n";
  check("u", nearly, nearly);
}

/** The same by the scenes of the repository, with few cells. */
void
test_slab_scenes()
{
  const auto displacement = [](const auto &dimension, const std::string &name) {
    constexpr int     dim    = std::decay_t<decltype(dimension)>::value;
    const std::string prefix = SOURCE_DIR "/../prm/cooks_membrane";
    auto statements = read_parameter_file(prefix + name, MPI_COMM_WORLD);
    for (const std::string setting :
         {dim == 2 ? "Grid/Subdivisions=5, 5" : "Grid/Subdivisions=5, 5, 1",
          dim == 2 ? "Material points/Points per cell=3" :
                     "Material points/Points per cell=4",
          "Output/Directory=.",
          "Output/Terminal=quiet",
          "Postprocess/Write grid=false",
          "Postprocess/Write material points=false"})
      statements.push_back(parse_override(setting, "test"));
    ParameterHandler prm;
    prm.declare_entry("Dimension", "2"); // as the program does
    MaterialPointMethod<dim>::declare_parameters(
      prm, SceneSections::find(statements));
    apply_parameters(statements, prm);
    MaterialPointMethod<dim> problem(MPI_COMM_WORLD);
    problem.parse_parameters(prm);
    problem.run();
    return get(problem, "Displacement y of A (m)");
  };
  const double plane =
    displacement(std::integral_constant<int, 2>(), "/cooks_membrane.prm");
  test::check_error("Cook's membrane, a periodic slab",
                    relative(displacement(std::integral_constant<int, 3>(),
                                          "_3d/plane_strain.prm"),
                             plane),
                    1e-9);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_surface();
  test_sphere();
  test_slab();
  test_slab_scenes();
  return 0;
}
