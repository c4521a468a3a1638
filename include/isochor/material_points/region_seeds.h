/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_region_seeds_h
#define isochor_region_seeds_h

#include <isochor/material_points/region_cut.h>

#include <memory>
#include <string>
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
      cut = std::make_unique<RegionCut<dim>>(conditions[0], false);
    }

    /** What is outside is dropped at once: seeds of a large empty grid would
     * fill the memory. */
    void
    add(const Seed<dim> &seed)
    {
      if (with_domains)
        cut->add(seed);
      else if (in_body(seed.location, 0.) > 0)
        seeds.push_back(seed);
    }

    /** Those that were added, or their parts, in this order. */
    std::vector<Seed<dim>>
    all()
    {
      std::vector<bool> is_inside; // all
      for (unsigned int i = 0; i < conditions.size() && with_domains; ++i)
        {
          if (i > 0)
            cut = std::make_unique<RegionCut<dim>>(conditions[i], false);
          for (const Seed<dim> &seed : seeds)
            cut->add(seed);
          seeds = cut->cut(is_inside);
        }
      return seeds;
    }

  private:
    const Expression<dim>           in_body;
    std::vector<Expression<dim>>    conditions;
    std::unique_ptr<RegionCut<dim>> cut; ///< by the first of them
    const bool                      with_domains;
    std::vector<Seed<dim>>          seeds;
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
        RegionCut<dim>        cut(condition, true);
        for (const Seed<dim> &seed : seeds)
          cut.add(seed);
        seeds = cut.cut(is_inside);
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
