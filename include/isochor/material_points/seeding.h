/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_seeding_h
#define isochor_seeding_h

#include <deal.II/base/quadrature.h>
#include <deal.II/base/tensor.h>

#include <isochor/base/rounding.h>

#include <array>
#include <cmath>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * The places and volume fractions (weights that sum to 1) of @p n_points
   * material points in the reference simplex:
   *  - n = k^dim: the centroids of the regular subdivision into k^dim simplices
   *    of equal volume (1, 4, 9, 16, ... in 2D; 1, 8, 27, ... in 3D);
   *  - 2D, 3, 6 and 12: the symmetric rules of degree 2, 4 and 6 of Dunavant,
   *    Int. J. Numer. Meth. Eng. 21 (1985) 1129-1148;
   *  - 3D, 4: the symmetric rule of degree 2;
   *  - every other count for which deal.II has a simplex rule.
   * Throws otherwise, naming the counts there are; @p subject says of what, and
   * which parameter tells.
   */
  template <int dim>
  Quadrature<dim>
  material_point_rule(
    const unsigned int n_points,
    const std::string &subject =
      "material points per cell (<Material points/Points per cell> or <Points "
      "per cell in zones>)");

  /** The corners of a simplex relative to its centroid. */
  template <int dim>
  using CornerVectors = std::array<Tensor<1, dim>, dim + 1>;

  /**
   * Put the corners of a tetrahedron into the order in which it is subdivided
   * best, whatever order they come in; its orientation stays. The regular
   * subdivision cuts the octahedra inside along the diagonal between the
   * middles of the edges 02 and 13 (Bey, Computing 55 (1995) 355-378): these
   * are to be the opposite edges with the largest product of lengths. That is
   * the shortest diagonal, or close to it; of the two equally short ones in a
   * tetrahedron of a box it is the one whose parts have the shape of the whole.
   * Of equal products that counts whose diagonal, turned such that its first
   * component that isn't 0 is positive, comes last in the order of components.
   * In 2D: nothing.
   */
  template <int dim, typename Vector>
  void
  order_for_subdivision(std::array<Vector, dim + 1> &corners)
  {
    if constexpr (dim == 3)
      {
        constexpr unsigned int even_orders[3][4] = {{0, 1, 2, 3},
                                                    {0, 2, 3, 1},
                                                    {0, 3, 1, 2}};
        const auto             given             = corners;
        // between the middles of two edges, twice; either sense means the same
        const auto diagonal_of = [&given](const unsigned int(&order)[4]) {
          Tensor<1, dim> d = (given[order[0]] - given[order[1]]) +
                             (given[order[2]] - given[order[3]]);
          const double size = d.norm();
          for (unsigned int a = 0; a < dim; ++a)
            if (std::abs(d[a]) > rounding::accumulated * size)
              return d[a] > 0 ? d : -d;
          return d;
        };
        const auto comes_later = [](const Tensor<1, dim> &d,
                                    const Tensor<1, dim> &e) {
          const double equal = rounding::accumulated * (d.norm() + e.norm());
          for (unsigned int a = 0; a < dim; ++a)
            if (std::abs(d[a] - e[a]) > equal)
              return d[a] > e[a];
          return false;
        };
        double         largest = 0;
        Tensor<1, dim> best;
        for (const auto &order : even_orders)
          {
            const double product =
              (given[order[0]] - given[order[2]]).norm_square() *
              (given[order[1]] - given[order[3]]).norm_square();
            const Tensor<1, dim> diagonal = diagonal_of(order);
            if (product < (1 - rounding::accumulated) * largest ||
                (product <= (1 + rounding::accumulated) * largest &&
                 !comes_later(diagonal, best)))
              continue;
            largest = product;
            best    = diagonal;
            for (unsigned int c = 0; c < 4; ++c)
              corners[c] = given[order[c]];
          }
      }
    else
      (void)corners;
  }

  /** The d! Kuhn simplices of the unit cube, by their corners. They tile it. */
  template <int dim>
  std::vector<std::array<Point<dim>, dim + 1>>
  box_simplices();

  /** Places and volume fractions of material points in the reference simplex,
   * and the simplex domain of each. */
  template <int dim>
  struct PointsWithDomains
  {
    Quadrature<dim>                 rule;
    std::vector<CornerVectors<dim>> domains;
  };

  /**
   * @p n_points domains of equal volume that tile the reference simplex, and
   * points at their centroids: the regular subdivision (n = k^dim), or each of
   * its simplices split at its centroid (n = (dim + 1) k^dim) or
   * barycentrically (n = (dim + 1)! k^dim). Domains that overlap or leave gaps,
   * as images of the cell around the points of a Gauss rule do, would make CPDI
   * inconsistent: the stress of a column in 3D stays wrong by 4 % on any grid.
   * Throws if there is no such tiling, naming the counts there are.
   */
  template <int dim>
  PointsWithDomains<dim>
  material_points_with_domains(const unsigned int n_points);
} // namespace isochor

#endif
