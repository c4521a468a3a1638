/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_element_h
#define isochor_element_h

#include <isochor/material_points/point_arrays.h>

#include <array>

namespace isochor
{
  /** What can go wrong in an evaluation; the largest of all ranks counts. */
  enum class EvaluationStatus : unsigned int
  {
    success           = 0,
    inverted_point    = 1,
    return_map_failed = 2
  };

  /**
   * The part of the body that shares one list of nodes: a background cell with
   * its points. Nodes are local to the element. Input is filled by the caller,
   * output by the kernel. Unknown a of node I is entry I * n_components + a;
   * the pressure, if any, is component dim.
   *
   * @tparam n_components dim for u, dim + 1 for u-p.
   * @tparam max_nodes dim + 1 for cells (then n_nodes is ignored).
   */
  template <int dim, int n_components, std::size_t max_nodes>
  struct Element
  {
    static constexpr int  n_max = max_nodes * n_components;
    static constexpr bool mixed = (n_components == dim + 1);

    unsigned int                          n_nodes = max_nodes;
    std::array<Tensor<1, dim>, max_nodes> gradient;  ///< ∇_n N_I
    std::array<Tensor<1, dim>, max_nodes> increment; ///< Δu_I
    std::array<double, max_nodes>         pressure;  ///< p_I
    /** p_I at the start of the step, and the share 1 - m that they have in the
     * mean of the step; 0: the pressures at its end count. */
    std::array<double, max_nodes>     pressure_at_start;
    double                            start_weight = 0;
    std::array<double, n_max>         residual;
    std::array<double, n_max * n_max> matrix; ///< row-major, n_dofs wide
    /** Of the points that it has been summed over. */
    CellCompliance compliance;

    /** (1 - m) (p - p_n) at a point with the shape values @p N. */
    template <typename Shape>
    double
    pressure_change(const Shape &N) const
    {
      double sum = 0;
      if (start_weight > 0)
        for (unsigned int I = 0; I < nodes(); ++I)
          sum += start_weight * N(I) * (pressure[I] - pressure_at_start[I]);
      return sum;
    }

    constexpr unsigned int
    nodes() const
    {
      return max_nodes == dim + 1 ? dim + 1 : n_nodes;
    }
    constexpr unsigned int
    n_dofs() const
    {
      return nodes() * n_components;
    }
  };
} // namespace isochor

#endif
