/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_leaf_template_h
#define isochor_leaf_template_h

#include <array>
#include <cstdint>
#include <vector>

namespace isochor
{
  /**
   * How a leaf of a forest is split into simplices, by its nodes: corners,
   * middles of edges and faces, and the centre, on the lattice {0, 1, 2}^dim,
   * numbered with the first axis fastest.
   */
  template <int dim>
  struct LeafTemplate
  {
    static constexpr unsigned int n_nodes = (dim == 2 ? 9 : 27);

    std::vector<std::array<unsigned char, dim + 1>> simplices;
    /** Those of its sides, by face. */
    std::array<std::vector<std::array<unsigned char, dim>>, 2 * dim> sides;
  };

  /**
   * Split a leaf with vertices at the nodes in the bit set @p present. In 3D
   * @p frames says by face where its axes point: bits 0 and 1 whether the first
   * and second are flipped, bit 2 whether they are swapped. In 2D frames[0] is
   * the direction of the diagonal, 0 for "/".
   */
  template <int dim>
  LeafTemplate<dim>
  split_leaf(const std::uint32_t                      present,
             const std::array<unsigned int, 2 * dim> &frames);

  inline constexpr std::array<unsigned int, 4> power_of_three = {{1, 3, 9, 27}};

  /** Coordinate @p d of a local node: 0, 1 or 2. */
  constexpr unsigned int
  coordinate(const unsigned int node, const unsigned int d)
  {
    return (node / power_of_three[d]) % 3;
  }

  /** The local node of corner @p i. */
  template <int dim>
  unsigned int
  corner_node(const unsigned int i)
  {
    unsigned int node = 0;
    for (unsigned int d = 0; d < dim; ++d)
      if (i & (1u << d))
        node += 2 * power_of_three[d];
    return node;
  }

  template <int dim>
  std::uint32_t
  corner_bits()
  {
    std::uint32_t bits = 0;
    for (unsigned int i = 0; i < (1u << dim); ++i)
      bits |= 1u << corner_node<dim>(i);
    return bits;
  }

  template <int dim>
  unsigned int
  n_middle_axes(const unsigned int node)
  {
    unsigned int n = 0;
    for (unsigned int d = 0; d < dim; ++d)
      n += (coordinate(node, d) == 1);
    return n;
  }
} // namespace isochor

#endif
