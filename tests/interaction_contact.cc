/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Forces of ties to places and of contact with rigid bodies, beside closed
// forms and references that are converged: doc/verification_interactions.md.

#include <array>
#include <fstream>
#include <functional>

#include "run_scene.h"

using namespace isochor;

namespace
{
  /** A mesh of triangles or tetrahedra, as a file of gmsh. */
  struct Mesh
  {
    std::vector<std::array<double, 3>>     vertices;
    std::vector<std::vector<unsigned int>> cells;

    std::string
    write(const std::string &name) const
    {
      if (test::this_rank() == 0)
        {
          std::ofstream out(name);
          out.precision(17);
          out << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n"
              << vertices.size() << '\n';
          for (unsigned int v = 0; v < vertices.size(); ++v)
            out << v + 1 << ' ' << vertices[v][0] << ' ' << vertices[v][1]
                << ' ' << vertices[v][2] << '\n';
          out << "$EndNodes\n$Elements\n" << cells.size() << '\n';
          for (unsigned int c = 0; c < cells.size(); ++c)
            {
              out << c + 1 << ' ' << (cells[c].size() == 3 ? 2 : 4) << " 2 1 1";
              for (const unsigned int v : cells[c])
                out << ' ' << v + 1;
              out << '\n';
            }
          out << "$EndElements\n";
        }
      test::wait_for_all_ranks();
      return "Quadrature/Type = CPDI\nMaterial points/Body mesh = " + name +
             '\n';
    }
  };

  /** A box of @p n cells in each of @p dim directions, halved or cut into six
   * along diagonals from the origin, and put where @p map says. */
  Mesh
  mapped_box(
    const unsigned int                                                 dim,
    const std::array<unsigned int, 3>                                 &n,
    const std::function<std::array<double, 3>(std::array<double, 3>)> &map)
  {
    Mesh       mesh;
    const auto vertex = [&](const std::array<unsigned int, 3> &i) {
      return (i[2] * (n[1] + 1) + i[1]) * (n[0] + 1) + i[0];
    };
    const std::array<unsigned int, 3> last = {
      {n[0], n[1], dim == 3 ? n[2] : 0}};
    for (unsigned int k = 0; k <= last[2]; ++k)
      for (unsigned int j = 0; j <= n[1]; ++j)
        for (unsigned int i = 0; i <= n[0]; ++i)
          mesh.vertices.push_back(
            map({{i / static_cast<double>(n[0]),
                  j / static_cast<double>(n[1]),
                  dim == 3 ? k / static_cast<double>(n[2]) : 0.}}));
    std::array<unsigned int, 3> order = {{0, 1, 2}};
    do
      {
        if (dim == 2 && order[2] != 2)
          continue;
        for (unsigned int k = 0; k < std::max(last[2], 1U); ++k)
          for (unsigned int j = 0; j < n[1]; ++j)
            for (unsigned int i = 0; i < n[0]; ++i)
              {
                std::array<unsigned int, 3> corner = {{i, j, k}};
                std::vector<unsigned int>   cell   = {vertex(corner)};
                for (unsigned int step = 0; step < dim; ++step)
                  {
                    ++corner[order[step]];
                    cell.push_back(vertex(corner));
                  }
                mesh.cells.push_back(cell);
              }
      }
    while (std::next_permutation(order.begin(), order.end()));
    return mesh;
  }

  /** Half of what is below the middle of a disc or ball of radius 1, where x
   * (and z) > 0, by @p n cells over the radius. */
  std::string
  write_ball(const unsigned int dim, const unsigned int n)
  {
    return mapped_box(dim,
                      {{n, n, n}},
                      [](std::array<double, 3> x) {
                        const double largest = std::max({x[0], x[1], x[2]}),
                                     length  = std::sqrt(
                                       x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
                        for (double &component : x)
                          component *= length > 0 ? largest / length : 0;
                        x[1] *= -1;
                        return x;
                      })
      .write("ball.msh");
  }

  /** The part of a ring up to @p angle. */
  std::string
  write_ring(const double       inner,
             const double       outer,
             const unsigned int n,
             const unsigned int n_around,
             const double       angle,
             const std::string &name = "ring.msh")
  {
    return mapped_box(2,
                      {{n, n_around, 0}},
                      [&](const std::array<double, 3> &s) {
                        const double r = inner + (outer - inner) * s[0];
                        return std::array<double, 3>{
                          {r * std::cos(angle * s[1]),
                           r * std::sin(angle * s[1]),
                           0}};
                      })
      .write(name);
  }

  const std::string incompressible =
    "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n";

  /** The bore of a thick incompressible tube or spherical shell, radii 1 and
   * 2, is widened by a tenth (G = 1): the force on its quarter, by the radial
   * equilibrium of the Neo-Hookean law. */
  void
  test_bore()
  {
    for (const bool sphere : {false, true})
      {
        const double       power = sphere ? 3 : 2, c = std::pow(1.1, power) - 1;
        double             p = 0;
        const unsigned int n = 1000;
        for (unsigned int i = 0; i < n; ++i)
          {
            // midpoint rule in R; dr = (R/r)^(power-1) dR
            const double R = 1 + (i + 0.5) / n,
                         r = std::pow(std::pow(R, power) + c, 1 / power),
                         l = r / R,
                         difference = sphere ? 2 * (l * l - std::pow(l, -4)) :
                                               l * l - 1 / (l * l);
            p += difference / r * std::pow(R / r, power - 1) / n;
          }
        const double exact = p * (sphere ? test::pi * 1.21 : 1.1);
        for (const unsigned int cells : {20, 40})
          {
            const auto problem = test::run_scene<2>(
              write_ring(1, 2, cells * 2 / 5, cells * 3 / 5, test::pi / 2) +
              incompressible + "Grid/Upper corner = 2.5, 2.5\n" +
              "Grid/Subdivisions = " + std::to_string(cells) + ", " +
              std::to_string(cells) +
              "\nBoundary conditions/Displacement = left: x=0; bottom: y=0\n" +
              (sphere ? "Formulation/Geometry = axisymmetric\n" : "") +
              "Boundary conditions/Surfaces of body = bore: x^2+y^2<1.001\n"
              "Interaction: bore - place/Displacement = x=0.1*t*x, "
              "y=0.1*t*y\n");
            test::check_error(
              (sphere ? "spherical cavity, " : "tube, ") +
                std::to_string(cells) + " cells",
              test::relative(
                test::get(*problem, "Force y on bore by place (N)"), exact),
              cells == 20 ? 0.01 : 0.003);
          }
      }
  }

  /** A quarter of a disc, or a half or quarter of a ball, moved against a
   * plane by @p way; the forces on it. */
  std::vector<double>
  squeeze(const unsigned int dim,
          const unsigned int n,
          const double       nu,
          const double       way,
          const unsigned int n_steps,
          const double       offset       = 0,
          const bool         axisymmetric = false)
  {
    const std::string force = "Force y on body by plane (N)";
    test::record_columns({force});
    std::ostringstream scene;
    scene.precision(17);
    const unsigned int wide = 14 * n / 10, high = n + 2;
    scene << write_ball(dim, n)
          << "Material/Young modulus = 1000\nMaterial/Poisson ratio = " << nu
          << "\nGrid/Lower corner = 0, " << -(high + offset) / n
          << (dim == 3 ? ", 0" : "")
          << "\nGrid/Upper corner = " << wide / static_cast<double>(n) << ", 0"
          << (dim == 3 ? ", " + std::to_string(wide / static_cast<double>(n)) :
                         "")
          << "\nGrid/Subdivisions = " << wide << ", " << high
          << (dim == 3 ? ", " + std::to_string(wide) : "")
          << "\nBoundary conditions/Displacement = left: x=0; top: y=0"
          << (dim == 3 ? "; front: z=0" : "")
          << "\nTime/Step size = " << 1. / n_steps
          << (axisymmetric ? "\nFormulation/Geometry = axisymmetric" : "")
          << "\nRigid body: plane/Shape = half plane\n"
             "Rigid body: plane/Point = 0, -1"
          << (dim == 3 ? ", 0" : "") << "\nRigid body: plane/Normal = 0, 1"
          << (dim == 3 ? ", 0" : "") << "\nRigid body: plane/Motion = y=" << way
          << "*t\nInteraction: body - plane/Law = unilateral\n";
    if (dim == 2)
      test::run_scene<2>(scene.str());
    else
      test::run_scene<3>(scene.str());
    return test::recorded().columns[force];
  }

  /** Beside a graded mesh that fits the disc and moves with it: 0.01 at the
   * contact, the same to 0.1 % as with 0.02. */
  void
  test_disc()
  {
    for (const auto &[nu, reference] :
         std::vector<std::pair<double, std::array<double, 3>>>{
           {0.3, {{3.9994, 21.705, 73.940}}},
           {0.4999, {{4.886, 26.969, 95.834}}}})
      {
        const auto         force      = squeeze(2, 40, nu, 0.15, 10);
        const double       squeezed[] = {1.5, 6, 15};
        const unsigned int step[]     = {0, 3, 9};
        for (unsigned int i = 0; i < 3 && force.size() == 10; ++i)
          test::check_error("disc squeezed by " + test::in_short(squeezed[i]) +
                              " %, nu = " + test::in_short(nu),
                            test::relative(force[step[i]], reference[i]),
                            i == 0 ? 0.01 : 0.005);
      }
    double least = 1e300, most = 0;
    for (const double offset : {0.1, 0.35, 0.6, 0.85})
      {
        const double force = squeeze(2, 20, 0.3, 0.06, 3, offset).back();
        least              = std::min(least, force);
        most               = std::max(most, force);
      }
    test::check_error("spread with the place of the grid",
                      most / least - 1,
                      0.005);
    std::array<double, 3> by_steps;
    for (unsigned int i = 0; i < 3; ++i)
      by_steps[i] = squeeze(2, 20, 0.3, 0.15, 3 << i).back();
    test::check_error("spread with the size of the step",
                      std::max(test::relative(by_steps[0], by_steps[2]),
                               test::relative(by_steps[1], by_steps[2])),
                      0.003);
  }

  /** Hertz: F = 4/3 E/(1-ν²) √R d^(3/2) for small d; for d of 2 % of R a graded
   * mesh has 1.065 times that. */
  void
  test_hertz()
  {
    const auto hertz = [](const double d) {
      return 4. / 3 * 1000 / (1 - 0.09) * d * std::sqrt(d);
    };
    test::check_error(
      "sphere against a plane, Hertz",
      test::relative(squeeze(2, 20, 0.3, 0.005, 2, 0, true).back(),
                     hertz(0.005)),
      0.02);
    test::check_error(
      "and beyond",
      test::relative(squeeze(2, 20, 0.3, 0.02, 2, 0, true).back(), 4.414),
      0.02);
    test::check_error(
      "in space, a quarter",
      test::relative(4 * squeeze(3, 8, 0.3, 0.1, 2).back(),
                     squeeze(2, 40, 0.3, 0.1, 2, 0, true).back()),
      0.03);
  }

  /** A bonded bush, radii 3 and 4, whose pin is moved sideways: per length
   *   4 π G / (ln(b/a) - (b² - a²)/(b² + a²)). */
  void
  test_bush()
  {
    const double exact = 4 * test::pi * 1e-4 / (std::log(4. / 3) - 7. / 25);
    const auto   bush  = test::run_scene<2>(
      write_ring(3, 4, 7, 168, 2 * test::pi * (1 - 1e-12)) +
      "Grid/Lower corner = -4.4, -4.4\nGrid/Upper corner = 4.4, 4.4\n"
         "Grid/Subdivisions = 59, 59\nMaterial/Young modulus = 3\n"
         "Material/Poisson ratio = 0.499999\n"
         "Boundary conditions/Surfaces of body = in: x^2+y^2<10; "
         "out: x^2+y^2>15\n"
         "Interaction: out - place/Displacement = x=0, y=0\n"
         "Rigid body: pin/Shape = circle\nRigid body: pin/Centre = 0, 0\n"
         "Rigid body: pin/Radius = 3\nRigid body: pin/Motion = x=1e-4*t\n"
         "Interaction: in - pin/Law = tie\n");
    test::check_error(
      "bonded bush",
      test::relative(test::get(*bush, "Force x on in by pin (N)"), exact),
      0.01);
  }

  /** A rough or smooth strip punch, half width 1, on a layer of J2 with c = 1,
   * over 2 + π. */
  double
  punch(const unsigned int n, const std::string &law)
  {
    std::ostringstream scene;
    scene << "Quadrature/Type = CPDI\nGrid/Upper corner = 5, " << 3 + 2. / n
          << "\nGrid/Subdivisions = " << 5 * n << ", " << 3 * n + 2
          << "\nMaterial points/Region = y<3\nMaterial points/Points per cell "
             "= 4\nMaterial/Model = J2\nMaterial/J2/Yield stress = 1.7320508\n"
             "Material/Young modulus = 300\nMaterial/Poisson ratio = 0.4999\n"
             "Boundary conditions/Displacement = left: x=0; right: x=0; "
             "bottom: x=0, y=0\nRigid body: punch/Shape = box\n"
             "Rigid body: punch/Lower corner = -1, 3\n"
             "Rigid body: punch/Upper corner = 1, 5\n"
             "Rigid body: punch/Motion = y=-0.06*t\nTime/Step size = 0.1667\n"
             "Interaction: body - punch/Law = "
          << law << '\n';
    return std::abs(test::get(*test::run_scene<2>(scene.str()),
                              "Force y on body by punch (N)")) /
           (2 + test::pi);
  }

  void
  test_punch()
  {
    for (const std::string law :
         {"unilateral",
          "Coulomb\nInteraction: body - punch/Friction coefficient = 100"})
      {
        const double at_2 = punch(2, law), at_4 = punch(4, law),
                     at_8 = punch(8, law);
        test::check((law[0] == 'u' ? "smooth" : "rough") +
                      std::string(" punch: limit load from above"),
                    at_2 < 1.3 && at_4 < 1.16 && at_8 < 1.11 && at_8 > 1 &&
                      at_4 > at_8 && at_2 > at_4,
                    test::in_short(at_2) + ' ' + test::in_short(at_4) + ' ' +
                      test::in_short(at_8));
      }
  }

  /** A circle that is moved by six times the thickness of a sheet pushes it,
   * in one step, which is cut, or in eight. */
  void
  test_sheet()
  {
    const auto force = [](const std::string &step) {
      return test::get(
        *test::run_scene<2>(
          "Quadrature/Type = CPDI\nGrid/Lower corner = -2, -2\n"
          "Grid/Upper corner = 2, 2\n"
          "Grid/Subdivisions = 40, 40\nMaterial/Young modulus = 1000\n"
          "Material points/Region = abs(x) < 1 && abs(y) < 0.1\n"
          "Boundary conditions/Surfaces of body = ends: abs(x) > 0.999\n"
          "Interaction: ends - place/Displacement = x=0, y=0\n"
          "Interaction: body - tool/Law = unilateral\n"
          "Rigid body: tool/Shape = circle\nRigid body: tool/Radius = 0.25\n"
          "Rigid body: tool/Centre = 0, 0.4\n"
          "Rigid body: tool/Motion = y=-1.2*t\nTime/Step size = " +
          step + '\n'),
        "Force y on body by tool (N)");
    };
    const double in_eight = force("0.125"), in_one = force("1");
    test::check("a sheet that is met within a step",
                in_eight < -100 && test::relative(in_one, in_eight) < 0.05,
                test::in_short(in_one) + ' ' + test::in_short(in_eight));
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_bore();
  test_disc();
  test_hertz();
  test_bush();
  test_punch();
  test_sheet();
  return 0;
}
