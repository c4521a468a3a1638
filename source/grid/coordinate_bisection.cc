/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/coordinate_bisection.h>

#include <algorithm>
#include <limits>

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
    std::sort(begin, end, [&](const Weight &a, const Weight &b) {
      return is_less(a.place, b.place, cut.axis);
    });
    // behind the cut is what has more than half of it there
    const double share  = sum * (middle - first) / (last - first);
    double       before = 0;
    auto         behind = begin;
    for (; behind != end && before + behind->weight / 2 < share; ++behind)
      before += behind->weight;
    cut.at_end = (behind == end);
    if (!cut.at_end)
      {
        cut.place = behind->place;
        // the same place is on one side
        while (behind != begin && (behind - 1)->place == cut.place)
          --behind;
      }
    divide(begin, behind, first, middle);
    divide(behind, end, middle, last);
  }



  template class CoordinateBisection<2>;
  template class CoordinateBisection<3>;
} // namespace isochor
