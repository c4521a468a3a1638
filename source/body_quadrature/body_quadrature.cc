/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>

namespace isochor
{
  template <int dim>
  void
  BodyQuadrature<dim>::declare_quadratures(ParameterHandler &prm)
  {
    prm.enter_subsection("Quadrature");
    prm.declare_entry(
      "Type",
      "CPDI",
      Patterns::Selection(PluginRegistry<BodyQuadrature<dim>>::names()),
      "How the body is integrated. 'CPDI': each point has a small triangle "
      "(tetrahedron) that deforms with the body; the most accurate, at "
      "about twice the cost of assembly. 'points': a "
      "sum over the material points, the plain Material Point Method, whose "
      "stresses don't converge when points cross cells; the cheapest where "
      "they don't. 'cell-filled': the points of cells inside the body share "
      "the volume of their cell; for material that flows far. 'cell-filled "
      "+ boundary': "
      "those of cells at the surface also share the part of their cell that "
      "the body fills.");
    PluginRegistry<BodyQuadrature<dim>>::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  std::unique_ptr<BodyQuadrature<dim>>
  BodyQuadrature<dim>::create(ParameterHandler &prm)
  {
    prm.enter_subsection("Quadrature");
    auto quadrature =
      PluginRegistry<BodyQuadrature<dim>>::create(prm.get("Type"));
    quadrature->parse_parameters(prm);
    prm.leave_subsection();
    return quadrature;
  }



  template <int dim>
  Point<dim>
  location_of_point(const SimplexGeometry<dim> &geometry,
                    const PointArrays<dim>     &points,
                    const unsigned int          k,
                    const unsigned int          q)
  {
    const auto &vertices = geometry.vertex_indices(points.cell[k]);
    Point<dim>  x;
    for (unsigned int I = 0; I <= dim; ++I)
      x += points.shape[q][I] * geometry.vertices()[vertices[I]];
    return x;
  }



  template class BodyQuadrature<2>;
  template class BodyQuadrature<3>;
  template Point<2>
  location_of_point(const SimplexGeometry<2> &,
                    const PointArrays<2> &,
                    const unsigned int,
                    const unsigned int);
  template Point<3>
  location_of_point(const SimplexGeometry<3> &,
                    const PointArrays<3> &,
                    const unsigned int,
                    const unsigned int);
} // namespace isochor
