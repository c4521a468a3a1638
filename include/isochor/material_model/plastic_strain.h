/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_plastic_strain_h
#define isochor_plastic_strain_h

#include <isochor/material_model/material_model.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** Where the equivalent plastic strain stands in the history of each of the
   * @p materials; numbers::invalid_unsigned_int where there is none. */
  template <int dim>
  std::vector<unsigned int>
  entries_of_plastic_strain(
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials)
  {
    std::vector<unsigned int> entries;
    for (const auto &material : materials)
      {
        const std::vector<std::string> names = material->history_names();
        const auto                     found =
          std::find(names.begin(), names.end(), "equivalent_plastic_strain");
        entries.push_back(found == names.end() ? numbers::invalid_unsigned_int :
                                                 found - names.begin());
      }
    return entries;
  }
} // namespace isochor

#endif
