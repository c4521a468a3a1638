/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/base/plain_message.h>
#include <isochor/transfer/contact_watch.h>

#include <algorithm>
#include <string>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Two vertices of the same body. */
    using Link = std::pair<unsigned int, unsigned int>;

    /** Sets of @p vertices, which are ascending. */
    class VertexSets
    {
    public:
      explicit VertexSets(const std::vector<unsigned int> &vertices)
        : vertices(vertices)
        , sets(vertices.size())
        , is_used(vertices.size(), 0)
      {}

      void
      merge(const unsigned int v, const unsigned int w)
      {
        const unsigned int i = place(v), j = place(w);
        sets.merge(i, j);
        is_used[i] = is_used[j] = 1;
      }

      /** Those that were merged, each with one that stands for its set. */
      std::vector<Link>
      links()
      {
        std::vector<Link> links;
        for (unsigned int i = 0; i < vertices.size(); ++i)
          if (is_used[i] != 0)
            links.emplace_back(vertices[i], vertices[sets.root(i)]);
        return links;
      }

    private:
      unsigned int
      place(const unsigned int v) const
      {
        return std::lower_bound(vertices.begin(), vertices.end(), v) -
               vertices.begin();
      }

      const std::vector<unsigned int> &vertices;
      DisjointSets                     sets;
      std::vector<unsigned char>       is_used;
    };



    /** Of this rank's points. */
    template <int dim>
    std::vector<Link>
    find_links(const PointArrays<dim>          &points,
               const SimplexGeometry<dim>      &geometry,
               const std::vector<unsigned int> &vertices)
    {
      VertexSets sets(vertices);
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        {
          // without stencils all of a cell act on its vertices
          const unsigned int end = points.has_stencils() ?
                                     points.cell_start[k + 1] :
                                     points.cell_start[k] + 1;
          for (unsigned int q = points.cell_start[k]; q < end; ++q)
            {
              const auto stencil = points.stencil(geometry, k, q);
              for (unsigned int I = 0; I < stencil.n_nodes; ++I)
                sets.merge(stencil.vertex[0], stencil.vertex[I]);
            }
        }
      return sets.links();
    }
  } // namespace



  template <int dim>
  ContactWatch<dim>::ContactWatch(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  unsigned int
  ContactWatch<dim>::count(const PointArrays<dim>          &points,
                           const std::vector<unsigned int> &vertices) const
  {
    const auto of_ranks =
      Utilities::MPI::all_gather(grid.communicator(),
                                 find_links(points, grid.geometry(), vertices));
    std::vector<unsigned int> all;
    for (const auto &links : of_ranks)
      for (const Link &link : links)
        all.push_back(link.first);
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    VertexSets sets(all);
    for (const auto &links : of_ranks)
      for (const Link &link : links)
        sets.merge(link.first, link.second);
    const std::vector<Link> links = sets.links();
    return std::count_if(links.begin(), links.end(), [](const Link &link) {
      return link.first == link.second;
    });
  }



  template <int dim>
  void
  ContactWatch<dim>::look(const PointArrays<dim>          &points,
                          const std::vector<unsigned int> &vertices,
                          const double                     time,
                          const bool                       at_start,
                          Warnings                        &warnings)
  {
    if (!at_start && !has_several)
      return;
    const unsigned int n_before =
      std::exchange(n_bodies, count(points, vertices));
    if (at_start)
      has_several = n_bodies > 1;
    else if (n_bodies < n_before)
      warnings.add(
        "bodies that meet",
        "At t = " + rounded(time) + " s bodies have come together: " +
          std::to_string(n_before) + " were apart, now there " +
          (n_bodies == 1 ? "is one" : "are " + std::to_string(n_bodies)) +
          ". Where they share nodes of the grid they are as one, from up to a "
          "cell before they touch: they don't slide along each other, and pull "
          "at each other until they share no node any more. If they are moved "
          "by a given way the force is too large by what this cell is of the "
          "way (two discs with 32 cells over the radius: 1.5 times); bodies "
          "that should bounce off each other may stay together. Use smaller "
          "cells where they meet, or let one of them be a wall (<Boundary "
          "conditions/Walls>) or a condition on the other one's surface.");
  }



  template class ContactWatch<2>;
  template class ContactWatch<3>;
} // namespace isochor
