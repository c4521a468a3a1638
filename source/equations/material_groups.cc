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
   * at a pressure of these parts of G (of soil and rock under loads that shear
   * it so): how much it resists, and what tells laws that yield from each
   * other, also such as differ in how they dilate. */
  template <int dim>
  static std::array<double, 4>
  response_to_shear(const MaterialModel<dim> &material)
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
          kinematics.pressure = -F[0][1] * material.shear_modulus();
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
    // What resists shear by a hundredth the least is the softest, so that a
    // weak joint is softer than an elastic body of its stiffness. Materials of
    // the same strength differ there by rounding: compared in single precision.
    using Properties = std::array<double, 6>;
    using Sorted     = std::pair<Properties, unsigned int>;
    std::vector<Sorted> sorted;
    for (unsigned int m = 0; m < kernel.materials.size(); ++m)
      if (kernel.materials[m] != nullptr)
        {
          const double K_inverse = kernel.materials[m]->inverse_bulk_modulus();
          const auto [small_shear, large_shear, small_theta, large_theta] =
            response_to_shear<dim>(*kernel.materials[m]);
          sorted.push_back(
            {{{static_cast<float>(small_shear),
               kernel.materials[m]->shear_modulus(),
               K_inverse == 0 ? std::numeric_limits<double>::max() :
                                1 / K_inverse,
               large_shear,
               small_theta,
               large_theta}},
             m});
        }
    std::sort(sorted.begin(), sorted.end());

    std::vector<Properties> first; // of each group
    for (const auto &[of_this, m] : sorted)
      {
        const bool may_yield = kernel.materials[m]->dissipates();
        const std::array<double, 2> stiffness = {{of_this[1], of_this[2]}};
        unsigned int                group     = 0;
        for (; group < size(); ++group)
          if (may_yield == dissipates[group] &&
              (may_yield ?
                 of_this == first[group] :
                 larger_ratio(stiffness, moduli[group]) <= same_stiffness))
            break;
        if (group == size() && group < most)
          {
            first.push_back(of_this);
            moduli.push_back(stiffness);
            dissipates.push_back(may_yield);
          }
        of_material[m] = std::min(group, size() - 1);
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
