/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/rtree.h>

#include <isochor/base/expression.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/grid/structured_grid.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <memory>

namespace isochor
{
  /** Where a formula φ(x, y(, z)) is negative. Its derivatives are differences;
   * the nearest place of the surface is found by Newton's method. */
  template <int dim>
  class FormulaShape : public RigidShape<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Formula",
                        "",
                        Patterns::Anything(),
                        "A smooth formula in x, y(, z), negative within the "
                        "rigid body and positive outside. Its values need not "
                        "be distances.");
      RigidShape<dim>::declare_corners(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      lower = this->get_place(prm, "Lower corner");
      upper = this->get_place(prm, "Upper corner");
      for (unsigned int d = 0; d < dim; ++d)
        this->check(upper[d] > lower[d],
                    "Upper corner",
                    "must exceed <" + this->parameter("Lower corner") +
                      "> in every coordinate: both are the corners of the "
                      "region that holds the surface of a formula.");
      step = 1e-4 * lower.distance(upper);
      phi  = std::make_unique<Expression<dim>>(prm.get("Formula"),
                                              this->parameter("Formula"),
                                              FormulaVariables::space);
      const auto              facets = surface(0);
      std::vector<Point<dim>> corners;
      for (const auto &facet : facets)
        corners.insert(corners.end(), facet.begin(), facet.end());
      samples = pack_rtree(corners);
      this->check(!facets.empty(),
                  "Formula",
                  "is zero nowhere between <" +
                    this->parameter("Lower corner") + "> and <Upper corner>.");
    }

    ClosestPoint<dim>
    closest(const Point<dim> &x) const override;

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double reach) const override;

    BoundingBox<dim>
    box() const override
    {
      const BoundingBox<dim> region({lower, upper});
      for (unsigned int v = 0; v < GeometryInfo<dim>::vertices_per_cell; ++v)
        if (value(region.vertex(v)) < 0)
          return this->unbounded();
      return region;
    }

    Point<dim>
    centre() const override
    {
      return Point<dim>(lower + (upper - lower) / 2);
    }

  private:
    double
    value(const Point<dim> &x) const
    {
      return (*phi)(x, 0.);
    }
    Tensor<1, dim>
    gradient(const Point<dim> &x) const;
    SymmetricTensor<2, dim>
    hessian(const Point<dim> &x) const;
    /** Bring @p p to the place of the surface that is nearest to @p x: x - p is
     * normal to it. False if that isn't found. */
    bool
    find_nearest(const Point<dim> &x, Point<dim> &p) const;
    void
    cut(const std::vector<Point<dim>>                &corners,
        std::vector<typename RigidShape<dim>::Facet> &facets) const;

    Point<dim>                       lower, upper;
    double                           step = 0; ///< of differences
    std::unique_ptr<Expression<dim>> phi;
    RTree<Point<dim>>                samples; ///< places of the surface
  };



  template <int dim>
  Tensor<1, dim>
  FormulaShape<dim>::gradient(const Point<dim> &x) const
  {
    Tensor<1, dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto at = [&](const int k) {
          Point<dim> y = x;
          y[d] += k * step;
          return value(y);
        };
        // of fourth order
        result[d] = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * step);
      }
    return result;
  }



  template <int dim>
  SymmetricTensor<2, dim>
  FormulaShape<dim>::hessian(const Point<dim> &x) const
  {
    SymmetricTensor<2, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          const auto at = [&](const int k, const int l) {
            Point<dim> y = x;
            y[i] += k * step;
            y[j] += l * step;
            return value(y);
          };
          result[i][j] =
            i == j ? (at(1, 0) - 2 * value(x) + at(-1, 0)) / (step * step) :
                     (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) /
                       (4 * step * step);
        }
    return result;
  }



  template <int dim>
  bool
  FormulaShape<dim>::find_nearest(const Point<dim> &x, Point<dim> &p) const
  {
    constexpr unsigned int most   = 30;
    const double           size   = lower.distance(upper);
    double                 lambda = 0;
    for (unsigned int n = 0; n < most; ++n)
      {
        // p - x + λ∇φ(p) = 0, φ(p) = 0
        const Tensor<1, dim>          g = gradient(p);
        const SymmetricTensor<2, dim> H = hessian(p);
        if (g.norm() == 0)
          return false;
        if (n == 0)
          lambda = (x - p) * g / g.norm_square();
        FullMatrix<double> matrix(dim + 1), inverse(dim + 1);
        Vector<double>     residual(dim + 1), change(dim + 1);
        for (unsigned int i = 0; i < dim; ++i)
          {
            for (unsigned int j = 0; j < dim; ++j)
              matrix(i, j) = (i == j ? 1. : 0.) + lambda * H[i][j];
            matrix(i, dim) = matrix(dim, i) = g[i];
            residual[i]                     = p[i] - x[i] + lambda * g[i];
          }
        residual[dim] = value(p);
        inverse.invert(matrix);
        inverse.vmult(change, residual);
        if (!std::isfinite(change.l2_norm())) // a singular matrix
          return false;
        Tensor<1, dim> way;
        for (unsigned int i = 0; i < dim; ++i)
          way[i] = change[i];
        // no further than the region is large
        const double share =
          std::min(1., size / (4 * way.norm() + rounding::arithmetic));
        p -= share * way;
        lambda -= share * change[dim];
        if (way.norm() <= rounding::arithmetic * size)
          return true;
      }
    return false;
  }



  template <int dim>
  ClosestPoint<dim>
  FormulaShape<dim>::closest(const Point<dim> &x) const
  {
    ClosestPoint<dim>    result;
    const double         at_x = value(x);
    const Tensor<1, dim> g_x  = gradient(x);
    // Newton's method begins at the nearest corner of a facet
    const auto nearest = samples.qbegin(boost::geometry::index::nearest(x, 1));
    Point<dim> p       = *nearest;
    const bool found   = find_nearest(x, p);
    Tensor<1, dim> g   = found ? gradient(p) : g_x;
    if (g.norm() == 0)
      g[0] = 1; // where φ is stationary all directions are as good
    const double slope = g.norm();
    result.normal      = g / slope;
    // to first order where no nearest place is found
    result.distance = found ? (x - p) * result.normal : at_x / slope;
    result.point    = x - result.distance * result.normal;

    // of the surface: P ∇∇φ P / |∇φ| with P = 1 - n ⊗ n; of the distance at x:
    // K (1 + d K)⁻¹
    const Tensor<2, dim> one = unit_symmetric_tensor<dim>(),
                         P = one - outer_product(result.normal, result.normal);
    const Tensor<2, dim> K =
      P * Tensor<2, dim>(hessian(found ? p : x)) * P / slope;
    const Tensor<2, dim> M = one + result.distance * K;
    if (found && determinant(M) != 0)
      result.curvature = symmetrize(K * invert(M));
    else
      result.curvature = symmetrize(K);
    return result;
  }



  template <int dim>
  void
  FormulaShape<dim>::cut(
    const std::vector<Point<dim>>                &corners,
    std::vector<typename RigidShape<dim>::Facet> &facets) const
  {
    std::vector<unsigned int> inside, outside;
    std::vector<double>       values;
    for (unsigned int v = 0; v <= dim; ++v)
      {
        values.push_back(value(corners[v]));
        (values[v] < 0 ? inside : outside).push_back(v);
      }
    // where edges of the simplex meet the surface
    std::vector<Point<dim>> places;
    for (const unsigned int i : inside)
      for (const unsigned int o : outside)
        {
          const auto at = [&](const double s) {
            return Point<dim>(corners[i] + s * (corners[o] - corners[i]));
          };
          std::uintmax_t n    = 50;
          const auto     root = boost::math::tools::toms748_solve(
            [&](const double s) { return value(at(s)); },
            0.,
            1.,
            values[i],
            values[o],
            boost::math::tools::eps_tolerance<double>(40),
            n);
          places.push_back(at(root.first));
        }
    const auto add = [&](typename RigidShape<dim>::Facet facet) {
      Tensor<1, dim> towards;
      for (const unsigned int o : outside)
        for (const unsigned int i : inside)
          towards += corners[o] - corners[i];
      Tensor<1, dim> normal;
      if constexpr (dim == 2)
        normal =
          Tensor<1, 2>({facet[1][1] - facet[0][1], facet[0][0] - facet[1][0]});
      else
        normal = cross_product_3d(facet[1] - facet[0], facet[2] - facet[0]);
      if (normal * towards < 0)
        std::swap(facet[0], facet[1]);
      facets.push_back(facet);
    };
    if constexpr (dim == 2)
      {
        if (places.size() == 2)
          add({{places[0], places[1]}});
      }
    else if (places.size() >= 3)
      {
        add({{places[0], places[1], places[2]}});
        if (places.size() == 4)
          add({{places[1], places[3], places[2]}});
      }
  }



  template <int dim>
  std::vector<typename RigidShape<dim>::Facet>
  FormulaShape<dim>::surface(const double /*reach*/) const
  {
    // a lattice over the region, in which each simplex is cut
    const StructuredGrid<dim> grid(
      std::vector<unsigned int>(dim, dim == 2 ? 48 : 16), {});
    const auto vertices = grid.vertices([&](const Point<dim> &unit) {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = lower[d] + unit[d] * (upper[d] - lower[d]);
      return x;
    });
    std::vector<typename RigidShape<dim>::Facet> facets;
    for (const auto &cell : grid.cells(vertices, "/"))
      {
        std::vector<Point<dim>> corners;
        for (const unsigned int v : cell.vertices)
          corners.push_back(vertices[v]);
        cut(corners, facets);
      }
    return facets;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, FormulaShape, "formula")
} // namespace isochor
