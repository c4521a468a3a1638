/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/revolution.h>

namespace isochor
{
  /** A circle or a sphere. */
  template <int dim>
  class Circle : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      RigidShape<dim>::declare_place(prm,
                                     "Centre",
                                     "The centre (m) of a circle.");
      RigidShape<dim>::declare_radius(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      middle = this->get_place(prm, "Centre");
      radius = this->get_positive(prm, "Radius");
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      ClosestPoint<dim>    result;
      const Tensor<1, dim> arm      = x - middle;
      const double         distance = arm.norm();
      result.distance               = distance - radius;
      if (distance > 0)
        {
          result.normal    = arm / distance;
          result.curvature = rounded_curvature(distance, result.normal);
        }
      else
        result.normal[0] = 1; // of all that are equally near
      result.point = middle + radius * result.normal;
      return result;
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double /*reach*/) const override
    {
      Revolution<dim> round;
      round.origin        = middle;
      round.axis[dim - 1] = 1;
      // a square, rounded to a circle
      std::vector<Outline::Corner> square;
      for (const auto &[x, y] : {std::make_pair(-radius, -radius),
                                 {radius, -radius},
                                 {radius, radius},
                                 {-radius, radius}})
        square.push_back({Point<2>(x, y), radius});
      round.outline = Outline(square, true, "a circle");
      return round.surface();
    }

    BoundingBox<dim>
    box() const override
    {
      Tensor<1, dim> half;
      for (unsigned int d = 0; d < dim; ++d)
        half[d] = radius;
      return BoundingBox<dim>(
        {Point<dim>(middle - half), Point<dim>(middle + half)});
    }

  private:
    Point<dim> middle;
    double     radius = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, Circle, "circle")
} // namespace isochor
