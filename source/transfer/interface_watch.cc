/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/equations/material_groups.h>
#include <isochor/transfer/interface_watch.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** How far a material reaches into a cell of another one, as a part of it,
     * and the ratio of their stiffnesses. */
    struct InterfaceCrossing
    {
      double depth = 0, ratio = 1;

      double
      weight() const
      {
        return depth * (ratio - 1);
      }
    };

    /** The cell in which materials of different groups share most. How far the
     * smaller part reaches into it is taken for its part of the volume. */
    template <int dim>
    InterfaceCrossing
    worst_shared_cell(const PointArrays<dim> &points,
                      const MixedKernel<dim> &kernel)
    {
      const MaterialGroups groups(kernel, nearly_alike);
      InterfaceCrossing    worst;
      if (groups.size() < 2)
        return worst;
      std::vector<double> volumes(groups.size());
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        {
          std::fill(volumes.begin(), volumes.end(), 0.);
          double all = 0;
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            {
              volumes[groups.of_material[points.material[q]]] +=
                points.volume[q];
              all += points.volume[q];
            }
          for (unsigned int a = 0; a < groups.size(); ++a)
            for (unsigned int b = 0; b < a && volumes[a] > 0; ++b)
              {
                const InterfaceCrossing here = {
                  std::min(volumes[a], volumes[b]) / all, groups.ratio(a, b)};
                if (here.weight() > worst.weight())
                  worst = here;
              }
        }
      return worst;
    }
  } // namespace



  template <int dim>
  void
  warn_of_interfaces_in_cells(const PointArrays<dim> &points,
                              const MixedKernel<dim> &kernel,
                              const MPI_Comm          comm,
                              const double            time,
                              Warnings               &warnings)
  {
    constexpr double        much   = 0.2; // 3 % of the stress
    const InterfaceCrossing worst  = worst_shared_cell(points, kernel);
    const double            weight = Utilities::MPI::max(worst.weight(), comm);
    if (weight < much)
      return;
    // of ranks that have found the same the same is told
    const bool   is_mine = worst.weight() == weight;
    const double depth = Utilities::MPI::max(is_mine ? worst.depth : 0., comm);
    warnings.add(
      "materials that meet within cells",
      "At t = " + rounded(time) +
        " s materials whose stiffnesses differ by up to " +
        rounded(1 + weight / depth) +
        " to 1, or whose strengths differ, meet within cells, " +
        rounded(depth) +
        " of which are of the one. Both are strained alike there: stresses "
        "of the stiff one are wrong, the more the larger both numbers are "
        "(100 to 1, half of a cell: by up to 230 %, and the settlement of "
        "two layers of four cells by 14 %), and neither more points nor "
        "smaller steps help. With <Quadrature/Type = CPDI> each material "
        "has functions of its own.");
  }



  template void
  warn_of_interfaces_in_cells<2>(const PointArrays<2> &,
                                 const MixedKernel<2> &,
                                 const MPI_Comm,
                                 const double,
                                 Warnings &);
  template void
  warn_of_interfaces_in_cells<3>(const PointArrays<3> &,
                                 const MixedKernel<3> &,
                                 const MPI_Comm,
                                 const double,
                                 Warnings &);
} // namespace isochor
