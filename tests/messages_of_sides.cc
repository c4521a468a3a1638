/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Scenes whose sides, surfaces or interfaces can hardly be meant are told of,
// and their neighbours that are right aren't.

#include "scene_messages.h"

using namespace isochor;

namespace
{
  void
  test_planes()
  {
    const auto stretch = [](const std::string &plane) {
      return messages<2>(good + "Grid/Stretch = y: 0 -> 0, " + plane +
                         " -> -1e-3*t\n");
    };
    expect("a plane that isn't in the grid",
           stretch("2"),
           {"ERROR", "at y = 2 m", "from 0 to 1 m"});
    expect("... a little beside it", stretch("1.05"), {});
  }

  /** A pressure on a column that is held sideways by walls: the normal of its
   * top has sideways components of rounding. */
  void
  test_load_between_walls()
  {
    expect("a pressure between walls",
           messages<3>(
             "Grid/Subdivisions = 2, 3, 1\nGrid/Upper corner = 0.7, 0.9, 0.3\n"
             "Quadrature/Type = CPDI\nMaterial/Young modulus = 1e6\n"
             "Boundary conditions/Displacement = left: x=0; right: x=0; front: "
             "z=0; back: z=0; bottom: y=0\n"
             "Boundary conditions/Pressure on body = top: 1e3*t\n"
             "Boundary conditions/Surfaces of body = top: y > 0.899\n"),
           {});
  }

  /** Quadratures that know one strain in each cell. */
  void
  test_shared_cells()
  {
    const auto layers = [](const std::string &quadrature,
                           const std::string &interface,
                           const std::string &modulus) {
      return messages<2>(
        good + "Quadrature/Type = " + quadrature +
          "\nGrid/Subdivisions = 4, 8\nMaterial/Young modulus = 1e6\nMaterial "
          "points/Points per cell = 4\n"
          "Formulation/Type = u\nMaterial points/Materials in zones = 2: y > " +
          interface + "\nMaterial 2/Young modulus = " + modulus + "\n",
        true,
        2);
    };
    for (const std::string quadrature : {"points"})
      {
        expect("materials in the same cells, " + quadrature,
               layers(quadrature, "0.5625", "1e8"),
               {"WARNING material interface within cells",
                "differ by up to 100 to 1",
                "<Quadrature/Type = CPDI>"});
        expect("... nearly the same",
               layers(quadrature, "0.5625", "1.1e6"),
               {});
        expect("... in cells of their own",
               layers(quadrature, "0.5", "1e8"),
               {});
      }
  }

  /** Layers that are one domain thick: in cells that they share, or cells of
   * their own. */
  void
  test_layers_of_one_domain()
  {
    const auto layer = [](const std::string &zone, const std::string &points) {
      return messages<2>(
        good +
          "Quadrature/Type = CPDI\nGrid/Subdivisions = 4, 8\n"
          "Formulation/Type = u\nMaterial/Young modulus = 1e6\n"
          "Material 2/Young modulus = 1e4\nMaterial points/Points per "
          "cell = " +
          points + "\nMaterial points/Materials in zones = 2: " + zone + "\n",
        true,
        2);
    };
    expect("a layer of one domain in the half of its cells",
           layer("y > 0.5 && y < 0.5625", "4"),
           {});
    expect("... of a material that is thick elsewhere",
           layer("(y > 0.5 && y < 0.5625) || y > 0.75", "4"),
           {});
    expect("... that is a cell", layer("y > 0.5 && y < 0.625", "1"), {});
    // tips of the one lie in the other, beside others of it
    expect("layers that meet at a slant", layer("y > 0.3 + 0.37*x", "4"), {});
  }

  /** Zones whose sides lie between the points. */
  void
  test_rounded_zones()
  {
    const auto zone = [](const std::string &zone, const std::string &more) {
      return messages<2>(
        good +
          "Quadrature/Type = CPDI\nGrid/Subdivisions = 4, 8\n"
          "Formulation/Type = u\nMaterial points/Materials in zones = 2: " +
          zone + "\n" + more,
        true,
        2);
    };
    const std::string no_domains = "Quadrature/Type = points\nMaterial "
                                   "points/Points per cell = 4\n";
    expect("a layer that is cut", zone("y < 0.515", ""), {});
    expect("a layer that is rounded to points",
           zone("y < 0.515", no_domains),
           {"WARNING rounded to the points",
            "material 1 stand for 0.5 m^2, 3.0"});
    expect("... on a line between points", zone("y < 0.5625", no_domains), {});
    expect("... by little", zone("y < 0.505", no_domains), {});
    expect("... with more points",
           zone("y < 0.515",
                no_domains + "Material points/Points per cell = 1024\n"),
           {});
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_planes();
  test_load_between_walls();
  test_shared_cells();
  test_layers_of_one_domain();
  test_rounded_zones();
  return 0;
}
