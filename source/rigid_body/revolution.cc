/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/rigid_body/revolution.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  Tensor<1, dim>
  Revolution<dim>::across() const
  {
    if constexpr (dim == 2)
      return Tensor<1, 2>({axis[1], -axis[0]});
    else
      {
        unsigned int least = 0;
        for (unsigned int d = 1; d < dim; ++d)
          if (std::abs(axis[d]) < std::abs(axis[least]))
            least = d;
        Tensor<1, dim> e;
        e[least] = 1;
        e        = cross_product_3d(e, axis);
        return e / e.norm();
      }
  }



  template <int dim>
  ClosestPoint<dim>
  Revolution<dim>::closest(const Point<dim> &x) const
  {
    const Tensor<1, dim> arm     = x - origin;
    const double         z       = arm * axis;
    Tensor<1, dim>       radial  = across();
    double               r       = arm * radial;
    bool                 on_axis = true;
    if constexpr (dim == 3)
      {
        const Tensor<1, dim> from_axis = arm - z * axis;
        r                              = from_axis.norm();
        on_axis                        = r == 0;
        if (!on_axis)
          radial = from_axis / r;
      }
    const ClosestPoint<2> flat = outline.closest(Point<2>(r, z));
    ClosestPoint<dim>     result;
    result.distance = flat.distance;
    result.point    = origin + flat.point[0] * radial + flat.point[1] * axis;
    result.normal   = flat.normal[0] * radial + flat.normal[1] * axis;
    const auto &H   = flat.curvature;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          result.curvature[i][j] =
            H[0][0] * radial[i] * radial[j] + H[1][1] * axis[i] * axis[j] +
            H[0][1] * (radial[i] * axis[j] + axis[i] * radial[j]);
          // round the axis the normal turns with the radial direction
          if (dim == 3)
            result.curvature[i][j] +=
              (on_axis ? H[0][0] : flat.normal[0] / r) *
              ((i == j ? 1. : 0.) - radial[i] * radial[j] - axis[i] * axis[j]);
        }
    return result;
  }



  template <int dim>
  std::vector<typename RigidShape<dim>::Facet>
  Revolution<dim>::surface() const
  {
    std::vector<typename RigidShape<dim>::Facet> facets;
    const Tensor<1, dim>                         e = across();
    // places on the axis are so up to rounding
    const double zero = 1e-12 * outline.box().get_boundary_points().second[0];
    for (auto [a, b] : outline.segments())
      {
        if constexpr (dim == 2)
          facets.push_back({{origin + a[0] * e + a[1] * axis,
                             origin + b[0] * e + b[1] * axis}});
        else
          {
            // half of the outline, up to the axis
            if (a[0] <= zero && b[0] <= zero)
              continue;
            for (auto [end, other] : {std::make_pair(&a, &b), {&b, &a}})
              if ((*end)[0] < 0)
                {
                  const double s = (*end)[0] / ((*end)[0] - (*other)[0]);
                  *end           = *end + s * (*other - *end);
                  (*end)[0]      = 0;
                }
            constexpr unsigned int n = 48;
            const Tensor<1, dim>   f = cross_product_3d(axis, e);
            const auto at = [&](const Point<2> &p, const unsigned int k) {
              const double angle = 2 * numbers::PI * (k % n) / n;
              return Point<dim>(origin + p[1] * axis +
                                p[0] *
                                  (std::cos(angle) * e + std::sin(angle) * f));
            };
            for (unsigned int k = 0; k < n; ++k)
              {
                if (a[0] > zero)
                  facets.push_back({{at(a, k), at(a, k + 1), at(b, k)}});
                if (b[0] > zero)
                  facets.push_back({{at(b, k), at(a, k + 1), at(b, k + 1)}});
              }
          }
      }
    return facets;
  }



  template <int dim>
  BoundingBox<dim>
  Revolution<dim>::box() const
  {
    const auto       section = outline.box().get_boundary_points();
    const double     r       = section.second[0];
    const Point<dim> a(origin + section.first[1] * axis),
      b(origin + section.second[1] * axis);
    Point<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double aside = r * std::sqrt(std::max(0., 1 - axis[d] * axis[d]));
        lower[d]           = std::min(a[d], b[d]) - aside;
        upper[d]           = std::max(a[d], b[d]) + aside;
      }
    return BoundingBox<dim>({lower, upper});
  }



  template struct Revolution<2>;
  template struct Revolution<3>;
} // namespace isochor
