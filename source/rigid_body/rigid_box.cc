/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <cmath>

namespace isochor
{
  /** A rectangle or a cuboid along the axes, whose edges may be rounded: the
   * places that are at most the radius away from a smaller box. */
  template <int dim>
  class RigidBox : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      RigidShape<dim>::declare_corners(prm);
      RigidShape<dim>::declare_edge_radius(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const Point<dim> lower = this->get_place(prm, "Lower corner"),
                       upper = this->get_place(prm, "Upper corner");
      radius                 = prm.get_double("Edge radius");
      for (unsigned int d = 0; d < dim; ++d)
        {
          this->check(upper[d] > lower[d],
                      "Upper corner",
                      "must exceed <" + this->parameter("Lower corner") +
                        "> in every coordinate.");
          this->check(2 * radius <= upper[d] - lower[d],
                      "Edge radius",
                      "must not exceed half of the box.");
          middle[d] = (lower[d] + upper[d]) / 2;
          half[d]   = (upper[d] - lower[d]) / 2;
        }
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      // how far x is outside of the smaller box along the axes
      Tensor<1, dim> beyond, side;
      unsigned int   most = 0, n_outside = 0, outside = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          side[d]   = x[d] >= middle[d] ? 1. : -1.;
          beyond[d] = std::abs(x[d] - middle[d]) - (half[d] - radius);
          if (beyond[d] > beyond[most])
            most = d;
          if (beyond[d] > 0)
            {
              ++n_outside;
              outside = d;
            }
        }
      ClosestPoint<dim> result;
      if (n_outside < 2)
        {
          const unsigned int d = n_outside == 1 ? outside : most;
          result.distance      = beyond[d] - radius;
          result.normal[d]     = side[d];
        }
      else
        {
          for (unsigned int d = 0; d < dim; ++d)
            if (beyond[d] > 0)
              result.normal[d] = side[d] * beyond[d];
          const double away = result.normal.norm();
          result.distance   = away - radius;
          result.normal /= away;
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              if (beyond[i] > 0 && beyond[j] > 0 &&
                  away > rounding::arithmetic * half.norm())
                result.curvature[i][j] =
                  ((i == j ? 1. : 0.) - result.normal[i] * result.normal[j]) /
                  away;
        }
      result.point = x - result.distance * result.normal;
      return result;
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double /*reach*/) const override
    {
      std::vector<typename RigidShape<dim>::Facet> facets;
      for (unsigned int d = 0; d < dim; ++d)
        for (const double side : {-1., 1.})
          add_face(d, side, facets);
      return facets;
    }

    BoundingBox<dim>
    box() const override
    {
      return BoundingBox<dim>(
        {Point<dim>(middle - half), Point<dim>(middle + half)});
    }

  private:
    /** Lines of the box along axis @p d, dense where it is rounded. */
    std::vector<double>
    lines(const unsigned int d) const
    {
      constexpr unsigned int n = 6;
      std::vector<double>    result;
      for (unsigned int k = 0; k <= n; ++k)
        // even in the angle
        result.push_back(
          radius * (1 - std::tan((n - k) * numbers::PI / (4 * n))) - half[d]);
      if (radius == 0)
        result.assign(1, -half[d]);
      for (unsigned int k = result.size(); k > 0; --k)
        if (result[k - 1] < 0)
          result.push_back(-result[k - 1]);
      return result;
    }

    /** The facets of one side: those of the sharp box, moved to the surface. */
    void
    add_face(const unsigned int                            d,
             const double                                  side,
             std::vector<typename RigidShape<dim>::Facet> &facets) const
    {
      const unsigned int a = (d + 1) % dim, b = (d + 2) % dim;
      const auto         at = [&](const double s, const double t) {
        Point<dim> x(middle);
        x[d] += side * half[d];
        x[a] += s;
        if (dim == 3)
          x[b] += t;
        return closest(x).point;
      };
      const auto first = lines(a), second = lines(b);
      for (unsigned int i = 0; i + 1 < first.size(); ++i)
        if constexpr (dim == 2)
          {
            // with the box on the left
            const bool forwards = (d == 0) == (side > 0);
            facets.push_back({{at(first[forwards ? i : i + 1], 0),
                               at(first[forwards ? i + 1 : i], 0)}});
          }
        else
          for (unsigned int j = 0; j + 1 < second.size(); ++j)
            {
              const auto p = at(first[i], second[j]),
                         q = at(first[i + 1], second[j]),
                         r = at(first[i + 1], second[j + 1]),
                         s = at(first[i], second[j + 1]);
              if (side > 0)
                facets.insert(facets.end(), {{{p, q, r}}, {{p, r, s}}});
              else
                facets.insert(facets.end(), {{{p, r, q}}, {{p, s, r}}});
            }
    }

    Point<dim>     middle;
    Tensor<1, dim> half;
    double         radius = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, RigidBox, "box")
} // namespace isochor
