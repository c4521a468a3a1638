/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/grid/cells_near_ranks.h>
#include <isochor/material_points/domain_relaxation.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  DomainRelaxation<dim>::DomainRelaxation(MaterialPoints<dim>       &points,
                                          const BackgroundGrid<dim> &grid,
                                          const Materials           &materials)
    : points(points)
    , grid(grid)
    , materials(materials)
  {}



  template <int dim>
  double
  DomainRelaxation<dim>::volume(
    const typename PointDomain<dim>::Corners &corners)
  {
    Tensor<2, dim> edges;
    for (unsigned int c = 0; c < dim; ++c)
      edges[c] = corners[c + 1] - corners[0];
    return std::abs(determinant(edges)) / (dim == 2 ? 2 : 6);
  }



  template <int dim>
  Tensor<1, dim>
  DomainRelaxation<dim>::gradient(
    const typename PointDomain<dim>::Corners &corners,
    const unsigned int                        c)
  {
    AssertIndexRange(c, dim + 1);
    std::array<Point<dim>, dim> face;
    for (unsigned int other = 0, i = 0; other <= dim; ++other)
      if (other != c)
        face[i++] = corners[other];
    Tensor<1, dim> area;
    if constexpr (dim == 2)
      area = cross_product_2d(face[1] - face[0]);
    else
      area = cross_product_3d(face[1] - face[0], face[2] - face[0]) / 2;
    return (area * (corners[c] - face[0]) > 0 ? 1. : -1.) / dim * area;
  }



  template <int dim>
  bool
  DomainRelaxation<dim>::is_needed() const
  {
    const PointLayout &l = points.layout();
    if (!l.mixed() || !l.with_domains || !l.with_surface)
      return false;
    double largest = 0;
    for (const auto &particle : points.handler())
      largest =
        std::max(largest, std::abs(particle.get_properties()[l.volume_gain]));
    return Utilities::MPI::max(largest, grid.communicator()) > 0;
  }



  template <int dim>
  unsigned int
  DomainRelaxation<dim>::find_vertex(const Point<dim>  &place,
                                     const unsigned int body)
  {
    while (tables.size() <= body)
      {
        tables.emplace_back(scale_of_places(grid));
        numbers.emplace_back();
      }
    const unsigned int n = tables[body].find_or_add(place);
    if (n == numbers[body].size())
      {
        numbers[body].push_back(vertices.size());
        vertices.emplace_back();
        vertices.back().place = place;
        vertices.back().body  = body;
      }
    return numbers[body][n];
  }



  template <int dim>
  void
  DomainRelaxation<dim>::find_domains()
  {
    const PointLayout               &l = points.layout();
    const std::vector<unsigned char> is_near =
      cells_near_other_ranks(grid.geometry(), grid.communicator());
    const auto all      = point_domains(points);
    auto       particle = points.handler().begin();
    domains.reserve(all.size());
    for (const PointDomain<dim> &of_point : all)
      {
        const auto values = particle->get_properties();
        Domain     domain;
        domain.corners  = of_point.current;
        domain.volume   = volume(domain.corners);
        domain.filled   = values[l.volume];
        domain.at_start = domain.filled / (1 + values[l.volume_gain]);
        domain.density  = l.axisymmetric ? values[l.history] : 1.;
        domain.particle = particle;
        const bool is_held =
          !materials[static_cast<unsigned int>(values[l.material])]
             ->dissipates();
        for (unsigned int c = 0; c <= dim; ++c)
          {
            domain.vertex[c] =
              find_vertex(of_point.current[c], points.body_of(*particle));
            Vertex &vertex   = vertices[domain.vertex[c]];
            vertex.is_shared = vertex.is_shared || is_near[of_point.cell];
            vertex.is_held   = vertex.is_held || is_held;
          }
        for (unsigned int c = 0; c <= dim; ++c)
          if ((of_point.outer_faces >> c) & 1)
            for (unsigned int other = 0; other <= dim; ++other)
              if (other != c)
                vertices[domain.vertex[other]].is_held = true;
        domains.push_back(domain);
        ++particle;
      }
  }



  template <int dim>
  void
  DomainRelaxation<dim>::exchange(const bool of_parts)
  {
    const MPI_Comm     comm    = grid.communicator();
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(comm),
                       rank    = Utilities::MPI::this_mpi_process(comm);
    if (n_ranks == 1)
      return;
    std::vector<double> values;
    for (const Vertex &vertex : vertices)
      if (vertex.is_shared)
        {
          values.push_back(vertex.body);
          for (unsigned int d = 0; d < dim; ++d)
            values.push_back(vertex.place[d]);
          for (unsigned int d = 0; d < dim; ++d)
            values.push_back(vertex.move[d]);
          values.push_back(vertex.weight);
          values.push_back(vertex.part);
          values.push_back(vertex.is_held ? 1. : 0.);
        }
    const auto             of_ranks = all_gather_arrays(comm, values);
    constexpr unsigned int n        = 2 * dim + 4;
    for (unsigned int other = 0; other < n_ranks; ++other)
      for (std::size_t i = 0; other != rank && i < of_ranks[other].size();
           i += n)
        {
          const double      *entry = of_ranks[other].data() + i;
          const unsigned int body  = static_cast<unsigned int>(entry[0]);
          if (body >= tables.size())
            continue;
          Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = entry[1 + d];
          const unsigned int found = tables[body].find(place);
          if (found == PlaceTable<dim>::none)
            continue;
          Vertex &vertex = vertices[numbers[body][found]];
          if (of_parts)
            {
              vertex.part = std::min(vertex.part, entry[2 * dim + 2]);
              continue;
            }
          for (unsigned int d = 0; d < dim; ++d)
            vertex.move[d] += entry[1 + dim + d];
          vertex.weight += entry[2 * dim + 1];
          vertex.is_held = vertex.is_held || entry[2 * dim + 3] > 0;
        }
  }



  template <int dim>
  void
  DomainRelaxation<dim>::pass()
  {
    // dim + 1 corners move at once
    constexpr double damping = 1.5 / (dim + 1), most = 0.5 / (dim + 1);
    for (Vertex &vertex : vertices)
      {
        vertex.move   = Tensor<1, dim>();
        vertex.weight = 0;
        vertex.part   = 1;
      }
    for (const Domain &domain : domains)
      {
        const double error =
          (domain.filled +
           domain.density * (volume(domain.corners) - domain.volume)) /
            domain.at_start -
          1;
        for (unsigned int c = 0; c <= dim; ++c)
          {
            const Tensor<1, dim> g =
              gradient(domain.corners, c) / domain.at_start;
            Vertex &vertex = vertices[domain.vertex[c]];
            vertex.move -= error * g;
            vertex.weight += g.norm_square();
          }
      }
    exchange(false);
    for (Vertex &vertex : vertices)
      vertex.move = vertex.is_held || vertex.weight == 0 ?
                      Tensor<1, dim>() :
                      damping / vertex.weight * vertex.move;
    for (const Domain &domain : domains)
      for (unsigned int c = 0; c <= dim; ++c)
        {
          Vertex      &vertex = vertices[domain.vertex[c]];
          const double change =
            std::abs(gradient(domain.corners, c) * vertex.move);
          if (change > most * volume(domain.corners))
            vertex.part =
              std::min(vertex.part, most * volume(domain.corners) / change);
        }
    exchange(true);
    for (Domain &domain : domains)
      for (unsigned int c = 0; c <= dim; ++c)
        {
          const Vertex &vertex = vertices[domain.vertex[c]];
          domain.corners[c] += vertex.part * vertex.move;
        }
  }



  template <int dim>
  void
  DomainRelaxation<dim>::relax()
  {
    if (!is_needed())
      return;
    find_domains();
    constexpr unsigned int n_passes = 2; // as many follow with each reset
    for (unsigned int i = 0; i < n_passes; ++i)
      pass();
    for (const Domain &domain : domains)
      if (volume(domain.corners) != domain.volume)
        store(domain);
  }



  template <int dim>
  void
  DomainRelaxation<dim>::store(const Domain &domain) const
  {
    const PointLayout   &l          = points.layout();
    auto                 particle   = domain.particle;
    const auto           properties = particle->get_properties();
    const Tensor<2, dim> F = deformation_gradient<dim>(properties.data(), l);
    const Point<dim>     centre = centroid<dim>(domain.corners);
    const CornerVectors<dim> label =
      corners_at_start<dim>(properties.data(), l);
    if (!move_domain(particle->get_location(),
                     domain.volume,
                     centre,
                     volume(domain.corners),
                     l,
                     properties.data()))
      return;
    const Tensor<2, dim> F_now = edge_matrix<dim>(domain.corners) *
                                 invert(edge_matrix<dim>(label)) /
                                 domain_stretch<dim>(properties.data(), l);
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        properties[l.F + i * dim + j] = F_now[i][j];
    particle->set_location(centre);
    materials[static_cast<unsigned int>(properties[l.material])]
      ->scale_elastic_volume(determinant(F_now) / determinant(F),
                             &properties[l.history]);
  }



  template class DomainRelaxation<2>;
  template class DomainRelaxation<3>;
} // namespace isochor
