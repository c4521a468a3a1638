/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_region_seeds_h
#define isochor_region_seeds_h

#include <isochor/material_points/region_cut.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /** Collects the seeds in a region: those with a domain are cut by its border,
   * others are in it or not by their places. A region that several conditions
   * describe is cut by one after the other, so that it has its edges. */
  template <int dim>
  class SeedsInRegion
  {
  public:
    SeedsInRegion(const std::string &region, const bool with_domains)
      : in_body(region, "Material points/Region")
      , with_domains(with_domains)
    {
      for (const std::string &condition : conditions_joined(region))
        conditions.emplace_back(condition, "Material points/Region");
      for (const Expression<dim> &condition : conditions)
        cuts.emplace_back(condition, false);
    }

    /** What is outside is dropped at once: seeds of a large empty grid would
     * fill the memory. */
    void
    add(const Seed<dim> &seed)
    {
      if (!with_domains)
        {
          if (in_body(seed.location, 0.) > 0)
            seeds.push_back(seed);
        }
      else if (std::all_of(cuts.begin(), cuts.end(), [&](const auto &cut) {
                 return cut.corners_inside(seed) != 0;
               }))
        seeds.push_back(seed);
    }

    /** Those that were added, or their parts, in this order. Once. */
    std::vector<Seed<dim>>
    all()
    {
      std::vector<bool> is_inside; // all
      for (RegionCut<dim> &cut : cuts)
        if (with_domains)
          seeds = cut.cut(seeds, is_inside);
      return std::move(seeds);
    }

  private:
    const Expression<dim>        in_body;
    std::vector<Expression<dim>> conditions;
    std::vector<RegionCut<dim>>  cuts; ///< by these
    const bool                   with_domains;
    std::vector<Seed<dim>>       seeds;
  };



  /** Let the @p number of the seeds in @p zone, of the parameter @p name, be
   * @p value. Their domains, if there are any, are cut by the border of the
   * zone, of its conditions one after the other. */
  template <int dim>
  void
  assign_zone(const std::string &zone,
              const std::string &name,
              const bool         with_domains,
              unsigned int Seed<dim>::*number,
              const unsigned int       value,
              std::vector<Seed<dim>>  &seeds)
  {
    const Expression<dim>          whole(zone, name, FormulaVariables::space);
    const std::vector<std::string> conditions = conditions_joined(zone);
    std::vector<bool>              is_inside;
    for (unsigned int i = 0; i < conditions.size() && with_domains; ++i)
      {
        const Expression<dim> condition(conditions[i], name);
        seeds = RegionCut<dim>(condition, true).cut(seeds, is_inside);
      }
    // between the borders of several conditions places say what is inside
    if (!with_domains || conditions.size() > 1)
      {
        is_inside.clear();
        for (const Seed<dim> &seed : seeds)
          is_inside.push_back(whole(seed.location, 0.) > 0);
      }
    for (unsigned int s = 0; s < seeds.size(); ++s)
      if (is_inside[s])
        seeds[s].*number = value;
  }
} // namespace isochor

#endif
