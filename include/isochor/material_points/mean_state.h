/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mean_state_h
#define isochor_mean_state_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/material_points.h>

#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Let @p properties be the state of two points of the same material put
   * together: V_0 and mass are sums; displacement, velocity and acceleration
   * means by mass; pressure, stress and history means by current volume; @p F
   * is their deformation gradient. All else is that of the first.
   */
  template <int dim>
  void
  mean_state(const double                                           *first,
             const double                                           *second,
             const Tensor<2, dim>                                   &F,
             const PointLayout                                      &layout,
             const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
             std::vector<double> &properties);
} // namespace isochor

#endif
