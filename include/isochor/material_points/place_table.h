/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_place_table_h
#define isochor_place_table_h

#include <deal.II/base/point.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** By what places in space are told apart. */
  template <int dim>
  struct PlaceScale
  {
    /** A place near to all others, so that the numbers below are the same
     * wherever the scene lies. */
    Point<dim> origin;
    /** Much larger than errors of rounding, much smaller than distances between
     * places (m). */
    double quantum;
  };

  /**
   * Numbers places in space. Places are the same if they differ by rounding,
   * that is, by much less than the quantum of the scale: they are rounded to
   * multiples of it, and where the rounding might go either way, both are
   * looked up.
   */
  template <int dim>
  class PlaceTable
  {
  public:
    using Key = std::array<std::int64_t, dim>;

    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    explicit PlaceTable(const PlaceScale<dim> &scale)
      : scale(scale)
    {}

    unsigned int
    size() const
    {
      return keys.size();
    }

    /** The number of @p x, or none. */
    unsigned int
    find(const Point<dim> &x) const
    {
      Key base, other;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const double scaled = scaled_coordinate(x, d);
          const double floor  = std::floor(scaled);
          base[d]             = static_cast<std::int64_t>(floor);
          other[d]            = base[d] + (scaled - floor < margin     ? -1 :
                                           scaled - floor > 1 - margin ? 1 :
                                                                         0);
        }
      for (unsigned int choice = 0; choice < (1u << dim); ++choice)
        {
          Key  key     = base;
          bool is_done = false;
          for (unsigned int d = 0; d < dim; ++d)
            if ((choice >> d) & 1)
              {
                is_done = is_done || other[d] == base[d];
                key[d]  = other[d];
              }
          if (is_done)
            continue;
          const unsigned int number = slots[slot_of(key)];
          if (number != none)
            return number;
        }
      return none;
    }

    unsigned int
    find_or_add(const Point<dim> &x)
    {
      const unsigned int number = find(x);
      if (number != none)
        return number;
      Key key;
      for (unsigned int d = 0; d < dim; ++d)
        key[d] = static_cast<std::int64_t>(std::floor(scaled_coordinate(x, d)));
      keys.push_back(key);
      if (2 * keys.size() > slots.size())
        enlarge();
      else
        slots[slot_of(key)] = keys.size() - 1;
      return keys.size() - 1;
    }

    /** Coordinates of a place from the origin, in units of the quantum. */
    const Key &
    key(const unsigned int number) const
    {
      return keys[number];
    }

  private:
    /** Of the quantum: what may be rounded either way. */
    static constexpr double margin = 0.05;
    /** So that the places of lattices are in the middle of what is rounded to
     * the same number, or at least not all at its ends. */
    static constexpr double offset = 0.381966;

    /** As == of the arrays, which calls a function to compare bytes. */
    static bool
    are_same(const Key &a, const Key &b)
    {
      bool same = true;
      for (unsigned int d = 0; d < dim; ++d)
        same = same && a[d] == b[d];
      return same;
    }

    /** The slot that holds the number of @p key, or the empty one where it
     * belongs: the first of these from that of its hash on. (Linear probing; a
     * std::unordered_map took twice the time of all that uses the table.) */
    std::size_t
    slot_of(const Key &key) const
    {
      std::uint64_t hash = 0;
      for (const std::int64_t k : key)
        {
          hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u;
          hash ^= hash >> 29;
        }
      const std::size_t mask = slots.size() - 1;
      std::size_t       slot = hash & mask;
      while (slots[slot] != none && !are_same(keys[slots[slot]], key))
        slot = (slot + 1) & mask;
      return slot;
    }

    void
    enlarge()
    {
      slots.assign(2 * slots.size(), none);
      for (unsigned int number = 0; number < keys.size(); ++number)
        slots[slot_of(keys[number])] = number;
    }

    double
    scaled_coordinate(const Point<dim> &x, const unsigned int d) const
    {
      return (x[d] - scale.origin[d]) / scale.quantum + offset;
    }

    PlaceScale<dim>           scale;
    std::vector<unsigned int> slots = std::vector<unsigned int>(64, none);
    std::vector<Key>          keys; ///< by number
  };
} // namespace isochor

#endif
