/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/isochoric_elasticity.h>
#include <isochor/material_model.h>
#include <isochor/tensor_tools.h>

#include <cmath>

namespace isochor
{
  /**
   * Compressible Neo-Hookean law with the stored energy
   *   W = K (J-1)²/2 + G/2 (tr b̄ - 3),  b̄ = J^{-2/3} F F^T,
   * hence dev τ = G dev b̄ (Iaconeta et al. 2019, eqs. 27-30).
   */
  template <int dim>
  class NeoHookean : public MaterialModel<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      IsotropicElasticity::declare_parameters(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      elasticity.parse_parameters(prm);
    }

    StressStatus
    evaluate(const Kinematics<dim> &kinematics,
             const double          *history_n,
             double                *history,
             StressResponse<dim>   &response) const override;

    double
    deviatoric_energy(const Tensor<2, dim> &F,
                      const double * /*history*/) const override
    {
      const double J = determinant(F);
      return elasticity.shear_modulus / 2 *
             (trace(push_forward(F, unit_symmetric_tensor<3>())) /
                std::cbrt(J * J) -
              3);
    }

    double
    shear_modulus() const override
    {
      return elasticity.shear_modulus;
    }

    double
    inverse_bulk_modulus() const override
    {
      return elasticity.inverse_bulk_modulus;
    }

    double
    density() const override
    {
      return elasticity.density;
    }

  private:
    IsotropicElasticity elasticity;
  };



  template <int dim>
  StressStatus
  NeoHookean<dim>::evaluate(const Kinematics<dim> &kinematics,
                            const double * /*history_n*/,
                            double * /*history*/,
                            StressResponse<dim> &response) const
  {
    const double                G = elasticity.shear_modulus;
    const double                J = kinematics.J;
    const SymmetricTensor<2, 3> G_b_bar =
      (G / std::cbrt(J * J)) *
      push_forward(kinematics.F, unit_symmetric_tensor<3>());

    response.deviatoric_stress = deviator(G_b_bar);
    response.tangent =
      isochoric_modulus<dim>(trace(G_b_bar) / 3, response.deviatoric_stress);
    set_elastic_volume_change(J, response);
    return is_finite(response) ? StressStatus::success :
                                 StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, NeoHookean, "Neo-Hookean")
} // namespace isochor
