/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/disjoint_sets.h>
#include <isochor/material_points/parts_of_body.h>
#include <isochor/material_points/place_table.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<dim>> &seeds)
  {
    double smallest = std::numeric_limits<double>::max(), farthest = 0;
    for (const Seed<dim> &seed : seeds)
      {
        farthest = std::max(farthest, seed.location.norm());
        smallest =
          std::min(smallest, (seed.domain[1] - seed.domain[0]).norm_square());
      }
    // of the size of a domain: more than the files of meshes are rounded to
    const double quantum = 1e-4 * std::sqrt(smallest);
    // coordinates are sums of a few numbers
    if (!(quantum > 1e3 * std::numeric_limits<double>::epsilon() * farthest))
      return {};

    PlaceTable<dim>           places({seeds.front().location, quantum});
    std::vector<unsigned int> corners;
    corners.reserve(seeds.size() * (dim + 1));
    for (const Seed<dim> &seed : seeds)
      for (const Tensor<1, dim> &corner : seed.domain)
        corners.push_back(places.find_or_add(seed.location + corner));
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



  template std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<2>> &);
  template std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<3>> &);
} // namespace isochor
