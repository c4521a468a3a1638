/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/shape_functions.h>

namespace isochor
{
  template <int dim>
  void
  ShapeFunctions<dim>::declare_functions(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Shape functions",
      "P1",
      Patterns::Selection(PluginRegistry<ShapeFunctions<dim>>::names()),
      "What displacements and pressures are between the nodes. 'P1': linear "
      "in each triangle or tetrahedron; the fastest. 'Q1': bilinear in "
      "quadrilaterals of two triangles, trilinear in hexahedra of six "
      "tetrahedra; more accurate on the same grid (a third of the error in "
      "bending with 'points', half with 'CPDI'), for boxes and trapezoids "
      "only.");
    PluginRegistry<ShapeFunctions<dim>>::declare_parameters(prm);
  }



  template <int dim>
  std::unique_ptr<ShapeFunctions<dim>>
  ShapeFunctions<dim>::create(ParameterHandler &prm)
  {
    auto functions =
      PluginRegistry<ShapeFunctions<dim>>::create(prm.get("Shape functions"));
    functions->parse_parameters(prm);
    return functions;
  }



  template class ShapeFunctions<2>;
  template class ShapeFunctions<3>;
} // namespace isochor
