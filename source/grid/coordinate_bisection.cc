/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/coordinate_bisection.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace isochor
{
  template <int dim>
  CoordinateBisection<dim>::CoordinateBisection(std::vector<Weight> weights,
                                                const unsigned int  n_ranks)
    : cuts(n_ranks - 1)
  {
    divide(weights.begin(), weights.end(), 0, n_ranks);
  }



  template <int dim>
  bool
  CoordinateBisection<dim>::is_less(const Place       &a,
                                    const Place       &b,
                                    const unsigned int axis)
  {
    for (unsigned int d = 0; d < dim; ++d)
      {
        const unsigned int i = (axis + d) % dim;
        if (a[i] != b[i])
          return a[i] < b[i];
      }
    return false;
  }



  template <int dim>
  bool
  CoordinateBisection<dim>::Cut::is_before(const Place &other) const
  {
    return !at_end && !is_less(other, place, axis);
  }



  template <int dim>
  unsigned int
  CoordinateBisection<dim>::rank(const Place &place) const
  {
    unsigned int first = 0, last = n_ranks();
    while (last - first > 1)
      {
        const unsigned int middle                          = (first + last) / 2;
        (cuts[middle - 1].is_before(place) ? first : last) = middle;
      }
    return first;
  }



  template <int dim>
  void
  CoordinateBisection<dim>::divide(const Iterator     begin,
                                   const Iterator     end,
                                   const unsigned int first,
                                   const unsigned int last)
  {
    Assert(first < last, ExcInternalError());
    if (last - first < 2)
      return;
    Place  lower, upper;
    double sum = 0;
    lower.fill(std::numeric_limits<std::uint32_t>::max());
    upper.fill(0);
    for (auto w = begin; w != end; ++w)
      {
        sum += w->weight;
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], w->place[d]);
            upper[d] = std::max(upper[d], w->place[d]);
          }
      }
    const unsigned int middle = (first + last) / 2;
    Cut               &cut    = cuts[middle - 1];
    for (unsigned int d = 1; d < dim && begin != end; ++d)
      if (upper[d] - lower[d] > upper[cut.axis] - lower[cut.axis])
        cut.axis = d;
    // behind the cut is what has more than half of it there
    const auto is_before = [&](const Weight &a, const Weight &b) {
      return is_less(a.place, b.place, cut.axis);
    };
    const double share  = sum * (middle - first) / (last - first);
    double       before = 0;
    auto         behind = begin;
    for (auto rest = end; behind != rest;) // a search, where a sort would do
      {
        const auto half = behind + (rest - behind) / 2;
        std::nth_element(behind, half, rest, is_before);
        double up_to_half = before;
        for (auto w = behind; w != half; ++w)
          up_to_half += w->weight;
        if (up_to_half + half->weight / 2 < share)
          {
            before = up_to_half + half->weight;
            behind = half + 1;
          }
        else
          rest = half;
      }
    cut.at_end = (behind == end);
    if (!cut.at_end)
      {
        cut.place = behind->place;
        // the same place is on one side
        behind = std::partition(begin, behind, [&](const Weight &w) {
          return is_less(w.place, cut.place, cut.axis);
        });
      }
    divide(begin, behind, first, middle);
    divide(behind, end, middle, last);
  }



  template <int dim>
  std::vector<typename CoordinateBisection<dim>::Place>
  places_of_cells(const std::vector<Point<dim>> &x,
                  const SimplexGeometry<dim>    &geometry)
  {
    Assert(!x.empty(), ExcInternalError());
    // much less than a cell, much more than rounding
    constexpr double n_steps = 1u << 24;
    Point<dim>       lower   = x[0];
    double           extent  = 0;
    for (const Point<dim> &vertex : x)
      for (unsigned int d = 0; d < dim; ++d)
        lower[d] = std::min(lower[d], vertex[d]);
    for (const Point<dim> &vertex : x)
      for (unsigned int d = 0; d < dim; ++d)
        extent = std::max(extent, vertex[d] - lower[d]);

    std::vector<typename CoordinateBisection<dim>::Place> places(
      geometry.n_cells());
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        Tensor<1, dim> centre;
        for (const unsigned int v : geometry.vertex_indices(cell))
          centre += (x[v] - lower) / (dim + 1);
        for (unsigned int d = 0; d < dim; ++d)
          places[cell][d] = centre[d] / extent * n_steps + 0.5;
      }
    return places;
  }



  template <std::size_t dim>
  std::vector<unsigned int>
  equal_parts(const std::vector<std::array<std::uint32_t, dim>> &places,
              const unsigned int                                 n_ranks)
  {
    Assert(n_ranks > 0, ExcInternalError());
    std::vector<typename CoordinateBisection<dim>::Weight> weights;
    weights.reserve(places.size());
    for (const auto &place : places)
      weights.push_back({place, 1.});
    const CoordinateBisection<dim> division(std::move(weights), n_ranks);
    std::vector<unsigned int>      ranks;
    ranks.reserve(places.size());
    for (const auto &place : places)
      ranks.push_back(division.rank(place));
    return ranks;
  }



  template class CoordinateBisection<2>;
  template class CoordinateBisection<3>;
  template std::vector<CoordinateBisection<2>::Place>
  places_of_cells(const std::vector<Point<2>> &, const SimplexGeometry<2> &);
  template std::vector<CoordinateBisection<3>::Place>
  places_of_cells(const std::vector<Point<3>> &, const SimplexGeometry<3> &);
  template std::vector<unsigned int>
  equal_parts(const std::vector<std::array<std::uint32_t, 2>> &,
              const unsigned int);
  template std::vector<unsigned int>
  equal_parts(const std::vector<std::array<std::uint32_t, 3>> &,
              const unsigned int);
} // namespace isochor
