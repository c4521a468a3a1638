/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_element_nodes_h
#define isochor_element_nodes_h

#include <cstddef>
#include <vector>

namespace isochor
{
  /** Lists of local nodes, one per element, in compressed-row form. */
  struct ElementNodes
  {
    std::vector<std::size_t>  start = {0};
    std::vector<unsigned int> node;

    unsigned int
    size() const
    {
      return start.size() - 1;
    }

    void
    clear()
    {
      start.assign(1, 0);
      node.clear();
    }

    template <typename Iterator>
    void
    add(Iterator first, Iterator last)
    {
      node.insert(node.end(), first, last);
      start.push_back(node.size());
    }

    bool
    operator==(const ElementNodes &other) const
    {
      return start == other.start && node == other.node;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &start &node;
    }
  };
} // namespace isochor

#endif
