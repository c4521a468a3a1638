/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/material_points/point_domain.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  namespace
  {
    /** One more than there are pairs of corners. */
    template <int dim>
    constexpr double base = dim *(dim + 1) + 1;
    /** Base to this power is less than 2^53. */
    template <int dim>
    constexpr unsigned int n_digits = (dim == 2 ? 18 : 14);
  } // namespace



  template <int dim>
  CornerVectors<dim>
  corners_at_start(const double *properties, const PointLayout &l)
  {
    CornerVectors<dim> corners;
    for (unsigned int c = 0; c < dim; ++c)
      for (unsigned int d = 0; d < dim; ++d)
        {
          corners[c + 1][d] = properties[l.domain + c * dim + d];
          corners[0][d] -= corners[c + 1][d];
        }
    return corners;
  }



  template <int dim>
  std::vector<PointDomain<dim>>
  point_domains(const MaterialPoints<dim> &points)
  {
    const PointLayout            &l = points.layout();
    std::vector<PointDomain<dim>> domains;
    domains.reserve(points.handler().n_locally_owned_particles());
    for (const auto &particle : points.handler())
      {
        const auto           values = particle.get_properties();
        const Tensor<2, dim> F = deformation_gradient<dim>(values.data(), l);
        const double         stretch = domain_stretch<dim>(values.data(), l);
        const CornerVectors<dim> corners =
          corners_at_start<dim>(values.data(), l);
        domains.emplace_back();
        PointDomain<dim> &domain = domains.back();
        domain.location          = particle.get_location();
        Point<dim> reference     = domain.location;
        for (unsigned int d = 0; d < dim; ++d)
          reference[d] -= values[l.displacement + d];
        for (unsigned int c = 0; c <= dim; ++c)
          {
            domain.reference[c] = reference + corners[c];
            domain.current[c]   = domain.location + F * (stretch * corners[c]);
          }
        domain.volume = values[l.volume] * determinant(F);
        domain.cell   = particle.get_surrounding_cell()->active_cell_index();
        domain.point  = domains.size() - 1;
        if (l.with_ancestry)
          domain.ancestry = values[l.ancestry];
        if (l.with_surface)
          domain.outer_faces = values[l.outer_faces];
      }
    return domains;
  }



  template <int dim>
  void
  store_domain(const PointDomain<dim>  &domain,
               const PointLayout       &l,
               const ArrayView<double> &properties)
  {
    const Point<dim> reference = centroid<dim>(domain.reference);
    for (unsigned int d = 0; d < dim; ++d)
      {
        properties[l.displacement + d] = domain.location[d] - reference[d];
        for (unsigned int c = 0; c < dim; ++c)
          properties[l.domain + c * dim + d] =
            domain.reference[c + 1][d] - reference[d];
      }
    if (l.with_ancestry)
      properties[l.ancestry] = domain.ancestry;
    if (l.with_surface)
      properties[l.outer_faces] = domain.outer_faces;
  }



  template <int dim>
  bool
  move_domain(const Point<dim>  &from,
              const double       volume_before,
              const Point<dim>  &centre,
              const double       volume,
              const PointLayout &l,
              double            *properties)
  {
    const double V_0     = properties[l.volume],
                 r       = l.axisymmetric ? from[0] / centre[0] : 1.,
                 density = l.axisymmetric ? properties[l.history] : 1.,
                 filled  = r * V_0 + density * (volume - r * volume_before);
    if (!(filled > 0))
      return false;
    properties[l.volume] = filled;
    properties[l.mass] *= filled / (r * V_0);
    properties[l.volume_gain] =
      filled / V_0 * (1 + properties[l.volume_gain]) - 1;
    for (unsigned int d = 0; d < dim; ++d)
      properties[l.displacement + d] += centre[d] - from[d];
    return true;
  }



  template <int dim>
  Point<dim>
  centroid(const typename PointDomain<dim>::Corners &corners)
  {
    Tensor<1, dim> from_first;
    for (const Point<dim> &corner : corners)
      from_first += (corner - corners[0]) / (dim + 1.);
    return corners[0] + from_first;
  }



  template <int dim>
  double
  length_in_cells(const typename PointDomain<dim>::Corners &corners,
                  const SimplexGeometry<dim>               &geometry,
                  const unsigned int                        cell)
  {
    const auto extent = [&](const unsigned int of, const Tensor<1, dim> &edge) {
      double first = std::numeric_limits<double>::max(),
             last  = std::numeric_limits<double>::lowest();
      for (const unsigned int v : geometry.vertex_indices(of))
        {
          const double place = geometry.vertices()[v] * edge;
          first              = std::min(first, place);
          last               = std::max(last, place);
        }
      return last - first; // times the edge's length
    };
    double longest = 0;
    for (unsigned int c = 0; c <= dim; ++c)
      for (unsigned int d = 0; d < c; ++d)
        {
          const Tensor<1, dim> edge  = corners[c] - corners[d];
          double               cells = extent(cell, edge);
          // simplices of a mesh with other diagonals may be thin there
          if (edge.norm_square() > cells)
            for (const unsigned int other : geometry.neighbours(cell))
              if (other != SimplexGeometry<dim>::no_cell)
                cells = std::max(cells, extent(other, edge));
          longest = std::max(longest, edge.norm_square() / cells);
        }
    return longest;
  }



  template <int dim>
  PlaceScale<dim>
  scale_of_places(const BackgroundGrid<dim> &grid)
  {
    const SimplexGeometry<dim> &geometry = grid.geometry();
    Point<dim> lower = geometry.vertices().front(), upper = lower;
    double     farthest = 0, extent = 0;
    for (const Point<dim> &vertex : geometry.vertices())
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], vertex[d]);
          upper[d] = std::max(upper[d], vertex[d]);
          farthest = std::max(farthest, std::abs(vertex[d]));
        }
    for (unsigned int d = 0; d < dim; ++d)
      extent = std::max(extent, upper[d] - lower[d]);
    double smallest = std::pow(extent, dim);
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      smallest = std::min(smallest, geometry.measure(cell));
    const double size = std::pow(smallest, 1. / dim);

    // places are sums of a few coordinates, over many steps
    const double rounding =
      1e4 * std::numeric_limits<double>::epsilon() * farthest;
    AssertThrow(rounding < 1e-3 * size,
                ExcMessage(
                  "The grid is too far from the origin for its "
                  "cells: they are " +
                  rounded(size) + " m long, coordinates up to " +
                  rounded(farthest) +
                  " m, of which 16 digits are known. That is too "
                  "little to split domains of points and to merge "
                  "them. Move the scene towards the origin (<Grid/"
                  "Lower corner>, <Grid/Upper corner>, or the mesh)."));
    return {lower, std::max(rounding, std::min(1e-8 * extent, 1e-4 * size))};
  }



  template <int dim>
  double
  Ancestry<dim>::of_part(const double       whole,
                         const unsigned int kept,
                         const unsigned int lost)
  {
    const double digit = 1 + kept * dim + (lost < kept ? lost : lost - 1);
    return std::fmod(whole, std::pow(base<dim>, n_digits<dim> - 1)) *
             base<dim> +
           digit;
  }



  template <int dim>
  std::pair<unsigned int, unsigned int>
  Ancestry<dim>::last(const double part)
  {
    const unsigned int pair = std::fmod(part, base<dim>) - 0.5;
    const unsigned int kept = pair / dim, lost = pair % dim;
    return {kept, lost < kept ? lost : lost + 1};
  }



  template <int dim>
  double
  Ancestry<dim>::of_whole(const double part)
  {
    return std::floor(part / base<dim>);
  }



  template struct Ancestry<2>;
  template CornerVectors<2>
  corners_at_start<2>(const double *, const PointLayout &);
  template CornerVectors<3>
  corners_at_start<3>(const double *, const PointLayout &);
  template std::vector<PointDomain<2>>
  point_domains(const MaterialPoints<2> &);
  template void
  store_domain(const PointDomain<2> &,
               const PointLayout &,
               const ArrayView<double> &);
  template bool
  move_domain<2>(const Point<2> &,
                 const double,
                 const Point<2> &,
                 const double,
                 const PointLayout &,
                 double *);
  template Point<2>
  centroid<2>(const typename PointDomain<2>::Corners &);
  template double
  length_in_cells<2>(const typename PointDomain<2>::Corners &,
                     const SimplexGeometry<2> &,
                     const unsigned int);
  template PlaceScale<2>
  scale_of_places(const BackgroundGrid<2> &);
  template struct Ancestry<3>;
  template std::vector<PointDomain<3>>
  point_domains(const MaterialPoints<3> &);
  template void
  store_domain(const PointDomain<3> &,
               const PointLayout &,
               const ArrayView<double> &);
  template bool
  move_domain<3>(const Point<3> &,
                 const double,
                 const Point<3> &,
                 const double,
                 const PointLayout &,
                 double *);
  template Point<3>
  centroid<3>(const typename PointDomain<3>::Corners &);
  template double
  length_in_cells<3>(const typename PointDomain<3>::Corners &,
                     const SimplexGeometry<3> &,
                     const unsigned int);
  template PlaceScale<3>
  scale_of_places(const BackgroundGrid<3> &);
} // namespace isochor
