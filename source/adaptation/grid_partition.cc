/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/grid_partition.h>
#include <isochor/base/mpi_sums.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  GridPartition<dim>::declare_parameters(ParameterHandler &prm)
  {
    LoadBalance::declare_parameters(prm);
  }



  template <int dim>
  void
  GridPartition<dim>::parse_parameters(ParameterHandler &prm)
  {
    balance.parse_parameters(prm);
  }



  template <int dim>
  bool
  GridPartition<dim>::is_needed(const BackgroundGrid<dim> &grid)
  {
    return !grid.is_adaptive() &&
           Utilities::MPI::n_mpi_processes(grid.communicator()) > 1;
  }



  template <int dim>
  std::vector<unsigned int>
  GridPartition<dim>::occupied_cells(const MaterialPoints<dim> &points)
  {
    // the handler keeps the points of a cell together
    std::vector<unsigned int> pairs;
    for (const auto &particle : points.handler())
      {
        const unsigned int cell =
          particle.get_surrounding_cell()->active_cell_index();
        if (pairs.empty() || pairs[pairs.size() - 2] != cell)
          pairs.insert(pairs.end(), {cell, 0});
        ++pairs.back();
      }
    return pairs;
  }



  template <int dim>
  std::vector<std::pair<unsigned int, double>>
  GridPartition<dim>::cell_weights(const std::vector<unsigned int> &occupied,
                                   const MPI_Comm                   comm)
  {
    AssertDimension(occupied.size() % 2, 0u);
    std::vector<std::pair<unsigned int, double>> weights;
    for (const auto &of_rank : all_gather_arrays(comm, occupied))
      for (std::size_t i = 0; i < of_rank.size(); i += 2)
        weights.emplace_back(of_rank[i],
                             of_rank[i + 1] + LoadBalance::cost_of_cell);
    return weights;
  }



  template <int dim>
  std::vector<unsigned int>
  GridPartition<dim>::owners(const CoordinateBisection<dim> &division,
                             const BackgroundGrid<dim>      &grid)
  {
    std::vector<unsigned int> ranks;
    ranks.reserve(grid.geometry().n_cells());
    for (const auto &place :
         places_of_cells(grid.generated_vertices(), grid.geometry()))
      ranks.push_back(division.rank(place));
    return ranks;
  }



  template <int dim>
  bool
  GridPartition<dim>::rebalance(BackgroundGrid<dim>     &grid,
                                MaterialPoints<dim>     &points,
                                const PointLocator<dim> &locator,
                                LastMotion              &last_motion)
  {
    if (!is_needed(grid))
      return false;
    const MPI_Comm     comm     = grid.communicator();
    const unsigned int n_ranks  = Utilities::MPI::n_mpi_processes(comm);
    const auto         occupied = occupied_cells(points);
    double             own      = points.handler().n_locally_owned_particles();
    own += LoadBalance::cost_of_cell * (occupied.size() / 2.);
    const double now =
      LoadBalance::imbalance(Utilities::MPI::all_gather(comm, own));
    if (!balance.is_too_large(now))
      return false;

    const auto weights = cell_weights(occupied, comm);
    const auto place =
      places_of_cells(grid.generated_vertices(), grid.geometry());
    std::vector<typename CoordinateBisection<dim>::Weight> entries;
    entries.reserve(weights.size());
    for (const auto &[cell, weight] : weights)
      entries.push_back({place[cell], weight});
    const CoordinateBisection<dim> next(std::move(entries), n_ranks);
    std::vector<double>            sums(n_ranks);
    for (const auto &[cell, weight] : weights)
      sums[next.rank(place[cell])] += weight;
    if (!balance.is_worth_it(now, LoadBalance::imbalance(sums)))
      return false;
    division = next;
    ++n_divisions;
    points.change_owners(locator,
                         [&]() { grid.set_owners(owners(division, grid)); });
    last_motion.send_to_owners(grid);
    return true;
  }



  template <int dim>
  void
  GridPartition<dim>::evaluate(const BackgroundGrid<dim> &grid,
                               const MaterialPoints<dim> &points,
                               Statistics                &statistics) const
  {
    if (!is_needed(grid))
      return;
    evaluate_balance(points, grid.communicator(), statistics);
    statistics.set("Divisions of grid", n_divisions);
  }



  template <int dim>
  std::string
  GridPartition<dim>::save_state() const
  {
    std::ostringstream              stream(std::ios::binary);
    boost::archive::binary_oarchive archive(stream);
    archive << n_divisions << division;
    return stream.str();
  }



  template <int dim>
  bool
  GridPartition<dim>::load_state(const std::string       &state,
                                 BackgroundGrid<dim>     &grid,
                                 MaterialPoints<dim>     &points,
                                 const PointLocator<dim> &locator)
  {
    std::istringstream              stream(state, std::ios::binary);
    boost::archive::binary_iarchive archive(stream);
    archive >> n_divisions >> division;
    if (n_divisions == 0)
      return false;
    points.change_owners(locator,
                         [&]() { grid.set_owners(owners(division, grid)); });
    return true;
  }



  template class GridPartition<2>;
  template class GridPartition<3>;
} // namespace isochor
