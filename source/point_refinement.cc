/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/point_refinement.h>

#include <algorithm>
#include <map>

namespace isochor
{
  template <int dim>
  void
  PointRefinement<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry("Split at holes",
                      "false",
                      Patterns::Bool(),
                      "Split points larger than the cells, so that cells "
                      "inside of the body don't run out of points. Needs "
                      "'Quadrature/Type' cell-filled.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  PointRefinement<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    active = prm.get_bool("Split at holes");
    prm.leave_subsection();
    prm.enter_subsection("Quadrature");
    AssertThrow(!active || prm.get("Type") == "cell-filled",
                ExcMessage("<Material points/Split at holes> needs "
                           "<Quadrature/Type = cell-filled>: 'points' knows no "
                           "holes, and the other types give points domains, "
                           "which are not split."));
    prm.leave_subsection();
  }



  template <int dim>
  std::vector<PointSplit<dim>>
  PointRefinement<dim>::find(const PointArrays<dim>   &points,
                             const CellOccupancy<dim> &occupancy) const
  {
    const SimplexGeometry<dim> &geometry = occupancy.grid.geometry();
    const unsigned int          rank =
      Utilities::MPI::this_mpi_process(occupancy.grid.communicator());
    const auto first = points.cell.begin(),
               last  = points.cell.begin() + points.n_occupied_cells;

    std::vector<PointSplit<dim>>   splits;
    std::map<unsigned int, double> rest; // of points split in this call
    for (const auto &hole : occupancy.occupied_cells())
      {
        if (!hole.is_hole || geometry.owner(hole.cell) != rank)
          continue;
        PointSplit<dim> split;
        double          largest = geometry.measure(hole.cell);
        bool            found   = false;
        for (const unsigned int cell : geometry.neighbours(hole.cell))
          {
            const auto at = std::lower_bound(first, last, cell);
            if (at == last || *at != cell)
              continue;
            const unsigned int k = at - first;
            for (unsigned int q = points.cell_start[k];
                 q < points.cell_start[k + 1];
                 ++q)
              {
                const auto   halved = rest.find(q);
                const double volume =
                  determinant(points.F[q]) *
                  (halved == rest.end() ? points.volume[q] : halved->second);
                if (volume > largest)
                  {
                    largest     = volume;
                    split.point = q;
                    found       = true;
                  }
              }
          }
        if (!found)
          continue;
        split.cell = hole.cell;
        for (const unsigned int v : geometry.vertex_indices(hole.cell))
          split.location += geometry.vertices()[v] / (dim + 1.);
        rest[split.point] = 0.5 * largest / determinant(points.F[split.point]);
        splits.push_back(split);
      }
    return splits;
  }



  template class PointRefinement<2>;
  template class PointRefinement<3>;
} // namespace isochor
