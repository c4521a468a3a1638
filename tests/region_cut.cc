/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Domains are cut by the borders of the region and of zones: volumes and
// surfaces of bodies against those of the shapes.

#include <isochor/material_points/outer_faces.h>
#include <isochor/material_points/surface_seeding.h>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Seeds of a scene, with domains. */
  template <int dim>
  struct Cut
  {
    std::vector<Seed<dim>> seeds;
    double                 volume = 0, surface = 0, smallest = 1e300;
    /** Σ over faces of area vectors, and of these times places less the
     * volume: 0 if the faces enclose it. */
    double gap = 0;
    /** By material, and by body. */
    std::map<unsigned int, double> of_material, of_zone;

    Cut(const std::string              &settings,
        const std::vector<std::string> &zones       = {},
        const unsigned int              n_materials = 3)
    {
      BackgroundGrid<dim> grid(MPI_COMM_SELF);
      BodySeeding<dim>    seeding;
      ParameterHandler    prm;
      BackgroundGrid<dim>::declare_parameters(prm);
      BodySeeding<dim>::declare_parameters(prm);
      test::set_parameters(prm, settings);
      grid.parse_parameters(prm);
      seeding.parse_parameters(prm);
      grid.create();
      seeds = seeding.seeds(grid, true, n_materials, zones);
      std::vector<unsigned int> body;
      for (const Seed<dim> &seed : seeds)
        {
          volume += seed.volume;
          smallest = std::min(smallest, seed.volume);
          of_material[seed.material] += seed.volume;
          of_zone[seed.zone] += seed.volume;
          body.push_back(10 * seed.material + seed.zone);
          for (const double lambda :
               grid.geometry().barycentric(seed.cell, seed.location))
            if (!(lambda > -1e-12))
              gap = 1e300;
        }
      find_outer_faces(seeds, body);
      measure_surface();
    }

  private:
    void
    measure_surface()
    {
      double         enclosed = 0;
      Tensor<1, dim> sum;
      for (const Seed<dim> &seed : seeds)
        for (unsigned int c = 0; c <= dim; ++c)
          if (((seed.outer_faces >> c) & 1) != 0)
            {
              FaceCorners<dim> face;
              for (unsigned int i = 0, v = 0; v <= dim; ++v)
                if (v != c)
                  face[i++] = seed.location + seed.domain[v];
              Tensor<1, dim> n;
              if constexpr (dim == 2)
                n = cross_product_2d(face[1] - face[0]);
              else
                n = cross_product_3d(face[1] - face[0], face[2] - face[0]) / 2;
              if (n * seed.domain[c] > 0)
                n = -n;
              surface += measure<dim>(face);
              sum += n;
              enclosed += n * face[0] / dim;
            }
      gap = std::max({gap, sum.norm(), std::abs(enclosed - volume)});
    }
  };

  const std::string p = "Material points/";

  /** The errors of volume and surface fall with second order: by 4 where cells
   * are half as large. */
  template <int dim>
  void
  test_convergence(const std::string               &what,
                   const std::string               &settings,
                   const std::vector<unsigned int> &n_cells,
                   const double                     volume,
                   const double                     surface,
                   const double                     of_volume,
                   const double                     of_surface)
  {
    std::array<double, 2> errors{};
    for (const unsigned int n : n_cells)
      {
        const std::string N = std::to_string(n);
        const Cut<dim>    cut(settings + "Grid/Subdivisions = " + N + ", " + N +
                           (dim == 3 ? ", " + N : "") + "\n");
        const double      in_volume = std::abs(cut.volume / volume - 1) * n * n,
                     in_surface = std::abs(cut.surface / surface - 1) * n * n;
        errors[0]               = std::max(errors[0], in_volume);
        errors[1]               = std::max(errors[1], in_surface);
        test::check_error(what + ", " + N + " cells: faces enclose the volume",
                          cut.gap,
                          1e-11);
      }
    test::check_error(what + ": error of the volume, by cells squared",
                      errors[0],
                      of_volume);
    test::check_error(what + ": error of the surface, by cells squared",
                      errors[1],
                      of_surface);
  }

  template <int dim>
  void
  test_exact(const std::string              &what,
             const std::string              &settings,
             const double                    volume,
             const double                    surface,
             const std::vector<std::string> &zones = {})
  {
    const Cut<dim> cut(settings, zones);
    test::check_error(what + ": volume", std::abs(cut.volume - volume), 1e-11);
    test::check_error(what + ": surface",
                      std::abs(cut.surface - surface),
                      1e-10);
    test::check_error(what + ": faces enclose the volume", cut.gap, 1e-12);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string box = "Grid/Lower corner = -1.2, -1.2\nGrid/Upper corner = "
                          "1.2, 1.2\n",
                    one = "Grid/Upper corner = 1.2, 1.2, 1.2\n";
  test_convergence<2>("disc",
                      box + p + "Region = x*x + y*y < 1\n",
                      {10, 20, 40, 80, 160},
                      numbers::PI,
                      2 * numbers::PI,
                      0.22,
                      0.06);
  test_convergence<2>("ring",
                      box + p +
                        "Region = x*x + y*y < 1 && (x - 0.1)^2 + y^2 > 0.25\n",
                      {20, 40, 80, 160},
                      0.75 * numbers::PI,
                      3 * numbers::PI,
                      0.06,
                      0.11);
  test_convergence<3>("octant of a ball",
                      one + p + "Region = x*x + y*y + z*z < 1\n",
                      {6, 12, 24},
                      numbers::PI / 6,
                      1.25 * numbers::PI,
                      0.1,
                      0.045);
  test_exact<2>("box between lines",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = y > 0.0125 && y < 0.5125\n",
                0.5,
                3.);
  test_exact<2>("half plane",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = x + 0.3*y < 0.62\n",
                0.62 - 0.15,
                1 + 0.62 + 0.32 + std::sqrt(1.09));
  test_exact<3>("half space",
                "Grid/Subdivisions = 4, 4, 4\n" + p +
                  "Region = x + 0.3*y + 0.2*z < 0.71\n",
                0.71 - 0.25,
                1 + 4 * (0.71 - 0.25) + std::sqrt(1.13));
  test_exact<2>("gap from a line on",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = y < 0.5 || y > 0.505\n",
                0.995,
                5.99);
  test_exact<2>("gap on vertices",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = abs(y - 0.5) > 0.005\n",
                0.99,
                5.98);
  test_exact<2>("strip on vertices",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = abs(y - 0.5) < 0.005\n",
                0.01,
                2.02);
  test_exact<2>("sides on lines",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = x >= 0.2 && x < 0.7 && y > 0.05 && y <= 0.6\n",
                0.275,
                2.1);
  // one condition after the other: edges and corners are where they should be
  test_exact<2>("rectangle between lines",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Region = y < 0.7321 && (x > 0.0777 && x < 0.8777)\n",
                0.7321 * 0.8,
                2 * (0.7321 + 0.8));
  test_exact<2>("square turned by 30 degrees",
                box + "Grid/Subdivisions = 24, 24\n" + p +
                  "Region = abs(x*cos(pi/6) + y*sin(pi/6)) < 0.5 && "
                  "abs(y*cos(pi/6) - x*sin(pi/6)) < 0.5\n",
                1,
                4);
  test_exact<2>("borders close to lines",
                "Grid/Subdivisions = 6, 6\n" + p +
                  "Region = x > 0.33334 && x < 0.66666 && y > 0.33334 && "
                  "y < 0.66666\n",
                0.33332 * 0.33332,
                4 * 0.33332);
  test_exact<3>("brick between planes",
                "Grid/Subdivisions = 5, 5, 5\n" + p +
                  "Region = x > 0.0777 && x < 0.8777 && y < 0.7321 && "
                  "z > 0.11 && z < 0.93\n",
                0.8 * 0.7321 * 0.82,
                2 * (0.8 * 0.7321 + 0.8 * 0.82 + 0.7321 * 0.82));
  // a face between materials or bodies is on the surface of both
  test_exact<2>("a material above a slanted line",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Materials in zones = 2: y > 0.21 + 0.3*x\n",
                1,
                4 + 2 * std::sqrt(1.09));
  test_exact<2>("a rectangle of another material",
                "Grid/Subdivisions = 10, 10\n" + p +
                  "Materials in zones = 2: x > 0.211 && x < 0.677 && "
                  "y < 0.533\n",
                1,
                4 + 2 * (0.466 + 2 * 0.533));
  test_exact<3>("bodies above and below a plane",
                "Grid/Subdivisions = 4, 4, 4\n",
                1,
                6 + 2 * std::sqrt(1.13),
                {"y > 0.21 + 0.3*x + 0.2*z"});
  {
    const Cut<2> cut("Grid/Subdivisions = 10, 10\n" + p +
                       "Region = x < 0.87\n" + p +
                       "Materials in zones = 2: y < 0.333; 3: y < 0.123\n",
                     {"x > 0.444"});
    test::check_error("materials and bodies: volumes",
                      std::max({std::abs(cut.of_material.at(0) - 0.667 * 0.87),
                                std::abs(cut.of_material.at(1) - 0.21 * 0.87),
                                std::abs(cut.of_material.at(2) - 0.123 * 0.87),
                                std::abs(cut.of_zone.at(1) - 0.426)}),
                      1e-11);
  }
  return 0;
}
