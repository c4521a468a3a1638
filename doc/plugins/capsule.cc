/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A rigid shape of one's own: all that is at most a radius away from a segment
// (Rigid body: NAME/Shape = capsule).

#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/revolution.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  class Capsule : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      // a parameter that others have, too, and one of its own
      RigidShape<dim>::declare_radius(prm);
      prm.declare_entry(
        "Segment",
        "0, 1, 0",
        Patterns::List(Patterns::Double(), 3, 3),
        "The axis of a capsule: its least x, its largest x, and "
        "its y (m).");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      radius             = this->get_positive(prm, "Radius");
      const auto numbers = Utilities::string_to_double(
        Utilities::split_string_list(prm.get("Segment")));
      this->check(numbers[1] > numbers[0],
                  "Segment",
                  "must have the least x before the largest.");
      begin[0] = numbers[0];
      end[0]   = numbers[1];
      begin[1] = end[1] = numbers[2];
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      ClosestPoint<dim> result;
      Point<dim>        foot        = begin; // the nearest place of the segment
      foot[0]                       = std::clamp(x[0], begin[0], end[0]);
      const Tensor<1, dim> arm      = x - foot;
      const double         distance = arm.norm();
      result.normal[1]              = 1; // for places on the segment itself
      Tensor<1, dim> edge;               // beside the segment, not at its ends
      edge[0] = (x[0] > begin[0] && x[0] < end[0] ? 1 : 0);
      if (distance > 0)
        {
          result.normal    = arm / distance;
          result.curvature = rounded_curvature(distance, result.normal, edge);
        }
      result.distance = distance - radius;
      result.point    = foot + radius * result.normal;
      return result;
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double /*reach*/) const override
    {
      // a rectangle whose corners are rounded to the last, around its axis
      const double                 z = end[0] - begin[0] + 2 * radius;
      std::vector<Outline::Corner> corners;
      for (const auto &corner : {Point<2>(-radius, 0),
                                 Point<2>(radius, 0),
                                 Point<2>(radius, z),
                                 Point<2>(-radius, z)})
        corners.push_back({corner, radius});
      Revolution<dim> solid;
      solid.origin = begin;
      solid.origin[0] -= radius;
      solid.axis[0] = 1;
      solid.outline = Outline(corners, true, "a capsule");
      return solid.surface();
    }

    BoundingBox<dim>
    box() const override
    {
      Point<dim> lower = begin, upper = end;
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] -= radius;
          upper[d] += radius;
        }
      return BoundingBox<dim>({lower, upper});
    }

  private:
    Point<dim> begin, end;
    double     radius = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, Capsule, "capsule")
} // namespace isochor
