/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Two blocks in the mesh of a body that have a part in common, where mass and
// stiffness would count twice: an error. Blocks that touch, with the same
// vertices or others, and those that a region or a group leaves out, are not.

#include "mesh_file.h"
#include "scene_messages.h"

using namespace isochor;

namespace
{
  /** A mesh of boxes of 1 m, cut into n parts along each edge, from these
   * heights on. Returns the settings of a scene with it. */
  template <int dim>
  std::string
  boxes(const std::vector<std::pair<double, unsigned int>> &from)
  {
    std::vector<Point<dim>>    vertices;
    std::vector<CellData<dim>> cells;
    for (const auto &[bottom, n] : from)
      {
        const unsigned int first = vertices.size(), n_1 = n + 1;
        const unsigned int layers = dim == 3 ? n : 1;
        for (unsigned int k = 0; k <= (dim == 3 ? n : 0); ++k)
          for (unsigned int j = 0; j <= n; ++j)
            for (unsigned int i = 0; i <= n; ++i)
              {
                Point<dim> x;
                x[0] = double(i) / n;
                x[1] = bottom + double(j) / n;
                if (dim == 3)
                  x[dim - 1] = double(k) / n;
                vertices.push_back(x);
              }
        for (unsigned int k = 0; k < layers; ++k)
          for (unsigned int j = 0; j < n; ++j)
            for (unsigned int i = 0; i < n; ++i)
              for (const auto &corners : box_simplices<dim>())
                {
                  CellData<dim> cell(dim + 1);
                  for (unsigned int v = 0; v <= dim; ++v)
                    {
                      const auto &c = corners[v];
                      cell.vertices[v] =
                        first + i + std::lround(c[0]) +
                        n_1 * (j + std::lround(c[1]) +
                               (dim == 3 ? n_1 * (k + std::lround(c[dim - 1])) :
                                           0));
                    }
                  cells.push_back(cell);
                }
      }
    test::write_mesh<dim>("overlapping_mesh.msh",
                          vertices,
                          cells,
                          {},
                          [](const unsigned int, const unsigned int) {
                            return false;
                          });
    const std::string zero = dim == 2 ? "" : ", 0", one = dim == 2 ? "" : ", 1";
    return "Grid/Upper corner = 1, 3" + one + "\nGrid/Subdivisions = 2, 6" +
           (dim == 2 ? "" : ", 2") +
           "\nBoundary conditions/Displacement = bottom: x=0, y=0" +
           (dim == 2 ? "" : ", z=0") + "\nBoundary conditions/Gravity = 0, -1" +
           zero + "\nMaterial points/Body mesh = overlapping_mesh.msh\n";
  }

  template <int dim>
  void
  test_boxes(const std::string                                  &what,
             const std::vector<std::pair<double, unsigned int>> &from,
             const std::vector<std::string>                     &words,
             const std::string                                  &settings = "")
  {
    const std::string told = messages<dim>(boxes<dim>(from) + settings);
    bool              has_all =
      !words.empty() == (told.find("overlap each other") != std::string::npos);
    for (const std::string &word : words)
      has_all = has_all && told.find(word) != std::string::npos;
    test::check(std::to_string(dim) + "D, " + what, has_all, told);
  }

  template <int dim>
  void
  test_dimension()
  {
    test_boxes<dim>("one block", {{0, 4}}, {});
    test_boxes<dim>("twice the same",
                    {{0, 2}, {0, 2}},
                    {"<Material points/Body mesh>",
                     dim == 2 ? "2 m^2" : "2 m^3",
                     "BooleanFragments"});
    test_boxes<dim>("a tenth of a cell in common",
                    {{0, 2}, {0.95, 2}},
                    {"overlap each other"});
    test_boxes<dim>("a small one in a large one",
                    {{0, 1}, {0.5, 4}},
                    {"overlap each other"});
    test_boxes<dim>("blocks that touch", {{0, 2}, {1, 2}}, {});
    test_boxes<dim>("... with other vertices", {{0, 2}, {1, 3}}, {});
    test_boxes<dim>("the overlap is not in the region",
                    {{0, 4}, {0.75, 4}},
                    {},
                    "Material points/Region = y < 0.7\n");
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_dimension<2>();
  test_dimension<3>();
  return 0;
}
