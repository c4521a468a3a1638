/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/material_points/mean_state.h>
#include <isochor/material_points/point_merging.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  PointMerging<dim>::PointMerging(MaterialPoints<dim>       &points,
                                  const BackgroundGrid<dim> &grid,
                                  const PointLocator<dim>   &locator,
                                  const Materials           &materials,
                                  const double               largest_share,
                                  const double               tolerance,
                                  const unsigned int         least_points)
    : points(points)
    , grid(grid)
    , locator(locator)
    , materials(materials)
    , largest_share(largest_share)
    , tolerance(tolerance)
    , least_points(least_points)
    , scale(scale_of_places(grid))
  {}



  template <int dim>
  types::particle_index
  PointMerging<dim>::merge()
  {
    types::particle_index sum = 0;
    for (;;)
      {
        const types::particle_index n =
          Utilities::MPI::sum(points.layout().with_domains ?
                                merge_domains() :
                                merge_points_of_cells(),
                              grid.communicator());
        if (n == 0)
          return sum;
        sum += n;
        points.relocate(locator, is_concerned);
      }
  }



  template <int dim>
  bool
  PointMerging<dim>::fits(const double volume, const unsigned int cell) const
  {
    return volume <= largest_share * locator.geometry().measure(cell);
  }



  template <int dim>
  bool
  PointMerging<dim>::are_alike(const double *first, const double *second) const
  {
    const auto F          = deformation_gradient<dim>(first, points.layout()),
               G          = deformation_gradient<dim>(second, points.layout());
    Tensor<2, dim> strain = transpose(F) * F;
    for (unsigned int d = 0; d < dim; ++d)
      strain[d][d] -= 1;
    return (F - G).norm() <= tolerance * strain.norm() / 2 + rounding::places;
  }



  template <int dim>
  bool
  PointMerging<dim>::fits_around(const double       volume,
                                 const unsigned int cell) const
  {
    const auto &neighbours = locator.geometry().neighbours(cell);
    return fits(volume, cell) &&
           std::all_of(neighbours.begin(),
                       neighbours.end(),
                       [&](const unsigned int next) {
                         return next == SimplexGeometry<dim>::no_cell ||
                                fits(volume, next);
                       });
  }



  template <int dim>
  types::particle_index
  PointMerging<dim>::merge_points_of_cells()
  {
    const PointLayout                            &l = points.layout();
    std::vector<Particles::ParticleIterator<dim>> vanishing;
    std::vector<Particles::ParticleIterator<dim>> here;
    const auto small_parts_from = [&](auto &particle) {
      // the handler keeps the points of a cell together
      here.clear();
      const unsigned int cell =
        particle->get_surrounding_cell()->active_cell_index();
      for (; particle != points.handler().end() &&
             particle->get_surrounding_cell()->active_cell_index() == cell;
           ++particle)
        {
          const auto values = particle->get_properties();
          if (values[l.ancestry] > 0 &&
              fits(values[l.volume] *
                     determinant(deformation_gradient<dim>(values.data(), l)),
                   cell))
            here.push_back(particle);
        }
      // their order in the handler depends on the number of ranks
      const auto place = [](const auto &point) {
        double sum = 0;
        for (unsigned int d = 0; d < dim; ++d)
          sum += point->get_location()[d] * std::pow(0.618, d);
        return sum;
      };
      std::sort(here.begin(), here.end(), [&](const auto &a, const auto &b) {
        return place(a) < place(b);
      });
      return cell;
    };
    const auto can_merge = [&](const Particles::ParticleIterator<dim> &a,
                               const Particles::ParticleIterator<dim> &b,
                               const unsigned int                      cell) {
      const auto   x = a->get_properties(), y = b->get_properties();
      const double V = x[l.volume] + y[l.volume];
      const auto   F = deformation_gradient<dim>(x.data(), l),
                 G   = deformation_gradient<dim>(y.data(), l);
      return x[l.material] == y[l.material] &&
             V <= std::min(x[l.ancestry], y[l.ancestry]) * (1 + 1e-10) &&
             fits_around(x[l.volume] * determinant(F) +
                           y[l.volume] * determinant(G),
                         cell) &&
             are_alike(x.data(), y.data());
    };
    for (auto particle = points.handler().begin();
         particle != points.handler().end();)
      {
        const unsigned int cell = small_parts_from(particle);
        std::vector<bool>  is_merged(here.size(), false);
        for (unsigned int i = 0; i < here.size(); ++i)
          {
            unsigned int nearest  = here.size();
            double       distance = std::numeric_limits<double>::max();
            for (unsigned int j = i + 1; j < here.size() && !is_merged[i]; ++j)
              {
                const double d =
                  here[i]->get_location().distance(here[j]->get_location());
                // the first of those that are equal but for rounding
                if (!is_merged[j] && d < distance * (1 - 1e-6) &&
                    can_merge(here[i], here[j], cell))
                  {
                    nearest  = j;
                    distance = d;
                  }
              }
            if (nearest == here.size())
              continue;
            is_merged[i] = is_merged[nearest] = true;
            unite_points(here[i], here[nearest]);
            vanishing.push_back(here[nearest]);
          }
      }
    points.handler().remove_particles(vanishing);
    return vanishing.size();
  }



  template <int dim>
  void
  PointMerging<dim>::unite_points(
    Particles::ParticleIterator<dim>       &remaining,
    const Particles::ParticleIterator<dim> &vanishing) const
  {
    const PointLayout        &l      = points.layout();
    const auto                values = remaining->get_properties();
    const auto                other  = vanishing->get_properties();
    const std::vector<double> first(values.begin(), values.end()),
      second(other.begin(), other.end());
    const Tensor<2, dim> F = deformation_gradient<dim>(first.data(), l),
                         G = deformation_gradient<dim>(second.data(), l);
    const double V         = first[l.volume] + second[l.volume],
                 s         = second[l.volume] / V,
                 J         = (1 - s) * determinant(F) + s * determinant(G);
    Tensor<2, dim> mean    = (1 - s) * F + s * G;
    mean *= std::pow(J / determinant(mean), 1. / dim);
    std::vector<double> properties;
    mean_state<dim>(
      first.data(), second.data(), mean, l, materials, properties);
    properties[l.ancestry] = std::min(first[l.ancestry], second[l.ancestry]);
    const double     m     = first[l.mass] + second[l.mass] > 0 ?
                               second[l.mass] / (first[l.mass] + second[l.mass]) :
                               0.5;
    const Point<dim> x     = remaining->get_location();
    remaining->set_location(x + m * (vanishing->get_location() - x));
    std::copy(properties.begin(), properties.end(), values.begin());
  }



  template class PointMerging<2>;
  template class PointMerging<3>;
} // namespace isochor
