/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/cells_near_ranks.h>

#include <utility>

namespace isochor
{
  template <int dim>
  void
  count_faces(const SimplexGeometry<dim> &geometry,
              std::vector<unsigned int>  &distances)
  {
    AssertDimension(distances.size(), geometry.n_cells());
    std::vector<unsigned int> last;
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      if (distances[cell] == 0)
        last.push_back(cell);
    for (unsigned int i = 1; i <= most_faces; ++i)
      for (const unsigned int cell : std::exchange(last, {}))
        for (const unsigned int next : geometry.neighbours(cell))
          if (next != SimplexGeometry<dim>::no_cell && distances[next] > i)
            {
              distances[next] = i;
              last.push_back(next);
            }
  }



  template <int dim>
  std::vector<unsigned char>
  cells_near_other_ranks(const SimplexGeometry<dim> &geometry,
                         const MPI_Comm              comm)
  {
    std::vector<unsigned char> is_near(geometry.n_cells(), 0);
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return is_near;
    const unsigned int        rank = Utilities::MPI::this_mpi_process(comm);
    std::vector<unsigned int> distances(geometry.n_cells(), most_faces + 1);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      if (geometry.owner(cell) != rank)
        distances[cell] = 0;
    count_faces(geometry, distances);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      is_near[cell] = (distances[cell] <= most_faces);
    return is_near;
  }



  template void
  count_faces(const SimplexGeometry<2> &, std::vector<unsigned int> &);
  template void
  count_faces(const SimplexGeometry<3> &, std::vector<unsigned int> &);
  template std::vector<unsigned char>
  cells_near_other_ranks(const SimplexGeometry<2> &, const MPI_Comm);
  template std::vector<unsigned char>
  cells_near_other_ranks(const SimplexGeometry<3> &, const MPI_Comm);
} // namespace isochor
