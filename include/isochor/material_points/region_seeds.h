/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_region_seeds_h
#define isochor_region_seeds_h

#include <isochor/material_points/region_cut.h>

#include <string>
#include <vector>

namespace isochor
{
  /** Collects the seeds in a region: those with a domain are cut by its border,
   * others are in it or not by their places. */
  template <int dim>
  class SeedsInRegion
  {
  public:
    SeedsInRegion(const std::string &region, const bool with_domains)
      : in_body(region, "Material points/Region")
      , cut(in_body, false)
      , with_domains(with_domains)
    {}

    /** What is outside is dropped at once: seeds of a large empty grid would
     * fill the memory. */
    void
    add(const Seed<dim> &seed)
    {
      if (with_domains)
        cut.add(seed);
      else if (in_body(seed.location, 0.) > 0)
        seeds.push_back(seed);
    }

    /** Those that were added, or their parts, in this order. */
    std::vector<Seed<dim>>
    all()
    {
      std::vector<bool> is_inside;
      return with_domains ? cut.cut(is_inside) : seeds;
    }

  private:
    const Expression<dim>  in_body;
    RegionCut<dim>         cut;
    const bool             with_domains;
    std::vector<Seed<dim>> seeds;
  };



  /** Let the @p number of the seeds in @p zone be @p value. Their domains, if
   * there are any, are cut by the border of the zone. */
  template <int dim>
  void
  assign_zone(const Expression<dim> &zone,
              const bool             with_domains,
              unsigned int Seed<dim>::*number,
              const unsigned int       value,
              std::vector<Seed<dim>>  &seeds)
  {
    std::vector<bool> is_inside;
    if (with_domains)
      {
        RegionCut<dim> cut(zone, true);
        for (const Seed<dim> &seed : seeds)
          cut.add(seed);
        seeds = cut.cut(is_inside);
      }
    else
      for (const Seed<dim> &seed : seeds)
        is_inside.push_back(zone(seed.location, 0.) > 0);
    for (unsigned int s = 0; s < seeds.size(); ++s)
      if (is_inside[s])
        seeds[s].*number = value;
  }
} // namespace isochor

#endif
