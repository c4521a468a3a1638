/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/material_points/mean_state.h>
#include <isochor/material_points/outer_faces.h>
#include <isochor/material_points/place_filter.h>
#include <isochor/material_points/point_merging.h>

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace isochor
{
  namespace
  {
    /** What was at the middle of the edge that was bisected last is the last
     * corner of its parts, what they have of its ends the one before. */
    template <int dim>
    constexpr unsigned int middle = dim;
    template <int dim>
    constexpr unsigned int end = dim - 1;

    /** The centroid at t = 0 of the domain that @p part is a half of. */
    template <int dim>
    Point<dim>
    centroid_of_whole(const PointDomain<dim> &part)
    {
      auto corners = part.reference;
      corners[middle<dim>] =
        part.reference[middle<dim>] +
        (part.reference[middle<dim>] - part.reference[end<dim>]);
      return centroid<dim>(corners);
    }

    template <int dim>
    void
    add_places(const typename PointDomain<dim>::Corners &corners,
               std::vector<double>                      &places)
    {
      for (const Point<dim> &corner : corners)
        for (unsigned int d = 0; d < dim; ++d)
          places.push_back(corner[d]);
    }

    /** Add the @p places of all ranks, coordinates one after the other. */
    template <int dim>
    void
    add_of_all_ranks(const std::vector<double> &places,
                     const MPI_Comm             comm,
                     PlaceTable<dim>           &table)
    {
      for (const auto &of_rank : all_gather_arrays(comm, places))
        for (std::size_t i = 0; i < of_rank.size(); i += dim)
          {
            Point<dim> place;
            for (unsigned int d = 0; d < dim; ++d)
              place[d] = of_rank[i + d];
            table.find_or_add(place);
          }
    }
  } // namespace



  template <int dim>
  PointMerging<dim>::PointMerging(MaterialPoints<dim>       &points,
                                  const BackgroundGrid<dim> &grid,
                                  const PointLocator<dim>   &locator,
                                  const Materials           &materials,
                                  const double               largest_share)
    : points(points)
    , grid(grid)
    , locator(locator)
    , materials(materials)
    , largest_share(largest_share)
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
          Utilities::MPI::sum(merge_domains(), grid.communicator());
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
  PointMerging<dim>::is_willing(const PointDomain<dim> &part) const
  {
    return part.ancestry > 0 && fits(2 * part.volume, part.cell);
  }



  template <int dim>
  PlaceTable<dim>
  PointMerging<dim>::find_middles(std::vector<unsigned int> &willing,
                                  std::vector<unsigned int> &is_vetoed) const
  {
    const MPI_Comm             comm = grid.communicator();
    std::vector<double>        places;
    std::vector<unsigned char> is_own_willing(domains.size(), 0);
    for (unsigned int i = 0; i < domains.size(); ++i)
      if (is_willing(domains[i]))
        {
          is_own_willing[i]       = 1;
          const Point<dim> &place = domains[i].reference[middle<dim>];
          if (changed_places &&
              changed_places->find(place) == PlaceTable<dim>::none)
            continue;
          willing.push_back(i);
          for (unsigned int d = 0; d < dim; ++d)
            places.push_back(place[d]);
        }
    PlaceTable<dim> middles(scale);
    add_of_all_ranks(places, comm, middles);
    is_vetoed.assign(middles.size(), 0);
    if (middles.size() == 0)
      return middles;
    const PlaceFilter<dim> filter(middles, scale);
    for (unsigned int i = 0; i < domains.size(); ++i)
      for (unsigned int c = 0; c <= dim; ++c)
        {
          const Point<dim> &corner = domains[i].reference[c];
          if ((c == middle<dim> && is_own_willing[i]) ||
              !filter.may_contain(corner))
            continue;
          const unsigned int number = middles.find(corner);
          if (number != PlaceTable<dim>::none)
            is_vetoed[number] = 1;
        }
    Utilities::MPI::max(is_vetoed, comm, is_vetoed);
    return middles;
  }



  template <int dim>
  void
  PointMerging<dim>::exchange_parts(std::vector<Part> &parts)
  {
    const MPI_Comm comm = grid.communicator();
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    std::vector<double> values;
    for (const Part &part : parts)
      {
        for (unsigned int c = 0; c <= dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            {
              values.push_back(part.domain.reference[c][d]);
              values.push_back(part.domain.current[c][d]);
            }
        values.push_back(part.domain.volume);
        values.push_back(part.domain.ancestry);
        values.push_back(part.domain.outer_faces);
        values.insert(values.end(),
                      part.properties,
                      part.properties + points.layout().n_properties);
      }
    parts.clear();
    received                = all_gather_arrays(comm, values);
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    for (unsigned int r = 0; r < received.size(); ++r)
      for (const double *value = received[r].data();
           r != rank && value != received[r].data() + received[r].size();)
        {
          Part part;
          for (unsigned int c = 0; c <= dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              {
                part.domain.reference[c][d] = *value++;
                part.domain.current[c][d]   = *value++;
              }
          part.domain.volume      = *value++;
          part.domain.ancestry    = *value++;
          part.domain.outer_faces = *value++;
          part.properties         = value;
          value += points.layout().n_properties;
          parts.push_back(part);
        }
  }



  template <int dim>
  std::vector<typename PointMerging<dim>::Pair>
  PointMerging<dim>::find_pairs(const std::vector<unsigned int> &willing,
                                const PlaceTable<dim>           &middles,
                                const std::vector<unsigned int> &is_vetoed)
  {
    PlaceTable<dim>   wholes(scale);
    std::vector<Pair> pairs;
    const auto        add = [&](const Part &part, const unsigned int number) {
      const auto [kept, lost] = Ancestry<dim>::last(part.domain.ancestry);
      const unsigned int i =
        wholes.find_or_add(centroid_of_whole<dim>(part.domain));
      if (i == pairs.size())
        pairs.emplace_back();
      pairs[i].middle                              = number;
      pairs[i].parts[kept < lost ? 0 : 1]          = part;
      pairs[i].parts[kept < lost ? 0 : 1].is_there = true;
    };
    auto         particle = points.handler().begin();
    unsigned int point    = 0;
    for (const unsigned int i : willing)
      {
        const unsigned int number =
          middles.find(domains[i].reference[middle<dim>]);
        if (is_vetoed[number])
          continue;
        for (; point < i; ++point)
          ++particle;
        Part part;
        part.domain     = domains[i];
        part.properties = particle->get_properties().data();
        part.particle   = particle;
        part.is_own     = true;
        add(part, number);
      }
    std::vector<Part> others;
    for (const Pair &pair : pairs)
      for (unsigned int i = 0; i < 2; ++i)
        if (!pair.parts[i].is_there)
          others.push_back(pair.parts[1 - i]);
    exchange_parts(others);
    for (const Part &part : others)
      if (!part.is_own && wholes.find(centroid_of_whole<dim>(part.domain)) !=
                            PlaceTable<dim>::none)
        add(part, middles.find(part.domain.reference[middle<dim>]));
    return pairs;
  }



  template <int dim>
  bool
  PointMerging<dim>::unite(Pair &pair) const
  {
    const Part &first = pair.parts[0], &second = pair.parts[1];
    if (!first.is_there || !second.is_there ||
        Ancestry<dim>::of_whole(first.domain.ancestry) !=
          Ancestry<dim>::of_whole(second.domain.ancestry))
      return false;
    const Point<dim> a = first.domain.current[end<dim>],
                     b = second.domain.current[end<dim>],
                     m = first.domain.current[middle<dim>];
    if (!((m - (a + (b - a) / 2)).norm() <= straightness * (b - a).norm()) ||
        !are_alike(first.properties, second.properties))
      return false;

    const auto [kept, lost] = Ancestry<dim>::last(first.domain.ancestry);
    PointDomain<dim> &whole = pair.whole;
    whole                   = first.domain;
    whole.ancestry          = Ancestry<dim>::of_whole(first.domain.ancestry);
    whole.outer_faces       = 0;
    for (unsigned int c = 0, other = 0; c <= dim; ++c)
      {
        const Part        &part = (c == lost ? second : first);
        const unsigned int from = (c == kept || c == lost ? end<dim> : other++);
        // what is opposite to an end of the edge is opposite to the middle of
        // the part that has the other end
        const unsigned int face =
          c == kept ? (second.domain.outer_faces >> middle<dim>) :
          c == lost ? (first.domain.outer_faces >> middle<dim>) :
                      (first.domain.outer_faces >> from);
        whole.outer_faces |= (face & flags_of_face) << c;
        whole.reference[c] = part.domain.reference[from];
        whole.current[c]   = part.domain.current[from];
      }
    const Tensor<2, dim> F = edge_matrix<dim>(whole.current) *
                             invert(edge_matrix<dim>(whole.reference));
    const PointLayout &l = points.layout();
    mean_state<dim>(
      first.properties, second.properties, F, l, materials, pair.properties);
    const double stretch = domain_stretch<dim>(pair.properties.data(), l);
    for (unsigned int i = 0; i < dim * dim; ++i)
      pair.properties[l.F + i] /= stretch;
    whole.volume =
      pair.properties[l.volume] * determinant(F) / std::pow(stretch, 1. * dim);
    whole.location   = centroid<dim>(whole.current);
    const auto place = locator.locate(whole.location, first.domain.cell);
    whole.cell       = place.cell;
    store_domain<dim>(whole, points.layout(), make_array_view(pair.properties));
    return place.found && determinant(F) > 0 && fits(whole.volume, place.cell);
  }



  template <int dim>
  types::particle_index
  PointMerging<dim>::merge_domains()
  {
    const MPI_Comm            comm = grid.communicator();
    std::vector<unsigned int> willing, is_vetoed;
    domains                       = point_domains(points);
    const PlaceTable<dim> middles = find_middles(willing, is_vetoed);
    if (middles.size() == 0)
      return 0;
    std::vector<Pair> pairs = find_pairs(willing, middles, is_vetoed);
    // the parts around a middle together or none of them
    for (Pair &pair : pairs)
      if (!unite(pair))
        is_vetoed[pair.middle] = 1;
    Utilities::MPI::max(is_vetoed, comm, is_vetoed);
    is_concerned.assign(locator.geometry().n_cells(), 0);
    std::vector<double>                           corners_of_merged;
    std::vector<Particles::ParticleIterator<dim>> vanishing;
    for (Pair &pair : pairs)
      {
        if (is_vetoed[pair.middle])
          continue;
        Part &first = pair.parts[0], &second = pair.parts[1];
        if (first.is_own)
          {
            std::copy(pair.properties.begin(),
                      pair.properties.end(),
                      first.particle->get_properties().begin());
            first.particle->set_location(pair.whole.location);
            add_places<dim>(pair.whole.reference, corners_of_merged);
            is_concerned[first.domain.cell] = 1;
          }
        if (second.is_own)
          vanishing.push_back(second.particle);
      }
    changed_places.emplace(scale);
    add_of_all_ranks(corners_of_merged, comm, *changed_places);
    points.handler().remove_particles(vanishing);
    return vanishing.size();
  }



  template class PointMerging<2>;
  template class PointMerging<3>;
} // namespace isochor
