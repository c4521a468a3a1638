/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/grid/grid_tools.h>

#include <isochor/base/expression.h>
#include <isochor/grid/background_grid.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/structured_grid.h>

#include <algorithm>
#include <array>
#include <set>

namespace isochor
{
  namespace
  {
    template <int dim>
    Point<dim>
    parse_point(const std::string &text, const std::string &parameter)
    {
      const auto coordinates =
        Utilities::string_to_double(Utilities::split_string_list(text));
      AssertThrow(coordinates.size() == dim,
                  ExcMessage("The parameter <" + parameter + "> must have " +
                             std::to_string(dim) + " coordinates, not <" +
                             text + ">."));
      Point<dim> p;
      for (unsigned int d = 0; d < dim; ++d)
        p[d] = coordinates[d];
      return p;
    }
  } // namespace



  template <int dim>
  BackgroundGrid<dim>::BackgroundGrid(const MPI_Comm comm)
    : comm(comm)
    , tria(new_triangulation())
    , p1_mapping(FE_SimplexP<dim>(1))
  {}



  template <int dim>
  std::unique_ptr<typename BackgroundGrid<dim>::SharedTriangulation>
  BackgroundGrid<dim>::new_triangulation() const
  {
    return std::make_unique<SharedTriangulation>(
      comm,
      Triangulation<dim>::none,
      false,
      SharedTriangulation::partition_custom_signal);
  }



  template <int dim>
  void
  BackgroundGrid<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid");
    prm.declare_entry(
      "Type",
      "box",
      Patterns::Selection("box|trapezoid|gmsh|adaptive"),
      "How the background grid is made. Boxes and trapezoids "
      "are structured simplex meshes with the boundaries left "
      "and right (least and largest x), bottom and top (y) "
      "and, in 3D, front and back (z); of a trapezoid its "
      "sides as they are before it is distorted. A gmsh file "
      "brings its physical groups as boundary names. An adaptive "
      "grid is refined from coarse quadrilaterals or "
      "hexahedra, see 'Coarse cells', as the section 'Adaptive "
      "grid' says.");
    prm.declare_entry("Coarse cells",
                      "box",
                      Patterns::Selection("box|trapezoid|gmsh"),
                      "What an adaptive grid is refined from: the "
                      "'Subdivisions' of a box or a trapezoid, or the "
                      "quadrilaterals (2D) or hexahedra (3D) of a gmsh file.");
    prm.declare_entry("Lower corner",
                      dim == 2 ? "0, 0" : "0, 0, 0",
                      Patterns::List(Patterns::Double(), dim, dim),
                      "Of a box (m).");
    prm.declare_entry("Upper corner",
                      dim == 2 ? "1, 1" : "1, 1, 1",
                      Patterns::List(Patterns::Double(), dim, dim),
                      "Of a box (m).");
    prm.declare_entry("Corners",
                      "0, 0; 1, 0; 1, 1; 0, 1",
                      Patterns::Anything(),
                      "The four corners of a trapezoid, counter-clockwise from "
                      "bottom left (m). In 3D it is extruded from z = 0 to "
                      "'Depth'.");
    prm.declare_entry("Depth",
                      "1",
                      Patterns::Double(0),
                      "Extrusion of a trapezoid in 3D (m).");
    prm.declare_entry("Subdivisions",
                      dim == 2 ? "8, 8" : "8, 8, 8",
                      Patterns::List(Patterns::Integer(1), dim, dim),
                      "Cells per direction of a box or trapezoid; each is "
                      "split into 2 triangles or 6 tetrahedra.");
    prm.declare_entry("Diagonals",
                      "/",
                      Patterns::Selection("/|\\|backslash|alternating"),
                      "Direction of the diagonals of a structured mesh.");
    prm.declare_entry(
      "Offset",
      dim == 2 ? "0, 0" : "0, 0, 0",
      Patterns::List(Patterns::Double(-0.9, 0.9), dim, dim),
      "By how much of a cell the inner grid lines (planes) of a "
      "box or trapezoid are moved along each axis; its sides "
      "stay. What changes with it is decided by the place of "
      "the grid: see the option --grid-offsets.");
    prm.declare_entry("File", "", Patterns::Anything(), "A gmsh .msh file.");
    prm.declare_entry(
      "Stretch",
      "",
      Patterns::Anything(),
      "A grid that follows a prescribed motion: 'axis: coordinate -> "
      "displacement(t), coordinate -> displacement(t), ...', for example "
      "'y: 0 -> 0, 0.1 -> 1e-3*t'. The grid planes at the given coordinates "
      "move as told, those between them are interpolated linearly. Empty: the "
      "grid rests.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid");
    parameters.type = prm.get("Type");
    parameters.coarse_type =
      parameters.type == "adaptive" ? prm.get("Coarse cells") : parameters.type;
    parameters.lower =
      parse_point<dim>(prm.get("Lower corner"), "Grid/Lower corner");
    parameters.upper =
      parse_point<dim>(prm.get("Upper corner"), "Grid/Upper corner");
    for (unsigned int d = 0; d < dim; ++d)
      AssertThrow(parameters.coarse_type != "box" ||
                    parameters.upper[d] > parameters.lower[d],
                  ExcMessage("The parameter <Grid/Upper corner> must exceed "
                             "<Grid/Lower corner> in every coordinate."));
    for (const auto &corner :
         Utilities::split_string_list(prm.get("Corners"), ';'))
      parameters.corners.push_back(parse_point<2>(corner, "Grid/Corners"));
    AssertThrow(parameters.corners.size() == 4,
                ExcMessage("The parameter <Grid/Corners> must list 4 points."));
    parameters.depth     = prm.get_double("Depth");
    parameters.diagonals = prm.get("Diagonals");
    parameters.file      = prm.get("File");
    for (const int n : Utilities::string_to_int(
           Utilities::split_string_list(prm.get("Subdivisions"))))
      parameters.subdivisions.push_back(n);
    parameters.offset = Utilities::string_to_double(
      Utilities::split_string_list(prm.get("Offset")));

    for (const auto &motion :
         split_named_list(prm.get("Stretch"), "Grid/Stretch"))
      {
        const std::string axes = "xyz";
        AssertThrow(parameters.stretch_axis == -1 && motion.first.size() == 1 &&
                      axes.substr(0, dim).find(motion.first) !=
                        std::string::npos,
                    ExcMessage("The parameter <Grid/Stretch> must name one "
                               "axis of " +
                               axes.substr(0, dim) + ", not <" + motion.first +
                               ">."));
        parameters.stretch_axis = axes.find(motion.first);
        for (const auto &plane : split_formulas(motion.second, "Grid/Stretch"))
          {
            const auto arrow = plane.find("->");
            AssertThrow(arrow != std::string::npos,
                        ExcMessage("The entry <" + plane +
                                   "> of the parameter <Grid/Stretch> must "
                                   "have the form <coordinate -> "
                                   "displacement>."));
            stretch_planes.push_back(Utilities::string_to_double(
              Utilities::trim(plane.substr(0, arrow))));
            plane_displacement.emplace_back(plane.substr(arrow + 2),
                                            "Grid/Stretch",
                                            FormulaVariables::time);
            AssertThrow(stretch_planes.size() < 2 ||
                          stretch_planes.back() >
                            stretch_planes[stretch_planes.size() - 2],
                        ExcMessage("The coordinates of <Grid/Stretch> must "
                                   "ascend."));
          }
      }
    prm.leave_subsection();
  }



  template <int dim>
  void
  BackgroundGrid<dim>::create()
  {
    if (parameters.type == "adaptive")
      {
        forest = std::make_unique<AdaptiveGrid<dim>>(make_coarse_grid());
        const auto leaves = forest->leaves();
        change(leaves,
               partition_leaves(std::vector<double>(leaves.size(), 1.),
                                Utilities::MPI::n_mpi_processes(comm)),
               0.);
        return;
      }
    tria->signals.create.connect([this]() {
      if (tria->n_active_cells() > 0)
        GridTools::partition_triangulation(
          Utilities::MPI::n_mpi_processes(comm), *tria);
    });
    if (parameters.type == "gmsh")
      read_gmsh();
    else
      create_structured();
    read_mesh_data();
    if (is_moving())
      set_vertices(vertices_at_time(0.));
  }



  template <int dim>
  void
  BackgroundGrid<dim>::assign_owners()
  {
    vertex_owners.assign(tria->n_vertices(), numbers::invalid_unsigned_int);
    for (unsigned int cell = 0; cell < cached_geometry->n_cells(); ++cell)
      for (const unsigned int v : cached_geometry->vertex_indices(cell))
        vertex_owners[v] =
          std::min(vertex_owners[v], cached_geometry->owner(cell));
  }



  template <int dim>
  void
  BackgroundGrid<dim>::collect_boundary()
  {
    faces.clear();
    for (const auto &cell : tria->active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          {
            std::set<unsigned int> on_face;
            for (const unsigned int v : cell->face(f)->vertex_indices())
              on_face.insert(cell->face(f)->vertex_index(v));
            for (const unsigned int v : cell->vertex_indices())
              if (on_face.count(cell->vertex_index(v)) == 0)
                faces.push_back(
                  {cell->active_cell_index(), v, cell->face(f)->boundary_id()});
          }
  }



  template <int dim>
  Point<dim>
  BackgroundGrid<dim>::place_at_time(const Point<dim> &reference,
                                     const double      time) const
  {
    // piecewise linear in the coordinate along the axis, constant outside
    const unsigned int axis         = parameters.stretch_axis;
    const auto        &planes       = stretch_planes;
    const double       y            = reference[axis];
    const auto         displacement = [&](const unsigned int plane) {
      return plane_displacement[plane](Point<1>(planes[plane]), time);
    };
    const unsigned int above =
      std::upper_bound(planes.begin(), planes.end(), y) - planes.begin();
    Point<dim> place = reference;
    if (above == 0)
      place[axis] += displacement(0);
    else if (above == planes.size())
      place[axis] += displacement(above - 1);
    else
      {
        const double s =
          (y - planes[above - 1]) / (planes[above] - planes[above - 1]);
        place[axis] +=
          (1 - s) * displacement(above - 1) + s * displacement(above);
      }
    return place;
  }



  template <int dim>
  bool
  BackgroundGrid<dim>::is_moving() const
  {
    return parameters.stretch_axis >= 0;
  }



  template <int dim>
  std::vector<Point<dim>>
  BackgroundGrid<dim>::vertices_at_time(const double time) const
  {
    std::vector<Point<dim>> positions = reference_vertices;
    if (is_moving())
      for (auto &position : positions)
        position = place_at_time(position, time);
    return positions;
  }



  template <int dim>
  void
  BackgroundGrid<dim>::set_vertices(const std::vector<Point<dim>> &positions)
  {
    // deal.II offers write access to vertices only through cells
    for (const auto &cell : tria->active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        cell->vertex(v) = positions[cell->vertex_index(v)];
    cached_geometry->set_vertices(positions);
  }



  template <int dim>
  types::boundary_id
  BackgroundGrid<dim>::boundary_id(const std::string &name,
                                   const std::string &parameter) const
  {
    const auto found = names.find(name);
    if (found == names.end())
      {
        std::string known;
        for (const auto &entry : names)
          known += (known.empty() ? "" : ", ") + entry.first;
        AssertThrow(false,
                    ExcMessage("The parameter <" + parameter +
                               "> names the boundary <" + name +
                               ">, which the grid does not have. It has: " +
                               known + "."));
      }
    return found->second;
  }



  template <int dim>
  const std::map<std::string, types::material_id> &
  BackgroundGrid<dim>::group_ids() const
  {
    return group_names;
  }



  template <int dim>
  std::string
  BackgroundGrid<dim>::boundary_crossed(const unsigned int cell,
                                        const Point<dim>  &x) const
  {
    const SimplexGeometry<dim> &geometry = *cached_geometry;
    Point<dim>                  start;
    for (const unsigned int vertex : geometry.vertex_indices(cell))
      start += geometry.vertices()[vertex] / (dim + 1.);

    // the first face that the line from there meets: where the barycentric
    // coordinate of the opposite vertex vanishes and the others don't exceed 1
    constexpr double   tolerance = 1e-6;
    double             first     = 1 + tolerance;
    types::boundary_id id        = numbers::invalid_boundary_id;
    for (const BoundaryFace &face : faces)
      {
        const double a =
          geometry.barycentric(face.cell, start)[face.opposite_vertex];
        const double b =
          geometry.barycentric(face.cell, x)[face.opposite_vertex];
        if (!(a >= 0 && b < a))
          continue;
        const double s = a / (a - b);
        const auto   lambda =
          geometry.barycentric(face.cell, Point<dim>(start + s * (x - start)));
        if (s<first && * std::min_element(lambda.begin(), lambda.end())> -
            tolerance)
          {
            first = s;
            id    = face.id;
          }
      }
    for (const auto &name : names)
      if (name.second == id)
        return name.first;
    return "a boundary without a name";
  }



  template <int dim>
  const std::map<std::string, types::boundary_id> &
  BackgroundGrid<dim>::boundary_names() const
  {
    return names;
  }



  template <int dim>
  const std::vector<BoundaryFace> &
  BackgroundGrid<dim>::boundary_faces() const
  {
    return faces;
  }



  template <int dim>
  const parallel::shared::Triangulation<dim> &
  BackgroundGrid<dim>::triangulation() const
  {
    return *tria;
  }



  template <int dim>
  const SimplexGeometry<dim> &
  BackgroundGrid<dim>::geometry() const
  {
    return *cached_geometry;
  }



  template <int dim>
  const Mapping<dim> &
  BackgroundGrid<dim>::mapping() const
  {
    return p1_mapping;
  }



  template <int dim>
  MPI_Comm
  BackgroundGrid<dim>::communicator() const
  {
    return comm;
  }



  template class BackgroundGrid<2>;
  template class BackgroundGrid<3>;
} // namespace isochor
