/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_invariants_h
#define isochor_invariants_h

#include <deal.II/base/exceptions.h>

#include <isochor/base/rounding.h>
#include <isochor/equations/active_nodes.h>
#include <isochor/material_points/point_arrays.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  using namespace dealii;

  DeclExceptionMsg(ExcOtherNodes, "The field is of other nodes.");

  /** What holds throughout a step, for Assert: all of it is looked at in Debug
   * only. */
  namespace invariants
  {
    /** Whether @p field has @p n_components entries per active node. */
    template <int dim>
    bool
    fits(const NodalField       &field,
         const ActiveNodes<dim> &nodes,
         const unsigned int      n_components)
    {
      return field.size() == nodes.n_global() * n_components &&
             field.locally_owned_size() == nodes.n_owned() * n_components;
    }

    /** Whether Σ N_I = 1 and Σ ∇N_I = 0 at the point of a stencil, but for
     * rounding. */
    template <int dim, typename Stencil>
    bool
    is_partition_of_unity(const Stencil &stencil)
    {
      double         sum = -1, size = 0;
      Tensor<1, dim> gradient;
      for (unsigned int I = 0; I < stencil.n_nodes; ++I)
        {
          sum += stencil.shape[I];
          gradient += stencil.gradient[I];
          size += stencil.gradient[I].norm();
        }
      return std::abs(sum) < rounding::places &&
             gradient.norm() <= rounding::places * size;
    }

    /** Whether the rows from start[i] up to start[i + 1] are those of a list of
     * @p n_entries. */
    template <typename Start>
    bool
    is_compressed(const std::vector<Start> &start, const std::size_t n_entries)
    {
      return !start.empty() && start.front() == 0 &&
             start.back() == n_entries &&
             std::is_sorted(start.begin(), start.end());
    }

    /** Whether the arrays are of one set of points: cells ascend, and have the
     * points between them. */
    template <int dim>
    bool
    is_consistent(const PointArrays<dim> &points)
    {
      return std::is_sorted(points.cell.begin(), points.cell.end()) &&
             points.cell_start.size() == points.cell.size() + 1 &&
             is_compressed(points.cell_start, points.n_points()) &&
             points.shape.size() == points.n_points() &&
             points.material.size() == points.n_points() &&
             (!points.has_stencils() ||
              (points.stencil_start.size() == points.n_points() + 1 &&
               is_compressed(points.stencil_start,
                             points.stencil_shape.size()) &&
               points.stencil_vertex.size() == points.stencil_shape.size() &&
               points.stencil_gradient.size() == points.stencil_shape.size()));
    }
  } // namespace invariants
} // namespace isochor

#endif
