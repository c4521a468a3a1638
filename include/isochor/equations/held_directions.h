/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_held_directions_h
#define isochor_held_directions_h

#include <deal.II/base/tensor.h>

#include <isochor/equations/nodal_constraints.h>

#include <map>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The directions in which constraints hold nodes, or let them follow others.
   */
  template <int dim>
  class HeldDirections
  {
  public:
    /** @p constraints is kept by reference. */
    HeldDirections(const NodalConstraints &constraints,
                   const unsigned int      n_components)
      : constraints(constraints)
      , n_components(n_components)
    {
      for (const auto &equation : constraints.equations)
        {
          std::map<unsigned int, Tensor<1, dim>> by_node;
          for (std::size_t i = equation.first; i < equation.last; ++i)
            if (constraints.entry[i] % n_components < dim)
              by_node[constraints.entry[i] / n_components]
                     [constraints.entry[i] % n_components] +=
                constraints.coefficient[i];
          for (const auto &node : by_node)
            directions[node.first].push_back(node.second);
        }
    }

    /** |n|² of what is left of @p n without the directions held at @p node. */
    double
    free_part(const unsigned int node, Tensor<1, dim> n) const
    {
      const auto leave_free = [&](Tensor<1, dim> &v) {
        for (unsigned int a = 0; a < dim; ++a)
          if (constraints.constrained[node * n_components + a] ==
              NodalConstraints::prescribed)
            v[a] = 0;
      };
      leave_free(n);
      const auto here = directions.find(node);
      if (here == directions.end())
        return n.norm_square();
      std::vector<Tensor<1, dim>> basis;
      for (Tensor<1, dim> v : here->second)
        {
          const double size = v.norm();
          leave_free(v);
          for (const Tensor<1, dim> &b : basis)
            v -= (v * b) * b;
          if (v.norm() > 1e-8 * size)
            basis.push_back(v / v.norm());
        }
      for (const Tensor<1, dim> &b : basis)
        n -= (n * b) * b;
      return n.norm_square();
    }

  private:
    const NodalConstraints                             &constraints;
    const unsigned int                                  n_components;
    std::map<unsigned int, std::vector<Tensor<1, dim>>> directions; ///< by node
  };
} // namespace isochor

#endif
