/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_isochoric_elasticity_h
#define isochor_isochoric_elasticity_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_model/tensor_tools.h>

namespace isochor
{
  /**
   * The spatial modulus of dev τ = G dev b̄ (Lie derivative, in Pa):
   *   2 μ̄ (I - 1/3 1⊗1) - 2/3 (dev τ ⊗ 1 + 1 ⊗ dev τ),  μ̄ = G tr b̄ / 3
   * (Simo & Hughes 1998, Box 9.2, the trial modulus).
   */
  template <int dim, typename Number>
  inline DEAL_II_ALWAYS_INLINE ModulusComponents<dim, Number>
                               isochoric_modulus(const Number                           &mu_bar,
                                                 const SymmetricComponents<dim, Number> &dev_tau)
  {
    constexpr unsigned int n =
      SymmetricTensor<2, dim>::n_independent_components;

    ModulusComponents<dim, Number> modulus;
    unrolled<n>([&](const auto i) {
      unrolled<n>([&](const auto j) {
        constexpr bool   row_normal = i < dim, column_normal = j < dim;
        constexpr double identity = (i != j ? 0. : row_normal ? 1. : 0.5);
        modulus[i * n + j] =
          2. * mu_bar *
            (identity - (row_normal && column_normal ? 1. / 3. : 0.)) -
          2. / 3. *
            ((column_normal ? dev_tau.in_plane(i) : Number(0.)) +
             (row_normal ? dev_tau.in_plane(j) : Number(0.)));
      });
    });
    return modulus;
  }

  /** The same of tensors. */
  template <int dim>
  inline SymmetricTensor<4, dim>
  isochoric_modulus(const double mu_bar, const SymmetricTensor<2, 3> &dev_tau)
  {
    SymmetricComponents<dim> components;
    store_symmetric<dim>(dev_tau, components.entry.data());
    SymmetricTensor<4, dim> modulus;
    copy_modulus<dim>(isochoric_modulus(mu_bar, components), modulus);
    return modulus;
  }

  /** Volume change is elastic, θ^e = J - 1 and ∂θ^e/∂d = J 1: the volumetric
   * half of the answer of a law with isochoric flow. */
  template <int dim>
  inline void
  set_elastic_volume_change(const double J, StressResponse<dim> &response)
  {
    response.volumetric_strain  = J - 1;
    response.volumetric_tangent = J * unit_symmetric_tensor<dim>();
  }
} // namespace isochor

#endif
