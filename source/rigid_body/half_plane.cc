/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/rigid_shape.h>

namespace isochor
{
  /** All that is behind a plane. */
  template <int dim>
  class HalfPlane : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      RigidShape<dim>::declare_place(prm,
                                     "Point",
                                     "A point (m) of the surface of a half "
                                     "plane.");
      RigidShape<dim>::declare_direction(prm,
                                         "Normal",
                                         "The direction that points out of a "
                                         "half plane. Of any length.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      place  = this->get_place(prm, "Point");
      normal = this->get_direction(prm, "Normal");
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      ClosestPoint<dim> result;
      result.distance = (x - place) * normal;
      result.point    = x - result.distance * normal;
      result.normal   = normal;
      return result;
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double reach) const override
    {
      if constexpr (dim == 2)
        {
          const Tensor<1, 2> along({-normal[1], normal[0]});
          return {{{place - reach * along, place + reach * along}}};
        }
      else
        {
          // along the axis that is least across the plane
          unsigned int least = 0;
          for (unsigned int d = 1; d < dim; ++d)
            if (std::abs(normal[d]) < std::abs(normal[least]))
              least = d;
          Tensor<1, 3> axis;
          axis[least] = 1;
          auto a      = cross_product_3d(axis, normal);
          a *= reach / a.norm();
          const auto       b = cross_product_3d(normal, a);
          const Point<dim> first(place - a - b), third(place + a + b);
          return {{{first, place + a - b, third}},
                  {{first, third, place - a + b}}};
        }
    }

    BoundingBox<dim>
    box() const override
    {
      return this->unbounded();
    }

    Point<dim>
    centre() const override
    {
      return place;
    }

  private:
    Point<dim>     place;
    Tensor<1, dim> normal;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, HalfPlane, "half plane")
} // namespace isochor
