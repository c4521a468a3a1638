/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Boundaries of the grid as partners of interactions: the surface that facets
// stand for, forces with closed forms in the plane, in space and in bodies of
// revolution, and other laws than contact without friction.

#include <isochor/interaction/smooth_facets.h>

#include "scene.h"

using namespace isochor;
using test::get;
using test::relative;

namespace
{
  using Facets = SmoothFacets<2>;

  /** A quarter of a circle of radius 2 in @p n facets, seen from inside. */
  Facets
  circle(const unsigned int n)
  {
    std::vector<Facets::Facet> facets(n);
    const auto                 at = [n](const double k) {
      const double a = k / n * numbers::PI / 2;
      return Point<2>(std::cos(a), std::sin(a));
    };
    for (unsigned int k = 0; k < n; ++k)
      {
        Facets::Facet &facet = facets[k];
        facet.normal         = -Tensor<1, 2>(at(k + 0.5));
        facet.part           = 0;
        for (unsigned int v = 0; v < 2; ++v)
          {
            facet.corners[v] = 2 * at(k + v);
            facet.normals[v] = -Tensor<1, 2>(at(k + v));
          }
        facet.rims.fill(Facets::Rim::none);
      }
    return Facets(std::move(facets));
  }

  void
  test_circle()
  {
    const Facets surface  = circle(16);
    double       distance = 0, normal = 0, curvature = 0;
    for (double a = 0.05; a < 1.5; a += 0.03)
      for (const double r : {1.98, 2., 2.02})
        {
          const Tensor<1, 2> e({std::cos(a), std::sin(a)}),
            along({-std::sin(a), std::cos(a)});
          const auto place = surface.nearest(Point<2>(r * e), e);
          distance = std::max(distance, std::abs(place.distance - (2 - r)));
          normal   = std::max(normal, (place.normal + e).norm());
          // ∂n/∂x = -1/r along the circle, on facets as the chord is
          if (r == 2.)
            curvature =
              std::max(curvature,
                       std::abs(along * (place.curvature * along) * 2 + 1));
        }
    test::check_error("distance from a circle", distance, 1e-4);
    test::check_error("normals of a circle", normal, 2e-3);
    test::check_error("curvature of a circle", curvature, 0.01);
  }

  /** A floor along x from 0 to 1, with two kinds of ends. */
  void
  test_rims()
  {
    std::vector<Facets::Facet> facets(1);
    facets[0].corners = {{Point<2>(0, 0), Point<2>(1, 0)}};
    facets[0].normal = facets[0].normals[0] = facets[0].normals[1] =
      Tensor<1, 2>({0, 1});
    facets[0].part = 0;
    facets[0].rims = {{Facets::Rim::free, Facets::Rim::concave}};
    const Facets       floor(std::move(facets));
    const Tensor<1, 2> down({0, -1});
    const auto         distance = [&](const double x, const double y) {
      return floor.nearest(Point<2>(x, y), down).distance;
    };
    test::check_error("above", std::abs(distance(0.5, 0.1) - 0.1), 1e-14);
    test::check_error("behind", std::abs(distance(0.5, -0.1) + 0.1), 1e-14);
    test::check_error("beyond a rim that goes on",
                      std::abs(distance(-0.3, -0.1) + 0.1),
                      1e-14);
    test::check_error("beyond a free rim",
                      std::abs(distance(1.03, -0.04) - 0.05),
                      1e-14);
  }

  const std::string block =
    "Quadrature/Type = CPDI\nMaterial/Young modulus = 1e5\n"
    "Material/Poisson ratio = 0.3\n"
    "Material/Density = 100\nNewton/Tolerance = 1e-9\n";

  /** Blocks on the floor: it carries their weight. */
  void
  test_weight()
  {
    const std::string force = "Force y on body by boundary bottom (N)";
    for (const std::string form : {"u", "u-p"})
      {
        const auto problem = test::run_scene<2>(
          block + "Formulation/Type = " + form +
          "\nGrid/Upper corner = 2, 1\nGrid/Subdivisions = 16, 8\n"
          "Material points/Region = x < 1.1 && y < 0.7\n"
          "Boundary conditions/Displacement = left: x=0\n"
          "Boundary conditions/Walls = bottom: n >= 0\n"
          "Boundary conditions/Gravity = 0, -10*t\n");
        test::check_error("weight of a block, " + form,
                          relative(get(*problem, force),
                                   10 * get(*problem, "Mass (kg)")),
                          1e-7);
      }
    const auto in_space = test::run_scene<3>(
      block + "Grid/Subdivisions = 3, 3, 3\n"
              "Boundary conditions/Displacement = left: x=0; back: z=0\n"
              "Boundary conditions/Walls = bottom: n >= 0; front: n >= 0\n"
              "Boundary conditions/Gravity = 0, -10*t, 0\n");
    test::check_error("weight of a cube",
                      relative(get(*in_space, force), 1000),
                      1e-7);
    const auto ring = test::run_scene<2>(
      block + "Formulation/Geometry = axisymmetric\nGrid/Lower corner = 1, 0\n"
              "Grid/Upper corner = 2, 1\nGrid/Subdivisions = 6, 6\n"
              "Boundary conditions/Walls = bottom: n >= 0\n"
              "Boundary conditions/Gravity = 0, -10*t\n");
    test::check_error("weight of a ring",
                      relative(get(*ring, force), 1000 * 3 * numbers::PI),
                      1e-7);
  }

  /** A block on a slope of 30°: with friction of 0.6 it stays, and slides with
   * 0.3 by g t²/2 (sin - 0.3 cos); tied it stays, too. */
  void
  test_laws()
  {
    const double      s = 0.5, c = std::sqrt(0.75);
    const std::string slope =
      block + "Grid/Type = box\nGrid/Upper corner = 2, 0.5\n"
              "Grid/Subdivisions = 32, 8\n"
              "Material points/Region = x > 0.25 && x < 0.75 && y < 0.25\n"
              "Material/Young modulus = 1e6\nDynamics/Inertia = true\n"
              "Dynamics/Spectral radius = 0\n"
              "Postprocess/Point probes = P: 0.5, 0.125\n"
              "Boundary conditions/Gravity = 5, -8.660254\n"
              "Time/Step size = 0.01\nTime/End time = 0.5\n";
    const auto slides = [&](const std::string &law) {
      return get(*test::run_scene<2>(
                   slope + "Interaction: body - boundary bottom/Law = " + law),
                 "Displacement x of P (m)");
    };
    test::check_error("slides",
                      relative(slides("Coulomb\nInteraction: body - boundary "
                                      "bottom/Friction coefficient = 0.3\n"),
                               10 * 0.125 * (s - 0.3 * c)),
                      0.01);
    // it slips as the weight comes suddenly, and then stays
    const std::string sticks = "Coulomb\nInteraction: body - boundary "
                               "bottom/Friction coefficient = 0.6\n";
    test::check_error("sticks",
                      std::abs(slides(sticks) -
                               slides(sticks + "Time/End time = 0.3\n")),
                      1e-6);
    test::check_error(
      "is tied",
      std::abs(get(*test::run_scene<2>(
                     slope + "Boundary conditions/Surfaces of body = "
                             "base: y < 0.001\nInteraction: base - boundary "
                             "bottom/Law = tie\n"),
                   "Displacement x of P (m)")),
      2e-4);
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_circle();
  test_rims();
  test_weight();
  test_laws();
  return 0;
}
