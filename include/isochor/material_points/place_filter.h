/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_place_filter_h
#define isochor_place_filter_h

#include <isochor/material_points/place_table.h>

#include <algorithm>
#include <array>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Says of most places that are not in a PlaceTable that they are not, in a
   * quarter of the time of PlaceTable::find(): by the bins of a lattice over
   * the places of the table, most of which are empty if these are few or
   * close to each other.
   */
  template <int dim>
  class PlaceFilter
  {
  public:
    /** @p scale is that of the table. */
    PlaceFilter(const PlaceTable<dim> &table, const PlaceScale<dim> &scale)
    {
      if (table.size() == 0)
        return;
      // two quanta around the lower end of what has the key, to be sure
      const auto place = [&](const typename PlaceTable<dim>::Key &key,
                             const unsigned int                   d,
                             const double                         shift) {
        return scale.origin[d] + (key[d] + shift) * scale.quantum;
      };
      auto least = table.key(0), most = least;
      for (unsigned int i = 1; i < table.size(); ++i)
        for (unsigned int d = 0; d < dim; ++d)
          {
            least[d] = std::min(least[d], table.key(i)[d]);
            most[d]  = std::max(most[d], table.key(i)[d]);
          }
      // bins are larger than a place, so that its corners are in all of its own
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d]            = place(least, d, -2);
          const double extent = place(most, d, 2) - lower[d];
          bins_per_length[d] =
            n_bins / (1.001 * extent + 4 * n_bins * scale.quantum);
        }
      for (unsigned int i = 0; i < table.size(); ++i)
        for (unsigned int corner = 0; corner < (1u << dim); ++corner)
          {
            Point<dim> x;
            for (unsigned int d = 0; d < dim; ++d)
              x[d] = place(table.key(i), d, (corner >> d) & 1 ? 2 : -2);
            is_used[bin(x)] = true;
          }
    }

    /** False only if @p x is not in the table. */
    bool
    may_contain(const Point<dim> &x) const
    {
      const unsigned int i = bin(x);
      return i < is_used.size() && is_used[i];
    }

  private:
    static constexpr unsigned int n_bins     = (dim == 2 ? 256 : 40); // a side
    static constexpr unsigned int n_all_bins = (dim == 2 ? 65536 : 64000);

    /** n_all_bins if @p x is outside of all. */
    unsigned int
    bin(const Point<dim> &x) const
    {
      unsigned int number = 0;
      for (unsigned int d = dim; d-- > 0;)
        {
          const double i = (x[d] - lower[d]) * bins_per_length[d];
          if (!(i >= 0 && i < n_bins))
            return n_all_bins;
          number = number * n_bins + static_cast<unsigned int>(i);
        }
      return number;
    }

    Point<dim>              lower;
    std::array<double, dim> bins_per_length{};
    std::vector<bool>       is_used = std::vector<bool>(n_all_bins, false);
  };
} // namespace isochor

#endif
