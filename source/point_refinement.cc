/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/mpi_sums.h>
#include <isochor/point_refinement.h>

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
                      "4 (2D) or 5 (3D) equal parts. 0: never.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  PointRefinement<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    largest_share = prm.get_double("Split at share of cell");
    prm.leave_subsection();
    if (largest_share == 0)
      return;
    // else parts of new parts would be split at once
    AssertThrow(largest_share >= 0.1,
                ExcMessage("<Material points/Split at share of cell> must be 0 "
                           "or at least 0.1: more than ten points per cell are "
                           "a matter of seeding."));
    prm.enter_subsection("Quadrature");
    const std::string type = prm.get("Type");
    prm.leave_subsection();
    AssertThrow(type == "points" || type == "cell-filled",
                ExcMessage("<Material points/Split at share of cell> needs "
                           "<Quadrature/Type> points or cell-filled: the other "
                           "types give points domains, which are not split."));
  }



  template <int dim>
  void
  PointRefinement<dim>::refine(MaterialPoints<dim>       &points,
                               const BackgroundGrid<dim> &grid,
                               const PointLocator<dim>   &locator) const
  {
    if (largest_share == 0)
      return;
    // parts may still be too large; bounded, since each round divides by four
    for (unsigned int round = 0; round < 8; ++round)
      {
        const std::vector<NewPoint> parts = split(points, locator);
        if (Utilities::MPI::sum(parts.size(), grid.communicator()) == 0)
          return;
        insert(points, grid, parts);
        points.relocate(locator);
      }
  }



  template <int dim>
  std::vector<typename PointRefinement<dim>::NewPoint>
  PointRefinement<dim>::split(MaterialPoints<dim>     &points,
                              const PointLocator<dim> &locator) const
  {
    static const auto  places = places_of_parts<dim>();
    const PointLayout &l      = points.layout();

    std::vector<NewPoint> parts;
    for (auto &particle : points.handler())
      {
        const unsigned int cell =
          particle.get_surrounding_cell()->active_cell_index();
        const ArrayView<double> values = particle.get_properties();
        const double            volume =
          values[l.volume] *
          determinant(deformation_gradient<dim>(values.data(), l));
        if (!(volume > largest_share * locator.geometry().measure(cell)))
          continue;

        std::array<Point<dim>, dim + 1> locations;
        const double                    size = std::pow(volume, 1. / dim);
        for (unsigned int i = 0; i < locations.size(); ++i)
          locations[i] = particle.get_location() + size * places[i];
        // beside a wall the point stays as it is
        if (!std::all_of(locations.begin(),
                         locations.end(),
                         [&](const Point<dim> &location) {
                           return locator.locate(location, cell).found;
                         }))
          continue;

        values[l.volume] /= dim + 2;
        values[l.mass] /= dim + 2;
        for (const Point<dim> &location : locations)
          parts.push_back({cell, location, {values.begin(), values.end()}});
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
