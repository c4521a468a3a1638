/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/postprocess/carried_reactions.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace isochor
{
  namespace
  {
    /** What travels between ranks: component, a number, place. */
    template <int dim>
    constexpr unsigned int length = dim + 2;

    template <int dim>
    void
    pack(const unsigned int   component,
         const double         number,
         const Point<dim>    &place,
         std::vector<double> &values)
    {
      values.push_back(component);
      values.push_back(number);
      for (unsigned int d = 0; d < dim; ++d)
        values.push_back(place[d]);
    }

    template <int dim>
    Point<dim>
    place_at(const std::vector<double> &values, const std::size_t i)
    {
      Point<dim> place;
      for (unsigned int d = 0; d < dim; ++d)
        place[d] = values[i + 2 + d];
      return place;
    }
  } // namespace



  template <int dim>
  Point<dim>
  place_of_entry(const StepContext<dim> &step, const unsigned int entry)
  {
    const auto        &vertices = step.grid.geometry().vertices();
    const unsigned int vertex   = entry / dim;
    if (vertex < vertices.size())
      return vertices[vertex];
    // A control node has its number after those of the vertices, and is the
    // same on each grid: a place where nothing else is, of each its own.
    Point<dim> place;
    place[0] = 1e100 * (1. + vertex - vertices.size());
    return place;
  }



  template <int dim>
  void
  carry_reactions(const StepContext<dim>                   &step,
                  const std::vector<HeldUnknown>           &held,
                  const std::map<unsigned int, Point<dim>> &places,
                  std::map<unsigned int, double>           &reactions)
  {
    const MPI_Comm      comm = step.grid.communicator();
    std::vector<double> mine;
    for (const auto &[entry, place] : places)
      pack(entry % dim, reactions.at(entry), place, mine);
    const auto before = all_gather_arrays(comm, mine);
    reactions.clear();
    if (std::all_of(before.begin(), before.end(), [](const auto &of_rank) {
          return of_rank.empty();
        }))
      return; // the first step
    mine.clear();
    for (const HeldUnknown &one : held)
      {
        pack(one.entry % dim, one.entry, place_of_entry(step, one.entry), mine);
        reactions[one.entry] = 0.;
      }

    // by component: the place, and the rank and the entry there
    using Candidate = std::pair<Point<dim>, std::pair<unsigned int, double>>;
    std::array<std::vector<Candidate>, dim> candidates;
    const auto                              now = all_gather_arrays(comm, mine);
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    for (unsigned int r = 0; r < now.size(); ++r)
      for (std::size_t i = 0; i < now[r].size(); i += length<dim>)
        candidates[static_cast<unsigned int>(now[r][i])].push_back(
          {place_at<dim>(now[r], i), {r, now[r][i + 1]}});
    for (unsigned int a = 0; a < dim; ++a)
      {
        const auto tree = pack_rtree(candidates[a]);
        for (const auto &of_rank : before)
          for (std::size_t i = 0; i < of_rank.size(); i += length<dim>)
            if (of_rank[i] == a)
              {
                std::vector<Candidate> nearest;
                tree.query(
                  boost::geometry::index::nearest(place_at<dim>(of_rank, i), 1),
                  std::back_inserter(nearest));
                if (!nearest.empty() && nearest[0].second.first == rank)
                  reactions[static_cast<unsigned int>(
                    nearest[0].second.second)] += of_rank[i + 1];
              }
      }
  }



  template Point<2>
  place_of_entry(const StepContext<2> &, const unsigned int);
  template Point<3>
  place_of_entry(const StepContext<3> &, const unsigned int);
  template void
  carry_reactions(const StepContext<2> &,
                  const std::vector<HeldUnknown> &,
                  const std::map<unsigned int, Point<2>> &,
                  std::map<unsigned int, double> &);
  template void
  carry_reactions(const StepContext<3> &,
                  const std::vector<HeldUnknown> &,
                  const std::map<unsigned int, Point<3>> &,
                  std::map<unsigned int, double> &);
} // namespace isochor
