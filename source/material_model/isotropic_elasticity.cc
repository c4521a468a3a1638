/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/plain_message.h>
#include <isochor/material_model/material_model.h>

#include <string>

namespace isochor
{
  void
  IsotropicElasticity::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Young modulus",
                      "1e6",
                      Patterns::Double(),
                      "Young's modulus E > 0, in Pa.");
    prm.declare_entry("Poisson ratio",
                      "0.3",
                      Patterns::Double(),
                      "Poisson's ratio, -1 < nu <= 0.5. The value 0.5 is an "
                      "incompressible material and needs a mixed formulation.");
    prm.declare_entry("Density",
                      "1000",
                      Patterns::Double(),
                      "Density of the reference configuration, in kg/m^3.");
  }



  void
  IsotropicElasticity::parse_parameters(ParameterHandler &prm)
  {
    const double E  = prm.get_double("Young modulus");
    const double nu = prm.get_double("Poisson ratio");
    density         = prm.get_double("Density");

    AssertThrow(E > 0,
                ExcMessage("<Young modulus> must be positive, not " +
                           std::to_string(E) + "."));
    AssertThrow(nu > -1 && nu <= 0.5,
                ExcMessage("<Poisson ratio> must be greater than -1 and at "
                           "most 0.5, not " +
                           std::to_string(nu) + "."));
    AssertThrow(density >= 0,
                ExcMessage("<Density> must not be negative, but is " +
                           std::to_string(density) + "."));

    shear_modulus        = E / (2 * (1 + nu));
    inverse_bulk_modulus = 3 * (1 - 2 * nu) / E;
  }



  std::string
  doubtful_strength(const std::string         &parameter,
                    const double               strength,
                    const IsotropicElasticity &elasticity)
  {
    // Young's modulus is 9 K G / (3 K + G)
    const double E =
      9 * elasticity.shear_modulus /
      (3 + elasticity.shear_modulus * elasticity.inverse_bulk_modulus);
    // the weakest metals and clays have 1e-4, and such as are meant to be rigid
    // before they yield some 1e-5
    constexpr double least = 1e-6;
    if (strength > 0 && strength < least * E)
      return "<" + parameter + "> = " + rounded(strength) + " Pa is only " +
             rounded(strength / E) + " of <Young modulus> = " + rounded(E) +
             " Pa: the material yields under very small loads. Are both in the "
             "same unit, not one in MPa or kPa and the other in Pa?";
    if (strength <= E)
      return "";
    return "<" + parameter + "> = " + rounded(strength) +
           " Pa is more than <Young modulus> = " + rounded(E) +
           " Pa: the material yields at strains of more than one only. Are both "
           "in the same unit? If it shall not yield, take <Model = "
           "Neo-Hookean>.";
  }
} // namespace isochor
