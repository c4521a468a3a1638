/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/quadrature_lib.h>

#include <isochor/material_points/point_domain.h>
#include <isochor/material_points/seeding.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace isochor
{
  namespace
  {
    /** The k for which n_points = k^dim, 0 if there is none. */
    template <int dim>
    unsigned int
    subdivisions(const unsigned int n_points)
    {
      const unsigned int k = std::round(std::pow(n_points, 1. / dim));
      return std::round(std::pow(k, dim)) == n_points ? k : 0;
    }

    /** Corners of the subdivision of the simplex 1 >= x_1 >= ... >= x_dim >= 0
     * into k^dim Kuhn simplices, mapped to the unit simplex. */
    template <int dim>
    std::vector<std::array<Point<dim>, dim + 1>>
    subdivide(const unsigned int k)
    {
      std::vector<std::array<Point<dim>, dim + 1>> simplices;
      std::array<unsigned int, dim>                axes;
      std::iota(axes.begin(), axes.end(), 0);
      const unsigned int n_boxes = std::pow(k, dim) + 0.5;
      do
        for (unsigned int box = 0; box < n_boxes; ++box)
          {
            // the path x, x + e_a0, x + e_a0 + e_a1, ... and its centroid
            std::array<Point<dim>, dim + 1> path;
            Point<dim>                      centroid;
            unsigned int                    rest = box;
            for (unsigned int d = 0; d < dim; ++d, rest /= k)
              path[0][d] = rest % k;
            for (unsigned int d = 0; d < dim; ++d)
              {
                path[d + 1] = path[d];
                path[d + 1][axes[d]] += 1;
              }
            for (const Point<dim> &corner : path)
              centroid += corner / (dim + 1.);
            bool inside = true;
            for (unsigned int d = 0; d + 1 < dim; ++d)
              inside = inside && centroid[d] > centroid[d + 1];
            if (!inside)
              continue;
            // the vertices e_1, e_1 + e_2, ... go to e_1, e_2, ...
            for (Point<dim> &x : path)
              for (unsigned int d = 0; d < dim; ++d)
                x[d] = (x[d] - (d + 1 < dim ? x[d + 1] : 0.)) / k;
            simplices.push_back(path);
          }
      while (std::next_permutation(axes.begin(), axes.end()));
      return simplices;
    }

    /** The dim + 1 simplices between a simplex' centroid and its faces. */
    template <int dim>
    std::vector<std::array<Point<dim>, dim + 1>>
    split_at_centroid(const std::array<Point<dim>, dim + 1> &corners)
    {
      std::vector<std::array<Point<dim>, dim + 1>> parts(dim + 1, corners);
      for (unsigned int f = 0; f <= dim; ++f)
        parts[f][f] = centroid<dim>(corners);
      return parts;
    }

    /** The (dim + 1)! simplices of the barycentric subdivision: each between a
     * vertex, the middle of an edge at it, that of a face at this edge, ... and
     * the centroid. */
    template <int dim>
    std::vector<std::array<Point<dim>, dim + 1>>
    split_barycentrically(const std::array<Point<dim>, dim + 1> &corners)
    {
      std::vector<std::array<Point<dim>, dim + 1>> parts;
      std::array<unsigned int, dim + 1>            order;
      std::iota(order.begin(), order.end(), 0);
      do
        {
          std::array<Point<dim>, dim + 1> part;
          Point<dim>                      sum;
          for (unsigned int i = 0; i <= dim; ++i)
            {
              sum += corners[order[i]];
              part[i] = sum / (i + 1.);
            }
          parts.push_back(part);
        }
      while (std::next_permutation(order.begin(), order.end()));
      return parts;
    }

    /** @p n_points simplices of equal volume that tile the unit simplex: k^dim,
     * or each of these split at its centroid or barycentrically; none if there
     * is no such tiling. */
    template <int dim>
    std::vector<std::array<Point<dim>, dim + 1>>
    tile(const unsigned int n_points)
    {
      if (const unsigned int k = subdivisions<dim>(n_points))
        return subdivide<dim>(k);
      constexpr unsigned int n_barycentric = (dim == 2 ? 6 : 24);
      for (const unsigned int m : {dim + 1u, n_barycentric})
        if (const unsigned int k =
              (n_points % m == 0 ? subdivisions<dim>(n_points / m) : 0))
          {
            std::vector<std::array<Point<dim>, dim + 1>> simplices;
            for (const auto &corners : subdivide<dim>(k))
              for (const auto &part : m == dim + 1 ?
                                        split_at_centroid<dim>(corners) :
                                        split_barycentrically<dim>(corners))
                simplices.push_back(part);
            return simplices;
          }
      return {};
    }

    template <int dim>
    Quadrature<dim>
    centroid_rule(const std::vector<std::array<Point<dim>, dim + 1>> &simplices)
    {
      std::vector<Point<dim>> points;
      for (const auto &corners : simplices)
        points.push_back(centroid<dim>(corners));
      return Quadrature<dim>(points,
                             std::vector<double>(points.size(),
                                                 1. / points.size()));
    }

    /** An orbit of a symmetric rule on the triangle: all permutations of the
     * barycentric coordinates (a, b, 1-a-b), each with weight w. */
    struct Orbit
    {
      double a, b, w;
    };

    Quadrature<2>
    dunavant_rule(const std::vector<Orbit> &orbits)
    {
      std::vector<Point<2>> points;
      std::vector<double>   weights;
      for (const Orbit &orbit : orbits)
        {
          std::array<double, 3> l = {{orbit.a, orbit.b, 1 - orbit.a - orbit.b}};
          // equal coordinates to the last bit, for next_permutation
          for (double &value : l)
            if (std::abs(value - l[0]) < 1e-12)
              value = l[0];
          std::sort(l.begin(), l.end());
          do
            {
              points.emplace_back(l[0], l[1]);
              weights.push_back(orbit.w);
            }
          while (std::next_permutation(l.begin(), l.end()));
        }
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
      for (double &weight : weights)
        weight /= sum;
      return Quadrature<2>(points, weights);
    }

    /** The symmetric rule of degree 2 with dim + 1 points: each lies on the
     * line from the centroid to a vertex, with the barycentric coordinate a for
     * the other vertices, from Σ_q w_q λ_i² = 2 / ((dim+1) (dim+2)). */
    template <int dim>
    Quadrature<dim>
    degree_two_rule()
    {
      const double            a = (1 - 1 / std::sqrt(dim + 2.)) / (dim + 1);
      std::vector<Point<dim>> points(dim + 1);
      for (unsigned int q = 0; q <= dim; ++q)
        for (unsigned int d = 0; d < dim; ++d)
          points[q][d] = (q == d + 1 ? 1 - dim * a : a);
      return Quadrature<dim>(points,
                             std::vector<double>(dim + 1, 1. / (dim + 1)));
    }

    /** deal.II's weights sum to the measure of the reference simplex. */
    template <int dim>
    Quadrature<dim>
    normalised(const Quadrature<dim> &rule)
    {
      std::vector<double> weights = rule.get_weights();
      const double sum = std::accumulate(weights.begin(), weights.end(), 0.);
      for (double &weight : weights)
        weight /= sum;
      return Quadrature<dim>(rule.get_points(), weights);
    }
  } // namespace



  template <int dim>
  Quadrature<dim>
  material_point_rule(const unsigned int n_points, const std::string &subject)
  {
    if (const unsigned int k = subdivisions<dim>(n_points))
      return centroid_rule<dim>(subdivide<dim>(k));

    if constexpr (dim == 2)
      {
        if (n_points == 3)
          return dunavant_rule({{1. / 6., 1. / 6., 1. / 3.}});
        if (n_points == 6)
          return dunavant_rule(
            {{0.445948490915965, 0.445948490915965, 0.223381589678011},
             {0.091576213509771, 0.091576213509771, 0.109951743655322}});
        if (n_points == 12)
          return dunavant_rule(
            {{0.249286745170910, 0.249286745170910, 0.116786275726379},
             {0.063089014491502, 0.063089014491502, 0.050844906370207},
             {0.053145049844817, 0.310352451033784, 0.082851075618374}});
      }
    if (dim == 3 && n_points == 4)
      return degree_two_rule<dim>();
    for (unsigned int n = 1; n <= 4; ++n)
      {
        const QGaussSimplex<dim> gauss(n);
        if (gauss.size() == n_points)
          return normalised<dim>(gauss);
        const QWitherdenVincentSimplex<dim> witherden_vincent(n);
        if (witherden_vincent.size() == n_points)
          return normalised<dim>(witherden_vincent);
      }
    AssertThrow(false,
                ExcMessage("There is no rule with " + std::to_string(n_points) +
                           " " + subject + ". Choose " +
                           (dim == 2 ?
                              "1, 3, 4, 6, 7, 9, 12, 15, 16, 25, ... k^2." :
                              "1, 4, 8, 14, 27, 35, 64, ... k^3.")));
    return Quadrature<dim>();
  }



  template <int dim>
  std::vector<std::array<Point<dim>, dim + 1>>
  box_simplices()
  {
    std::vector<std::array<Point<dim>, dim + 1>> simplices;
    std::array<unsigned int, dim>                axes;
    std::iota(axes.begin(), axes.end(), 0);
    do
      {
        std::array<Point<dim>, dim + 1> path;
        for (unsigned int d = 0; d < dim; ++d)
          {
            path[d + 1] = path[d];
            path[d + 1][axes[d]] += 1;
          }
        simplices.push_back(path);
      }
    while (std::next_permutation(axes.begin(), axes.end()));
    return simplices;
  }



  template <int dim>
  PointsWithDomains<dim>
  material_points_with_domains(const unsigned int n_points)
  {
    const auto simplices = tile<dim>(n_points);
    AssertThrow(
      !simplices.empty(),
      ExcMessage(
        "The points own parts of the body, and a cell can't be divided into " +
        std::to_string(n_points) +
        " equal parts (<Material points/Points per cell> or <Points "
        "per cell in zones>). Choose " +
        (dim == 2 ? "1, 3, 4, 6, 9, 12, 16, 24, 25, ... k^2, 3 k^2, "
                    "6 k^2." :
                    "1, 4, 8, 24, 27, 32, 64, ... k^3, 4 k^3, "
                    "24 k^3.")));
    std::vector<CornerVectors<dim>> domains(simplices.size());
    for (unsigned int q = 0; q < simplices.size(); ++q)
      for (unsigned int c = 0; c <= dim; ++c)
        domains[q][c] = simplices[q][c] - centroid<dim>(simplices[q]);
    return {centroid_rule<dim>(simplices), domains};
  }



  template Quadrature<2>
  material_point_rule<2>(const unsigned int, const std::string &);
  template Quadrature<3>
  material_point_rule<3>(const unsigned int, const std::string &);
  template std::vector<std::array<Point<2>, 3>>
  box_simplices<2>();
  template std::vector<std::array<Point<3>, 4>>
  box_simplices<3>();
  template PointsWithDomains<2>
  material_points_with_domains<2>(const unsigned int);
  template PointsWithDomains<3>
  material_points_with_domains<3>(const unsigned int);
} // namespace isochor
