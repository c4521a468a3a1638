/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Smooth walls of any direction: a scene that is turned has the answer of the
// one along the axes, whose conditions are those of 'Displacement'; forces of
// inclined planes and of curved walls have closed forms.

#include <isochor/boundary_condition/wall_surface.h>

#include <fstream>

#include "scene.h"

using namespace isochor;

namespace
{
  /** The unit square, or a prism of it, turned by @p degrees about z. */
  std::string
  turned_box(const double degrees)
  {
    const double       a = degrees / 180 * numbers::PI;
    std::ostringstream text;
    text.precision(17);
    text << "Grid/Type = trapezoid\nGrid/Corners = 0, 0; " << std::cos(a)
         << ", " << std::sin(a) << "; " << std::cos(a) - std::sin(a) << ", "
         << std::sin(a) + std::cos(a) << "; " << -std::sin(a) << ", "
         << std::cos(a) << '\n';
    return text.str();
  }

  /** The reaction on @p boundary in the last step. */
  template <int dim>
  Tensor<1, dim>
  reaction(const MaterialPointMethod<dim> &problem, const std::string &boundary)
  {
    Tensor<1, dim> force;
    for (unsigned int a = 0; a < dim; ++a)
      force[a] = problem.last_statistics().get(
        std::string("Reaction ") + "xyz"[a] + " on " + boundary + " (N)");
    return force;
  }

  /** The same of a wall that only pushes. */
  template <int dim>
  Tensor<1, dim>
  force(const MaterialPointMethod<dim> &problem, const std::string &boundary)
  {
    Tensor<1, dim> force;
    for (unsigned int a = 0; a < dim; ++a)
      force[a] = problem.last_statistics().get(
        std::string("Force ") + "xyz"[a] + " on body by boundary " + boundary +
        " (N)");
    return force;
  }

  unsigned int
  most_iterations()
  {
    unsigned int most = 0;
    for (const auto &newton : test::recorded().newton)
      most = std::max(most, newton.n_iterations());
    return most;
  }
} // namespace

/** Tension of a block between smooth walls, one of which is drawn away. */
template <int dim>
void
test_tension(const std::string &name,
             const std::string &settings,
             const double       tolerance = 1e-7)
{
  const std::string block =
    std::string(dim == 2 ? "Grid/Subdivisions = 4, 4\n" :
                           "Grid/Subdivisions = 3, 3, 2\n") +
    "Material/Young modulus = 1e4\nPostprocess/Reactions = right\n"
    "Newton/Tolerance = 1e-10\n" +
    settings;
  const std::string sides = dim == 2 ? "" : "; front: z = 0; back: z = 0.05*t";
  const auto        along_axes =
    test::run_scene<dim>(block + turned_box(0) +
                         "Boundary conditions/Displacement = left: x = 0; "
                         "bottom: y = 0; right: x = 0.2*t" +
                         sides + '\n');
  const unsigned int n_iterations = most_iterations();
  const auto         turned       = test::run_scene<dim>(
    block + turned_box(30) +
    "Boundary conditions/Walls = left: n = 0; bottom: n = 0; right: n = "
                  "-0.2*t\nBoundary conditions/Displacement = " +
    (dim == 2 ? "" : sides.substr(2)) + '\n');
  const Tensor<1, dim> expected = reaction(*along_axes, "right"),
                       found    = reaction(*turned, "right");
  const double   c = std::cos(numbers::PI / 6), s = 0.5;
  Tensor<1, dim> back = found;
  back[0]             = c * found[0] + s * found[1];
  back[1]             = -s * found[0] + c * found[1];
  test::check_error("turned tension, " + std::to_string(dim) + "D, " + name,
                    (back - expected).norm() / expected.norm(),
                    tolerance);
  test::check("as many iterations, " + std::to_string(dim) + "D, " + name,
              most_iterations() <= n_iterations + 1,
              std::to_string(most_iterations()));
}

void
test_tensions()
{
  const std::string u  = "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n";
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.499\n";
  for (const std::string quadrature : {"points", "CPDI"})
    test_tension<2>("u-p, " + quadrature,
                    up + "Quadrature/Type = " + quadrature + '\n');
  test_tension<2>("u, kept grid",
                  u + test::keep_grid + "Time/Step size = 0.25\n");
  test_tension<2>("u-p, CPDI, kept grid",
                  up + test::keep_grid +
                    "Quadrature/Type = CPDI\nTime/Step size = 0.25\n");
  test_tension<2>("u-p, Block FGMRES",
                  up + "Linear solver/Solver = Block FGMRES\n");
  test_tension<2>("u, Block FGMRES",
                  u + "Linear solver/Solver = Block FGMRES\n");
  test_tension<3>("u", u);
  test_tension<3>("u-p, CPDI", up + "Quadrature/Type = CPDI\n");
  test_tension<3>("u, Block FGMRES",
                  u + "Linear solver/Solver = Block FGMRES\n");
  // in motion: velocity of the wall, masses, trial steps
  const std::string dynamic =
    "Dynamics/Inertia = true\nMaterial/Density = 1000\nTime/End time = "
    "0.2\nTime/Step size = 0.02\n" +
    test::keep_grid;
  test_tension<2>("u, dynamic", u + dynamic);
  test_tension<2>("u-p, CPDI, dynamic",
                  up + dynamic + "Quadrature/Type = CPDI\n");
}

/** A block rests on a smooth plane of 30 degrees, and on a stop. */
void
test_plane()
{
  const std::string block =
    "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e5\n"
    "Material/Density = 100\nPostprocess/Reactions = bottom, left\n"
    "Newton/Tolerance = 1e-10\nBoundary conditions/Gravity = 0, -10*t\n" +
    turned_box(30);
  const Tensor<1, 2> n{{-0.5, std::sqrt(0.75)}}, along{{std::sqrt(0.75), 0.5}};
  const double       weight = 1000;
  for (const std::string walls :
       {"left: n = 0; bottom: n = 0", "left: n >= 0; bottom: n >= 0"})
    {
      const auto problem = test::run_scene<2>(
        block + "Boundary conditions/Walls = " + walls +
        (walls.find('>') == std::string::npos ? "\n" :
                                                "\nQuadrature/Type = CPDI\n"));
      const auto of = [&](const std::string &boundary) {
        return walls.find('>') == std::string::npos ?
                 reaction(*problem, boundary) :
                 force(*problem, boundary);
      };
      test::check_error("weight on a plane, " + walls,
                        std::abs(of("bottom") * n / weight - std::sqrt(0.75)),
                        1e-8);
      test::check_error("weight at the stop, " + walls,
                        std::abs(of("left") * along / weight - 0.5),
                        1e-8);
    }
}

/** One-sided walls push like others, and let go. */
void
test_contact()
{
  const std::string block =
    "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e4\n"
    "Quadrature/Type = CPDI\n"
    "Postprocess/Reactions = bottom, top\nNewton/Tolerance = 1e-10\n" +
    turned_box(30);
  const auto run = [&](const std::string &walls) {
    return test::run_scene<2>(block +
                              "Boundary conditions/Walls = left: n = "
                              "0; " +
                              walls + '\n');
  };
  const auto pushed = run("top: n = 0.05*t; bottom: n = 0");
  test::check_error("a one-sided wall pushes",
                    (force(*run("top: n = 0.05*t; bottom: n >= 0"), "bottom") -
                     reaction(*pushed, "bottom"))
                        .norm() /
                      reaction(*pushed, "bottom").norm(),
                    1e-8);
  test::check_error(
    "and lets go",
    force(*run("top: n = -0.05*t; bottom: n >= 0"), "bottom").norm(),
    1e-8);
  // a wall 0.01 m away takes one fifth less
  const auto late = test::run_scene<2>(
    block + test::keep_grid +
    "Time/Step size = 0.25\nBoundary conditions/Walls = left: n "
    "= 0; top: n = 0.05*t; bottom: n >= -0.01\n");
  const auto equal = test::run_scene<2>(
    block + test::keep_grid +
    "Time/Step size = 0.25\nBoundary conditions/Walls = left: n "
    "= 0; top: n = 0.04*t; bottom: n = 0\n");
  test::check_error("a wall at a distance",
                    (reaction(*late, "top") - reaction(*equal, "top")).norm() /
                      reaction(*equal, "top").norm(),
                    1e-7);
  // nothing turns it: a corner between two one-sided walls
  const auto corner = run("bottom: n >= 0; right: n >= 0.02*t; top: n = 0");
  test::check("a corner between two walls",
              force(*corner, "bottom").norm() > 1,
              "");
}

/** The mesh of a ring, turned about the origin. */
std::string
turned_ring(const double degrees)
{
  const double a = degrees / 180 * numbers::PI, c = std::cos(a),
               s = std::sin(a);
  std::ifstream     in(SOURCE_DIR "/quarter_ring.msh");
  const std::string name = "ring_" + std::to_string(int(degrees)) + ".msh";
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    {
      std::ofstream out(name);
      out.precision(17);
      bool nodes = false;
      for (std::string line; std::getline(in, line);)
        {
          double             x, y, z;
          unsigned int       k;
          std::istringstream numbers(line);
          if (nodes && (numbers >> k >> x >> y >> z))
            out << k << ' ' << c * x - s * y << ' ' << s * x + c * y << ' ' << z
                << '\n';
          else
            out << line << '\n';
          nodes = (line == "$Nodes") || (nodes && line != "$EndNodes");
        }
    }
  MPI_Barrier(MPI_COMM_WORLD);
  return "Grid/Type = gmsh\nGrid/File = " + name + '\n';
}

/** A ring is widened by a curved wall; its ends are smooth walls, too. */
void
test_ring()
{
  const std::string ring    = "Material/Young modulus = 1e4\nMaterial/Poisson "
                              "ratio = 0.3\nFormulation/Type = u\n"
                              "Postprocess/Reactions = inner, left\n"
                              "Newton/Tolerance = 1e-10\n";
  const auto        quarter = test::run_scene<2>(
    ring + turned_ring(0) +
    "Boundary conditions/Displacement = left: x = 0; bottom: y = 0; inner: x = "
           "0.1*t*x/sqrt(x^2+y^2), y = 0.1*t*y/sqrt(x^2+y^2)\n");
  const double expected = reaction(*quarter, "inner").norm(),
               across   = std::abs(reaction(*quarter, "left")[0]);
  const auto curved     = test::run_scene<2>(
    ring + turned_ring(0) +
    "Boundary conditions/Displacement = left: x = 0; bottom: y = 0\n"
        "Boundary conditions/Walls = inner: n = 0.1*t\n");
  test::check_error("a curved wall",
                    std::abs(reaction(*curved, "inner").norm() / expected - 1),
                    1e-7);
  for (const std::string &more :
       {std::string(), test::keep_grid + "Time/Step size = 0.5\n"})
    {
      const auto turned = test::run_scene<2>(
        ring + turned_ring(25) + more +
        "Boundary conditions/Walls = left: n = 0; bottom: n = 0; inner: n >= "
        "0.1*t\nQuadrature/Type = CPDI\n");
      // nodes of the boundary are moved, or what lies between them, too: cells
      // of 0.2 m
      test::check_error(
        "between inclined walls" + std::string(more.empty() ? "" : ", kept"),
        std::abs(force(*turned, "inner").norm() / (std::sqrt(2.) * across) - 1),
        3e-3);
    }
}

/** The smooth surface that a polygon stands for. */
void
test_surface()
{
  ParameterHandler prm;
  BackgroundGrid<2>::declare_parameters(prm);
  test::set_parameters(prm, turned_ring(0));
  BackgroundGrid<2> grid(MPI_COMM_WORLD);
  grid.parse_parameters(prm);
  grid.create();
  WallSurface<2> outer;
  outer.initialize(grid, grid.boundary_id("outer", ""));
  double worst_distance = 0, worst_normal = 0, worst_node = 0;
  for (const auto &node : outer.nodes())
    worst_node = std::max(
      worst_node,
      (node.normal + grid.geometry().vertices()[node.vertex] / 2.).norm());
  for (double angle = 0.01; angle < 1.57; angle += 0.01)
    for (const double r : {1.9, 2., 2.1})
      {
        const Point<2> x(r * std::cos(angle), r * std::sin(angle));
        const auto     place = outer.locate(x);
        worst_distance =
          std::max(worst_distance, std::abs(place.distance - (2 - r)));
        worst_normal = std::max(worst_normal, (place.normal + x / r).norm());
      }
  // cells of 0.2 m: h^4 / R^3
  test::check_error("normals at vertices", worst_node, 1e-8);
  test::check_error("distance from a circle", worst_distance, 2e-4);
  test::check_error("normals of a circle", worst_normal, 4e-3);
}

void
test_conflicts()
{
  const auto problem = test::run_scene<2>(
    "Grid/Subdivisions = 2, 2\nMaterial/Young modulus = 1e4\n"
    "Boundary conditions/Displacement = bottom: y = 0.01*t; top: y = 0\n"
    "Boundary conditions/Walls = left: n = 0; bottom: n = 0.02*t\n");
  bool found = false;
  for (const auto &warning : problem->all_warnings().all())
    found = found || warning.text.find(
                       "<Boundary conditions/Displacement> and "
                       "<Boundary conditions/Walls = bottom> determine the "
                       "same 3 displacement components") != std::string::npos;
  test::check("contradictions are told", found, "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_surface();
  test_tensions();
  test_plane();
  test_contact();
  test_ring();
  test_conflicts();
  return 0;
}
