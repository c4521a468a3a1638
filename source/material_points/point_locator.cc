/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/exceptions.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/base/rounding.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/point_locator.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Bounding boxes are enlarged by this part of their extent (to contain
     * the points that are clamped) and of the coordinates (rounding). */
    constexpr double box_margin = 1e-8;



    /** The point of the cell next to a point that rounding put outside. */
    template <std::size_t n>
    void
    clamp(std::array<double, n> &lambda)
    {
      double sum = 0;
      for (double &value : lambda)
        {
          value = std::max(value, 0.);
          sum += value;
        }
      for (double &value : lambda)
        value /= sum;
    }



    template <std::size_t n>
    double
    minimum(const std::array<double, n> &lambda)
    {
      return *std::min_element(lambda.begin(), lambda.end());
    }



    /** How much barycentric coordinates of @p x, far from the origin, may be
     * wrong by rounding, with a margin: coordinates carry it from their sums,
     * and ∇λ enlarges it. */
    template <int dim>
    double
    rounding_at(const SimplexGeometry<dim> &geometry,
                const unsigned int          cell,
                const Point<dim>           &x)
    {
      double steepest = 0;
      for (const auto &gradient : geometry.gradients(cell))
        steepest = std::max(steepest, gradient.norm());
      return 16 * std::numeric_limits<double>::epsilon() * steepest *
             Tensor<1, dim>(x).norm();
    }



    template <int dim>
    LocateResult<dim>
    accept(const unsigned int                         cell,
           typename SimplexGeometry<dim>::Barycentric lambda)
    {
      if (minimum(lambda) < 0.)
        clamp(lambda);
      return {cell, lambda, true};
    }



    template <int dim>
    BoundingBox<dim>
    bounding_box(const SimplexGeometry<dim> &geometry, const unsigned int cell)
    {
      AssertIndexRange(cell, geometry.n_cells());
      const auto &indices = geometry.vertex_indices(cell);
      Point<dim>  lower   = geometry.vertices()[indices[0]];
      Point<dim>  upper   = lower;
      for (const unsigned int v : indices)
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], geometry.vertices()[v][d]);
            upper[d] = std::max(upper[d], geometry.vertices()[v][d]);
          }
      const double margin =
        box_margin * lower.distance(upper) +
        rounding::numbers * std::max(lower.norm(), upper.norm());
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] -= margin;
          upper[d] += margin;
        }
      return BoundingBox<dim>({lower, upper});
    }
  } // namespace



  /** Bounding boxes of all cells, built when first needed for the current
   * coordinates: most walks never need it. */
  template <int dim>
  struct PointLocator<dim>::SearchTree
  {
    using Leaf = std::pair<BoundingBox<dim>, unsigned int>;

    const RTree<Leaf> &
    get(const SimplexGeometry<dim> &geometry)
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (generation != geometry.generation())
        {
          std::vector<Leaf> leaves;
          leaves.reserve(geometry.n_cells());
          for (unsigned int c = 0; c < geometry.n_cells(); ++c)
            leaves.emplace_back(bounding_box(geometry, c), c);
          boxes      = pack_rtree(leaves);
          generation = geometry.generation();
        }
      return boxes;
    }

  private:
    std::mutex   mutex;
    RTree<Leaf>  boxes;
    unsigned int generation = 0; // a geometry's count starts with one
  };



  template <int dim>
  PointLocator<dim>::PointLocator(const SimplexGeometry<dim> &geometry)
    : simplices(geometry)
    , tree(std::make_unique<SearchTree>())
  {}



  template <int dim>
  PointLocator<dim>::~PointLocator() = default;



  template <int dim>
  LocateResult<dim>
  PointLocator<dim>::locate(const Point<dim>  &x,
                            const unsigned int hint_cell) const
  {
    constexpr unsigned int no_cell  = SimplexGeometry<dim>::no_cell;
    unsigned int           cell     = hint_cell;
    unsigned int           previous = no_cell;

    for (unsigned int step = 0; cell != no_cell && step < max_steps; ++step)
      {
        const auto lambda = simplices.barycentric(cell, x);
        const auto lowest = minimum(lambda);
        if (lowest >= -inside_tolerance ||
            (lowest > -rounding::places &&
             lowest >= -rounding_at(simplices, cell, x)))
          return accept<dim>(cell, lambda);

        unsigned int next   = no_cell;
        double       behind = -inside_tolerance;
        for (unsigned int i = 0; i <= dim; ++i)
          if (lambda[i] < behind && simplices.neighbours(cell)[i] != no_cell)
            {
              behind = lambda[i];
              next   = simplices.neighbours(cell)[i];
            }

        // Stuck at the boundary, or going back: around a re-entrant corner, or
        // across a face whose two sides disagree by rounding.
        if (next == no_cell || next == previous)
          {
            if (lowest >=
                -std::max(clamp_tolerance, rounding_at(simplices, cell, x)))
              return accept<dim>(cell, lambda);
            break;
          }
        previous = cell;
        cell     = next;
      }
    return search(x,
                  hint_cell == no_cell ? 0 :
                                         simplices.layer_of_cell(hint_cell));
  }



  template <int dim>
  LocateResult<dim>
  PointLocator<dim>::locate_in(const Point<dim>  &x,
                               const unsigned int cell) const
  {
    AssertIndexRange(cell, simplices.n_cells());
    const auto lambda = simplices.barycentric(cell, x);
    return minimum(lambda) >= -clamp_tolerance ? accept<dim>(cell, lambda) :
                                                 LocateResult<dim>();
  }



  template <int dim>
  LocateResult<dim>
  PointLocator<dim>::search(const Point<dim> &x, const unsigned int layer) const
  {
    LocateResult<dim> best;
    for (unsigned int d = 0; d < dim; ++d)
      if (!std::isfinite(x[d]))
        return best;

    namespace bgi      = boost::geometry::index;
    double best_lowest = std::numeric_limits<double>::lowest();
    for (const auto &leaf :
         tree->get(simplices) | bgi::adaptors::queried(bgi::intersects(x)))
      {
        const unsigned int cell = leaf.second;
        if (simplices.layer_of_cell(cell) != layer)
          continue;
        const auto   lambda = simplices.barycentric(cell, x);
        const double error  = rounding_at(simplices, cell, x);
        double       lowest = minimum(lambda);
        if (lowest < -std::max(clamp_tolerance, error))
          continue;
        // Ties are decided by the cells' numbers, not by the tree's order, nor
        // by rounding.
        if (std::abs(lowest) <= std::max(inside_tolerance, error))
          lowest = 0;
        if (lowest > best_lowest || (lowest == best_lowest && cell < best.cell))
          {
            best.cell        = cell;
            best.barycentric = lambda;
            best_lowest      = lowest;
          }
      }
    return best.cell == SimplexGeometry<dim>::no_cell ?
             best :
             accept<dim>(best.cell, best.barycentric);
  }



  template <int dim>
  LocateResult<dim>
  PointLocator<dim>::locate_towards(const Point<dim>  &x,
                                    const unsigned int cell,
                                    Tensor<1, dim>    &r) const
  {
    AssertIndexRange(cell, simplices.n_cells());
    auto place = locate(x + r, cell);
    if (place.found)
      return place;
    double inside = 0, outside = 1;
    place = locate(x, cell);
    for (unsigned int i = 0; i < 40; ++i)
      {
        const double middle = (inside + outside) / 2;
        const auto   result = locate(x + middle * r, cell);
        if (result.found)
          place = result;
        (result.found ? inside : outside) = middle;
      }
    r *= inside;
    return place;
  }



  template <int dim>
  LocateResult<dim>
  PointLocator<dim>::locate_nearest(const Point<dim>  &x,
                                    const unsigned int cell,
                                    Tensor<1, dim>    &r) const
  {
    const Point<dim> sought = x + r;
    auto             place  = locate(sought, cell);
    if (place.found)
      return place;
    place.cell = nearest_cells<dim>(
                   simplices,
                   sought,
                   cell,
                   [](const unsigned int) { return true; },
                   std::numeric_limits<double>::max())
                   .front();
    r                 = sought + way_to_cell(simplices, place.cell, sought) - x;
    place.barycentric = simplices.barycentric(place.cell, x + r);
    return place;
  }



  template <int dim>
  Relocation<dim>
  relocate_points(const PointLocator<dim>             &locator,
                  const ArrayView<const Point<dim>>   &locations,
                  const ArrayView<const unsigned int> &hint_cells)
  {
    AssertThrow(locations.size() == hint_cells.size(),
                ExcMessage("Each point needs one hint cell: got " +
                           std::to_string(locations.size()) + " points and " +
                           std::to_string(hint_cells.size()) + " hints."));
    Relocation<dim> result;
    result.cells.reserve(locations.size());
    result.barycentrics.reserve(locations.size());
    for (std::size_t p = 0; p < locations.size(); ++p)
      {
        const auto found = locator.locate(locations[p], hint_cells[p]);
        result.cells.push_back(found.cell);
        result.barycentrics.push_back(found.barycentric);
        if (!found.found)
          result.lost.push_back(p);
        else if (found.cell != hint_cells[p])
          result.changed.push_back(p);
      }
    return result;
  }



  template class PointLocator<2>;
  template class PointLocator<3>;
  template Relocation<2>
  relocate_points<2>(const PointLocator<2> &,
                     const ArrayView<const Point<2>> &,
                     const ArrayView<const unsigned int> &);
  template Relocation<3>
  relocate_points<3>(const PointLocator<3> &,
                     const ArrayView<const Point<3>> &,
                     const ArrayView<const unsigned int> &);
} // namespace isochor
