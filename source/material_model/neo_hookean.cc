/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/pack_response.h>
#include <isochor/material_model/tensor_tools.h>

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

    bool
    evaluates_packs() const override
    {
      return true;
    }

    StressStatus
    evaluate_pack(const PackKinematics<dim>                         &kinematics,
                  const std::array<const double *, PointPack::size> &history_n,
                  PackResponse<dim> &response) const override;

    double
    deviatoric_energy(const Tensor<2, dim> &F,
                      const double * /*history*/) const override
    {
      const double J = determinant(F);
      return elasticity.shear_modulus / 2 *
             (left_cauchy_green<double>(F).trace() / std::cbrt(J * J) - 3);
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

    /** F F^T. @tparam Number double, or PointPack with a TensorPack. */
    template <typename Number, typename Matrix>
    static SymmetricComponents<dim, Number>
    left_cauchy_green(const Matrix &F)
    {
      const std::array<Number, 6> one = {{1., 1., 1., 0., 0., 0.}};
      return push_forward_by<dim>(F, one.data());
    }

    /** G J^{-2/3} (Pa). */
    double
    isochoric_stiffness(const double J) const
    {
      return elasticity.shear_modulus / std::cbrt(J * J);
    }
  };



  template <int dim>
  StressStatus
  NeoHookean<dim>::evaluate(const Kinematics<dim> &kinematics,
                            const double * /*history_n*/,
                            double * /*history*/,
                            StressResponse<dim> &response) const
  {
    const double                   J = kinematics.J;
    const SymmetricComponents<dim> G_b_bar =
      isochoric_stiffness(J) * left_cauchy_green<double>(kinematics.F);
    const SymmetricComponents<dim> dev_stress = G_b_bar.deviator();
    dev_stress.copy_to(response.deviatoric_stress);
    if (kinematics.with_tangent)
      copy_modulus<dim>(isochoric_modulus(G_b_bar.trace() / 3, dev_stress),
                        response.tangent);
    set_elastic_volume_change(J, response);
    // squares of all entries of F stand in the trace
    return std::isfinite(G_b_bar.trace() + J) ? StressStatus::success :
                                                StressStatus::return_map_failed;
  }



  template <int dim>
  StressStatus
  NeoHookean<dim>::evaluate_pack(
    const PackKinematics<dim> &kinematics,
    const std::array<const double *, PointPack::size> & /*history_n*/,
    PackResponse<dim> &response) const
  {
    const PointPack                          &J = kinematics.J;
    const SymmetricComponents<dim, PointPack> G_b_bar =
      PointPack(isochoric_stiffness(J[0]), isochoric_stiffness(J[1])) *
      left_cauchy_green<PointPack>(kinematics.F);
    response.deviatoric_stress = G_b_bar.deviator();
    if (kinematics.with_tangent)
      response.tangent = isochoric_modulus((1. / 3.) * G_b_bar.trace(),
                                           response.deviatoric_stress);
    return std::isfinite(sum(G_b_bar.trace() + J)) ?
             StressStatus::success :
             StressStatus::return_map_failed;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, NeoHookean, "Neo-Hookean")
} // namespace isochor
