/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/boundary_condition/material_at_nodes.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  MaterialAtNodes<dim>::set(
    const std::vector<PrescribedComponent<dim>> &conditions,
    const std::vector<Point<dim>>               &reference)
  {
    formulas.clear();
    for (const auto &condition : conditions)
      if (condition.depends_on_place)
        for (const unsigned int v : condition.vertices)
          formulas[v];
    extent = 0;
    for (const Point<dim> &x : reference)
      extent = std::max(extent, x.distance(reference[0]));
    if (!formulas.empty())
      for (const auto &condition : conditions)
        for (const unsigned int v : condition.vertices)
          if (const auto found = formulas.find(v); found != formulas.end())
            found->second[condition.component] = condition.displacement;
  }



  template <int dim>
  Tensor<1, dim>
  MaterialAtNodes<dim>::residual(const Formulas   &displacement,
                                 const Point<dim> &X,
                                 const Point<dim> &x,
                                 const double      t)
  {
    Tensor<1, dim> r;
    for (unsigned int d = 0; d < dim; ++d)
      if (displacement[d])
        r[d] = X[d] + (*displacement[d])(X, t) - x[d];
    return r;
  }



  template <int dim>
  Point<dim>
  MaterialAtNodes<dim>::place(const unsigned int             vertex,
                              const std::vector<Point<dim>> &reference,
                              const StepContext<dim>        &step) const
  {
    AssertIndexRange(vertex, reference.size());
    // Newton's method with difference quotients
    constexpr unsigned int most_iterations = 50;
    constexpr double       difference      = 1e-6;
    const auto             found           = formulas.find(vertex);
    const double           t = (step.grid_is_kept ? reset_time : step.old_time);
    if (t == 0 || found == formulas.end())
      return reference[vertex];
    const Formulas   &u = found->second;
    const Point<dim> &x = step.grid.geometry().vertices()[vertex];
    Point<dim>        X = reference[vertex];
    try
      {
        for (unsigned int k = 0; k < most_iterations; ++k)
          {
            const Tensor<1, dim> r = residual(u, X, x, t);
            if (r.norm() <=
                rounding::arithmetic * extent + rounding::numbers * x.norm())
              return X;
            Tensor<2, dim> J = unit_symmetric_tensor<dim>();
            for (unsigned int a = 0; a < dim; ++a)
              if (u[a])
                {
                  Point<dim> low = X, high = X;
                  low[a] -= difference * extent;
                  high[a] += difference * extent;
                  const Tensor<1, dim> change =
                    (residual(u, high, x, t) - residual(u, low, x, t)) /
                    (high[a] - low[a]);
                  for (unsigned int d = 0; d < dim; ++d)
                    if (u[d])
                      J[d][a] = change[d];
                }
            if (std::abs(determinant(J)) < difference)
              break;
            X -= invert(J) * r;
          }
      }
    catch (const StandardExceptions::ExcMessage &)
      {} // the formula has no value where the search has come to
    std::string text;
    for (unsigned int d = 0; d < dim; ++d)
      text += (d > 0 ? ", " : "(") + rounded(reference[vertex][d]);
    AssertThrow(false,
                ExcMessage(
                  "At t = " + rounded(t) +
                  " s a formula of <Boundary conditions/Displacement> brings "
                  "no material to a node of its boundary, or material from "
                  "several places, " +
                  text +
                  "). Check how the formula depends on the place, or keep the "
                  "grid: <Grid reset/Steps between resets = 0>."));
    return reference[vertex];
  }



  template class MaterialAtNodes<2>;
  template class MaterialAtNodes<3>;
} // namespace isochor
