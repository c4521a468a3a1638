/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_coordinate_bisection_h
#define isochor_coordinate_bisection_h

#include <isochor/grid/simplex_geometry.h>

#include <boost/serialization/access.hpp>
#include <boost/serialization/array.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace isochor
{
  /**
   * A division of space among ranks: it is cut in two across the longest
   * extent of what has weight, so that both parts get their share of it, and
   * the parts again, until there is one for each rank (recursive coordinate
   * bisection, Berger & Bokhari, IEEE Trans. Comput. C-36 (1987) 570-580).
   * Parts are boxes but for the last layer of cells, so that ranks have few
   * nodes in common.
   *
   * The cuts are all there is to know: a place belongs to one rank whether
   * there is weight or not.
   */
  template <int dim>
  class CoordinateBisection
  {
  public:
    /** A place, in integers: cells of one layer, which differ by rounding only,
     * have the same coordinate. */
    using Place = std::array<std::uint32_t, dim>;

    struct Weight
    {
      Place  place;
      double weight;
    };

    /** All space belongs to rank 0. */
    CoordinateBisection() = default;

    /** Divide @p weights among @p n_ranks. The result does not depend on their
     * order, if they are integers. */
    CoordinateBisection(std::vector<Weight> weights,
                        const unsigned int  n_ranks);

    unsigned int
    rank(const Place &place) const;

    unsigned int
    n_ranks() const
    {
      return cuts.size() + 1;
    }

  private:
    using Iterator = typename std::vector<Weight>::iterator;

    /** Between two groups of ranks. */
    struct Cut
    {
      unsigned int axis = 0;
      /** The first one behind the cut. Places in its layer are told apart by
       * their other coordinates. */
      Place place{};
      /** Nothing is behind it. */
      bool at_end = false;

      bool
      is_before(const Place &other) const;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &axis &place &at_end;
      }
    };

    static bool
    is_less(const Place &a, const Place &b, const unsigned int axis);
    /** Divide the weights from @p begin to @p end among ranks from @p first to
     * below @p last. */
    void
    divide(const Iterator     begin,
           const Iterator     end,
           const unsigned int first,
           const unsigned int last);

    /** That before rank r is number r - 1. */
    std::vector<Cut> cuts;

    friend class boost::serialization::access;
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &cuts;
    }
  };



  /** The centres of all cells, their vertices being at @p vertices. */
  template <int dim>
  std::vector<typename CoordinateBisection<dim>::Place>
  places_of_cells(const std::vector<Point<dim>> &vertices,
                  const SimplexGeometry<dim>    &geometry);

  /** The ranks of cells at @p places, as many for each of @p n_ranks. */
  template <std::size_t dim>
  std::vector<unsigned int>
  equal_parts(const std::vector<std::array<std::uint32_t, dim>> &places,
              const unsigned int                                 n_ranks);
} // namespace isochor

#endif
