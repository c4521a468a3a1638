/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_model/isochoric_elasticity.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/tensor_tools.h>

#include <cmath>

namespace isochor
{
  /**
   * Rubber whose chains can only be stretched so far (A. N. Gent, Rubber Chem.
   * Technol. 69 (1996) 59-61):
   *   W = K (J-1)²/2 - G J_m/2 ln(1 - (Ī - 3)/J_m),  Ī = tr b̄.
   * With J_m → ∞ it is the Neo-Hookean law.
   */
  template <int dim>
  class Gent : public MaterialModel<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      IsotropicElasticity::declare_parameters(prm);
      prm.enter_subsection("Gent");
      prm.declare_entry("Limit",
                        "50",
                        Patterns::Double(1e-6),
                        "J_m, the largest tr b̄ - 3 that the chains allow.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      elasticity.parse_parameters(prm);
      prm.enter_subsection("Gent");
      limit = prm.get_double("Limit");
      prm.leave_subsection();
    }

    StressStatus
    evaluate(const Kinematics<dim> &kinematics,
             const double * /*history_n*/,
             double * /*history*/,
             StressResponse<dim> &response) const override
    {
      const double                J = kinematics.J;
      const SymmetricTensor<2, 3> b_bar =
        push_forward(kinematics.F, unit_symmetric_tensor<3>()) /
        std::cbrt(J * J);
      const SymmetricTensor<2, 3> dev_b_bar = deviator(b_bar);
      const double                rest      = 1 - (trace(b_bar) - 3) / limit;
      if (rest <= 0)
        return StressStatus::return_map_failed; // the step will be cut

      // dev τ = 2 W'(Ī) dev b̄, and 2 W' changes by 4 W'' dev b̄ : d
      const double modulus       = elasticity.shear_modulus / rest;
      response.deviatoric_stress = modulus * dev_b_bar;
      response.tangent = isochoric_modulus<dim>(modulus * trace(b_bar) / 3,
                                                response.deviatoric_stress);
      const SymmetricTensor<2, dim> direction = in_plane<dim>(dev_b_bar);
      response.tangent +=
        2 * modulus / (limit * rest) * outer_product(direction, direction);
      set_elastic_volume_change(J, response);
      return StressStatus::success;
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
    double              limit = 50;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, Gent, "Gent")
} // namespace isochor
