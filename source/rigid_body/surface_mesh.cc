/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/mesh_reader.h>
#include <isochor/rigid_body/surface_mesh.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The corners of an STL file, three for each triangle. */
    std::vector<Point<3>>
    read_stl(std::istream &file, const std::string &subject)
    {
      const std::string     text{std::istreambuf_iterator<char>(file),
                             std::istreambuf_iterator<char>()};
      std::vector<Point<3>> corners;
      // binary: a header, the number of triangles, for each a normal, three
      // corners and two bytes
      constexpr std::size_t header = 80, record = 50;
      std::uint32_t         n = 0;
      if (text.size() >= header + sizeof(n))
        std::memcpy(&n, text.data() + header, sizeof(n));
      if (text.size() >= header + sizeof(n) &&
          text.size() == header + sizeof(n) + record * n)
        {
          for (std::size_t i = 0; i < 3 * std::size_t(n); ++i)
            {
              std::array<float, 3> x;
              std::memcpy(x.data(),
                          text.data() + header + sizeof(n) + record * (i / 3) +
                            sizeof(x) * (1 + i % 3),
                          sizeof(x));
              corners.emplace_back(x[0], x[1], x[2]);
            }
          return corners;
        }
      AssertThrow(text.compare(0, 5, "solid") == 0,
                  ExcMessage(subject +
                             "is no STL file: a text begins with 'solid', and "
                             "a binary file has 84 bytes and 50 for each "
                             "triangle."));
      std::istringstream words(text);
      for (std::string word; words >> word;)
        if (word == "vertex")
          {
            Point<3> x;
            AssertThrow(words >> x[0] >> x[1] >> x[2],
                        ExcMessage(subject + "has a vertex without three "
                                             "coordinates."));
            corners.push_back(x);
          }
      AssertThrow(corners.size() % 3 == 0,
                  ExcMessage(subject + "ends within a triangle."));
      return corners;
    }



    /** The nodes by their numbers. */
    std::map<std::size_t, Point<3>>
    read_nodes(std::istream      &file,
               const double       version,
               const std::string &subject)
    {
      std::map<std::size_t, Point<3>> nodes;
      const auto                      read = [&](const std::size_t tag) {
        Point<3> x;
        file >> x[0] >> x[1] >> x[2];
        nodes[tag] = x;
      };
      std::size_t n = 0, n_blocks = 1, tag = 0;
      if (find_gmsh_section(file, "$Nodes"))
        {
          if (version >= 4)
            file >> n_blocks >> n >> tag >> tag;
          for (std::size_t block = 0; block < n_blocks && file; ++block)
            {
              std::vector<std::size_t> tags;
              if (version >= 4)
                {
                  int ignored;
                  file >> ignored >> ignored >> ignored >> n;
                  for (std::size_t i = 0; i < n && file >> tag; ++i)
                    tags.push_back(tag);
                  for (const std::size_t number : tags)
                    read(number);
                }
              else
                {
                  file >> n;
                  for (std::size_t i = 0; i < n && file >> tag; ++i)
                    read(tag);
                }
            }
        }
      AssertThrow(file && !nodes.empty(),
                  ExcMessage(subject + "has no nodes, or ends within them."));
      return nodes;
    }



    /** Elements of one kind: the numbers of their nodes. */
    template <unsigned int n_nodes>
    using Elements = std::vector<std::array<std::size_t, n_nodes>>;

    /** Throw for elements that are no part of a surface or of what it encloses.
     */
    template <int dim>
    void
    check_type(const int type, const std::string &subject)
    {
      // gmsh's types: 1 line, 2 triangle, 4 tetrahedron, 15 point
      AssertThrow(type == 1 || type == 2 || (dim == 3 && type == 4) ||
                    type == 15,
                  ExcMessage(subject + "has elements of gmsh's type " +
                             std::to_string(type) + ", but a rigid body in " +
                             std::to_string(dim) + "D needs " +
                             (dim == 2 ? "lines or triangles" :
                                         "triangles or tetrahedra") +
                             " of first order."));
    }



    /** Read elements with dim nodes (facets) and with dim + 1 nodes (cells). */
    template <int dim>
    void
    read_elements(std::istream      &file,
                  const double       version,
                  const std::string &subject,
                  Elements<dim>     &facets,
                  Elements<dim + 1> &cells)
    {
      const int   facet_type = dim - 1, cell_type = dim == 2 ? 2 : 4;
      std::string line;
      const auto  read = [&](const int type, std::istream &numbers) {
        check_type<dim>(type, subject);
        if (type == cell_type)
          {
            cells.emplace_back();
            for (std::size_t &node : cells.back())
              numbers >> node;
          }
        else if (type == facet_type)
          {
            facets.emplace_back();
            for (std::size_t &node : facets.back())
              numbers >> node;
          }
        AssertThrow(numbers,
                    ExcMessage(subject + "has an element without its nodes."));
      };
      std::size_t n = 0, n_blocks = 0, number;
      if (!find_gmsh_section(file, "$Elements"))
        return;
      if (version < 4)
        {
          file >> n;
          std::getline(file, line);
          for (std::size_t i = 0; i < n && std::getline(file, line); ++i)
            {
              std::istringstream numbers(line);
              int                type = 0, n_tags = 0, tag;
              numbers >> number >> type >> n_tags;
              for (int k = 0; k < n_tags; ++k)
                numbers >> tag;
              read(type, numbers);
            }
        }
      else
        {
          file >> n_blocks;
          std::getline(file, line);
          for (std::size_t block = 0; block < n_blocks && file; ++block)
            {
              int entity_dim, entity, type = 0;
              file >> entity_dim >> entity >> type >> n;
              std::getline(file, line);
              for (std::size_t i = 0; i < n && std::getline(file, line); ++i)
                {
                  std::istringstream numbers(line);
                  numbers >> number;
                  read(type, numbers);
                }
            }
        }
      AssertThrow(file, ExcMessage(subject + "ends within its elements."));
    }



    /** Nodes at the same place, as where parts of a mesh meet, are one: the
     * first. */
    template <int dim>
    void
    name_places_once(const std::map<std::size_t, Point<3>> &nodes,
                     Elements<dim + 1>                     &cells)
    {
      std::map<std::array<double, 3>, std::size_t> first;
      std::map<std::size_t, std::size_t>           names;
      for (const auto &[tag, x] : nodes)
        names[tag] =
          first.emplace(std::array<double, 3>{{x[0], x[1], x[2]}}, tag)
            .first->second;
      for (auto &cell : cells)
        for (std::size_t &node : cell)
          if (const auto name = names.find(node); name != names.end())
            node = name->second;
    }



    /** The faces that only one of @p cells has. */
    template <int dim>
    Elements<dim>
    boundary_of(const Elements<dim + 1> &cells)
    {
      std::map<std::array<std::size_t, dim>, unsigned int> count;
      for (const auto &cell : cells)
        for (unsigned int left_out = 0; left_out <= dim; ++left_out)
          {
            std::array<std::size_t, dim> face;
            for (unsigned int i = 0, k = 0; i <= dim; ++i)
              if (i != left_out)
                face[k++] = cell[i];
            std::sort(face.begin(), face.end());
            ++count[face];
          }
      Elements<dim> faces;
      for (const auto &[face, n] : count)
        if (n == 1)
          faces.push_back(face);
      return faces;
    }



    /** One vertex for each place, and no facet that is less than one. */
    template <int dim>
    SurfaceMesh<dim>
    merge(const std::vector<std::array<Point<dim>, dim>> &facets)
    {
      SurfaceMesh<dim>                                mesh;
      std::map<std::array<double, dim>, unsigned int> known;
      for (const auto &facet : facets)
        {
          std::array<unsigned int, dim> corners;
          for (unsigned int i = 0; i < dim; ++i)
            {
              std::array<double, dim> key;
              for (unsigned int d = 0; d < dim; ++d)
                key[d] = facet[i][d];
              const auto [entry, is_new] =
                known.emplace(key, mesh.vertices.size());
              if (is_new)
                mesh.vertices.push_back(facet[i]);
              corners[i] = entry->second;
            }
          auto sorted = corners;
          std::sort(sorted.begin(), sorted.end());
          if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end())
            mesh.facets.push_back(corners);
        }
      return mesh;
    }



    template <int dim>
    SurfaceMesh<dim>
    read_gmsh(std::istream &file, const std::string &subject)
    {
      const double      version = check_gmsh_format(file, subject);
      const auto        nodes   = read_nodes(file, version, subject);
      Elements<dim>     facets;
      Elements<dim + 1> cells;
      read_elements<dim>(file, version, subject, facets, cells);
      if (!cells.empty())
        {
          name_places_once<dim>(nodes, cells);
          facets = boundary_of<dim>(cells);
        }
      std::vector<std::array<Point<dim>, dim>> places;
      for (const auto &facet : facets)
        {
          places.emplace_back();
          for (unsigned int i = 0; i < dim; ++i)
            {
              const auto node = nodes.find(facet[i]);
              AssertThrow(node != nodes.end(),
                          ExcMessage(subject + "has an element with the node " +
                                     std::to_string(facet[i]) +
                                     ", which it doesn't list."));
              AssertThrow(dim == 3 || node->second[2] == 0,
                          ExcMessage(subject +
                                     "is not in the plane z = 0, but the scene "
                                     "has <Dimension = 2>."));
              for (unsigned int d = 0; d < dim; ++d)
                places.back()[i][d] = node->second[d];
            }
        }
      return merge<dim>(places);
    }
  } // namespace



  template <int dim>
  SurfaceMesh<dim>
  read_surface_mesh(const std::string &file_name, const std::string &parameter)
  {
    const std::string subject =
      "The mesh file <" + file_name + "> of the parameter <" + parameter + "> ";
    std::error_code code;
    std::ifstream   file(file_name, std::ios::binary);
    AssertThrow(file && !std::filesystem::is_directory(file_name, code),
                ExcMessage(subject +
                           "can't be opened. Names in a parameter file are "
                           "relative to its folder."));
    std::string ending = std::filesystem::path(file_name).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
      return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    SurfaceMesh<dim> mesh;
    if constexpr (dim == 3)
      if (ending == ".stl")
        {
          const auto corners = read_stl(file, subject);
          std::vector<std::array<Point<3>, 3>> triangles;
          for (std::size_t i = 0; i < corners.size(); i += 3)
            triangles.push_back({{corners[i], corners[i + 1], corners[i + 2]}});
          mesh = merge<3>(triangles);
        }
    AssertThrow(ending == ".msh" || (dim == 3 && ending == ".stl"),
                ExcMessage(subject + "must end with .msh (gmsh)" +
                           (dim == 3 ? " or .stl." : ".")));
    if (ending == ".msh")
      mesh = read_gmsh<dim>(file, subject);
    AssertThrow(!mesh.facets.empty(),
                ExcMessage(subject + "holds no surface: no " +
                           (dim == 2 ? "lines or triangles." :
                                       "triangles or tetrahedra.")));
    return mesh;
  }



  template SurfaceMesh<2>
  read_surface_mesh<2>(const std::string &, const std::string &);
  template SurfaceMesh<3>
  read_surface_mesh<3>(const std::string &, const std::string &);
} // namespace isochor
