/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_plastic_strain_h
#define isochor_plastic_strain_h

#include <isochor/base/rounding.h>
#include <isochor/material_model/material_model.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** Where the equivalent plastic strain stands in the history of @p material;
   * numbers::invalid_unsigned_int if there is none. */
  template <int dim>
  unsigned int
  entry_of_plastic_strain(const MaterialModel<dim> &material)
  {
    const std::vector<std::string> names = material.history_names();
    const auto                     found =
      std::find(names.begin(), names.end(), "equivalent_plastic_strain");
    return found == names.end() ? numbers::invalid_unsigned_int :
                                  found - names.begin();
  }

  /** The same of each of the @p materials. */
  template <int dim>
  std::vector<unsigned int>
  entries_of_plastic_strain(
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials)
  {
    std::vector<unsigned int> entries;
    for (const auto &material : materials)
      entries.push_back(entry_of_plastic_strain(*material));
    return entries;
  }

  /** m = |e^e|/(|e^e| + |Δe^p|), the part of its elastic shear strain e^e that
   * a point keeps through a step with the plastic one Δe^p: 1 if nothing flows.
   * @p stress is |dev τ| (Pa) at the end of the step, @p plastic_strain the
   * change of the equivalent plastic strain, √(2/3) |Δe^p|. Positive also at
   * the apex of a cone, where there is no shear stress. */
  inline double
  kept_shear_strain(const double shear_modulus,
                    const double stress,
                    const double plastic_strain)
  {
    Assert(shear_modulus > 0, ExcInternalError());
    const double elastic = stress / (2 * shear_modulus) + rounding::accumulated,
                 plastic = std::sqrt(1.5) * std::max(0., plastic_strain);
    return elastic / (elastic + plastic);
  }

} // namespace isochor

#endif
