/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/material_groups.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  namespace
  {
    double
    larger_ratio(const std::array<double, 2> &a, const std::array<double, 2> &b)
    {
      double larger = 1;
      for (unsigned int i = 0; i < 2; ++i)
        if (a[i] != b[i])
          larger = std::max({larger, a[i] / b[i], b[i] / a[i]});
      return larger;
    }
  } // namespace



  template <int dim>
  MaterialGroups::MaterialGroups(const MixedKernel<dim> &kernel,
                                 const double            same_stiffness)
    : of_material(kernel.materials.size(), 0)
  {
    using Sorted = std::pair<std::array<double, 2>, unsigned int>;
    std::vector<Sorted> sorted; // by stiffness, of equals by number
    for (unsigned int m = 0; m < kernel.materials.size(); ++m)
      if (kernel.materials[m] != nullptr)
        {
          const double K_inverse = kernel.materials[m]->inverse_bulk_modulus();
          sorted.push_back(
            {{{kernel.materials[m]->shear_modulus(),
               K_inverse == 0 ? std::numeric_limits<double>::max() :
                                1 / K_inverse}},
             m});
        }
    std::sort(sorted.begin(), sorted.end());
    for (const auto &[of_this, m] : sorted)
      {
        const bool may_yield = kernel.materials[m]->dissipates();
        const bool is_new =
          moduli.empty() || may_yield || dissipates.back() ||
          larger_ratio(of_this, moduli.back()) > same_stiffness;
        if (is_new && moduli.size() < most)
          {
            moduli.push_back(of_this);
            dissipates.push_back(may_yield);
          }
        of_material[m] = moduli.size() - 1;
      }
  }



  double
  MaterialGroups::ratio(const unsigned int a, const unsigned int b) const
  {
    return std::max(larger_ratio(moduli[a], moduli[b]),
                    dissipates[a] || dissipates[b] ? 2. : 1.);
  }



  template MaterialGroups::MaterialGroups(const MixedKernel<2> &, const double);
  template MaterialGroups::MaterialGroups(const MixedKernel<3> &, const double);
} // namespace isochor
