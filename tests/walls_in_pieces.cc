/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A smooth wall may have several names: where its pieces meet nodes slide on as
// they do in the middle of one. If pieces that meet smoothly don't move alike,
// a warning names them.

#include <isochor/boundary_condition/wall_surface.h>

#include <fstream>

#include "scene.h"

using namespace isochor;

namespace
{
  /** The mesh of a ring whose outer curve has a second name, <outer2>, from its
   * middle on. */
  std::string
  ring_in_pieces()
  {
    std::ifstream     in(SOURCE_DIR "/quarter_ring.msh");
    const std::string name = "ring_in_pieces.msh";
    if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::ofstream out(name);
        unsigned int  n_outer = 0;
        for (std::string line; std::getline(in, line);)
          {
            unsigned int       number, type, n_tags, tag, curve, a, b;
            std::istringstream numbers(line);
            if (line == "5")
              line = "6\n1 6 \"outer2\"";
            else if (numbers >> number >> type >> n_tags >> tag >> curve >> a >>
                       b &&
                     type == 1 && n_tags == 2 && tag == 2 && ++n_outer > 8)
              line = std::to_string(number) + " 1 2 6 6 " + std::to_string(a) +
                     ' ' + std::to_string(b);
            out << line << '\n';
          }
      }
    MPI_Barrier(MPI_COMM_WORLD);
    return "Grid/Type = gmsh\nGrid/File = " + name + '\n';
  }

  const std::string whole =
    "Grid/Type = gmsh\nGrid/File = " SOURCE_DIR "/quarter_ring.msh\n";

  bool
  warns(const MaterialPointMethod<2> &problem, const std::string &text)
  {
    bool found = false;
    for (const auto &warning : problem.all_warnings().all())
      found = found || warning.text.find(text) != std::string::npos;
    return found;
  }
} // namespace

/** The normals of a circle, also in the middle. */
void
test_surface()
{
  ParameterHandler prm;
  BackgroundGrid<2>::declare_parameters(prm);
  test::set_parameters(prm, ring_in_pieces());
  BackgroundGrid<2> grid(MPI_COMM_WORLD);
  grid.parse_parameters(prm);
  grid.create();
  const std::vector<types::boundary_id> ids = {grid.boundary_id("outer2", ""),
                                               grid.boundary_id("outer", ""),
                                               grid.boundary_id("left", "")};
  for (const bool joined : {true, false})
    {
      std::array<WallSurface<2>, 3> parts;
      unsigned int                  n_nodes = 0;
      double                        worst = 0, worst_distance = 0;
      for (unsigned int w = 0; w < 3; ++w)
        {
          parts[w].initialize(grid, ids, w, [&](auto, auto, auto) {
            return joined;
          });
          n_nodes += w < 2 ? parts[w].nodes().size() : 0;
          for (const auto &node : parts[w].nodes())
            if (w < 2)
              worst = std::max(worst,
                               (node.normal +
                                grid.geometry().vertices()[node.vertex] / 2.)
                                 .norm());
        }
      // from one piece on to the other
      for (const double angle : {0.5, 1.})
        for (unsigned int w = 0; w < 2; ++w)
          worst_distance =
            std::max(worst_distance,
                     std::abs(parts[w]
                                .locate(Point<2>(1.9 * std::cos(angle),
                                                 1.9 * std::sin(angle)))
                                .distance -
                              0.1));
      if (!joined)
        {
          test::check("two pieces", n_nodes == 18, "");
          continue;
        }
      test::check("one condition at the node between the pieces",
                  n_nodes == 17,
                  std::to_string(n_nodes));
      test::check_error("normals at vertices", worst, 1e-8);
      test::check_error("distance from a circle", worst_distance, 2e-4);
    }
}

/** A ring between smooth shells slides round under a shear of 1000 N on one of
 * its ends; the other one holds it by as much. */
void
test_sliding()
{
  const auto force = [](const std::string &grid, const std::string &walls) {
    const auto problem = test::run_scene<2>(
      "Material/Young modulus = 1e6\nMaterial/Poisson ratio = 0.3\n"
      "Formulation/Type = u\nNewton/Tolerance = 1e-10\n"
      "Postprocess/Reactions = left\n"
      "Boundary conditions/Displacement = left: x = 0\n"
      "Boundary conditions/Traction = bottom: 0, 1e3*t\n" +
      grid + "Boundary conditions/Walls = inner: n = 0; " + walls + '\n');
    return test::get(*problem, "Reaction x on left (N)");
  };
  for (const std::string &more :
       {std::string(), test::keep_grid + "Time/Step size = 0.5\n"})
    {
      const double expected = force(whole + more, "outer: n = 0");
      test::check_error("handed on by a wall in one piece",
                        test::relative(std::abs(expected), 1000),
                        0.01);
      for (const std::string walls : {"outer: n = 0; outer2: n = 0",
                                      "outer2: n = 0; outer: n = 0.*t",
                                      "outer: n=x-x; outer2: n = 0"})
        test::check_error("in two, " + walls + (more.empty() ? "" : ", kept"),
                          test::relative(force(ring_in_pieces() + more, walls),
                                         expected),
                          1e-8);
      test::check_error("one-sided" + std::string(more.empty() ? "" : ", kept"),
                        test::relative(force(ring_in_pieces() + more,
                                             "outer: n >= 0; outer2: n >= 0\n"
                                             "Quadrature/Type = CPDI"),
                                       force(whole + more,
                                             "outer: n >= 0\n"
                                             "Quadrature/Type = CPDI")),
                        1e-8);
    }
}

/** Walls in one plane that contradict each other. */
void
test_contradiction()
{
  // two squares, whose tops have names of their own
  if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    std::ofstream("squares.msh")
      << "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n"
         "1 1 \"bottom\"\n1 2 \"first\"\n1 3 \"second\"\n2 4 \"body\"\n"
         "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 2 0 0\n4 0 1 0\n"
         "5 1 1 0\n6 2 1 0\n$EndNodes\n$Elements\n8\n1 1 2 1 1 1 2\n"
         "2 1 2 1 1 2 3\n3 1 2 2 2 4 5\n4 1 2 3 3 5 6\n5 2 2 4 4 1 2 5\n"
         "6 2 2 4 4 1 5 4\n7 2 2 4 4 2 3 6\n8 2 2 4 4 2 6 5\n$EndElements\n";
  MPI_Barrier(MPI_COMM_WORLD);
  const auto plane = test::run_scene<2>(
    "Grid/Type = gmsh\nGrid/File = squares.msh\n"
    "Material/Young modulus = 1e4\nBoundary conditions/Displacement = bottom: "
    "x = 0, y = 0\n"
    "Boundary conditions/Walls = first: n = 0.1*t; second: n = 0.02*t\n");
  test::check("contradictions name the boundaries",
              warns(*plane,
                    "<Boundary conditions/Walls = first> and <Boundary "
                    "conditions/Walls = second> determine the same"),
              "");
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_surface();
  test_sliding();
  test_contradiction();
  return 0;
}
