/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/rounding.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <unordered_set>

namespace isochor
{
  namespace
  {
    /** Up to dim + 1 points relative to the one whose distance is sought. */
    template <int dim>
    struct Corners
    {
      std::array<Tensor<1, dim>, dim + 1> r;
      unsigned int                        n = 0;
    };

    /**
     * Barycentric coordinates of the origin's projection onto the plane through
     * the corners, from the normal equations of min |r_0 + Σ s_i (r_i - r_0)|,
     * solved by Cramer's rule or elimination (at most dim unknowns).
     */
    template <int dim>
    std::array<double, dim + 1>
    project(const Corners<dim> &corners)
    {
      Assert(corners.n > 1 && corners.n <= dim + 1, ExcInternalError());
      const unsigned int                           m = corners.n - 1;
      std::array<std::array<double, dim + 1>, dim> A{};
      for (unsigned int i = 0; i < m; ++i)
        {
          const Tensor<1, dim> edge = corners.r[i + 1] - corners.r[0];
          for (unsigned int j = 0; j < m; ++j)
            A[i][j] = edge * (corners.r[j + 1] - corners.r[0]);
          A[i][m] = -(edge * corners.r[0]);
        }
      // symmetric positive definite: no pivoting
      for (unsigned int k = 0; k < m; ++k)
        for (unsigned int i = k + 1; i < m; ++i)
          {
            const double factor = A[i][k] / A[k][k];
            for (unsigned int j = k; j <= m; ++j)
              A[i][j] -= factor * A[k][j];
          }
      std::array<double, dim + 1> lambda{};
      lambda[0] = 1;
      for (unsigned int k = m; k-- > 0;)
        {
          double s = A[k][m];
          for (unsigned int j = k + 1; j < m; ++j)
            s -= A[k][j] * lambda[j + 1];
          lambda[k + 1] = s / A[k][k];
          lambda[0] -= lambda[k + 1];
        }
      return lambda;
    }



    /** The point of the convex hull of the corners that is nearest to the
     * origin. Where the projection is outside, it lies on a face that the
     * origin sees, one opposite to a corner of negative coordinate. */
    template <int dim>
    Tensor<1, dim>
    nearest_to_origin(const Corners<dim> &corners)
    {
      Assert(corners.n > 0, ExcInternalError());
      if (corners.n == 1)
        return corners.r[0];
      const auto     lambda = project(corners);
      Tensor<1, dim> nearest;
      double         least  = std::numeric_limits<double>::max();
      bool           inside = true;
      for (unsigned int i = 0; i < corners.n; ++i)
        if (lambda[i] < 0)
          {
            inside = false;
            Corners<dim> face;
            for (unsigned int j = 0; j < corners.n; ++j)
              if (j != i)
                face.r[face.n++] = corners.r[j];
            const Tensor<1, dim> on_face = nearest_to_origin(face);
            if (on_face.norm_square() < least)
              {
                least   = on_face.norm_square();
                nearest = on_face;
              }
          }
      if (inside && corners.n <= dim)
        for (unsigned int i = 0; i < corners.n; ++i)
          nearest += lambda[i] * corners.r[i];
      return nearest;
    }
  } // namespace



  template <int dim>
  Tensor<1, dim>
  way_to_cell(const SimplexGeometry<dim> &geometry,
              const unsigned int          cell,
              const Point<dim>           &x)
  {
    AssertIndexRange(cell, geometry.n_cells());
    Corners<dim> corners;
    for (const unsigned int vertex : geometry.vertex_indices(cell))
      corners.r[corners.n++] = geometry.vertices()[vertex] - x;
    return nearest_to_origin(corners);
  }



  template <int dim>
  double
  distance_to_cell(const SimplexGeometry<dim> &geometry,
                   const unsigned int          cell,
                   const Point<dim>           &x)
  {
    return way_to_cell(geometry, cell, x).norm();
  }



  template <int dim>
  Point<dim>
  cell_centroid(const SimplexGeometry<dim> &geometry, const unsigned int cell)
  {
    Point<dim> sum;
    for (const unsigned int v : geometry.vertex_indices(cell))
      sum += geometry.vertices()[v] / (dim + 1.);
    return sum;
  }



  template <int dim>
  double
  cell_size(const SimplexGeometry<dim> &geometry, const unsigned int cell)
  {
    constexpr double factorial = (dim == 2) ? 2. : 6.;
    return std::pow(factorial * geometry.measure(cell), 1. / dim);
  }



  template <int dim>
  std::vector<unsigned int>
  nearest_cells(const SimplexGeometry<dim>                    &geometry,
                const Point<dim>                              &x,
                const unsigned int                             start,
                const std::function<bool(const unsigned int)> &is_candidate,
                const double                                   largest_distance)
  {
    AssertIndexRange(start, geometry.n_cells());
    Assert(largest_distance >= 0, ExcInternalError());
    using Entry = std::pair<double, unsigned int>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue;
    std::unordered_set<unsigned int>                                    seen;
    const auto add = [&](const unsigned int cell) {
      if (cell != SimplexGeometry<dim>::no_cell && seen.insert(cell).second)
        queue.emplace(distance_to_cell(geometry, cell, x), cell);
    };
    std::vector<Entry> found;
    double             limit = largest_distance, least = limit;
    add(start);
    while (!queue.empty())
      {
        const auto [distance, cell] = queue.top();
        // the start may be further away than what is sought
        if (distance > limit && cell != start)
          break;
        queue.pop();
        if (distance <= limit && is_candidate(cell))
          {
            found.emplace_back(distance, cell);
            if (distance < least)
              {
                least = distance;
                limit =
                  least + rounding::accumulated * cell_size(geometry, cell);
              }
          }
        for (const unsigned int neighbour : geometry.neighbours(cell))
          add(neighbour);
      }
    std::vector<unsigned int> cells;
    for (const auto &[distance, cell] : found)
      if (distance <= limit)
        cells.push_back(cell);
    std::sort(cells.begin(), cells.end());
    return cells;
  }



  template Tensor<1, 2>
  way_to_cell<2>(const SimplexGeometry<2> &,
                 const unsigned int,
                 const Point<2> &);
  template double
  distance_to_cell<2>(const SimplexGeometry<2> &,
                      const unsigned int,
                      const Point<2> &);
  template Tensor<1, 3>
  way_to_cell<3>(const SimplexGeometry<3> &,
                 const unsigned int,
                 const Point<3> &);
  template double
  distance_to_cell<3>(const SimplexGeometry<3> &,
                      const unsigned int,
                      const Point<3> &);
  template double
  cell_size<2>(const SimplexGeometry<2> &, const unsigned int);
  template Point<2>
  cell_centroid<2>(const SimplexGeometry<2> &, const unsigned int);
  template double
  cell_size<3>(const SimplexGeometry<3> &, const unsigned int);
  template Point<3>
  cell_centroid<3>(const SimplexGeometry<3> &, const unsigned int);
  template std::vector<unsigned int>
  nearest_cells<2>(const SimplexGeometry<2> &,
                   const Point<2> &,
                   const unsigned int,
                   const std::function<bool(const unsigned int)> &,
                   const double);
  template std::vector<unsigned int>
  nearest_cells<3>(const SimplexGeometry<3> &,
                   const Point<3> &,
                   const unsigned int,
                   const std::function<bool(const unsigned int)> &,
                   const double);
} // namespace isochor
