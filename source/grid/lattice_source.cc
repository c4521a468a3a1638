/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/adaptive_grid.h>
#include <isochor/grid/lattice_source.h>
#include <isochor/grid/structured_grid.h>

#include <array>

namespace isochor
{
  namespace
  {
    /** The number of a side is its boundary id. */
    template <int dim>
    std::map<std::string, types::boundary_id>
    side_ids()
    {
      const std::array<std::string, 6> names = {
        {"left", "right", "bottom", "top", "front", "back"}};
      std::map<std::string, types::boundary_id> ids;
      for (unsigned int side = 0; side < 2 * dim; ++side)
        ids[names[side]] = side;
      return ids;
    }
  } // namespace



  template <int dim>
  void
  LatticeSource<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Subdivisions",
                      dim == 2 ? "8, 8" : "8, 8, 8",
                      Patterns::List(Patterns::Integer(1), dim, dim),
                      "Cells per direction of a box or trapezoid; each is "
                      "split into 2 triangles or 6 tetrahedra.");
    prm.declare_entry("Diagonals",
                      "/",
                      Patterns::Selection("/|\\|backslash|alternating"),
                      "Direction of the diagonals by which the cells of a "
                      "box or trapezoid are split; alternating: by turns, "
                      "so that none is preferred. 'backslash' is another "
                      "word for \\, which at the end of a line joins it "
                      "with the next.");
    prm.declare_entry(
      "Offset",
      dim == 2 ? "0, 0" : "0, 0, 0",
      Patterns::List(Patterns::Double(-0.9, 0.9), dim, dim),
      "By how much of a cell the inner grid lines (planes) of a "
      "box or trapezoid are moved along each axis; its sides stay. Where "
      "the lines lie below the body is arbitrary; by how much a result "
      "changes with them is its error: see the option --grid-offsets.");
  }



  template <int dim>
  void
  LatticeSource<dim>::parse_parameters(ParameterHandler &prm)
  {
    diagonals = prm.get("Diagonals");
    for (const int n : Utilities::string_to_int(
           Utilities::split_string_list(prm.get("Subdivisions"))))
      subdivisions.push_back(n);
    offset = Utilities::string_to_double(
      Utilities::split_string_list(prm.get("Offset")));
  }



  template <int dim>
  MeshGroups
  LatticeSource<dim>::make_mesh(Triangulation<dim> &tria) const
  {
    const StructuredGrid<dim> lattice(subdivisions, offset);
    const auto                vertices =
      lattice.vertices([this](const Point<dim> &unit) { return place(unit); });
    tria.create_triangulation(vertices,
                              lattice.cells(vertices, diagonals),
                              SubCellData());
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          for (unsigned int side = 0; side < 2 * dim; ++side)
            {
              bool on_side = true;
              for (const unsigned int v : cell->face(f)->vertex_indices())
                on_side = on_side &&
                          lattice.on_side(cell->face(f)->vertex_index(v), side);
              if (on_side)
                cell->face(f)->set_boundary_id(side);
            }
    return {side_ids<dim>(), {}};
  }



  template <int dim>
  std::vector<Hypercube<dim>>
  LatticeSource<dim>::hypercubes() const
  {
    return StructuredGrid<dim>(subdivisions, offset).boxes();
  }



  template <int dim>
  CoarseGrid<dim>
  LatticeSource<dim>::coarse_cells(MeshGroups &groups) const
  {
    groups.faces = side_ids<dim>();
    return coarse_lattice<dim>(subdivisions, [this](const Point<dim> &unit) {
      return place(unit);
    });
  }



  template <int dim>
  Point<dim>
  parse_point(const std::string &text, const std::string &parameter)
  {
    const auto coordinates =
      Utilities::string_to_double(Utilities::split_string_list(text));
    AssertThrow(coordinates.size() == dim,
                ExcMessage("The parameter <" + parameter + "> must have " +
                           std::to_string(dim) + " coordinates, not <" + text +
                           ">."));
    Point<dim> p;
    for (unsigned int d = 0; d < dim; ++d)
      p[d] = coordinates[d];
    return p;
  }



  template class LatticeSource<2>;
  template class LatticeSource<3>;
  template Point<2>
  parse_point<2>(const std::string &, const std::string &);
  template Point<3>
  parse_point<3>(const std::string &, const std::string &);
} // namespace isochor
