/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_volume_error_h
#define isochor_volume_error_h

#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  /** How far the volumes of points are from what the pressure asks for, u-p:
   * root mean squares of e = θ^e - p/K over the body, and over where it is
   * sheared, weighted with |dev b|/(tr b/3), b = F Fᵀ: a neck, or the soil
   * around a pile, is a small part of its body. */
  struct VolumeError
  {
    double in_body = 0, in_shear = 0;

    double
    largest() const
    {
      return std::max(in_body, in_shear);
    }
  };

  /** θ^e - p/K of a point of @p material that has the @p state. */
  template <int dim>
  double
  excess_of_volume(const typename MixedKernel<dim>::PointState &state,
                   const MaterialModel<dim>                    &material)
  {
    return state.volumetric_strain -
           state.pressure * material.inverse_bulk_modulus();
  }

  /** The same by point of @p step.points, at the end of the step that its nodes
   * go through with @p unknowns. */
  template <int dim>
  std::vector<double>
  volume_excesses(const StepContext<dim> &step, const NodalField &unknowns);

  /** Of the @p excesses e of the @p points; 0 if none is larger than
   * @p negligible, as no mean then is. Collective. */
  template <int dim>
  VolumeError
  volume_error(const StepContext<dim>    &step,
               const MaterialPoints<dim> &points,
               const std::vector<double> &excesses,
               const double               negligible);
} // namespace isochor

#endif
