/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_plastic_strain_h
#define isochor_plastic_strain_h

#include <isochor/material_model/material_model.h>

#include <algorithm>
#include <cmath>
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

  /** m = |e^e|/(|e^e| + |Δe^p|), the part of its elastic shear strain e^e that
   * a point keeps through a step with the plastic one Δe^p: 1 if the step is
   * elastic. @p F is the step's deformation gradient, @p before and @p after
   * the deviatoric Kirchhoff stresses (Pa) at its ends. */
  inline double
  kept_shear_strain(const double                 shear_modulus,
                    const Tensor<2, 3>          &F,
                    const SymmetricTensor<2, 3> &before,
                    const SymmetricTensor<2, 3> &after)
  {
    Assert(determinant(F) > 0 && shear_modulus > 0, ExcInternalError());
    const Tensor<2, 3> l = Tensor<2, 3>(unit_symmetric_tensor<3>()) - invert(F);
    const SymmetricTensor<2, 3> carried =
      std::pow(determinant(F), -2. / 3) *
      deviator(symmetrize(F * Tensor<2, 3>(before) * transpose(F)));
    const double elastic = after.norm() / (2 * shear_modulus),
                 plastic = (deviator(symmetrize(l)) -
                            (after - carried) / (2 * shear_modulus))
                             .norm();
    return plastic > 0 ? elastic / (elastic + plastic) : 1;
  }
} // namespace isochor

#endif
