/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_coarse_grid_h
#define isochor_coarse_grid_h

#include <deal.II/base/point.h>
#include <deal.II/base/types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The quadrilaterals or hexahedra that an adaptive grid is refined from: the
   * roots of its trees. Each is the multilinear image of the unit cube.
   */
  template <int dim>
  struct CoarseGrid
  {
    static constexpr unsigned int n_corners = 1u << dim;

    std::vector<Point<dim>> vertices;
    /** Vertices of a cell; corner i has the coordinate d of the unit cube where
     * bit d of i is set. Positively oriented. */
    std::vector<std::array<unsigned int, n_corners>> cells;
    /** Of face 2 d + s, where the coordinate d of the unit cube is s;
     * numbers::internal_face_boundary_id inside of the grid. */
    std::vector<std::array<types::boundary_id, 2 * dim>> boundary_ids;
    std::vector<types::material_id>                      material_ids;
  };

  /**
   * A leaf of a forest: a cell of the tree `tree`, a coarse cell, halved
   * `level` times in each direction. Leaves of a forest are listed along its
   * space-filling curve, tree by tree.
   */
  template <int dim>
  struct Leaf
  {
    /** Coordinates in a tree count from 0 to this. The midpoints of the
     * smallest leaves still have integer coordinates. */
    static constexpr std::uint32_t resolution = 1u << 20;
    static constexpr unsigned int  max_level  = 18;

    unsigned int                   tree;
    std::array<std::uint32_t, dim> corner; ///< the lowest one
    unsigned int                   level;

    std::uint32_t
    size() const
    {
      return resolution >> level;
    }

    bool
    operator==(const Leaf &other) const
    {
      return tree == other.tree && corner == other.corner &&
             level == other.level;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &tree &corner &level;
    }
  };
} // namespace isochor

#endif
