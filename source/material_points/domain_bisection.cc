/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/domain_bisection.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

namespace isochor
{
  namespace
  {
    /** The corners of each edge of a simplex. */
    template <int dim>
    constexpr std::array<std::pair<unsigned int, unsigned int>,
                         dim *(dim + 1) / 2>
    corners_of_edges()
    {
      std::array<std::pair<unsigned int, unsigned int>, dim *(dim + 1) / 2>
                   edges{};
      unsigned int e = 0;
      for (unsigned int a = 0; a <= dim; ++a)
        for (unsigned int b = a + 1; b <= dim; ++b, ++e)
          {
            edges[e].first  = a;
            edges[e].second = b;
          }
      return edges;
    }

    template <int dim>
    constexpr auto edge_corners = corners_of_edges<dim>();
  } // namespace



  template <int dim>
  DomainBisection<dim>::DomainBisection(std::vector<PointDomain<dim>> &&all,
                                        const PlaceScale<dim>          &scale,
                                        const bool                      flipped,
                                        const MPI_Comm                  comm,
                                        const DomainCondition &may_be_shared)
    : domains(std::move(all))
    , flipped(flipped)
    , comm(comm)
    , may_be_shared(may_be_shared)
    , table(scale)
    , is_new(domains.size(), 1)
  {
    edges_of.reserve(domains.size());
    // an edge is shared by two in the plane, by about six in space
    const std::size_t n_edges_expected = 2 * domains.size();
    ranks.reserve(n_edges_expected);
    middles.reserve(n_edges_expected);
    is_marked.reserve(n_edges_expected);
    for (const PointDomain<dim> &domain : domains)
      edges_of.push_back(number_edges(domain));
    exchange_lengths();
  }



  template <int dim>
  typename DomainBisection<dim>::Edges
  DomainBisection<dim>::number_edges(const PointDomain<dim> &domain)
  {
    Edges edges;
    for (unsigned int e = 0; e < n_edges; ++e)
      {
        const auto [a, b]        = edge_corners<dim>[e];
        const auto      &corners = flipped ? domain.current : domain.reference;
        const Point<dim> middle  = corners[a] + (corners[b] - corners[a]) / 2;
        edges[e]                 = table.find_or_add(middle);
        // lengths that are equal but for rounding have to be equal; domains of
        // neighbours may differ about it, the longest counts
        const double length = std::floor(
          2e4 * std::log2((domain.current[b] - domain.current[a]).norm()) +
          0.38);
        if (edges[e] < is_marked.size())
          {
            ranks[edges[e]].length = std::max(ranks[edges[e]].length, length);
            continue;
          }
        ranks.push_back({length, table.key(edges[e])});
        middles.push_back(middle);
        is_marked.push_back(0);
      }
    return edges;
  }



  template <int dim>
  template <typename Condition>
  unsigned int
  DomainBisection<dim>::longest(const Edges     &edges,
                                const Condition &condition) const
  {
    unsigned int first = n_edges;
    for (unsigned int e = 0; e < n_edges; ++e)
      if (condition(e) &&
          (first == n_edges || ranks[edges[e]] < ranks[edges[first]]))
        first = e;
    return first;
  }



  template <int dim>
  void
  DomainBisection<dim>::close_marks(std::vector<unsigned int> &newly_marked)
  {
    AssertDimension(edges_of.size(), domains.size());
    for (bool changed = true; changed;)
      {
        changed = false;
        for (const Edges &edges : edges_of)
          {
            if (std::none_of(edges.begin(), edges.end(), [&](const auto edge) {
                  return is_marked[edge] != 0;
                }))
              continue;
            // the whole, then the triangle without corner c; in the plane
            // these are the same
            for (unsigned int c = (dim == 2 ? dim + 1 : 0); c <= dim + 1; ++c)
              {
                const auto is_in_face = [c](const unsigned int e) {
                  return edge_corners<dim>[e].first != c &&
                         edge_corners<dim>[e].second != c;
                };
                bool is_touched = false;
                for (unsigned int e = 0; e < n_edges; ++e)
                  is_touched =
                    is_touched || (is_in_face(e) && is_marked[edges[e]]);
                const unsigned int edge = edges[longest(edges, is_in_face)];
                if (!is_touched || is_marked[edge])
                  continue;
                is_marked[edge] = 1;
                newly_marked.push_back(edge);
                changed = true;
              }
          }
      }
  }



  template <int dim>
  void
  DomainBisection<dim>::exchange_lengths()
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    std::vector<double> values;
    for (unsigned int i = 0; i < domains.size(); ++i)
      if (is_new[i] && may_be_shared(domains[i]))
        for (const unsigned int edge : edges_of[i])
          {
            for (unsigned int d = 0; d < dim; ++d)
              values.push_back(middles[edge][d]);
            values.push_back(ranks[edge].length);
          }
    for (const auto &of_rank : all_gather_arrays(comm, values))
      for (std::size_t i = 0; i < of_rank.size(); i += dim + 1)
        {
          Point<dim> middle;
          for (unsigned int d = 0; d < dim; ++d)
            middle[d] = of_rank[i + d];
          const unsigned int edge = table.find(middle);
          if (edge != PlaceTable<dim>::none)
            ranks[edge].length = std::max(ranks[edge].length, of_rank[i + dim]);
        }
  }



  template <int dim>
  void
  DomainBisection<dim>::exchange_marks(std::vector<unsigned int> &newly_marked)
  {
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      {
        newly_marked.clear();
        return;
      }
    std::vector<double> places;
    for (const unsigned int edge : newly_marked)
      for (unsigned int d = 0; d < dim; ++d)
        places.push_back(middles[edge][d]);
    newly_marked.clear();
    for (const auto &of_rank : all_gather_arrays(comm, places))
      for (std::size_t i = 0; i < of_rank.size(); i += dim)
        {
          Point<dim> middle;
          for (unsigned int d = 0; d < dim; ++d)
            middle[d] = of_rank[i + d];
          const unsigned int edge = table.find(middle);
          if (edge != PlaceTable<dim>::none)
            is_marked[edge] = 1;
        }
  }



  template <int dim>
  bool
  DomainBisection<dim>::bisect_longest_edges(
    const std::vector<unsigned int> &of_domains)
  {
    Assert(std::all_of(of_domains.begin(),
                       of_domains.end(),
                       [&](const unsigned int i) {
                         return i < domains.size();
                       }),
           ExcInternalError());
    std::vector<unsigned int> newly_marked;
    for (const unsigned int i : of_domains)
      {
        const unsigned int edge =
          edges_of[i][longest(edges_of[i],
                              [](const unsigned int) { return true; })];
        if (!std::exchange(is_marked[edge], 1))
          newly_marked.push_back(edge);
      }
    if (Utilities::MPI::sum(newly_marked.size(), comm) == 0)
      return false;
    for (;;)
      {
        close_marks(newly_marked);
        if (Utilities::MPI::sum(newly_marked.size(), comm) == 0)
          break;
        exchange_marks(newly_marked);
      }
    bisect_marked();
    return true;
  }



  template <int dim>
  void
  DomainBisection<dim>::bisect(const IsLarge &is_large)
  {
    unsigned int n_rounds_left = 100;
    for (;;)
      {
        AssertThrow(n_rounds_left-- > 0, ExcInternalError());
        std::vector<unsigned int> large;
        for (unsigned int i = 0; i < domains.size(); ++i)
          if (std::exchange(is_new[i], 0) && is_large(domains[i]))
            large.push_back(i);
        if (!bisect_longest_edges(large))
          return;
      }
  }



  template <int dim>
  bool
  DomainBisection<dim>::bisect(const std::vector<unsigned char> &asked,
                               const IsLarge                    &is_large)
  {
    AssertDimension(asked.size(), domains.size());
    std::vector<unsigned int> numbers;
    for (unsigned int i = 0; i < domains.size(); ++i)
      if (asked[i])
        numbers.push_back(i);
    if (!bisect_longest_edges(numbers))
      return false;
    bisect(is_large);
    return true;
  }



  template <int dim>
  void
  DomainBisection<dim>::bisect_marked()
  {
    AssertDimension(edges_of.size(), domains.size());
    const auto all_domains = std::move(domains);
    const auto all_edges   = std::move(edges_of);
    domains.clear();
    edges_of.clear();
    is_new.clear();
    domains.reserve(all_domains.size());
    edges_of.reserve(all_edges.size());
    for (unsigned int i = 0; i < all_domains.size(); ++i)
      add_parts(all_domains[i], all_edges[i], false);
    std::fill(is_marked.begin(), is_marked.end(), 0);
    exchange_lengths();
  }



  template <int dim>
  void
  DomainBisection<dim>::add_parts(const PointDomain<dim> &domain,
                                  const Edges            &edges,
                                  const bool              is_part)
  {
    const unsigned int edge = longest(edges, [&](const unsigned int e) {
      return is_marked[edges[e]] != 0;
    });
    if (edge == n_edges)
      {
        domains.push_back(domain);
        edges_of.push_back(edges);
        is_new.push_back(is_part);
        return;
      }
    const auto [a, b] = edge_corners<dim>[edge];
    // an edge halved that often is rounding
    if (domain.n_halvings >= std::numeric_limits<double>::digits)
      {
        std::ostringstream place;
        place << domain.location;
        AssertThrow(false,
                    ExcMessage("The domain of a material point, at (" +
                               place.str() +
                               "), is flat: the deformation is too large for "
                               "<Quadrature/Type = CPDI>, as where flow parts "
                               "before a tip."));
      }
    for (const auto &[kept, lost] :
         {std::make_pair(a, b), std::make_pair(b, a)})
      {
        PointDomain<dim> part = domain;
        part.volume /= 2;
        ++part.n_halvings;
        part.ancestry = Ancestry<dim>::of_part(domain.ancestry, kept, lost);
        // what is opposite to the end of the edge is between the parts
        part.outer_faces = ((domain.outer_faces >> lost) & flags_of_face)
                           << dim;
        unsigned int c = 0;
        for (unsigned int other = 0; other <= dim; ++other)
          if (other != kept && other != lost)
            {
              part.outer_faces |=
                ((domain.outer_faces >> other) & flags_of_face) << c;
              part.reference[c] = domain.reference[other];
              part.current[c++] = domain.current[other];
            }
        part.reference[c] = domain.reference[kept];
        part.current[c++] = domain.current[kept];
        // the same to the last bit in both parts
        part.reference[c] =
          domain.reference[a] + (domain.reference[b] - domain.reference[a]) / 2;
        part.current[c] =
          domain.current[a] + (domain.current[b] - domain.current[a]) / 2;
        add_parts(part, number_edges(part), true);
      }
  }



  template class DomainBisection<2>;
  template class DomainBisection<3>;
} // namespace isochor
