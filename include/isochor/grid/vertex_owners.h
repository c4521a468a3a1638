/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_vertex_owners_h
#define isochor_vertex_owners_h

#include <isochor/grid/simplex_geometry.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The rank of each vertex: that of its cells. Where ranks meet they take
   * turns, so that none of them has more equations than the others: of the
   * vertices that the same ranks share, in the order of their numbers, the
   * first part belongs to the first rank, the next one to the second, and so
   * on, some rounds. The parts are long so that neighbours mostly have the same
   * owner, and ranks few nodes in common.
   */
  template <int dim>
  std::vector<unsigned int>
  owners_of_vertices(const SimplexGeometry<dim> &geometry);
} // namespace isochor

#endif
