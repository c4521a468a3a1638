/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/domain_flips.h>
#include <isochor/material_points/mean_state.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
  namespace
  {
    /** Positive if the corners go around it counter-clockwise. */
    double
    area(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) /
             2;
    }

    double
    quality(const Point<2> &a, const Point<2> &b, const Point<2> &c)
    {
      return 4 * std::sqrt(3.) * std::abs(area(a, b, c)) /
             ((b - a).norm_square() + (c - b).norm_square() +
              (a - c).norm_square());
    }

    double
    quality(const PointDomain<2>::Corners &corners)
    {
      return quality(corners[0], corners[1], corners[2]);
    }

    /** Of a domain with the state @p values and its centroid at @p whole: what
     * a part of it with the centroid @p centre has, @p share of its area. */
    void
    take_part(const Point<2>      &whole,
              const Point<2>      &centre,
              const double         share,
              const PointLayout   &l,
              std::vector<double> &values)
    {
      Assert(share >= 0 && share <= 1 + 1e-10, ExcInternalError());
      const Tensor<1, 2> shift = centre - whole,
                         moved =
                           shift -
                           invert(deformation_gradient<2>(values.data(), l)) *
                             shift;
      values[l.volume] *= share;
      // of rings
      values[l.mass] *= share * (l.axisymmetric ? centre[0] / whole[0] : 1.);
      for (unsigned int d = 0; d < 2; ++d)
        values[l.displacement + d] += moved[d];
    }
  } // namespace



  template <int dim>
  bool
  is_flowing(const double                                           *properties,
             const PointLayout                                      &l,
             const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials)
  {
    return l.mixed() && l.with_domains && properties[l.volume_gain] != 0 &&
           materials[static_cast<unsigned int>(properties[l.material])]
             ->dissipates();
  }



  DomainFlips::DomainFlips(MaterialPoints<2>       &points,
                           const BackgroundGrid<2> &grid,
                           const Materials         &materials)
    : points(points)
    , grid(grid)
    , materials(materials)
  {}



  typename DomainFlips::Edge
  DomainFlips::edge(const Triangle &triangle, const unsigned int opposite) const
  {
    AssertIndexRange(opposite, 3);
    const auto [a, b] = std::minmax(triangle.number[(opposite + 1) % 3],
                                    triangle.number[(opposite + 2) % 3]);
    return {{triangle.body, a, b}};
  }



  PlaceTable<2>
  DomainFlips::corners_of_poor(const std::vector<PointDomain<2>> &flowing) const
  {
    std::vector<double> places;
    for (const PointDomain<2> &domain : flowing)
      if (quality(domain.current) < poor)
        for (const Point<2> &corner : domain.current)
          places.insert(places.end(), {corner[0], corner[1]});
    PlaceTable<2> corners(scale_of_places(grid));
    for (const auto &of_rank : all_gather_arrays(grid.communicator(), places))
      for (std::size_t i = 0; i < of_rank.size(); i += 2)
        corners.find_or_add(Point<2>(of_rank[i], of_rank[i + 1]));
    return corners;
  }



  void
  DomainFlips::collect()
  {
    const PointLayout                          &l = points.layout();
    std::vector<Particles::ParticleIterator<2>> particles;
    std::vector<PointDomain<2>>                 flowing;
    auto particle = points.handler().begin();
    for (const PointDomain<2> &domain : point_domains(points))
      {
        if (is_flowing<2>(particle->get_properties().data(), l, materials))
          {
            particles.push_back(particle);
            flowing.push_back(domain);
          }
        ++particle;
      }
    PlaceTable<2> corners = corners_of_poor(flowing);
    if (corners.size() == 0)
      return;
    std::vector<double> values;
    for (unsigned int i = 0; i < flowing.size(); ++i)
      {
        const auto &places = flowing[i].current;
        if (std::count_if(places.begin(), places.end(), [&](const auto &place) {
              return corners.find(place) != PlaceTable<2>::none;
            }) < 2)
          continue;
        own.push_back(particles[i]);
        for (const Point<2> &corner : places)
          values.insert(values.end(), {corner[0], corner[1]});
        values.push_back(points.body_of(*particles[i]));
        values.push_back(flowing[i].outer_faces);
        const auto properties = particles[i]->get_properties();
        values.insert(values.end(), properties.begin(), properties.end());
      }
    const auto of_ranks = all_gather_arrays(grid.communicator(), values);
    for (unsigned int rank = 0; rank < of_ranks.size(); ++rank)
      {
        if (rank == Utilities::MPI::this_mpi_process(grid.communicator()))
          first_own = triangles.size();
        add_triangles(of_ranks[rank], corners);
      }
  }



  void
  DomainFlips::add_triangles(const std::vector<double> &values,
                             PlaceTable<2>             &corners)
  {
    const unsigned int n_properties = points.layout().n_properties;
    for (const double *value = values.data();
         value != values.data() + values.size();)
      {
        Triangle triangle;
        for (unsigned int c = 0; c < 3; ++c, value += 2)
          {
            triangle.corners[c] = Point<2>(value[0], value[1]);
            triangle.number[c]  = corners.find_or_add(triangle.corners[c]);
          }
        triangle.body        = static_cast<unsigned int>(*value++);
        triangle.outer_faces = static_cast<unsigned int>(*value++);
        triangle.properties.assign(value, value + n_properties);
        value += n_properties;
        const PointLayout &l = points.layout();
        triangle.places.fill(centroid<2>(triangle.corners));
        const auto from_point =
          corners_at_start<2>(triangle.properties.data(), l);
        for (unsigned int c = 0; c < 3; ++c)
          for (unsigned int d = 0; d < 2; ++d)
            triangle.places[c][d] +=
              from_point[c][d] - triangle.properties[l.displacement + d];
        triangles.push_back(triangle);
        link(triangles.size() - 1, true);
      }
  }



  void
  DomainFlips::link(const unsigned int triangle, const bool is_there)
  {
    AssertIndexRange(triangle, triangles.size());
    for (unsigned int c = 0; c < 3; ++c)
      {
        auto &side = sides[edge(triangles[triangle], c)];
        if (is_there)
          side.insert(triangle);
        else
          side.erase(triangle);
      }
  }



  bool
  DomainFlips::find_partner(const unsigned int triangle, Pairs &best) const
  {
    const PointLayout &l        = points.layout();
    const Triangle    &first    = triangles[triangle];
    double             smallest = quality(first.corners);
    bool               is_found = false;
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto &side = sides.at(edge(first, c));
        if (side.size() != 2)
          continue;
        const unsigned int other =
          *side.begin() == triangle ? *side.rbegin() : *side.begin();
        const Triangle &second = triangles[other];
        if (first.properties[l.material] != second.properties[l.material])
          continue;
        const auto place_in = [](const Triangle    &in,
                                 const unsigned int number) {
          return static_cast<unsigned int>(
            std::find(in.number.begin(), in.number.end(), number) -
            in.number.begin());
        };
        Pair pair{triangle, c, (c + 1) % 3, (c + 2) % 3};
        Pair partner{other,
                     0,
                     place_in(second, first.number[pair.lost]),
                     place_in(second, first.number[pair.kept])};
        partner.apex       = 3 - partner.kept - partner.lost;
        const Point<2> &o  = first.corners[pair.apex],
                       &a  = first.corners[pair.kept],
                       &b  = first.corners[pair.lost],
                       &p  = second.corners[partner.apex];
        const double worse = std::min(quality(o, a, p), quality(o, p, b));
        // both on the same side of the new diagonal as before
        if (!(worse > smallest && area(o, a, p) * area(o, a, b) > 0 &&
              area(o, p, b) * area(o, a, b) > 0))
          continue;
        const auto has_face = [](const Triangle    &of,
                                 const unsigned int opposite) {
          return (of.outer_faces >> opposite & flags_of_face) != 0;
        };
        if ((has_face(first, pair.lost) && has_face(second, partner.kept)) ||
            (has_face(first, pair.kept) && has_face(second, partner.lost)))
          continue;
        // a face that stays the one opposite to a corner of the same point is
        // remembered by what acts on it
        if ((first.outer_faces >> pair.kept |
             second.outer_faces >> partner.kept) &
            flags_of_face)
          {
            std::swap(pair.kept, pair.lost);
            std::swap(partner.kept, partner.lost);
          }
        smallest = worse;
        best     = {{pair, partner}};
        is_found = true;
      }
    return is_found;
  }



  void
  DomainFlips::flip(const Pairs &pairs)
  {
    for (const Pair &pair : pairs)
      link(pair.triangle, false);
    const std::array<Triangle, 2> old = {
      {triangles[pairs[0].triangle], triangles[pairs[1].triangle]}};
    for (unsigned int i = 0; i < 2; ++i)
      {
        const Pair     &pair = pairs[i], &partner = pairs[1 - i];
        const Triangle &other       = old[1 - i];
        Triangle       &triangle    = triangles[pair.triangle];
        triangle.corners[pair.lost] = other.corners[partner.apex];
        triangle.number[pair.lost]  = other.number[partner.apex];
        triangle.places[pair.lost]  = other.places[partner.apex];
        triangle.is_changed         = true;
        // opposite to what was lost: as before; to the apex: what the other
        // had; to the end that is kept: between the two
        triangle.outer_faces =
          (old[i].outer_faces & (flags_of_face << pair.lost)) |
          ((other.outer_faces >> partner.kept & flags_of_face) << pair.apex);
        if (triangle.outer_faces >> pair.apex & flags_of_face)
          triangle.places[pair.kept] = other.places[partner.lost];
        set_state({{old[i], other}}, {{pair, partner}}, triangle);
      }
    for (const Pair &pair : pairs)
      link(pair.triangle, true);
  }



  void
  DomainFlips::set_state(const std::array<Triangle, 2> &old,
                         const Pairs                   &pairs,
                         Triangle                      &triangle) const
  {
    const PointLayout    &l   = points.layout();
    const Point<2>       &end = old[0].corners[pairs[0].kept];
    std::array<double, 2> of_old;
    for (unsigned int i = 0; i < 2; ++i)
      of_old[i] =
        std::abs(area(old[i].corners[0], old[i].corners[1], old[i].corners[2]));
    const Point<2> &o = old[0].corners[pairs[0].apex],
                   &p = old[1].corners[pairs[1].apex];
    // where the diagonals cross
    const Point<2> middle = o + of_old[0] / (of_old[0] + of_old[1]) * (p - o);
    std::array<std::vector<double>, 2> part;
    std::array<double, 2>              of_part;
    double                             ring = 0; // V_0 R
    for (unsigned int i = 0; i < 2; ++i)
      {
        const PointDomain<2>::Corners corners = {
          {old[i].corners[pairs[i].apex], end, middle}};
        const Point<2> centre = centroid<2>(corners);
        of_part[i] = std::abs(area(corners[0], corners[1], corners[2]));
        part[i]    = old[i].properties;
        take_part(centroid<2>(old[i].corners),
                  centre,
                  of_part[i] / of_old[i],
                  l,
                  part[i]);
        if (l.axisymmetric)
          ring += part[i][l.volume] * centre[0] / part[i][l.history];
      }
    const unsigned int larger = of_part[1] > of_part[0] ? 1 : 0;
    Tensor<2, 2>       F      = deformation_gradient<2>(part[larger].data(), l);
    const double       V_0    = part[0][l.volume] + part[1][l.volume];
    F *= std::sqrt((of_part[0] + of_part[1]) / V_0 / determinant(F));
    mean_state<2>(
      part[0].data(), part[1].data(), F, l, materials, triangle.properties);
    if (l.axisymmetric)
      triangle.properties[l.history] =
        centroid<2>(triangle.corners)[0] * V_0 / ring;
  }



  void
  DomainFlips::place_outer_face(const Triangle &triangle,
                                PointDomain<2> &domain)
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (triangle.outer_faces >> c & flags_of_face)
        {
          auto              &R = domain.reference;
          const unsigned int a = (c + 1) % 3, b = (c + 2) % 3;
          const double       area_R = area(R[a], R[b], R[c]);
          const Tensor<1, 2> face   = triangle.corners[b] - triangle.corners[a],
                             was    = triangle.places[b] - triangle.places[a];
          const double along = (triangle.corners[c] - triangle.corners[a]) *
                               face / face.norm_square();
          R[a] = triangle.places[a];
          R[b] = triangle.places[b];
          // cross_product_2d() turns clockwise
          R[c] = R[a] + along * was -
                 2 * area_R / was.norm_square() * cross_product_2d(was);
          return;
        }
  }



  void
  DomainFlips::store() const
  {
    const PointLayout &l = points.layout();
    for (unsigned int i = 0; i < own.size(); ++i)
      {
        const Triangle &triangle = triangles[first_own + i];
        if (!triangle.is_changed)
          continue;
        auto               particle = own[i];
        const auto         values   = particle->get_properties();
        const Tensor<2, 2> inverse =
          invert(deformation_gradient<2>(triangle.properties.data(), l)) /
          domain_stretch<2>(triangle.properties.data(), l);
        PointDomain<2> domain;
        domain.location    = centroid<2>(triangle.corners);
        domain.outer_faces = triangle.outer_faces;
        if (l.with_ancestry)
          domain.ancestry = values[l.ancestry];
        for (unsigned int c = 0; c < 3; ++c)
          {
            domain.reference[c] =
              domain.location +
              inverse * (triangle.corners[c] - domain.location);
            for (unsigned int d = 0; d < 2; ++d)
              domain.reference[c][d] -= triangle.properties[l.displacement + d];
          }
        place_outer_face(triangle, domain);
        std::copy(triangle.properties.begin(),
                  triangle.properties.end(),
                  values.begin());
        store_domain<2>(domain, l, values);
        const Tensor<2, 2> F = edge_matrix<2>(triangle.corners) *
                               invert(edge_matrix<2>(domain.reference)) /
                               domain_stretch<2>(triangle.properties.data(), l);
        for (unsigned int i = 0; i < 2; ++i)
          for (unsigned int j = 0; j < 2; ++j)
            values[l.F + i * 2 + j] = F[i][j];
        particle->set_location(domain.location);
      }
  }



  unsigned int
  DomainFlips::flip()
  {
    collect();
    std::set<std::pair<double, unsigned int>> queue;
    const auto                                add = [&](const unsigned int i) {
      const double q = quality(triangles[i].corners);
      if (q < poor)
        queue.emplace(q, i);
    };
    for (unsigned int i = 0; i < triangles.size(); ++i)
      add(i);
    unsigned int n_flips = 0;
    while (!queue.empty())
      {
        // each flip makes the worst of two better, so that this ends
        const auto [q, i] = *queue.begin();
        queue.erase(queue.begin());
        Pairs pairs;
        if (q != quality(triangles[i].corners) || !find_partner(i, pairs))
          continue;
        flip(pairs);
        ++n_flips;
        for (const Pair &pair : pairs)
          add(pair.triangle);
      }
    store();
    return n_flips;
  }



  template bool
  is_flowing<2>(const double *,
                const PointLayout &,
                const std::vector<std::unique_ptr<MaterialModel<2>>> &);
  template bool
  is_flowing<3>(const double *,
                const PointLayout &,
                const std::vector<std::unique_ptr<MaterialModel<3>>> &);
} // namespace isochor
