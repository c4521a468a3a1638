/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pack_response_h
#define isochor_pack_response_h

#include <isochor/material_model/point_pack.h>
#include <isochor/material_model/tensor_tools.h>

namespace isochor
{
  /** Kinematics of the points of a pack, which are in one element: they share
   * ΔF. */
  template <int dim>
  struct PackKinematics
  {
    TensorPack<dim> F_increment;
    PointPack       isochoric_scale;
    TensorPack<dim> F;
    PointPack       J;
    bool            with_tangent = true;
  };

  /** What MaterialModel::evaluate_pack() answers: the first two members of
   * StressResponse. The rest is that of elastic volume change. */
  template <int dim>
  struct PackResponse
  {
    SymmetricComponents<dim, PointPack> deviatoric_stress;
    ModulusComponents<dim, PointPack>   tangent;
  };
} // namespace isochor

#endif
