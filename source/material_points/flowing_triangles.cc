/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/flowing_triangles.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace isochor
{
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



  bool
  FlowingTriangles::Triangle::has_face(const unsigned int opposite) const
  {
    AssertIndexRange(opposite, 3);
    return (outer_faces >> opposite & flags_of_face) != 0;
  }



  unsigned int
  FlowingTriangles::Triangle::place_of(const unsigned int corner) const
  {
    return std::find(number.begin(), number.end(), corner) - number.begin();
  }



  typename FlowingTriangles::Edge
  FlowingTriangles::edge(const Triangle &triangle, const unsigned int opposite)
  {
    AssertIndexRange(opposite, 3);
    const auto [a, b] = std::minmax(triangle.number[(opposite + 1) % 3],
                                    triangle.number[(opposite + 2) % 3]);
    return {{triangle.body, a, b}};
  }



  Tensor<2, 2>
  FlowingTriangles::to_unit(const unsigned int cell) const
  {
    const auto  &geometry = grid.geometry();
    Tensor<2, 2> map;
    for (unsigned int d = 0; d < 2; ++d)
      {
        const auto [least, most] =
          std::minmax_element(geometry.vertex_indices(cell).begin(),
                              geometry.vertex_indices(cell).end(),
                              [&](const unsigned int a, const unsigned int b) {
                                return geometry.vertices()[a][d] <
                                       geometry.vertices()[b][d];
                              });
        map[d][d] =
          1 / (geometry.vertices()[*most][d] - geometry.vertices()[*least][d]);
      }
    return map;
  }



  bool
  FlowingTriangles::is_poor(const PointDomain<2>::Corners &corners,
                            const Tensor<2, 2>            &to_unit)
  {
    return quality(corners) < poor &&
           quality(map_corners(to_unit, corners)) < poor;
  }



  PlaceTable<2>
  FlowingTriangles::corners_of_poor(
    const std::vector<PointDomain<2>> &flowing) const
  {
    std::vector<double> places;
    for (const PointDomain<2> &domain : flowing)
      if (is_poor(domain.current, to_unit(domain.cell)))
        for (const Point<2> &corner : domain.current)
          places.insert(places.end(), {corner[0], corner[1]});
    PlaceTable<2> corners(scale_of_places(grid));
    for (const auto &of_rank : all_gather_arrays(grid.communicator(), places))
      for (std::size_t i = 0; i < of_rank.size(); i += 2)
        corners.find_or_add(Point<2>(of_rank[i], of_rank[i + 1]));
    return corners;
  }



  FlowingTriangles::FlowingTriangles(MaterialPoints<2>       &points,
                                     const BackgroundGrid<2> &grid,
                                     const Materials         &materials)
    : points(points)
    , grid(grid)
    , materials(materials)
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
        if (std::none_of(places.begin(), places.end(), [&](const auto &place) {
              return corners.find(place) != PlaceTable<2>::none;
            }))
          continue;
        own.push_back(particles[i]);
        for (const Point<2> &corner : places)
          values.insert(values.end(), {corner[0], corner[1]});
        values.push_back(points.body_of(*particles[i]));
        values.push_back(flowing[i].outer_faces);
        const Tensor<2, 2> map = to_unit(flowing[i].cell);
        values.insert(values.end(), map.begin_raw(), map.end_raw());
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
  FlowingTriangles::add_triangles(const std::vector<double> &values,
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
        std::copy(value, value + 4, triangle.to_unit.begin_raw());
        value += 4;
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



  double
  FlowingTriangles::radius_at_start(const Triangle &triangle) const
  {
    return layout().axisymmetric ? centroid<2>(triangle.corners)[0] /
                                     triangle.properties[layout().history] :
                                   1.;
  }



  void
  FlowingTriangles::fill(const double J, Triangle &triangle) const
  {
    const PointLayout &l      = layout();
    double            *values = triangle.properties.data();
    Tensor<2, 2>       F      = deformation_gradient<2>(values, l);
    const double       J_now =
      std::abs(
        area(triangle.corners[0], triangle.corners[1], triangle.corners[2])) /
      values[l.volume];
    F *= std::sqrt(J_now / determinant(F));
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        values[l.F + i * 2 + j] = F[i][j];
    materials[static_cast<unsigned int>(values[l.material])]
      ->scale_elastic_volume(J_now / J, &values[l.history]);
  }



  void
  FlowingTriangles::link(const unsigned int triangle, const bool is_there)
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



  void
  FlowingTriangles::place_outer_face(const Triangle &triangle,
                                     PointDomain<2> &domain)
  {
    for (unsigned int c = 0; c < 3; ++c)
      if (triangle.has_face(c))
        {
          auto              &R = domain.reference;
          const unsigned int a = (c + 1) % 3, b = (c + 2) % 3;
          const double       area_R = area(R[a], R[b], R[c]);
          const Tensor<1, 2> face   = triangle.corners[b] - triangle.corners[a];
          Tensor<1, 2>       was    = triangle.places[b] - triangle.places[a];
          const Point<2>     middle = triangle.places[a] + was / 2;
          was *= std::max(1., face.norm() / (largest_stretch * was.norm()));
          const double along = (triangle.corners[c] - triangle.corners[a]) *
                               face / face.norm_square();
          R[a] = middle - was / 2;
          R[b] = middle + was / 2;
          // cross_product_2d() turns clockwise
          R[c] = R[a] + along * was -
                 2 * area_R / was.norm_square() * cross_product_2d(was);
          return;
        }
  }



  void
  FlowingTriangles::store()
  {
    const PointLayout                          &l = points.layout();
    std::vector<Particles::ParticleIterator<2>> vanishing;
    for (unsigned int i = 0; i < own.size(); ++i)
      {
        const Triangle &triangle = triangles[first_own + i];
        if (triangle.is_gone)
          vanishing.push_back(own[i]);
        if (triangle.is_gone || !triangle.is_changed)
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
    points.handler().remove_particles(vanishing); // collective
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
