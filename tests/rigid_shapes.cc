/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Shapes of rigid bodies: distances against those of their facets, normals and
// curvatures against differences, signs against winding numbers, and errors.

#include "../doc/plugins/capsule.cc"
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

  void
  test_around_axes()
  {
    const std::string cone =
      "Shape = cone\nApex = 0.1, 0.2\nDirection = 0, 2\nShaft radius = 0.3\n"
      "Length = 1.5\n";
    const auto sharp = test::make_shape<2>(cone);
    test::test_shape<2>(*sharp, {"cone", {0.1, 0.8}, 1});
    test::test_shape<2>(*test::make_shape<2>(cone + "Tip radius = 0.1"),
                        {"cone with a round tip", {0.1, 0.8}, 1, 1e-3});
    // the flanks enclose 60 degrees
    const auto flank = sharp->closest({0.4, 0.2});
    test::report("normal of a cone's flank",
                 std::abs(flank.normal[1] + 0.5) < 1e-12,
                 std::to_string(flank.normal[1]));
    test::test_shape<2>(*test::make_shape<2>(
                          "Shape = wedge\nApex = 0, 1\nDirection = 1, 1\n"
                          "Apex angle = 40\nLength = 2\nTip radius = 0.1"),
                        {"wedge", {0.7, 1.7}, 1, 1e-3});
    test::test_shape<2>(*test::make_shape<2>(
                          "Shape = cylinder\nFirst end = 0, 0\n"
                          "Second end = 0, 2\nRadius = 1\nEdge radius = 0.3"),
                        {"section of a cylinder", {0, 1}, 1.5, 1e-3});
    test::test_shape<3>(*test::make_shape<3>(
                          "Shape = cone\nApex = 0, 0, 0\nDirection = 1, 1, 0\n"
                          "Shaft radius = 0.5\nTip radius = 0.1\nLength = 2"),
                        {"cone in space", {0.7, 0.7, 0}, 1, 5e-3, 60});
    test::test_shape<3>(*test::make_shape<3>(
                          "Shape = cylinder\nFirst end = 0, 0, 0\n"
                          "Second end = 1, 2, -1\nRadius = 0.8\n"
                          "Edge radius = 0.2"),
                        {"cylinder in space", {0.5, 1, -0.5}, 1.2, 8e-3, 60});
    // on the axis in front of a round tip: a sphere
    const auto tip =
      test::make_shape<3>("Shape = cone\nDirection = 0, 0, 1\n"
                          "Shaft radius = 0.5\nTip radius = 0.1\nLength = 2")
        ->closest({0, 0, -0.1});
    const SymmetricTensor<2, 3> sphere =
      rounded_curvature<3>(0.3, Tensor<1, 3>({0, 0, -1}));
    test::report("on the axis in front of a round tip",
                 std::abs(tip.distance - 0.2) < 1e-12 &&
                   (tip.curvature - sphere).norm() < 1e-10,
                 std::to_string(tip.distance));
  }

  /** The example of doc/extending.md. */
  void
  test_plugin()
  {
    const std::string capsule =
      "Shape = capsule\nSegment = -1, 1, 0.5\nRadius = 0.4\n";
    test::test_shape<2>(*test::make_shape<2>(capsule),
                        {"capsule", {0, 0.5}, 1.2, 1e-3});
    test::test_shape<3>(*test::make_shape<3>(capsule),
                        {"capsule in space", {0, 0.5, 0}, 0.9, 3e-3, 60});
  }

  void
  test_formulas()
  {
    test::ShapeTest<2> ellipse{"ellipse", {0, 0}, 2, 2e-3, 50};
    ellipse.differences = 1e-4;
    test::test_shape<2>(*test::make_shape<2>(
                          "Shape = formula\nFormula = x^2/4 + y^2 - 1\n"
                          "Lower corner = -2.1, -1.1\nUpper corner = 2.1, 1.1"),
                        ellipse);
    const auto sphere =
      test::make_shape<3>("Shape = formula\nFormula = x^2 + y^2 + z^2 - 1\n"
                          "Lower corner = -1.2, -1.1, -1\n"
                          "Upper corner = 1.1, 1.2, 1.3");
    test::Random     random;
    test::WorstError distance, normal, curvature;
    for (unsigned int n = 0; n < 50; ++n)
      {
        Point<3> x(random(), random(), random());
        x *= (1 + 0.5 * random()) / x.norm();
        const auto at = sphere->closest(x);
        distance.add(std::abs(at.distance - x.norm() + 1), "x");
        normal.add((at.normal - x / x.norm()).norm(), "x");
        curvature.add(
          (at.curvature - rounded_curvature<3>(x.norm(), x / x.norm())).norm(),
          "x");
      }
    distance.report("distance from the sphere of a formula", 1e-10);
    normal.report("normal of the sphere of a formula", 1e-10);
    curvature.report("curvature of the sphere of a formula", 1e-5);
    double farthest = 0;
    for (const auto &facet : sphere->surface(1))
      for (const auto &corner : facet)
        farthest = std::max(farthest, std::abs(corner.norm() - 1));
    test::report("facets of a formula in space",
                 farthest < 1e-10,
                 std::to_string(farthest));
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
    test_error<2>("no shaft",
                  "Shape = cone\nShaft radius = 1\nLength = 1",
                  {"<Rigid body: tool/Length> must be more than", "1.732"});
    test_error<2>("too blunt a tip",
                  "Shape = wedge\nLength = 1\nTip radius = 1",
                  {"wedge> with its <Tip radius>", "too short"});
    test_error<3>("a cylinder without a length",
                  "Shape = cylinder\nRadius = 1",
                  {"<Rigid body: tool/Second end> must be another place"});
    test_error<3>("too large a rounding of a cylinder",
                  "Shape = cylinder\nSecond end = 0, 1, 0\nRadius = 1\n"
                  "Edge radius = 0.6",
                  {"<Rigid body: tool/Edge radius> must exceed neither"});
    const std::string region = "\nUpper corner = 1, 1";
    test_error<2>("a formula without a surface",
                  "Shape = formula\nFormula = 1 + x^2" + region,
                  {"<Rigid body: tool/Formula> is zero nowhere"});
    test_error<2>("a formula in t",
                  "Shape = formula\nFormula = x - t" + region,
                  {"Rigid body: tool/Formula", "depends on t"});
    test_error<2>("a formula without a region",
                  "Shape = formula\nFormula = x",
                  {"<Rigid body: tool/Upper corner> must exceed"});
  }
} // namespace

int
main()
{
  test_in_the_plane();
  test_polygons();
  test_in_space();
  test_around_axes();
  test_plugin();
  test_formulas();
  test_errors();
  return 0;
}
