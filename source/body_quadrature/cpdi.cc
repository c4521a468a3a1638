/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/body_quadrature/domain_stencil.h>
#include <isochor/body_quadrature/walls_at_place.h>
#include <isochor/equations/body_term.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  /**
   * Each point owns a simplex domain with corners x_c = x_p + F r_c, and sees
   *   N_pI = 1/(d+1) Σ_c N_I(x_c),   ∇N_pI = Σ_c N_I(x_c) ∇λ_c
   * with λ_c the domain's barycentric coordinates. The domains move with the
   * interpolant on them, so that they go on tiling the body: exact for constant
   * stress on every grid. Sadeghirad, Brannon & Burghardt, Int. J. Numer. Meth.
   * Eng. 86 (2011) 1435-1456, do so with parallelograms.
   *
   * A corner outside of the grid sees the functions of the nearest cell,
   * continued to where it is. Where a boundary that is held has drawn the body
   * out of a grid that is put back, it goes to the nearest place of the grid;
   * in statics the point then integrates the part of its volume that is left
   * inside: with all of it the stress beside the boundary would be too small by
   * the part of a cell that is outside.
   */
  template <int dim>
  class CPDI : public BodyQuadrature<dim>
  {
  public:
    bool
    is_linear_on_domains() const override
    {
      return true;
    }

    bool
    forces_jump() const override
    {
      return false;
    }

    void
    start_step(PointArrays<dim>        &points,
               const PointLocator<dim> &locator,
               const MixedKernel<dim>  &kernel,
               const bool /*with_occupancy*/,
               CellOccupancy<dim> &occupancy) const override
    {
      const std::vector<double> corner_shares =
        build_stencils(points, locator, occupancy);
      occupancy.update(points, kernel);
      collect_overlapped_cells(points, corner_shares, occupancy, kernel);
    }

  private:
    /** Returns the part of its corner for each entry of DomainCorners::cells.
     */
    std::vector<double>
    build_stencils(PointArrays<dim>         &points,
                   const PointLocator<dim>  &locator,
                   const CellOccupancy<dim> &occupancy) const;
    void
    collect_overlapped_cells(PointArrays<dim>          &points,
                             const std::vector<double> &corner_shares,
                             const CellOccupancy<dim>  &occupancy,
                             const MixedKernel<dim>    &kernel) const;
  };



  namespace
  {
    constexpr unsigned int no_cell = SimplexGeometry<2>::no_cell;

    /**
     * The cells that the corner at x + r shares its part of the domain among:
     * the one it lies in, @p place, or, if it is on a face or vertex, those
     * that the domain fills next to it. They are found slightly within the
     * domain, so that rounding has no say; there are several only if an edge of
     * the domain lies in a face, or the like.
     */
    template <int dim>
    void
    find_corner_cells(const PointLocator<dim>   &locator,
                      const Point<dim>          &x,
                      const Tensor<1, dim>      &r,
                      const LocateResult<dim>   &place,
                      std::vector<unsigned int> &cells)
    {
      constexpr double within       = 1e-3;
      const auto       is_near_face = [&](const LocateResult<dim> &at) {
        for (unsigned int v = 0; v <= dim; ++v)
          if (at.barycentric[v] < rounding::places &&
              locator.geometry().neighbours(at.cell)[v] !=
                SimplexGeometry<dim>::no_cell)
            return true;
        return false;
      };
      cells.assign(1, place.cell);
      if (!is_near_face(place))
        return;
      const Point<dim> inside = x + (1 - within) * r;
      const auto       at     = locator.locate(inside, place.cell);
      if (!at.found)
        return;
      cells.assign(1, at.cell);
      if (is_near_face(at))
        cells = nearest_cells<dim>(
          locator.geometry(),
          inside,
          at.cell,
          [](const unsigned int) { return true; },
          std::numeric_limits<double>::max());
    }

    /** Whether a place that is @p way beyond the grid, from @p place, is beyond
     * a face of the grid's boundary that is held: where nothing holds it, or
     * material is on the other one of periodic sides, what is outside of the
     * grid goes on carrying stress. */
    template <int dim>
    bool
    is_beyond_held_boundary(const CellOccupancy<dim> &occupancy,
                            const LocateResult<dim>  &place,
                            const Tensor<1, dim>     &way)
    {
      constexpr double            along_normal = 0.5;
      const SimplexGeometry<dim> &geometry     = occupancy.grid.geometry();
      const auto &vertices  = geometry.vertex_indices(place.cell);
      const auto &gradients = geometry.gradients(place.cell);
      bool        is_beyond = false;
      for (unsigned int v = 0; v <= dim; ++v)
        if (place.barycentric[v] < rounding::accumulated &&
            geometry.neighbours(place.cell)[v] == no_cell &&
            -(gradients[v] * way) >
              along_normal * gradients[v].norm() * way.norm())
          {
            bool all_open = true;
            for (unsigned int w = 0; w <= dim; ++w)
              if (w != v)
                {
                  if (occupancy.is_near_periodic_side(vertices[w]))
                    return false;
                  all_open =
                    all_open && occupancy.is_at_open_boundary(vertices[w]);
                }
            if (all_open)
              return false;
            is_beyond = true;
          }
      return is_beyond;
    }

    /** The cell whose functions, continued, are seen by a corner that is @p way
     * beyond the grid, from @p x at @p place. Of cells that are as near to it
     * as that of the place, one whose functions are there those of nodes on the
     * other faces of the boundary at x: what is held along a wall stays on it,
     * and periodic sides decide alike. */
    template <int dim>
    unsigned int
    continued_cell(const CellOccupancy<dim> &occupancy,
                   const LocateResult<dim>  &place,
                   const Point<dim>         &x,
                   const Tensor<1, dim>     &way)
    {
      const WallsAtPlace<dim> sides(occupancy, place.cell, x, way);
      if (sides.are_those_of(place.cell))
        return place.cell;
      const std::vector<unsigned int> cells = nearest_cells<dim>(
        occupancy.grid.geometry(),
        x + way,
        place.cell,
        [](const unsigned int) { return true; },
        std::numeric_limits<double>::max());
      const auto found =
        std::find_if(cells.begin(), cells.end(), [&](const unsigned int cell) {
          return sides.are_those_of(cell);
        });
      return found == cells.end() ? place.cell : *found;
    }

    template <int dim>
    Tensor<1, dim>
    middle_of(const CornerVectors<dim> &corners)
    {
      Tensor<1, dim> middle;
      for (const Tensor<1, dim> &r : corners)
        middle += r / (dim + 1.);
      return middle;
    }

    /** Lists the cells that corners act on (DomainCorners::cells). */
    template <int dim>
    class CornerCells
    {
    public:
      CornerCells(PointArrays<dim>          &points,
                  const PointLocator<dim>   &locator,
                  const ShapeFunctions<dim> &functions)
        : points(points)
        , locator(locator)
        , functions(functions)
      {}

      /** What each of the cells gets of its corner's part of the domain, in
       * the stabilisation. */
      std::vector<double> shares;

      /** A corner of point @p q, at @p r from it and at @p place, that acts on
       * @p nodes. */
      void
      add(const unsigned int       q,
          const Point<dim>        &x,
          const Tensor<1, dim>    &r,
          const LocateResult<dim> &place,
          const CornerNodes<dim>  &nodes)
      {
        find_corner_cells(locator, x, r, place, cells);
        for (const unsigned int cell : cells)
          add(q, cell, 1. / cells.size());
        if (nodes.touches_others(functions, cells))
          add(q, place.cell, 0.);
      }

    private:
      void
      add(const unsigned int q, const unsigned int cell, const double share)
      {
        points.domain_corners.cells.emplace_back(q, cell);
        shares.push_back(share);
      }

      PointArrays<dim>          &points;
      const PointLocator<dim>   &locator;
      const ShapeFunctions<dim> &functions;
      std::vector<unsigned int>  cells;
    };
  } // namespace



  template <int dim>
  std::vector<double>
  CPDI<dim>::build_stencils(PointArrays<dim>         &points,
                            const PointLocator<dim>  &locator,
                            const CellOccupancy<dim> &occupancy) const
  {
    const ShapeFunctions<dim> &functions = occupancy.grid.shape_functions();
    CornerCells<dim>           corner_cells(points, locator, functions);
    points.clear_stencils();
    DomainStencil<dim>                    stencil;
    std::array<CornerNodes<dim>, dim + 1> at;
    const bool                            in_statics = points.velocity.empty();
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Point<dim>   x = points.location(locator.geometry(), k, q);
          CornerVectors<dim> corners, whole;
          bool               is_cut = false;
          for (unsigned int c = 0; c <= dim; ++c)
            {
              Tensor<1, dim> &r = corners[c];
              whole[c] = r       = points.F[q] * points.domain[q][c];
              const auto   place = locator.locate_nearest(x, points.cell[k], r);
              unsigned int continued = no_cell;
              if ((r - whole[c]).norm() > rounding::accumulated * r.norm())
                {
                  if (is_beyond_held_boundary(occupancy, place, whole[c] - r))
                    is_cut = in_statics;
                  else
                    {
                      continued = continued_cell<dim>(occupancy,
                                                      place,
                                                      x + r,
                                                      whole[c] - r);
                      r         = whole[c];
                    }
                }
              at[c].evaluate(
                functions, locator.geometry(), place, continued, x + r);
              corner_cells.add(q, x, r, place, at[c]);
            }
          stencil.set(at, corners);
          if (is_cut)
            {
              points.weight[q] =
                points.volume[q] * part_of_domain<dim>(corners, whole);
              // from the middle of the corners in the grid to the point
              stencil.move(-middle_of<dim>(corners));
            }
          stencil.append_to(points);
        }
    return corner_cells.shares;
  }



  template <int dim>
  void
  CPDI<dim>::collect_overlapped_cells(PointArrays<dim>          &points,
                                      const std::vector<double> &corner_shares,
                                      const CellOccupancy<dim>  &occupancy,
                                      const MixedKernel<dim>    &kernel) const
  {
    // A corner stands for its part of the domain, but the cell is as stiff as
    // the points in it: where materials meet, corners of soft domains lie in
    // cells of the stiff one, by a hair at first.
    const BackgroundGrid<dim>             &grid = occupancy.grid;
    std::map<unsigned int, CellCompliance> compliance;
    for (unsigned int i = 0; i < corner_shares.size(); ++i)
      {
        if (corner_shares[i] == 0)
          continue;
        const unsigned int q = points.domain_corners.cells[i].first;
        for_parts_of_element(
          grid,
          points.domain_corners.cells[i].second,
          [&](const unsigned int cell, const double part) {
            if (!occupancy.is_closed(cell))
              return;
            const double V =
              part * corner_shares[i] * points.measure(q) / (dim + 1);
            const auto *const content = occupancy.content(cell);
            if (content != nullptr && content->volume_over_G > 0)
              kernel.add_compliance(points,
                                    q,
                                    V,
                                    content->volume_over_G /
                                      content->reference_volume,
                                    compliance[cell]);
            else
              kernel.add_compliance(points, q, V, compliance[cell]);
          });
      }
    points.set_overlapped_cells(grid.geometry(), compliance);
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature, CPDI, "CPDI")
} // namespace isochor
