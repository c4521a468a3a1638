/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/body_quadrature/body_quadrature.h>
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
   * Eng. 86 (2011) 1435-1456, do so with parallelograms. A corner outside of
   * the grid is drawn back towards its point.
   */
  template <int dim>
  class CPDI : public BodyQuadrature<dim>
  {
  public:
    bool
    needs_domains() const override
    {
      return true;
    }

    bool
    forces_jump() const override
    {
      return false;
    }

    /** The domains would no longer tile the body. */
    bool
    allows_change_of_F() const override
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
      const std::vector<double> corner_shares = build_stencils(points, locator);
      occupancy.update(points, kernel, false);
      collect_overlapped_cells(
        points, locator.geometry(), corner_shares, occupancy, kernel);
    }

  private:
    /** Returns the part of its corner for each entry of corner_cells. */
    std::vector<double>
    build_stencils(PointArrays<dim>        &points,
                   const PointLocator<dim> &locator) const;
    void
    collect_overlapped_cells(PointArrays<dim>           &points,
                             const SimplexGeometry<dim> &geometry,
                             const std::vector<double>  &corner_shares,
                             const CellOccupancy<dim>   &occupancy,
                             const MixedKernel<dim>     &kernel) const;
  };



  namespace
  {
    /** Shape functions below this are zero: a corner on a face. */
    constexpr double no_support = 1e-9;

    /** The cell and barycentric coordinates of a corner at x + r; if that is
     * outside of the grid, r is shortened until it is inside. */
    template <int dim>
    LocateResult<dim>
    locate_corner(const PointLocator<dim> &locator,
                  const Point<dim>        &x,
                  const unsigned int       cell,
                  Tensor<1, dim>          &r)
    {
      auto place = locator.locate(x + r, cell);
      if (place.found)
        return place;
      double inside = 0, outside = 1;
      place = locator.locate(x, cell);
      for (unsigned int i = 0; i < 40; ++i)
        {
          const double middle = (inside + outside) / 2;
          const auto   result = locator.locate(x + middle * r, cell);
          if (result.found)
            place = result;
          (result.found ? inside : outside) = middle;
        }
      r *= inside;
      return place;
    }

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
      constexpr double near_face = 1e-6, within = 1e-3;
      const auto       is_near_face = [&](const LocateResult<dim> &at) {
        for (unsigned int v = 0; v <= dim; ++v)
          if (at.barycentric[v] < near_face &&
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

    /** Whether a corner at @p place acts on nodes that none of @p cells has,
     * however little. */
    template <int dim>
    bool
    touches_other_nodes(const SimplexGeometry<dim>      &geometry,
                        const LocateResult<dim>         &place,
                        const std::vector<unsigned int> &cells)
    {
      for (unsigned int v = 0; v <= dim; ++v)
        if (place.barycentric[v] >= no_support &&
            std::none_of(
              cells.begin(), cells.end(), [&](const unsigned int cell) {
                const auto &nodes = geometry.vertex_indices(cell);
                return std::find(nodes.begin(),
                                 nodes.end(),
                                 geometry.vertex_indices(place.cell)[v]) !=
                       nodes.end();
              }))
          return true;
      return false;
    }

    /** The nodes of one domain, and sums over its corners. */
    template <int dim>
    class DomainStencil
    {
    public:
      void
      clear()
      {
        n_nodes = 0;
      }

      /** Add N at @p vertex and the gradient N ∇λ of a corner. */
      void
      add(const unsigned int    vertex,
          const double          N,
          const Tensor<1, dim> &gradient_of_corner)
      {
        unsigned int I = 0;
        while (I < n_nodes && vertices[I] != vertex)
          ++I;
        if (I == n_nodes)
          {
            ++n_nodes;
            vertices[I]  = vertex;
            shape[I]     = 0;
            gradients[I] = Tensor<1, dim>();
          }
        shape[I] += N / (dim + 1);
        gradients[I] += N * gradient_of_corner;
      }

      void
      append_to(PointArrays<dim> &points) const
      {
        for (unsigned int I = 0; I < n_nodes; ++I)
          {
            points.stencil_vertex.push_back(vertices[I]);
            points.stencil_shape.push_back(shape[I]);
            points.stencil_gradient.push_back(gradients[I]);
          }
        points.stencil_start.push_back(points.stencil_vertex.size());
      }

    private:
      static constexpr unsigned int     n_max   = (dim + 1) * (dim + 1);
      unsigned int                      n_nodes = 0;
      std::array<unsigned int, n_max>   vertices;
      std::array<double, n_max>         shape;
      std::array<Tensor<1, dim>, n_max> gradients;
    };

    /** ∇λ_c of the simplex with the given corners. */
    template <int dim>
    CornerVectors<dim>
    barycentric_gradients(const CornerVectors<dim> &corners)
    {
      Tensor<2, dim> edges;
      for (unsigned int d = 0; d < dim; ++d)
        edges[d] = corners[d + 1] - corners[0];
      const double J = determinant(edges);
      AssertThrow(std::abs(J) > 1e-14 * std::pow(edges.norm(), dim),
                  ExcMessage("The domain of a material point is flat: the "
                             "deformation is too large for <Quadrature/Type = "
                             "CPDI>."));
      const Tensor<2, dim> inverse = invert(edges);
      CornerVectors<dim>   gradients;
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          {
            gradients[c + 1][d] = inverse[d][c];
            gradients[0][d] -= inverse[d][c];
          }
      return gradients;
    }
  } // namespace



  template <int dim>
  std::vector<double>
  CPDI<dim>::build_stencils(PointArrays<dim>        &points,
                            const PointLocator<dim> &locator) const
  {
    const SimplexGeometry<dim> &geometry = locator.geometry();
    std::vector<double>         corner_shares;
    std::vector<unsigned int>   cells;
    points.stencil_start.assign(1, 0);
    points.stencil_vertex.clear();
    points.stencil_shape.clear();
    points.stencil_gradient.clear();
    points.corner_cells.clear();
    DomainStencil<dim> stencil;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Point<dim>   x = location_of_point(geometry, points, k, q);
          CornerVectors<dim> corners;
          std::array<LocateResult<dim>, dim + 1> places;
          for (unsigned int c = 0; c <= dim; ++c)
            {
              corners[c] = points.F[q] * points.domain[q][c];
              places[c] = locate_corner(locator, x, points.cell[k], corners[c]);
              find_corner_cells(locator, x, corners[c], places[c], cells);
              for (const unsigned int cell : cells)
                {
                  points.corner_cells.emplace_back(q, cell);
                  corner_shares.push_back(1. / cells.size());
                }
              if (touches_other_nodes(locator.geometry(), places[c], cells))
                {
                  points.corner_cells.emplace_back(q, places[c].cell);
                  corner_shares.push_back(0.);
                }
            }
          const auto gradients = barycentric_gradients<dim>(corners);
          stencil.clear();
          for (unsigned int c = 0; c <= dim; ++c)
            {
              double sum = 0;
              for (double &N : places[c].barycentric)
                {
                  if (N < no_support)
                    N = 0;
                  sum += N;
                }
              for (unsigned int I = 0; I <= dim; ++I)
                if (places[c].barycentric[I] > 0)
                  stencil.add(geometry.vertex_indices(places[c].cell)[I],
                              places[c].barycentric[I] / sum,
                              gradients[c]);
            }
          stencil.append_to(points);
        }
    return corner_shares;
  }



  template <int dim>
  void
  CPDI<dim>::collect_overlapped_cells(PointArrays<dim>           &points,
                                      const SimplexGeometry<dim> &geometry,
                                      const std::vector<double>  &corner_shares,
                                      const CellOccupancy<dim>   &occupancy,
                                      const MixedKernel<dim>     &kernel) const
  {
    // a corner stands for its part of the domain
    std::map<unsigned int, CellCompliance> compliance;
    for (unsigned int i = 0; i < corner_shares.size(); ++i)
      {
        const auto &[q, cell] = points.corner_cells[i];
        if (corner_shares[i] > 0 && occupancy.is_closed(cell))
          kernel.add_compliance(points,
                                q,
                                corner_shares[i] * points.measure(q) /
                                  (dim + 1),
                                compliance[cell]);
      }
    points.overlapped_cells.clear();
    for (const auto &[cell, sum] : compliance)
      {
        OverlappedCell<dim> overlapped{cell, sum, {}};
        for (unsigned int v = 0; v <= dim; ++v)
          overlapped.corners[v] =
            geometry.vertices()[geometry.vertex_indices(cell)[v]];
        points.overlapped_cells.push_back(overlapped);
      }
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BodyQuadrature, CPDI, "CPDI")
} // namespace isochor
