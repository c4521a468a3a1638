/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_cells_near_ranks_h
#define isochor_cells_near_ranks_h

#include <deal.II/base/mpi.h>

#include <isochor/grid/simplex_geometry.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /** How many faces domains that take part in a change of domains are away from
   * its cause, at most: what is bisected there hardly ever concerns domains
   * further away. */
  constexpr unsigned int most_faces = 8;

  /** By cell: how many faces it is away from those that are 0 already, at
   * most most_faces + 1, which the others hold. */
  template <int dim>
  void
  count_faces(const SimplexGeometry<dim> &geometry,
              std::vector<unsigned int>  &distances);

  /** By cell: whether it is at most most_faces away from those of other ranks;
   * domains elsewhere share no corner with one of another rank. */
  template <int dim>
  std::vector<unsigned char>
  cells_near_other_ranks(const SimplexGeometry<dim> &geometry,
                         const MPI_Comm              comm);
} // namespace isochor

#endif
