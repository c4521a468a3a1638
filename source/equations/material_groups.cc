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



  /** |dev τ| and θ^e of @p material in simple shear by a hundredth and by one,
   * at a pressure of its stiffness: what tells laws that yield from each other,
   * also such as differ in how they dilate. */
  template <int dim>
  static std::array<double, 4>
  strengths(const MaterialModel<dim> &material)
  {
    const unsigned int    n = material.history_names().size();
    std::vector<double>   history_n(n + 1), history(n + 1);
    std::array<double, 4> result{};
    material.initialize_history(history_n.data());
    for (unsigned int i = 0; i < 2; ++i)
      {
        Kinematics<dim> kinematics;
        Tensor<2, dim>  F = unit_symmetric_tensor<dim>();
        F[0][1]           = i == 0 ? 0.01 : 1;
        kinematics.set_increment(F);
        kinematics.F            = F;
        kinematics.J            = 1;
        kinematics.with_tangent = false;
        if (material.depends_on_pressure())
          kinematics.pressure = -material.shear_modulus();
        StressResponse<dim> response;
        if (material.evaluate(kinematics,
                              history_n.data(),
                              history.data(),
                              response) == StressStatus::success)
          {
            result[i]     = response.deviatoric_stress.norm();
            result[i + 2] = response.volumetric_strain;
          }
      }
    return result;
  }



  template <int dim>
  MaterialGroups::MaterialGroups(const MixedKernel<dim> &kernel,
                                 const double            same_stiffness)
    : of_material(kernel.materials.size(), 0)
  {
    // G, K, and of those that yield strengths; of equals by number
    using Properties = std::array<double, 6>;
    using Sorted     = std::pair<Properties, unsigned int>;
    std::vector<Sorted> sorted;
    for (unsigned int m = 0; m < kernel.materials.size(); ++m)
      if (kernel.materials[m] != nullptr)
        {
          const double K_inverse = kernel.materials[m]->inverse_bulk_modulus();
          const auto   strength  = kernel.materials[m]->dissipates() ?
                                     strengths<dim>(*kernel.materials[m]) :
                                     std::array<double, 4>{};
          sorted.push_back(
            {{{kernel.materials[m]->shear_modulus(),
               K_inverse == 0 ? std::numeric_limits<double>::max() :
                                1 / K_inverse,
               strength[0],
               strength[1]}},
             m});
        }
    std::sort(sorted.begin(), sorted.end());
    Properties last{};
    for (const auto &[of_this, m] : sorted)
      {
        const bool may_yield = kernel.materials[m]->dissipates();
        const std::array<double, 2> stiffness = {{of_this[0], of_this[1]}};
        const bool                  is_same =
          !moduli.empty() && may_yield == dissipates.back() &&
          (may_yield ?
             of_this == last :
             larger_ratio(stiffness, moduli.back()) <= same_stiffness);
        last = of_this;
        if (!is_same && moduli.size() < most)
          {
            moduli.push_back(stiffness);
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
