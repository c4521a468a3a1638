/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_quadrature_h
#define isochor_body_quadrature_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/cell_occupancy.h>
#include <isochor/point_locator.h>

#include <map>

namespace isochor
{
  /**
   * How integrals over the body are computed from its points. When points
   * cross cells, the plain sum over points is wrong by O(1) in each cell,
   * whatever the grid's size, and stresses don't converge. The choices:
   *
   *  - points: ∫ a dv = Σ_p J_p V0_p a_p, the Material Point Method as it is;
   *  - cell-filled: within the step, the points of each interior cell e share
   *    its measure, V0_p ← V0_p |e| / Σ_{q∈e} J_q V0_q with J at t_n. An
   *    interior cell that lost all its points gets a massless one with the
   *    state of the points around, in the mean over each vertex and then over
   *    the vertices; of several materials that with the largest volume. Masses,
   *    and with them external forces, are not scaled;
   *  - cell-filled + boundary: in addition cells at the surface are scaled to
   *    the part of them that the body fills, the sum of their overlaps with
   *    the points' convected domains; by a factor in [0.2, 5]. What the
   *    domains fill of cells without points is integrated by a massless point
   *    with the state of those around, as holes are;
   *  - CPDI: each point owns a simplex domain with corners x_c = x_p + F r_c,
   *    and sees N_pI = 1/(d+1) Σ_c N_I(x_c), ∇N_pI = Σ_c N_I(x_c) ∇λ_c with λ_c
   *    the domain's barycentric coordinates. The domains move with the
   *    interpolant on them, so that they go on tiling the body: exact for
   *    constant stress on every grid. Sadeghirad, Brannon & Burghardt, Int. J.
   *    Numer. Meth. Eng. 86 (2011) 1435-1456, do so with parallelograms. A
   *    corner outside of the grid is drawn back towards its point.
   */
  template <int dim>
  class BodyQuadrature
  {
  public:
    BodyQuadrature(const BackgroundGrid<dim> &grid);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether each point must carry a domain. */
    bool
    needs_domains() const
    {
      return type == Type::cell_filled_with_boundary || type == Type::cpdi;
    }

    /** Whether start_step() needs to know the cells' occupancy. */
    bool
    needs_occupancy() const
    {
      return type != Type::points;
    }

    /** The simple sum over points, the method of the paper. */
    bool
    is_plain() const
    {
      return type == Type::points;
    }

    /**
     * Prepare weights, stencils and massless points of @p points, as gathered,
     * for the coming step. Updates @p occupancy if @p with_occupancy.
     * Collective.
     */
    void
    start_step(PointArrays<dim>        &points,
               const PointLocator<dim> &locator,
               const MixedKernel<dim>  &kernel,
               const bool               with_occupancy,
               CellOccupancy<dim>      &occupancy) const;

  private:
    enum class Type
    {
      points,
      cell_filled,
      cell_filled_with_boundary,
      cpdi
    } type = Type::cpdi;

    /** Reference volume scaled to fill the cells. */
    void
    fill_interior_cells(PointArrays<dim>         &points,
                        const CellOccupancy<dim> &occupancy) const;
    /** Returns what the body fills of cells without points, of this rank and
     * near it. */
    std::map<unsigned int, double>
    fill_boundary_cells(PointArrays<dim>         &points,
                        const CellOccupancy<dim> &occupancy) const;
    std::map<unsigned int, double>
    fill_of_boundary_cells(const PointArrays<dim>   &points,
                           const CellOccupancy<dim> &occupancy) const;
    /** Integrate holes, and @p cells by the volumes given, by a point each. */
    void
    add_hole_points(PointArrays<dim>              &points,
                    const CellOccupancy<dim>      &occupancy,
                    const MixedKernel<dim>        &kernel,
                    std::map<unsigned int, double> cells) const;

    /** Returns the part of its corner for each entry of corner_cells. */
    std::vector<double>
    build_stencils(PointArrays<dim>        &points,
                   const PointLocator<dim> &locator) const;
    void
    collect_overlapped_cells(PointArrays<dim>          &points,
                             const std::vector<double> &corner_shares,
                             const CellOccupancy<dim>  &occupancy,
                             const MixedKernel<dim>    &kernel) const;
    Point<dim>
    location(const PointArrays<dim> &points,
             const unsigned int      k,
             const unsigned int      q) const;

    const BackgroundGrid<dim> &grid;
  };
} // namespace isochor

#endif
