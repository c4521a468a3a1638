/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_bisection_h
#define isochor_domain_bisection_h

#include <deal.II/base/mpi.h>

#include <isochor/material_points/place_table.h>
#include <isochor/material_points/point_domain.h>

#include <array>
#include <functional>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Splits simplex domains that tile a body so that the parts still do, and
   * neighbours share whole faces: a corner in the middle of a neighbour's edge
   * would move differently from that edge, and a homogeneous stress would have
   * forces there. Domains are bisected at an edge, and all domains that share
   * the edge with them: where one is too large, and where a neighbour has been
   * bisected, the longest edge of each triangle of the domain (Rivara, Int. J.
   * Numer. Meth. Eng. 20 (1984) 745-756; in space Plaza & Carey, Appl. Numer.
   * Math. 32 (2000) 195-218). Domains whose several edges are to be bisected
   * begin with the longest, of equals with one that its place determines, so
   * that both sides of a face do the same.
   */
  template <int dim>
  class DomainBisection
  {
  public:
    using DomainCondition = std::function<bool(const PointDomain<dim> &)>;

    /** @p domains of the points of this rank that take part; others stay
     * whole, even beside these. Their corners are told apart, by @p scale, by
     * where they were at t = 0 or, if they are @p flipped at times, which
     * leaves no common place at t = 0, by where they are. Those for which @p
     * may_be_shared is false share no edge with one of another rank.
     * Collective. */
    DomainBisection(std::vector<PointDomain<dim>> &&domains,
                    const PlaceScale<dim>          &scale,
                    const bool                      flipped,
                    const MPI_Comm                  comm,
                    const DomainCondition          &may_be_shared);

    /** Says whether a domain is too large, after having found its location and
     * cell, of which it knows those of the whole that it is a part of. */
    using IsLarge = std::function<bool(PointDomain<dim> &)>;

    /** Split domains until none is too large. Collective. */
    void
    bisect(const IsLarge &is_large);

    /** Bisect the domains that are @p asked for, by their place in parts(), and
     * then what is too large. Whether any was asked for on any rank.
     * Collective. */
    bool
    bisect(const std::vector<unsigned char> &asked, const IsLarge &is_large);

    /** In the order of the domains that they come from. */
    const std::vector<PointDomain<dim>> &
    parts() const
    {
      return domains;
    }

  private:
    static constexpr unsigned int n_edges = dim * (dim + 1) / 2;
    using Edges                           = std::array<unsigned int, n_edges>;

    /** Of the edges' lengths, longer ones first. */
    struct Rank
    {
      double                        length; ///< rounded logarithm
      typename PlaceTable<dim>::Key middle;
      bool
      operator<(const Rank &other) const
      {
        return length > other.length ||
               (length == other.length && middle < other.middle);
      }
    };

    Edges
    number_edges(const PointDomain<dim> &domain);
    /** The first by Rank among the edges of @p n_corners corners of a domain
     * that fulfil @p condition; n_edges if there is none. */
    template <typename Condition>
    unsigned int
    longest(const Edges &edges, const Condition &condition) const;
    /** Mark edges until all domains with a marked edge have their longest ones
     * marked. Returns what was marked here. */
    void
    close_marks(std::vector<unsigned int> &newly_marked);
    /** Agree with the other ranks about the lengths of edges of new domains.
     */
    void
    exchange_lengths();
    void
    exchange_marks(std::vector<unsigned int> &newly_marked);
    /** Bisect the longest edges of domains, by number, and what has to be
     * bisected with them. False if no rank has any. Collective. */
    bool
    bisect_longest_edges(const std::vector<unsigned int> &of_domains);
    void
    bisect_marked();
    void
    add_parts(const PointDomain<dim> &domain,
              const Edges            &edges,
              const bool              is_part);

    std::vector<PointDomain<dim>> domains;
    std::vector<Edges>            edges_of; ///< by domain
    const bool                    flipped;
    const MPI_Comm                comm;
    const DomainCondition         may_be_shared;
    PlaceTable<dim>               table;   ///< of the edges' middles
    std::vector<Point<dim>>       middles; ///< by edge, as the next two
    std::vector<Rank>             ranks;
    std::vector<unsigned char>    is_marked;
    std::vector<unsigned char>    is_new; ///< by domain
  };
} // namespace isochor

#endif
