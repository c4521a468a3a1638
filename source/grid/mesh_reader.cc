/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/grid/grid_in.h>

#include <isochor/base/plain_message.h>
#include <isochor/grid/mesh_reader.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace isochor
{
  bool
  find_gmsh_section(std::istream &file, const std::string &title)
  {
    file.clear();
    file.seekg(0);
    for (std::string line; std::getline(file, line);)
      if (line.compare(0, title.size(), title) == 0)
        return true;
    return false;
  }



  double
  check_gmsh_format(std::istream &file, const std::string &subject)
  {
    const std::string expected =
      "It must be a gmsh .msh file in text form, format 2 or 4.1.";
    std::string header;
    std::getline(file, header);
    if (header.compare(0, 4, "$NOD") == 0)
      AssertThrow(false,
                  ExcMessage(subject + "has gmsh's format 1. " + expected));
    AssertThrow(header.compare(0, 11, "$MeshFormat") == 0,
                ExcMessage(subject +
                           "can't be read: it does not start with "
                           "$MeshFormat. " +
                           expected));
    double version   = 0;
    int    is_binary = 0;
    file >> version >> is_binary;
    AssertThrow(is_binary == 0,
                ExcMessage(subject +
                           "is binary. Let gmsh write text: 'Mesh.Binary = "
                           "0;' in the .geo file, or no option -bin."));
    AssertThrow(file && ((version >= 2 && version < 3) || version == 4.1),
                ExcMessage(subject + "has format " +
                           std::to_string(version).substr(0, 3) + ". " +
                           expected +
                           " Let gmsh write it with 'Mesh.MshFileVersion = "
                           "2.2;'."));
    return version;
  }



  namespace
  {
    /** What messages start with. */
    std::string
    subject(const std::string &file_name, const std::string &parameter)
    {
      return "The mesh file <" + file_name + "> of the parameter <" +
             parameter + "> ";
    }



    /** The gmsh types of the elements in the file. */
    std::set<int>
    element_types(std::istream &file, const double version)
    {
      std::set<int> types;
      if (!find_gmsh_section(file, "$Elements"))
        return types;
      std::size_t n = 0, n_blocks = 0;
      std::string line;
      if (version < 4)
        {
          file >> n;
          for (std::size_t i = 0; i < n && file; ++i)
            {
              std::size_t number;
              int         type;
              if (file >> number >> type)
                types.insert(type);
              std::getline(file, line);
            }
          return types;
        }
      file >> n_blocks;
      std::getline(file, line);
      for (std::size_t block = 0; block < n_blocks && file; ++block)
        {
          int entity_dim, entity, type;
          if (file >> entity_dim >> entity >> type >> n)
            types.insert(type);
          std::getline(file, line);
          for (std::size_t i = 0; i < n && file; ++i)
            std::getline(file, line);
        }
      return types;
    }



    /** Throw for elements that aren't @p cells of first order. */
    void
    check_elements(const std::set<int> &types,
                   const unsigned int   dim,
                   const MeshCells      cells,
                   const std::string   &subject)
    {
      // the gmsh reference manual, "MSH file format": 1 line, 2 triangle,
      // 4 tetrahedron, 15 point; 3, 5, 6, 7 quadrangle, hexahedron, prism,
      // pyramid; from 8 on the same of higher order
      const bool        simplices = (cells == MeshCells::simplices);
      const int         wanted = simplices ? 2 * dim - 2 : 2 * dim - 1; // type
      const std::string name   = simplices ?
                                   (dim == 2 ? "triangles" : "tetrahedra") :
                                   (dim == 2 ? "quadrilaterals" : "hexahedra");
      for (const int type : types)
        {
          AssertThrow(type <= 7 || type == 15,
                      ExcMessage(subject +
                                 "holds elements of second or higher order "
                                 "(gmsh's type " +
                                 std::to_string(type) +
                                 "). Let gmsh write first order: "
                                 "'Mesh.ElementOrder = 1;' in the .geo file, "
                                 "or -order 1."));
          AssertThrow(!simplices || (type != 3 && (type < 5 || type == 15)),
                      ExcMessage(subject +
                                 "holds other cells than triangles (2D) or "
                                 "tetrahedra (3D): gmsh's type " +
                                 std::to_string(type) +
                                 ". Don't recombine or extrude in layers."));
          AssertThrow(simplices ||
                        (type != 2 && type != 4 && type != 6 && type != 7),
                      ExcMessage(subject + "holds other cells than " + name +
                                 ": gmsh's type " + std::to_string(type) +
                                 ". Let gmsh recombine all of it, or use "
                                 "<Grid/Type = gmsh>."));
        }
      AssertThrow(dim == 3 || types.count(simplices ? 4 : 5) == 0,
                  ExcMessage(subject + "holds " +
                             (simplices ? "tetrahedra" : "hexahedra") +
                             ", but the scene has <Dimension = 2>."));
      AssertThrow(types.count(wanted) > 0,
                  ExcMessage(subject + "holds no " + name +
                             ". If it has physical groups, gmsh saves only "
                             "what is in one: put the cells of the " +
                             (dim == 2 ? "surfaces" : "volumes") +
                             " into one, too."));
    }



    /** The names of the physical groups of dimension @p group_dim. */
    std::map<std::string, unsigned int>
    read_physical_names(std::istream      &file,
                        const int          group_dim,
                        const std::string &subject)
    {
      std::map<std::string, unsigned int> names;
      if (!find_gmsh_section(file, "$PhysicalNames"))
        return names;
      unsigned int n = 0;
      file >> n;
      for (unsigned int i = 0; i < n && file; ++i)
        {
          int          d  = 0;
          unsigned int id = 0;
          std::string  line;
          file >> d >> id;
          std::getline(file, line);
          const auto first = line.find('"'), last = line.rfind('"');
          if (d != group_dim || first == std::string::npos)
            continue;
          const std::string name = line.substr(first + 1, last - first - 1);
          AssertThrow(names.emplace(name, id).second,
                      ExcMessage(subject + "has two physical groups <" + name +
                                 "> of " + std::to_string(d) +
                                 " dimensions. Give them names of their own, "
                                 "or make them one."));
        }
      return names;
    }
  } // namespace



  bool
  in_groups(const types::material_id                         id,
            const std::vector<std::string>                  &wanted,
            const std::map<std::string, types::material_id> &ids)
  {
    for (const std::string &name : wanted)
      {
        const auto group = ids.find(name);
        if (group == ids.end())
          {
            std::string known;
            for (const auto &entry : ids)
              known += (known.empty() ? "" : ", ") + entry.first;
            AssertThrow(false,
                        ExcMessage(
                          "The parameter <Material points/Physical groups> "
                          "names <" +
                          name + ">, but the mesh has " +
                          (known.empty() ? "no named group of cells" :
                                           "the groups of cells " + known) +
                          "."));
          }
        if (id == group->second)
          return true;
      }
    return wanted.empty();
  }



  template <int dim>
  MeshGroups
  read_mesh(const std::string  &file_name,
            const std::string  &parameter,
            Triangulation<dim> &tria,
            const MeshCells     cells)
  {
    const std::string name = subject(file_name, parameter);
    std::error_code   code;
    std::ifstream     file(file_name, std::ios::binary);
    AssertThrow(file && !std::filesystem::is_directory(file_name, code),
                ExcMessage(name +
                           "can't be opened. Names in a parameter file are "
                           "relative to its folder."));
    const double version = check_gmsh_format(file, name);
    check_elements(element_types(file, version), dim, cells, name);

    MeshGroups groups;
    for (const auto &group : read_physical_names(file, dim - 1, name))
      groups.faces[group.first] = group.second;
    for (const auto &group : read_physical_names(file, dim, name))
      groups.cells[group.first] = group.second;

    file.clear();
    file.seekg(0);
    try
      {
        GridIn<dim> grid_in(tria);
        // from a stream: the version for file names drops the boundary ids
        grid_in.read_msh(file);
      }
    catch (const std::exception &exc)
      {
        AssertThrow(false,
                    ExcMessage(name +
                               "can't be read as a gmsh .msh file (format 2 or "
                               "4.1): " +
                               plain_message(exc)));
      }
    return groups;
  }



  template MeshGroups
  read_mesh<2>(const std::string &,
               const std::string &,
               Triangulation<2> &,
               const MeshCells);
  template MeshGroups
  read_mesh<3>(const std::string &,
               const std::string &,
               Triangulation<3> &,
               const MeshCells);
} // namespace isochor
