/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_face_projection_h
#define isochor_face_projection_h

#include <isochor/interaction/face_copies.h>
#include <isochor/interaction/interaction_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace isochor
{
  /**
   * Where a place x is on the plane of a face with the corners y_i:
   *   x - y(ξ) = g_n n,  y(ξ) = y_0 + Σ ξ^α τ_α,  τ_α = y_α - y_0,
   * n the outward unit normal of the face. ξ is not bound to the face.
   */
  template <int dim>
  struct FaceProjection
  {
    static constexpr unsigned int n_tangents = dim - 1;

    Tensor<1, dim> normal;
    double         distance; ///< g_n (m)
    /** From x to the nearest place of the face itself (m²). */
    double                                 distance_square;
    std::array<Tensor<1, dim>, n_tangents> tangent, dual; ///< τ_α, τ^α
    Tensor<2, n_tangents>                  inverse_metric;
    Tensor<1, n_tangents>                  xi;
    std::array<double, dim>                nearest; ///< weights of that place

    FaceProjection(const Point<dim>                  &x,
                   const std::array<Point<dim>, dim> &corners);

    /** From ξ to the face, 0 within it (m). */
    double
    distance_beyond() const
    {
      return std::sqrt(std::max(0., distance_square - distance * distance));
    }

    /** Weights of the corners at ξ. */
    std::array<double, dim>
    corner_weights() const;

    /** How normal and ξ change with a change of x - y at fixed ξ by
     * @p relative and of the tangents by @p of_tangent:
     *   δn = - Σ τ^α (n·δτ_α),  δξ^α = τ^α·δ(x - y) + g_n a^{αβ} n·δτ_β. */
    Tensor<1, dim>
    normal_change(
      const std::array<Tensor<1, dim>, n_tangents> &of_tangent) const;
    Tensor<1, n_tangents>
    xi_change(const Tensor<1, dim>                         &relative,
              const std::array<Tensor<1, dim>, n_tangents> &of_tangent) const;
  };
} // namespace isochor

#endif
