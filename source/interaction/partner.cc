/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/partner.h>

namespace isochor
{
  template <int dim>
  PartnerPlace<dim>
  nearest_place(const double                   distance,
                const Tensor<1, dim>          &n,
                const SymmetricTensor<2, dim> &curvature,
                const Tensor<1, dim>          &slip,
                const Tensor<2, dim>          &slip_by_x)
  {
    const Tensor<2, dim> H   = curvature;
    const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
    const Tensor<2, dim> T   = one - outer_product(n, n);
    const double         s_n = slip * n;
    PartnerPlace<dim>    place;
    place.normal      = n;
    place.normal_gap  = distance;
    place.gap         = distance * n + slip - s_n * n;
    place.normal_by_x = H;
    // δ(T s) = T δs - (s·n) δn - (s·δn) n
    place.gap_by_x = outer_product(n, n) + (distance - s_n) * H +
                     T * slip_by_x - outer_product(n, slip * H);
    return place;
  }



  template PartnerPlace<2>
  nearest_place(const double,
                const Tensor<1, 2> &,
                const SymmetricTensor<2, 2> &,
                const Tensor<1, 2> &,
                const Tensor<2, 2> &);
  template PartnerPlace<3>
  nearest_place(const double,
                const Tensor<1, 3> &,
                const SymmetricTensor<2, 3> &,
                const Tensor<1, 3> &,
                const Tensor<2, 3> &);
} // namespace isochor
