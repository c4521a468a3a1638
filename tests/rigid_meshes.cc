/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Rigid bodies from files of meshes: against the shapes that these are meshes
// of, whatever the orientation of the facets and the format; and bad files.

#include <isochor/grid/structured_grid.h>

#include <cstdint>
#include <fstream>

#include "rigid_shape_tools.h"

using namespace isochor;

namespace
{
  template <int dim>
  using Facets = std::vector<std::array<Point<dim>, dim>>;

  /** Every third facet is turned. */
  template <int dim>
  Facets<dim>
  mixed_up(Facets<dim> facets)
  {
    for (unsigned int f = 0; f < facets.size(); f += 3)
      std::swap(facets[f][0], facets[f][1]);
    return facets;
  }

  void
  write_stl(const std::string &name, const Facets<3> &facets)
  {
    std::ofstream out(name);
    out.precision(17);
    out << "solid body\n";
    for (const auto &facet : facets)
      {
        out << " facet normal 0 0 0\n  outer loop\n";
        for (const auto &x : facet)
          out << "   vertex " << x << '\n';
        out << "  endloop\n endfacet\n";
      }
    out << "endsolid body\n";
  }

  void
  write_binary_stl(const std::string &name, const Facets<3> &facets)
  {
    std::ofstream     out(name, std::ios::binary);
    const std::string header = "solid, as some binary files begin";
    out << header << std::string(80 - header.size(), ' ');
    const std::uint32_t n = facets.size();
    out.write(reinterpret_cast<const char *>(&n), sizeof(n));
    for (const auto &facet : facets)
      {
        const float zero[3] = {0, 0, 0};
        out.write(reinterpret_cast<const char *>(zero), sizeof(zero));
        for (const auto &x : facet)
          for (unsigned int d = 0; d < 3; ++d)
            {
              const float value = x[d];
              out.write(reinterpret_cast<const char *>(&value), sizeof(value));
            }
        out.write("\0\0", 2);
      }
  }

  /** Elements of one @p type with nodes of their own, format 2.2 or 4.1. */
  template <int dim, std::size_t n_nodes>
  void
  write_msh(const std::string                                  &name,
            const std::vector<std::array<Point<dim>, n_nodes>> &elements,
            const unsigned int                                  type,
            const bool                                          is_new)
  {
    std::ofstream out(name);
    out.precision(17);
    const std::size_t n = elements.size(), n_all = n_nodes * n;
    out << "$MeshFormat\n"
        << (is_new ? "4.1" : "2.2") << " 0 8\n"
        << "$EndMeshFormat\n$Nodes\n";
    if (is_new)
      {
        out << "1 " << n_all << " 1 " << n_all << "\n2 1 0 " << n_all << '\n';
        for (std::size_t i = 1; i <= n_all; ++i)
          out << i << '\n';
      }
    else
      out << n_all << '\n';
    std::size_t number = 0;
    for (const auto &element : elements)
      for (const auto &x : element)
        {
          if (!is_new)
            out << ++number << ' ';
          out << x << (dim == 2 ? " 0\n" : "\n");
        }
    out << "$EndNodes\n$Elements\n";
    if (is_new)
      out << "1 " << n << " 1 " << n << "\n2 1 " << type << ' ' << n << '\n';
    else
      out << n << '\n';
    number = 0;
    for (std::size_t e = 1; e <= n; ++e)
      {
        out << e;
        if (!is_new)
          out << ' ' << type << " 2 1 1";
        for (std::size_t i = 0; i < n_nodes; ++i)
          out << ' ' << ++number;
        out << '\n';
      }
    out << "$EndElements\n";
  }

  /** The simplices of a box. */
  template <int dim>
  std::vector<std::array<Point<dim>, dim + 1>>
  cells_of_box(const Point<dim> &lower, const Point<dim> &upper)
  {
    const StructuredGrid<dim> grid(std::vector<unsigned int>(dim, 2), {});
    const auto vertices = grid.vertices([&](const Point<dim> &unit) {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = lower[d] + unit[d] * (upper[d] - lower[d]);
      return x;
    });
    std::vector<std::array<Point<dim>, dim + 1>> result;
    for (const auto &cell : grid.cells(vertices, "/"))
      {
        result.emplace_back();
        for (unsigned int i = 0; i <= dim; ++i)
          result.back()[i] = vertices[cell.vertices[i]];
      }
    return result;
  }

  /** Both shapes see the same. */
  template <int dim>
  void
  compare(const std::string     &what,
          const RigidShape<dim> &shape,
          const RigidShape<dim> &expected,
          const Point<dim>      &middle,
          const double           size)
  {
    test::Random       random;
    test::WorstError   error;
    const unsigned int n = 400;
    for (unsigned int i = 0; i < n; ++i)
      {
        Point<dim> x = middle;
        for (unsigned int d = 0; d < dim; ++d)
          x[d] += size * random();
        // also places on lines that edges of facets may be on
        if (i % 2 == 0)
          for (unsigned int d = 0; d < dim; ++d)
            x[d] = std::round(4 * x[d]) / 4;
        const auto         a = shape.closest(x), b = expected.closest(x);
        std::ostringstream where;
        where << x;
        error.add(std::abs(a.distance - b.distance),
                  "distance at " + where.str());
        // where two faces are equally near either may be taken
        if (b.distance < 1e-12 && (a.normal - b.normal).norm() > 1e-6)
          continue;
        error.add((a.normal - b.normal).norm(), "normal at " + where.str());
        error.add((a.point - b.point).norm(), "place at " + where.str());
        // none on the line where a face ends and the surroundings of an edge
        // begin
        Tensor<1, dim> aside;
        for (unsigned int d = 0; d < dim; ++d)
          aside[d] = 1e-7 * (d + 1);
        if ((expected.closest(x + aside).curvature -
             expected.closest(x - aside).curvature)
              .norm() > 1e-3)
          continue;
        error.add((a.curvature - b.curvature).norm(),
                  "curvature at " + where.str());
      }
    error.report(what, 1e-6);
  }

  void
  test_in_the_plane()
  {
    const auto box = test::make_shape<2>("Shape = box\nLower corner = 0, 0\n"
                                         "Upper corner = 2, 1");
    const auto triangles = cells_of_box<2>({0, 0}, {2, 1});
    write_msh<2, 3>("triangles.msh", triangles, 2, false);
    const auto mesh = test::make_shape<2>("Shape = mesh\nFile = triangles.msh");
    compare<2>("a mesh of triangles is a box", *mesh, *box, {1, 0.5}, 2);
    write_msh<2, 2>("lines.msh", mixed_up<2>(mesh->surface(1)), 1, true);
    compare<2>("a mesh of lines is a box",
               *test::make_shape<2>("Shape = mesh\nFile = lines.msh"),
               *box,
               {1, 0.5},
               2);
    // with a hole, and scaled
    Facets<2> lines;
    for (const double r : {1000., 500.})
      for (unsigned int k = 0; k < 4; ++k)
        {
          const auto corner = [r](const unsigned int i) {
            return Point<2>(i % 4 == 0 || i % 4 == 3 ? -r : r,
                            i % 4 < 2 ? -r : r);
          };
          lines.push_back({{corner(k), corner(k + 1)}});
        }
    write_msh<2, 2>("frame.msh", mixed_up<2>(lines), 1, false);
    const auto frame =
      test::make_shape<2>("Shape = mesh\nFile = frame.msh\nScale = 0.001");
    test::test_shape<2>(*frame, {"a frame", {0, 0}, 1.2});
    test::report("a hole is outside",
                 std::abs(frame->closest({0, 0.1}).distance - 0.4) < 1e-12,
                 std::to_string(frame->closest({0, 0.1}).distance));
  }

  void
  test_boxes_in_space()
  {
    const auto box = test::make_shape<3>("Shape = box\nLower corner = 0, 0, 0\n"
                                         "Upper corner = 2, 1, 1.5");
    const Point<3> middle(1, 0.5, 0.75);
    write_msh<3, 4>("tetrahedra.msh",
                    cells_of_box<3>({0, 0, 0}, {2, 1, 1.5}),
                    4,
                    true);
    const auto mesh =
      test::make_shape<3>("Shape = mesh\nFile = tetrahedra.msh");
    compare<3>("a mesh of tetrahedra is a box", *mesh, *box, middle, 2);
    const auto facets = mixed_up<3>(mesh->surface(1));
    write_msh<3, 3>("triangles3.msh", facets, 2, false);
    compare<3>("a mesh of triangles is a box",
               *test::make_shape<3>("Shape = mesh\nFile = triangles3.msh"),
               *box,
               middle,
               2);
    write_stl("box.stl", facets);
    compare<3>("an STL file is a box",
               *test::make_shape<3>("Shape = mesh\nFile = box.stl"),
               *box,
               middle,
               2);
    write_binary_stl("binary.STL", facets);
    compare<3>("a binary STL file is a box",
               *test::make_shape<3>("Shape = mesh\nFile = binary.STL"),
               *box,
               middle,
               2);
  }

  void
  test_round_body()
  {
    // the facets of a cone: a sharp apex, edges that are hardly bent
    const auto cone = test::make_shape<3>("Shape = cone\nDirection = 0, 0, 1\n"
                                          "Shaft radius = 0.5\nLength = 1.5");
    write_stl("cone.stl", mixed_up<3>(cone->surface(1)));
    const auto mesh = test::make_shape<3>("Shape = mesh\nFile = cone.stl");
    test::test_shape<3>(*mesh, {"mesh of a cone", {0, 0, 0.9}, 0.7, 1e-9, 100});
    test::Random     random;
    test::WorstError distance, normal;
    for (unsigned int n = 0; n < 200; ++n)
      {
        const Point<3> x(random(), random(), 0.7 + random());
        const auto     a = mesh->closest(x), b = cone->closest(x);
        distance.add(std::abs(a.distance - b.distance), "x");
        if (b.distance > 0)
          normal.add((a.normal - b.normal).norm(), "x");
      }
    // chords of 48 edges
    distance.report("distance from the mesh of a cone",
                    0.5 * (1 - std::cos(numbers::PI / 48)));
    normal.report("normal of the mesh of a cone", 1.1 * numbers::PI / 48);
  }

  template <int dim>
  void
  test_error(const std::string              &what,
             const std::string              &file,
             const std::vector<std::string> &words)
  {
    test::expect_error(what, words, [&]() {
      test::make_shape<dim>("Shape = mesh\nFile = " + file);
    });
  }

  void
  write(const std::string &name, const std::string &text)
  {
    std::ofstream(name) << text;
  }

  void
  test_errors()
  {
    test_error<2>("no file",
                  "nowhere.msh",
                  {"<nowhere.msh>",
                   "<Rigid body: tool/File>",
                   "can't be opened"});
    write("body.obj", "");
    test_error<3>("an unknown format", "body.obj", {".msh (gmsh) or .stl"});
    write("plane.stl", "solid a\nendsolid a\n");
    test_error<2>("STL in the plane", "plane.stl", {"must end with .msh"});
    test_error<3>("an empty STL file", "plane.stl", {"holds no surface"});
    write("bad.stl", "facets");
    test_error<3>("no STL file", "bad.stl", {"is no STL file"});
    write("cut.stl", "solid a\nvertex 0 0 0\nvertex 1 0\n");
    test_error<3>("a cut vertex", "cut.stl", {"without three coordinates"});
    write("cut.stl", "solid a\nvertex 0 0 0\nvertex 1 0 0\n");
    test_error<3>("a cut triangle", "cut.stl", {"ends within a triangle"});
    auto facets =
      test::make_shape<3>("Shape = box\nUpper corner = 1, 1, 1")->surface(1);
    facets.pop_back();
    write_stl("open.stl", facets);
    test_error<3>("an open surface",
                  "open.stl",
                  {"<open.stl>",
                   "is not a closed surface",
                   "1 triangles share"});
    write_msh<2, 2>("open.msh",
                    {{{Point<2>(0, 0), Point<2>(1, 0)}},
                     {{Point<2>(1, 0), Point<2>(1, 1)}}},
                    1,
                    false);
    test_error<2>("an open line",
                  "open.msh",
                  {"is not a closed surface",
                   "1 lines end at the point (0, 0)"});
    write_msh<2, 3>("empty.msh", {}, 2, false);
    test_error<2>("an empty mesh", "empty.msh", {"has no nodes"});
    write_msh<3, 3>(
      "tilted.msh",
      {{{Point<3>(0, 0, 0), Point<3>(1, 0, 0), Point<3>(0, 0, 1)}}},
      2,
      false);
    test_error<2>("a mesh in space",
                  "tilted.msh",
                  {"is not in the plane z = 0"});
    write_msh<2, 4>(
      "quadrilateral.msh",
      {{{Point<2>(0, 0), Point<2>(1, 0), Point<2>(1, 1), Point<2>(0, 1)}}},
      3,
      true);
    test_error<2>("a quadrilateral",
                  "quadrilateral.msh",
                  {"gmsh's type 3", "lines or triangles of first order"});
    write("points.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n"
          "$EndNodes\n$Elements\n1\n1 15 2 1 1 1\n$EndElements\n");
    test_error<2>("only points", "points.msh", {"holds no surface"});
    write("cut.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n"
          "$EndNodes\n$Elements\n2\n1 1 2 1 1 1 1\n");
    test_error<2>("a file that ends early",
                  "cut.msh",
                  {"ends within its elements"});
    write("lost.msh",
          "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n"
          "$EndNodes\n$Elements\n1\n1 1 2 1 1 1 7\n$EndElements\n");
    test_error<2>("a node that isn't there", "lost.msh", {"with the node 7"});
  }
} // namespace

int
main()
{
  test_in_the_plane();
  test_boxes_in_space();
  test_round_body();
  test_errors();
  return 0;
}
