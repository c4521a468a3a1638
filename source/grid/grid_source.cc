/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/grid_source.h>

namespace isochor
{
  template <int dim>
  void
  GridSource<dim>::declare_sources(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Type",
      "box",
      Patterns::Selection(PluginRegistry<GridSource<dim>>::names()),
      "How the background grid is made. Boxes and trapezoids are divided into "
      "rows of equal cells and these into triangles or tetrahedra. Their "
      "boundaries are called left and right (least and largest x), bottom and "
      "top (y) and, in 3D, front and back (z); a trapezoid's have the names of "
      "the sides of the box that it is a distorted image of. A gmsh file "
      "brings its physical groups as boundary names. An adaptive grid is "
      "refined from coarse quadrilaterals or hexahedra, see 'Coarse cells', "
      "and the section 'Adaptive grid'.");
    PluginRegistry<GridSource<dim>>::declare_parameters(prm);
  }



  template <int dim>
  std::unique_ptr<GridSource<dim>>
  GridSource<dim>::create(const std::string &name, ParameterHandler &prm)
  {
    auto source      = PluginRegistry<GridSource<dim>>::create(name);
    source->declared = PluginRegistry<GridSource<dim>>::parameters(name);
    source->parse_parameters(prm);
    return source;
  }



  template <int dim>
  std::string
  GridSource<dim>::names_with_coarse_cells()
  {
    std::string list;
    for (const std::string &name :
         Utilities::split_string_list(PluginRegistry<GridSource<dim>>::names(),
                                      '|'))
      if (PluginRegistry<GridSource<dim>>::create(name)->has_coarse_cells())
        list += (list.empty() ? "" : "|") + name;
    return list;
  }



  template <int dim>
  MeshGroups
  GridSource<dim>::make_mesh(Triangulation<dim> & /*tria*/) const
  {
    AssertThrow(false, ExcNotImplemented());
    return {};
  }



  template <int dim>
  CoarseGrid<dim>
  GridSource<dim>::coarse_cells(MeshGroups & /*groups*/) const
  {
    AssertThrow(false, ExcNotImplemented());
    return {};
  }



  template class GridSource<2>;
  template class GridSource<3>;
} // namespace isochor
