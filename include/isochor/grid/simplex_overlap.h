/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_simplex_overlap_h
#define isochor_simplex_overlap_h

#include <array>
#include <cmath>

namespace isochor
{
  /** The corners of a simplex, each by its barycentric coordinates with respect
   * to another simplex, the cell. */
  template <int dim>
  using SimplexInCell = std::array<std::array<double, dim + 1>, dim + 1>;

  /** The volume of @p simplex as a part of the cell's: |det λ|, with the
   * corners' barycentric coordinates in rows. */
  template <int dim>
  inline double
  part_of_cell(const SimplexInCell<dim> &simplex)
  {
    // rows relative to the first; the last column follows from the others
    std::array<std::array<double, dim>, dim> a;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        a[i][j] = simplex[i + 1][j] - simplex[0][j];
    if constexpr (dim == 2)
      return std::abs(a[0][0] * a[1][1] - a[0][1] * a[1][0]);
    else
      return std::abs(a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) -
                      a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
                      a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]));
  }

  /**
   * The volume that @p simplex and the cell share, as a part of the cell's
   * volume; exact but for rounding. The simplex is cut at the planes λ_face =
   * 0, one after the other from @p face on. With the corners a_1 ... a_k where
   * λ_face >= 0, b_1 ... b_m where it is not, and the points c_ij of the plane
   * on the edges a_i b_j, what remains is the union of the simplices
   *
   *     a_1 ... a_i and the c on a monotone path from (i, 1) to (k, m),
   *
   * over all i and all paths: the staircase triangulation of the product of
   * two simplices (De Loera, Rambau & Santos, Triangulations, 2010, sec. 6.2),
   * with the a_i joined to it.
   */
  template <int dim>
  inline double
  overlap_with_cell(const SimplexInCell<dim> &simplex,
                    const unsigned int        face = 0)
  {
    if (face > dim)
      return part_of_cell<dim>(simplex);

    std::array<unsigned int, dim + 1> in, out;
    unsigned int                      k = 0, m = 0;
    for (unsigned int i = 0; i <= dim; ++i)
      if (simplex[i][face] >= 0)
        in[k++] = i;
      else
        out[m++] = i;
    if (m == 0)
      return overlap_with_cell<dim>(simplex, face + 1);
    if (k == 0)
      return 0.;

    const auto cut = [&](const unsigned int i, const unsigned int j) {
      const auto  &a = simplex[in[i]], &b = simplex[out[j]];
      const double s = a[face] / (a[face] - b[face]);
      auto         c = a;
      for (unsigned int d = 0; d <= dim; ++d)
        c[d] += s * (b[d] - a[d]);
      c[face] = 0;
      return c;
    };
    // a path takes k - 1 - i steps in i and m - 1 in j: bit n of `steps` says
    // which of them is the n-th
    double             overlap = 0;
    SimplexInCell<dim> part;
    for (unsigned int first = 0; first < k; ++first)
      {
        part[first]                = simplex[in[first]];
        const unsigned int n_steps = k - 1 - first + m - 1;
        for (unsigned int steps = 0; steps < (1u << n_steps); ++steps)
          {
            unsigned int i = first, j = 0, n = first + 1;
            part[n++] = cut(i, j);
            for (unsigned int s = 0; s < n_steps && i < k && j < m; ++s)
              {
                (steps >> s & 1u) ? ++i : ++j;
                if (i < k && j < m)
                  part[n++] = cut(i, j);
              }
            if (i == k - 1 && j == m - 1)
              overlap += overlap_with_cell<dim>(part, face + 1);
          }
      }
    return overlap;
  }
} // namespace isochor

#endif
