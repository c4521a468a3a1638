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
    makes_stencils() const override
    {
      return true;
    }

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
      const std::vector<double> corner_shares =
        build_stencils(points, locator, occupancy.grid.shape_functions());
      occupancy.update(points, kernel, false);
      collect_overlapped_cells(points, corner_shares, occupancy, kernel);
    }

  private:
    /** Returns the part of its corner for each entry of corner_cells. */
    std::vector<double>
    build_stencils(PointArrays<dim>          &points,
                   const PointLocator<dim>   &locator,
                   const ShapeFunctions<dim> &functions) const;
    void
    collect_overlapped_cells(PointArrays<dim>          &points,
                             const std::vector<double> &corner_shares,
                             const CellOccupancy<dim>  &occupancy,
                             const MixedKernel<dim>    &kernel) const;
  };



  namespace
  {
    /** Shape functions below this are zero: a corner on a face. */
    constexpr double no_support = 1e-9;

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

    /** The shape functions of the nodes that a corner at @p place acts on, but
     * for a factor, and their sum. */
    template <int dim>
    double
    evaluate_corner(const ShapeFunctions<dim>            &functions,
                    const LocateResult<dim>              &place,
                    typename ShapeFunctions<dim>::Values &at)
    {
      functions.evaluate(place.cell, place.barycentric, at);
      double sum = 0;
      for (unsigned int I = 0; I < at.n_nodes; ++I)
        {
          if (std::abs(at.shape[I]) < no_support)
            at.shape[I] = 0;
          sum += at.shape[I];
        }
      return sum;
    }

    /** Whether a corner with the shape functions @p at acts on nodes that none
     * of the elements of @p cells has, however little. */
    template <int dim>
    bool
    touches_other_nodes(const ShapeFunctions<dim>                  &functions,
                        const typename ShapeFunctions<dim>::Values &at,
                        const std::vector<unsigned int>            &cells)
    {
      for (unsigned int I = 0; I < at.n_nodes; ++I)
        if (at.shape[I] != 0 &&
            std::none_of(
              cells.begin(), cells.end(), [&](const unsigned int cell) {
                const auto nodes = functions.nodes(cell);
                return std::find(nodes.begin(), nodes.end(), at.vertex[I]) !=
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
      static constexpr unsigned int n_max =
        (dim + 1) * ShapeFunctions<dim>::max_nodes;
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
  CPDI<dim>::build_stencils(PointArrays<dim>          &points,
                            const PointLocator<dim>   &locator,
                            const ShapeFunctions<dim> &functions) const
  {
    std::vector<double>       corner_shares;
    std::vector<unsigned int> cells;
    points.clear_stencils();
    DomainStencil<dim>                                        stencil;
    std::array<typename ShapeFunctions<dim>::Values, dim + 1> at;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const Point<dim>   x = points.location(locator.geometry(), k, q);
          CornerVectors<dim> corners;
          std::array<double, dim + 1> sums;
          for (unsigned int c = 0; c <= dim; ++c)
            {
              corners[c] = points.F[q] * points.domain[q][c];
              const LocateResult<dim> place =
                locator.locate_towards(x, points.cell[k], corners[c]);
              sums[c] = evaluate_corner(functions, place, at[c]);
              find_corner_cells(locator, x, corners[c], place, cells);
              for (const unsigned int cell : cells)
                {
                  points.corner_cells.emplace_back(q, cell);
                  corner_shares.push_back(1. / cells.size());
                }
              if (touches_other_nodes(functions, at[c], cells))
                {
                  points.corner_cells.emplace_back(q, place.cell);
                  corner_shares.push_back(0.);
                }
            }
          const auto gradients = barycentric_gradients<dim>(corners);
          stencil.clear();
          for (unsigned int c = 0; c <= dim; ++c)
            for (unsigned int I = 0; I < at[c].n_nodes; ++I)
              if (at[c].shape[I] != 0)
                stencil.add(at[c].vertex[I],
                            at[c].shape[I] / sums[c],
                            gradients[c]);
          stencil.append_to(points);
        }
    return corner_shares;
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
        const unsigned int q = points.corner_cells[i].first;
        for_parts_of_element(
          grid,
          points.corner_cells[i].second,
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
