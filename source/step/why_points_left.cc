/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/step/why_points_left.h>
#include <isochor/transfer/grid_reset.h>

namespace isochor
{
  namespace
  {
    /** Whether a condition holds the displacement normal to @p boundary, at
     * least on a part of it. */
    template <int dim>
    bool
    is_held(const std::string &boundary, const CellOccupancy<dim> &walls)
    {
      const auto &names = walls.grid.boundary_names();
      const auto  name  = names.find(boundary);
      if (name == names.end())
        return false;
      // all vertices of an open face are marked, of a held one those at its rim
      for (const BoundaryFace &face : walls.grid.boundary_faces())
        if (face.id == name->second)
          {
            const auto &vertices =
              walls.grid.geometry().vertex_indices(face.cell);
            for (unsigned int v = 0; v <= dim; ++v)
              if (v != face.opposite_vertex &&
                  !walls.is_at_open_boundary(vertices[v]))
                return true;
          }
      return false;
    }
  } // namespace



  template <int dim>
  std::string
  why_points_left(const std::vector<std::string> &boundaries,
                  const Scene<dim>               &scene,
                  const CellOccupancy<dim>       &walls,
                  const GridReset<dim>           &reset)
  {
    std::string held, text;
    for (const std::string &boundary : boundaries)
      if (is_held(boundary, walls))
        held += (held.empty() ? "<" : ", <") + boundary + ">";
      else
        text = "Enlarge the grid, or hold the body by boundary conditions.";
    if (!held.empty())
      text +=
        (text.empty() ? "" : " ") + held +
        " holds the material in its cells. If it moves out of the grid: "
        "Enlarge this, or let it follow by <Grid/Stretch>. If not, material "
        "beside it has jumped through these cells while they were empty and "
        "resisted nothing. That happens to points at the surface of a body "
        "with strains that no cell feels: use <Quadrature/Type = CPDI> if it "
        "isn't set, smaller steps, or more <Material points/Points per "
        "cell>.";
    if (scene.time.step <= 1)
      text += std::string(text.empty() ? "" : " ") +
              "That it does so in the first step may be a matter of units: "
              "lengths, of the grid and the body, go with stiffnesses, loads "
              "and <Material/Density> (m with Pa, N and kg/m^3; mm with MPa, N "
              "and t/mm^3).";
    if (const std::string why = reset.why(); !why.empty())
      text += (text.empty() ? "" : " ") + why;
    for (const auto *const condition :
         with_role<const HasPeriods>(scene.boundary_conditions))
      if (const std::string why = condition->why_points_left(boundaries);
          !why.empty())
        text += (text.empty() ? "" : " ") + why;
    return text.empty() ? text : text + " ";
  }



  template std::string
  why_points_left(const std::vector<std::string> &,
                  const Scene<2> &,
                  const CellOccupancy<2> &,
                  const GridReset<2> &);
  template std::string
  why_points_left(const std::vector<std::string> &,
                  const Scene<3> &,
                  const CellOccupancy<3> &,
                  const GridReset<3> &);
} // namespace isochor
