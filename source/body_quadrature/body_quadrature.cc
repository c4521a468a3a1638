/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>

#include <algorithm>

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
      "they don't.");
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



  namespace
  {
    /** Points without a stencil get the shape functions of the grid at their
     * place. */
    template <int dim>
    void
    add_stencils(const ShapeFunctions<dim> &functions, PointArrays<dim> &points)
    {
      typename ShapeFunctions<dim>::Values at;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            functions.evaluate(points.cell[k], points.shape[q], at);
            for (unsigned int I = 0; I < at.n_nodes; ++I)
              {
                points.stencil_vertex.push_back(at.vertex[I]);
                points.stencil_shape.push_back(at.shape[I]);
                points.stencil_gradient.push_back(at.gradient[I]);
              }
            points.stencil_start.push_back(points.stencil_vertex.size());
          }
    }

    /** The cells of the stabilisation: those of the elements with points. */
    template <int dim>
    void
    stabilise_elements(const BackgroundGrid<dim> &grid,
                       const MixedKernel<dim>    &kernel,
                       PointArrays<dim>          &points)
    {
      std::map<unsigned int, CellCompliance> compliance;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        {
          const CellCompliance of_points =
            kernel.compliance_of_points(points,
                                        points.cell_start[k],
                                        points.cell_start[k + 1]);
          for_parts_of_element(grid,
                               points.cell[k],
                               [&](const unsigned int cell, const double part) {
                                 compliance[cell].volume +=
                                   part * of_points.volume;
                                 compliance[cell].mass += part * of_points.mass;
                               });
        }
      points.set_overlapped_cells(grid.geometry(), compliance);
    }
  } // namespace



  template <int dim>
  void
  BodyQuadrature<dim>::set_up(PointArrays<dim>        &points,
                              const PointLocator<dim> &locator,
                              const MixedKernel<dim>  &kernel,
                              const bool               with_occupancy,
                              CellOccupancy<dim>      &occupancy) const
  {
    const BackgroundGrid<dim> &grid = occupancy.grid;
    const bool                 by_functions =
      !grid.shape_functions().are_linear() && !is_linear_on_domains();
    if (by_functions)
      {
        points.clear_stencils();
        add_stencils(grid.shape_functions(), points);
      }
    start_step(points, locator, kernel, with_occupancy, occupancy);
    if (kernel.stabilisation.has_orthogonal_subscales ?
          !is_linear_on_domains() :
          by_functions && kernel.stabilisation.coefficient > 0)
      stabilise_elements(grid, kernel, points);
  }



  template class BodyQuadrature<2>;
  template class BodyQuadrature<3>;
} // namespace isochor
