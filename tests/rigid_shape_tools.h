/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_rigid_shape_tools_h
#define isochor_tests_rigid_shape_tools_h

// What is true of the distance from any shape, tested against its facets.

#include <isochor/rigid_body/rigid_shape.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "material_test_tools.h"

namespace isochor
{
  namespace test
  {
    /** The shape with the lines of @p settings, "Name = value". */
    template <int dim>
    std::unique_ptr<RigidShape<dim>>
    make_shape(const std::string &settings)
    {
      ParameterHandler prm;
      RigidShape<dim>::declare_shapes(prm);
      std::string        lines;
      std::istringstream text(settings);
      for (std::string line; std::getline(text, line);)
        lines += "set " + line + '\n';
      prm.parse_input_from_string(lines);
      return RigidShape<dim>::create(prm, "Rigid body: tool");
    }

    /** The distance of @p x from a facet: a convex function of the place on it,
     * of which ever finer samples find the least value. */
    template <int dim>
    double
    distance_of_facet(const std::array<dealii::Point<dim>, dim> &facet,
                      const dealii::Point<dim>                  &x)
    {
      double best = 1e300, at[2] = {0.5, dim == 2 ? 0. : 0.5}, width = 0.5;
      for (unsigned int level = 0; level < 40; ++level, width *= 0.6)
        {
          double found[2] = {at[0], at[1]};
          for (int i = -4; i <= 4; ++i)
            for (int j = (dim == 2 ? 0 : -4); j <= (dim == 2 ? 0 : 4); ++j)
              {
                const double s = std::clamp(at[0] + width * i / 4, 0., 1.);
                const double t =
                  dim == 2 ? 0. : std::clamp(at[1] + width * j / 4, 0., 1 - s);
                dealii::Point<dim> y = facet[0] + s * (facet[1] - facet[0]);
                if (dim == 3)
                  y += t * (facet[dim - 1] - facet[0]);
                if (x.distance(y) < best)
                  {
                    best     = x.distance(y);
                    found[0] = s;
                    found[1] = t;
                  }
              }
          at[0] = found[0];
          at[1] = found[1];
        }
      return best;
    }

    /** How often the facets go round @p x: 1 inside of a closed surface, 0
     * outside (in 3D by the solid angle, van Oosterom & Strackee, IEEE Trans.
     * Biomed. Eng. 30 (1983) 125-126). */
    template <int dim>
    double
    winding(const std::vector<std::array<dealii::Point<dim>, dim>> &facets,
            const dealii::Point<dim>                               &x)
    {
      double sum = 0;
      for (const auto &facet : facets)
        {
          const Tensor<1, dim> a = facet[0] - x, b = facet[1] - x;
          if constexpr (dim == 2)
            sum +=
              std::atan2(a[0] * b[1] - a[1] * b[0], a * b) / (2 * numbers::PI);
          else
            {
              const Tensor<1, dim> c = facet[2] - x;
              const double         u = a.norm(), v = b.norm(), w = c.norm();
              sum += std::atan2(a * cross_product_3d(b, c),
                                u * v * w + (a * b) * w + (b * c) * u +
                                  (c * a) * v) /
                     (2 * numbers::PI);
            }
        }
      return sum;
    }

    /** What a test of one shape needs to know. */
    template <int dim>
    struct ShapeTest
    {
      std::string        name;
      dealii::Point<dim> middle;
      double             size      = 1;    ///< places are at most that far away
      double             tolerance = 1e-9; ///< of facets: they are chords
      unsigned int       n_places  = 200;
      bool               is_closed = true;
      double             reach     = 50;
      /** How exact gradients have to be. */
      double differences = 1e-6;
    };

    /** Of @p shape: distances from facets, the sign, the nearest place,
     * gradients and Hessians. */
    template <int dim>
    void
    test_shape(const RigidShape<dim> &shape, const ShapeTest<dim> &test)
    {
      const auto facets = shape.surface(test.reach);
      Random     random;
      WorstError distance, sign, nearest, gradient, hessian, on_surface, in_box;
      unsigned int n_smooth = 0, n_inside = 0;
      for (const auto &facet : facets)
        for (const auto &corner : facet)
          on_surface.add(std::abs(shape.closest(corner).distance), "corner");
      for (unsigned int n = 0; n < test.n_places; ++n)
        {
          dealii::Point<dim> x = test.middle;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += test.size * random();
          std::ostringstream where;
          where << x;
          const ClosestPoint<dim> at      = shape.closest(x);
          double                  sampled = 1e300;
          for (const auto &facet : facets)
            {
              double nearest_corner = 1e300, edge = 0;
              for (unsigned int i = 0; i < dim; ++i)
                {
                  nearest_corner =
                    std::min(nearest_corner, x.distance(facet[i]));
                  edge =
                    std::max(edge, facet[i].distance(facet[(i + 1) % dim]));
                }
              if (nearest_corner - edge < sampled)
                sampled = std::min(sampled, distance_of_facet<dim>(facet, x));
            }
          distance.add(std::abs(sampled - std::abs(at.distance)), where.str());
          if (test.is_closed && std::abs(at.distance) > 2 * test.tolerance)
            sign.add(std::abs(winding<dim>(facets, x) -
                              (at.distance < 0 ? 1. : 0.)),
                     where.str());
          n_inside += (at.distance < 0);
          nearest.add((x - at.point - at.distance * at.normal).norm() +
                        std::abs(at.normal.norm() - 1),
                      where.str());
          if (at.distance < 0)
            in_box.add(shape.box().point_inside(x) ? 0. : 1., where.str());
          // differences mean something where no kink is near
          const double h     = 1e-5 * test.size;
          double       error = 0, turn = 0, kink = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              dealii::Point<dim> p = x, m = x;
              p[d] += h;
              m[d] -= h;
              const auto plus = shape.closest(p), minus = shape.closest(m);
              error =
                std::max(error,
                         std::abs((plus.distance - minus.distance) / (2 * h) -
                                  at.normal[d]));
              const Tensor<1, dim> change =
                (plus.normal - minus.normal) / (2 * h);
              for (unsigned int i = 0; i < dim; ++i)
                turn = std::max(turn, std::abs(change[i] - at.curvature[i][d]));
              kink = std::max(kink,
                              (plus.curvature - minus.curvature).norm() * h +
                                (plus.normal - minus.normal).norm());
            }
          if (kink > 1e-3)
            continue;
          ++n_smooth;
          gradient.add(error, where.str());
          hessian.add(turn * test.size, where.str());
        }
      on_surface.report(test.name + ": facets are on the surface", 1e-9);
      distance.report(test.name + ": distance of the facets", test.tolerance);
      if (test.is_closed)
        sign.report(test.name + ": sign by the winding number", 1e-6);
      nearest.report(test.name + ": nearest place", 1e-12 * test.size * 100);
      gradient.report(test.name + ": normal by differences", test.differences);
      hessian.report(test.name + ": curvature by differences",
                     100 * test.differences);
      in_box.report(test.name + ": box", 0.5);
      report(test.name + ": places inside and outside, most without a kink",
             n_inside > test.n_places / 20 &&
               n_inside < 19 * test.n_places / 20 &&
               n_smooth > 4 * test.n_places / 5,
             std::to_string(n_inside) + " inside, " + std::to_string(n_smooth) +
               " smooth");
    }

    /** @p action throws a message with all of @p words in it. */
    inline void
    expect_error(const std::string              &what,
                 const std::vector<std::string> &words,
                 const std::function<void()>    &action)
    {
      std::string message = "no error";
      try
        {
          action();
        }
      catch (const std::exception &exc)
        {
          message = exc.what();
        }
      // deal.II breaks the lines of messages anywhere
      std::string        text, part;
      std::istringstream parts(message);
      while (parts >> part)
        text += part + ' ';
      bool ok = true;
      for (const std::string &word : words)
        ok = ok && text.find(word) != std::string::npos;
      report(what, ok, text);
    }
  } // namespace test
} // namespace isochor

#endif
