/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Shapes of rigid bodies: distances against those of their facets, normals and
// curvatures against differences, signs against winding numbers, and errors.

#include "rigid_shape_tools.h"

using namespace isochor;

namespace
{
  void
  test_in_the_plane()
  {
    test::test_shape<2>(*test::make_shape<2>("Shape = half plane\n"
                                             "Point = 0.5, 0.2\n"
                                             "Normal = 1, 2"),
                        {"half plane", {0.5, 0.2}, 2, 1e-9, 200, false});
    test::test_shape<2>(*test::make_shape<2>("Shape = circle\n"
                                             "Centre = 1, 2\nRadius = 0.5"),
                        {"circle", {1, 2}, 1, 5e-4});
    const std::string box =
      "Shape = box\nLower corner = -1, 0\nUpper corner = 1, 3\n";
    test::test_shape<2>(*test::make_shape<2>(box), {"box", {0, 1.5}, 3});
    test::test_shape<2>(*test::make_shape<2>(box + "Edge radius = 0.4"),
                        {"rounded box", {0, 1.5}, 3, 5e-3});
    test::test_shape<2>(*test::make_shape<2>(box + "Edge radius = 1"),
                        {"box with round ends", {0, 1.5}, 3, 5e-3});
  }

  void
  test_polygons()
  {
    // an arrow: with a concave corner
    const std::string points = "Points = 0, 0; 2, -1; 1, 0; 2, 1\n",
                      arrow  = "Shape = polygon\n" + points;
    test::test_shape<2>(*test::make_shape<2>(arrow), {"polygon", {1, 0}, 1.5});
    test::test_shape<2>(*test::make_shape<2>(
                          "Shape = polygon\nPoints = 2, 1; 1, 0; 2, -1; 0, 0"),
                        {"polygon backwards", {1, 0}, 1.5});
    test::test_shape<2>(*test::make_shape<2>(arrow + "Edge radius = 0.1"),
                        {"rounded polygon", {1, 0}, 1.5, 1e-3});
    // outside and inside are exchanged
    const auto inside  = test::make_shape<2>(arrow),
               outside = test::make_shape<2>(arrow + "Solid side = right");
    test::WorstError error;
    test::Random     random;
    for (unsigned int n = 0; n < 100; ++n)
      {
        const Point<2> x(1 + 2 * random(), 2 * random());
        const auto     a = inside->closest(x), b = outside->closest(x);
        error.add(std::abs(a.distance + b.distance) +
                    (a.normal + b.normal).norm() +
                    (a.curvature + b.curvature).norm(),
                  "x");
      }
    error.report("a container is the opposite of a polygon", 1e-12);
    // ground with a slope; its ends go on
    const std::string chain = "Shape = polygon\nClosed = false\n"
                              "Points = -1, 0; 0, 0; 1, -1; 3, -1\n";
    const auto        ground =
      test::make_shape<2>(chain + "Solid side = right\nEdge radius = 0.2");
    test::test_shape<2>(*ground, {"open chain", {1, 0}, 3, 1e-3, 200, false});
    for (const double x : {-1000., 1000.})
      {
        const auto at = ground->closest({x, 1});
        test::report("an open chain goes on at x = " +
                       std::to_string(static_cast<int>(x)),
                     std::abs(at.distance - (x < 0 ? 1 : 2)) < 1e-12 &&
                       std::abs(at.normal[1] - 1) < 1e-12,
                     std::to_string(at.distance));
      }
    const auto edge = test::make_shape<2>(arrow)->closest({0, 0});
    test::report("a corner itself",
                 std::abs(edge.distance) < 1e-14 &&
                   std::abs(edge.normal[0] + 1) < 1e-12 &&
                   edge.curvature.norm() == 0,
                 std::to_string(edge.distance));
  }

  void
  test_in_space()
  {
    test::test_shape<3>(*test::make_shape<3>("Shape = half plane\n"
                                             "Point = 0.5, 0.2, 0\n"
                                             "Normal = 1, 2, -1"),
                        {"half space", {0.5, 0.2, 0}, 2, 1e-9, 100, false});
    test::test_shape<3>(*test::make_shape<3>("Shape = circle\n"
                                             "Centre = 1, 2, 3\n"
                                             "Radius = 0.5"),
                        {"sphere", {1, 2, 3}, 0.8, 3e-3, 40});
    const std::string box =
      "Shape = box\nLower corner = -1, 0, 0\nUpper corner = 1, 3, 2\n";
    test::test_shape<3>(*test::make_shape<3>(box),
                        {"box in space", {0, 1.5, 1}, 2.5});
    test::test_shape<3>(*test::make_shape<3>(box + "Edge radius = 0.4"),
                        {"rounded box in space", {0, 1.5, 1}, 2, 1e-2, 40});
  }

  template <int dim>
  void
  test_error(const std::string              &what,
             const std::string              &settings,
             const std::vector<std::string> &words)
  {
    test::expect_error(what, words, [&]() { test::make_shape<dim>(settings); });
  }

  void
  test_errors()
  {
    test_error<2>("no radius",
                  "Shape = circle",
                  {"<Rigid body: tool/Radius> must be positive"});
    test_error<3>("no normal",
                  "Shape = half plane\nNormal = 0, 0, 0",
                  {"<Rigid body: tool/Normal> must not be zero"});
    test_error<2>("an empty box",
                  "Shape = box\nUpper corner = 1, 0",
                  {"<Rigid body: tool/Upper corner> must exceed"});
    test_error<2>("a rounding that is too large",
                  "Shape = box\nUpper corner = 1, 2\nEdge radius = 0.6",
                  {"<Rigid body: tool/Edge radius> must not exceed half"});
    const std::string polygon = "Shape = polygon\nPoints = ";
    test_error<2>("two points",
                  polygon + "0, 0; 1, 0",
                  {"<Rigid body: tool/Points> needs at least 3 points"});
    test_error<2>("a point in space",
                  polygon + "0, 0; 1, 0, 0; 2, 1",
                  {"<Rigid body: tool/Points> must have 2 coordinates"});
    test_error<2>("a polygon that crosses itself",
                  polygon + "0, 0; 1, 1; 1, 0; 0, 1",
                  {"crosses or touches itself", "(0, 0)", "(1, 0)"});
    test_error<2>("a point twice",
                  polygon + "0, 0; 1, 0; 1, 0; 1, 1",
                  {"the point (1, 0) twice"});
    test_error<2>("an edge that comes back",
                  polygon + "0, 0; 2, 0; 1, 0; 1, 1",
                  {"crosses or touches itself"});
    test_error<2>("too short an edge",
                  polygon + "0, 0; 1, 0; 1, 1\nEdge radius = 0.5",
                  {"too short for the rounding"});
    test_error<2>("an open chain without a side",
                  polygon + "0, 0; 1, 0\nClosed = false",
                  {"<Rigid body: tool/Solid side> must be <left> or <right>"});
    test_error<2>("ends that meet",
                  polygon + "-1, 0; 0, -1; 1, 0; 0, 0.1\nClosed = false\n"
                            "Solid side = left",
                  {"crosses or touches itself"});
  }
} // namespace

int
main()
{
  test_in_the_plane();
  test_polygons();
  test_in_space();
  test_errors();
}
