/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/disjoint_sets.h>
#include <isochor/material_points/parts_of_body.h>
#include <isochor/material_points/place_table.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace isochor
{
  namespace
  {
    /** The corners of the domains of seeds, numbered by place. */
    template <int dim>
    struct CornerPlaces
    {
      PlaceTable<dim>           places;
      std::vector<unsigned int> of_seeds; ///< dim + 1 each; empty: can't tell

      explicit CornerPlaces(const std::vector<Seed<dim>> &seeds)
        : places({seeds.front().location, 1})
      {
        double smallest = std::numeric_limits<double>::max(), farthest = 0;
        for (const Seed<dim> &seed : seeds)
          {
            farthest = std::max(farthest, seed.location.norm());
            smallest =
              std::min(smallest,
                       (seed.domain[1] - seed.domain[0]).norm_square());
          }
        // of the size of a domain: more than the files of meshes are rounded to
        const double quantum = 1e-4 * std::sqrt(smallest);
        // coordinates are sums of a few numbers
        if (!(quantum >
              1e3 * std::numeric_limits<double>::epsilon() * farthest))
          return;
        places = PlaceTable<dim>({seeds.front().location, quantum});
        of_seeds.reserve(seeds.size() * (dim + 1));
        for (const Seed<dim> &seed : seeds)
          for (const Tensor<1, dim> &corner : seed.domain)
            of_seeds.push_back(places.find_or_add(seed.location + corner));
      }
    };
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<dim>> &seeds)
  {
    const CornerPlaces<dim> corners_of(seeds);
    const auto &[places, corners] = corners_of;
    if (corners.empty())
      return {};
    DisjointSets sets(places.size());
    for (std::size_t i = 0; i < corners.size(); ++i)
      sets.merge(corners[i], corners[i - i % (dim + 1)]);

    constexpr unsigned int    none = PlaceTable<dim>::none;
    std::vector<unsigned int> part_of_set(places.size(), none);
    std::vector<unsigned int> parts(seeds.size());
    unsigned int              n_parts = 0;
    for (std::size_t s = 0; s < seeds.size(); ++s)
      {
        unsigned int &part = part_of_set[sets.root(corners[s * (dim + 1)])];
        if (part == none)
          part = n_parts++;
        parts[s] = part;
      }
    return parts;
  }



  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>>
  pairs_across(const std::vector<Seed<dim>>      &seeds,
               const std::vector<Tensor<1, dim>> &periods)
  {
    std::vector<std::pair<unsigned int, unsigned int>> pairs;
    if (periods.empty())
      return pairs;
    const CornerPlaces<dim> corners(seeds);
    using Face = std::array<unsigned int, dim>; // sorted places
    // the face opposite to a corner, by the places of all of them
    const auto face_of = [](const auto &place_of, const unsigned int opposite) {
      Face face;
      for (unsigned int c = 0, i = 0; c <= dim; ++c)
        if (c != opposite)
          face[i++] = place_of(c);
      std::sort(face.begin(), face.end());
      return face;
    };
    for (const Tensor<1, dim> &period : periods)
      {
        std::map<Face, unsigned int> seed_of_image;
        for (unsigned int s = 0; s * (dim + 1) < corners.of_seeds.size(); ++s)
          for (unsigned int c = 0; c <= dim; ++c)
            {
              const Face image = face_of(
                [&](const unsigned int corner) {
                  return corners.places.find(seeds[s].location +
                                             seeds[s].domain[corner] - period);
                },
                c);
              if (image.back() != PlaceTable<dim>::none) // the largest number
                seed_of_image.emplace(image, s);
            }
        for (unsigned int t = 0;
             t * (dim + 1) < corners.of_seeds.size() && !seed_of_image.empty();
             ++t)
          for (unsigned int c = 0; c <= dim; ++c)
            {
              const auto found = seed_of_image.find(face_of(
                [&](const unsigned int corner) {
                  return corners.of_seeds[t * (dim + 1) + corner];
                },
                c));
              if (found != seed_of_image.end())
                pairs.emplace_back(found->second, t);
            }
      }
    return pairs;
  }



  template std::vector<std::pair<unsigned int, unsigned int>>
  pairs_across(const std::vector<Seed<2>> &, const std::vector<Tensor<1, 2>> &);
  template std::vector<std::pair<unsigned int, unsigned int>>
  pairs_across(const std::vector<Seed<3>> &, const std::vector<Tensor<1, 3>> &);
  template std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<2>> &);
  template std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<3>> &);
} // namespace isochor
