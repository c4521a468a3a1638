/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Equations that determine a vector of a node, of which walls and prescribed
// components hold a part.

#include <isochor/equations/nodal_constraints.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Component @p b of the vector that equation @p number is of. */
    unsigned int
    entry_of(const NodalConstraints &all,
             const unsigned int      number,
             const unsigned int      b)
    {
      const auto &equations = all.equations;
      return all
        .entry[equations[number - equations[number].component + b].first];
    }
  } // namespace



  void
  NodalConstraints::project(Equation &equation, const unsigned int number) const
  {
    using Vector           = std::array<double, 3>;
    const unsigned int n   = equation.n_vector;
    const auto         dot = [](const Vector &a, const Vector &b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    std::vector<Vector> normals;
    const auto          add_normal = [&](Vector v) {
      const double size = std::sqrt(dot(v, v));
      for (const Vector &other : normals)
        {
          const double along = dot(v, other);
          for (unsigned int d = 0; d < 3; ++d)
            v[d] -= along * other[d];
        }
      const double rest = std::sqrt(dot(v, v));
      if (!(rest > 1e-8 * size))
        return;
      for (double &component : v)
        component /= rest;
      normals.push_back(v);
    };
    for (unsigned int b = 0; b < n; ++b)
      {
        const unsigned int e = entry_of(*this, number, b);
        Vector             v{};
        if (place[e] == none)
          v[b] = constrained[e] == is_free ? 0. : 1.;
        else if (const unsigned int wall = equation_of_follower[place[e]];
                 wall != none &&
                 equations[wall].precedence < equation.precedence)
          for (std::size_t i = equations[wall].first; i < equations[wall].last;
               ++i)
            for (unsigned int d = 0; d < n; ++d)
              if (entry[i] == entry_of(*this, number, d))
                v[d] += coefficient[i];
        add_normal(v);
      }
    for (unsigned int b = 0; b < n; ++b)
      {
        equation.projection[b] = (b == equation.component) ? 1. : 0.;
        for (const Vector &normal : normals)
          equation.projection[b] -= normal[equation.component] * normal[b];
      }
  }



  void
  NodalConstraints::combine(const Equation              &equation,
                            const unsigned int           number,
                            const std::array<double, 3> &parts)
  {
    row.clear();
    row_value   = 0;
    row_changes = false;
    for (unsigned int b = 0; b < equation.n_vector; ++b)
      if (parts[b] != 0.)
        {
          const Equation &of_b = equations[number - equation.component + b];
          for (std::size_t i = of_b.first; i < of_b.last; ++i)
            add_to_row(entry[i], parts[b] * coefficient[i]);
          row_value += parts[b] * of_b.value;
          row_changes = row_changes || of_b.changes;
        }
    substitute();
    // what is left of other components is rounding; all other terms stay, even
    // zeros, so that the same unknowns follow the same ones
    const auto is_left = [&](const auto &term) {
      bool of_vector = false;
      for (unsigned int b = 0; b < equation.n_vector; ++b)
        of_vector = of_vector || term.first == entry_of(*this, number, b);
      return of_vector && std::abs(term.second) < 1e-14;
    };
    if (equation.n_vector > 1)
      row.erase(std::remove_if(row.begin(), row.end(), is_left), row.end());
  }
} // namespace isochor
