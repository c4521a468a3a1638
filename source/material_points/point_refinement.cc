/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/material_points/point_refinement.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    /**
     * Where the new points of a split go, from the old one, in units of the
     * dim-th root of its volume: the corners of an equilateral triangle or
     * tetrahedron. At this distance the parts, as discs or balls around the
     * points, have the second moment of the whole: in 2D
     * 3/4 r² + V/4/(2π) = V/(2π), in 3D
     * 4/5 r² + 3/5 (V/5 3/(4π))^(2/3) = 3/5 (V 3/(4π))^(2/3).
     */
    template <int dim>
    std::array<Tensor<1, dim>, dim + 1>
    places_of_parts()
    {
      std::array<Tensor<1, dim>, dim + 1> places;
      if constexpr (dim == 2)
        for (unsigned int i = 0; i < 3; ++i)
          {
            const double angle = numbers::PI * (0.5 + 2. / 3 * i);
            const double r     = std::sqrt(0.5 / numbers::PI);
            places[i][0]       = r * std::cos(angle);
            places[i][1]       = r * std::sin(angle);
          }
      else
        for (unsigned int i = 0; i < 4; ++i)
          {
            const double r = std::sqrt(0.75 * (1 - std::pow(5., -2. / 3))) *
                             std::cbrt(0.75 / numbers::PI) / std::sqrt(3.);
            for (unsigned int d = 0; d < 3; ++d) // every other corner of a cube
              places[i][d] = ((i ^ (i << 1)) >> d) % 2 ? r : -r;
          }
      return places;
    }
  } // namespace



  template <int dim>
  void
  PointRefinement<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry("Split at share of cell",
                      "0",
                      Patterns::Double(0),
                      "Split points whose current volume is larger than this "
                      "share of the volume of the cell that they are in, into "
                      "4 (2D) or 5 (3D) equal parts; points with domains, of "
                      "the quadratures 'cell-filled + boundary' and 'CPDI', "
                      "into the 4 or 8 parts of the domain. 0: never; on an "
                      "adaptive grid 1.5 / 'Points per cell'.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  PointRefinement<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    largest_share         = prm.get_double("Split at share of cell");
    const double asked    = prm.get_integer("Points per cell");
    const double per_cell = asked > 0 ? asked : (1 << dim);
    prm.leave_subsection();
    // else parts of new parts would be split at once
    AssertThrow(largest_share == 0 || largest_share >= 0.1,
                ExcMessage("<Material points/Split at share of cell> must be 0 "
                           "or at least 0.1: more than ten points per cell are "
                           "a matter of seeding."));
    // no point of the rules for seeding is split in its own cell, all are
    // where cells have been halved
    share_on_adaptive_grids =
      largest_share > 0 ? largest_share : 1.5 / per_cell;
  }



  template <int dim>
  void
  PointRefinement<dim>::refine(MaterialPoints<dim>       &points,
                               const BackgroundGrid<dim> &grid,
                               const PointLocator<dim>   &locator) const
  {
    const double share =
      grid.is_adaptive() ? share_on_adaptive_grids : largest_share;
    if (share == 0)
      return;
    // parts may still be too large; bounded, since each round divides by four
    for (unsigned int round = 0; round < 8; ++round)
      {
        const std::vector<NewPoint> parts = split(points, locator, share);
        if (Utilities::MPI::sum(parts.size(), grid.communicator()) == 0)
          return;
        insert(points, grid, parts);
        points.relocate(locator);
      }
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::Part>
  PointRefinement<dim>::parts_of_domain(const CornerVectors<dim> &given,
                                        const Tensor<2, dim>     &F)
  {
    CornerVectors<dim> domain = given;
    order_for_subdivision<dim>(domain);
    // corners and middles of edges, by pairs of corners
    using Pair = std::pair<unsigned int, unsigned int>;
    std::vector<std::array<Pair, dim + 1>> simplices;
    for (unsigned int c = 0; c <= dim; ++c)
      {
        simplices.emplace_back();
        for (unsigned int e = 0; e <= dim; ++e)
          simplices.back()[e] = {c, e};
      }
    if constexpr (dim == 2)
      simplices.push_back({{{0, 1}, {1, 2}, {0, 2}}});
    else
      {
        simplices.push_back({{{0, 1}, {0, 2}, {0, 3}, {1, 3}}});
        simplices.push_back({{{0, 1}, {0, 2}, {1, 2}, {1, 3}}});
        simplices.push_back({{{0, 2}, {0, 3}, {1, 3}, {2, 3}}});
        simplices.push_back({{{0, 2}, {1, 2}, {1, 3}, {2, 3}}});
      }
    // the point itself gets the part in the middle, in 3D one of those
    std::swap(simplices.front(), simplices[dim + 1]);

    std::vector<Part> parts;
    for (const auto &simplex : simplices)
      {
        Part           part;
        Tensor<1, dim> centre;
        for (unsigned int c = 0; c <= dim; ++c)
          {
            part.domain[c] =
              (domain[simplex[c].first] + domain[simplex[c].second]) / 2.;
            centre += part.domain[c] / (dim + 1.);
          }
        for (Tensor<1, dim> &corner : part.domain)
          corner -= centre;
        part.shift = F * centre;
        parts.push_back(part);
      }
    return parts;
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::Part>
  PointRefinement<dim>::parts_around(const double volume)
  {
    static const auto places = places_of_parts<dim>();
    std::vector<Part> parts(1);
    for (const Tensor<1, dim> &place : places)
      parts.push_back({std::pow(volume, 1. / dim) * place, {}});
    return parts;
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split(MaterialPoints<dim>     &points,
                              const PointLocator<dim> &locator,
                              const double             share) const
  {
    const PointLayout    &l = points.layout();
    std::vector<NewPoint> parts;
    for (auto &particle : points.handler())
      {
        const unsigned int cell =
          particle.get_surrounding_cell()->active_cell_index();
        const ArrayView<double> values = particle.get_properties();
        const Tensor<2, dim>    F = deformation_gradient<dim>(values.data(), l);
        const double            volume = values[l.volume] * determinant(F);
        if (!(volume > share * locator.geometry().measure(cell)))
          continue;

        CornerVectors<dim> domain;
        for (unsigned int c = 0; c < dim && l.with_domains; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            {
              domain[c + 1][d] = values[l.domain + c * dim + d];
              domain[0][d] -= domain[c + 1][d];
            }
        std::vector<Part> places =
          l.with_domains ? parts_of_domain(domain, F) : parts_around(volume);
        // beside a wall they come closer
        const Point<dim> x       = particle.get_location();
        const auto       outside = [&](const Part &part) {
          return !locator.locate(x + part.shift, cell).found;
        };
        for (unsigned int i = 0;
             i < 20 && std::any_of(places.begin(), places.end(), outside);
             ++i)
          for (Part &part : places)
            part.shift *= 0.75;

        const Tensor<2, dim>      inverse = invert(F);
        const std::vector<double> old(values.begin(), values.end());
        for (unsigned int i = 0; i < places.size(); ++i)
          {
            // they move with the point's F, so that X = x - u is affine
            const Tensor<1, dim> &shift = places[i].shift;
            const Tensor<1, dim>  u     = shift - inverse * shift;
            std::vector<double>   part  = old;
            part[l.volume] /= places.size();
            part[l.mass] /= places.size();
            for (unsigned int d = 0; d < dim; ++d)
              part[l.displacement + d] += u[d];
            for (unsigned int c = 0; c < dim && l.with_domains; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                part[l.domain + c * dim + d] = places[i].domain[c + 1][d];
            if (i > 0)
              {
                parts.push_back({cell, x + shift, part});
                continue;
              }
            std::copy(part.begin(), part.end(), values.begin());
            particle.set_location(x + shift);
          }
      }
    return parts;
  }



  template <int dim>
  void
  PointRefinement<dim>::insert(MaterialPoints<dim>         &points,
                               const BackgroundGrid<dim>   &grid,
                               const std::vector<NewPoint> &parts) const
  {
    types::particle_index id =
      points.handler().get_next_free_particle_index() +
      exclusive_and_total_sum(parts.size(), grid.communicator()).first;

    // into the cell of the old point; the place may be in another one
    for (const NewPoint &part : parts)
      {
        std::vector<double> properties = part.properties;
        points.handler().insert_particle(
          part.location,
          SimplexGeometry<dim>::reference_location(
            grid.geometry().barycentric(part.cell, part.location)),
          id++,
          grid.geometry().cell_iterator(part.cell),
          make_array_view(properties));
      }
    points.handler().update_cached_numbers();
  }



  template class PointRefinement<2>;
  template class PointRefinement<3>;
} // namespace isochor
