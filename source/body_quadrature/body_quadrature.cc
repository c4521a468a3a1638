/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/body_quadrature.h>

namespace isochor
{
  template <int dim>
  BodyQuadrature<dim>::BodyQuadrature(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  void
  BodyQuadrature<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Quadrature");
    prm.declare_entry(
      "Type",
      "CPDI",
      Patterns::Selection("points|cell-filled|cell-filled + boundary|CPDI"),
      "How the body is integrated. 'CPDI': each point is a simplex that "
      "deforms with the body; the most accurate, and about twice the cost of "
      "assembly. Best with k^dim points per cell, which tile it. 'points': a "
      "sum over the material points, the plain Material Point Method, whose "
      "stresses don't converge when points cross cells; the cheapest where "
      "they don't. 'cell-filled': the points of interior cells share the "
      "cell's measure; for material that flows far. 'cell-filled + boundary': "
      "those of cells at the surface also share what the body fills of the "
      "cell.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  BodyQuadrature<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Quadrature");
    const std::string name = prm.get("Type");
    prm.leave_subsection();
    type = name == "points"      ? Type::points :
           name == "cell-filled" ? Type::cell_filled :
           name == "CPDI"        ? Type::cpdi :
                                   Type::cell_filled_with_boundary;
  }



  template <int dim>
  void
  BodyQuadrature<dim>::start_step(PointArrays<dim>        &points,
                                  const PointLocator<dim> &locator,
                                  const MixedKernel<dim>  &kernel,
                                  const bool               with_occupancy,
                                  CellOccupancy<dim>      &occupancy) const
  {
    std::vector<double> corner_shares;
    if (type == Type::cpdi)
      corner_shares = build_stencils(points, locator);
    const bool fill =
      type == Type::cell_filled || type == Type::cell_filled_with_boundary;
    if (with_occupancy)
      occupancy.update(points, kernel, fill);
    if (type == Type::cpdi)
      collect_overlapped_cells(points, corner_shares, occupancy, kernel);
    if (fill)
      {
        fill_interior_cells(points, occupancy);
        std::map<unsigned int, double> bare;
        if (type == Type::cell_filled_with_boundary)
          bare = fill_boundary_cells(points, occupancy);
        occupancy.add_cells(bare);
        add_hole_points(points, occupancy, kernel, bare);
      }
  }



  template <int dim>
  Point<dim>
  BodyQuadrature<dim>::location(const PointArrays<dim> &points,
                                const unsigned int      k,
                                const unsigned int      q) const
  {
    const auto &vertices = grid.geometry().vertex_indices(points.cell[k]);
    Point<dim>  x;
    for (unsigned int I = 0; I <= dim; ++I)
      x += points.shape[q][I] * grid.geometry().vertices()[vertices[I]];
    return x;
  }



  template class BodyQuadrature<2>;
  template class BodyQuadrature<3>;
} // namespace isochor
