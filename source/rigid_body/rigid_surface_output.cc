/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/data_out_base.h>
#include <deal.II/grid/reference_cell.h>

#include <isochor/base/safe_file.h>
#include <isochor/rigid_body/rigid_surface_output.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  write_rigid_surface(const std::string                              &file_name,
                      const std::vector<std::array<Point<dim>, dim>> &facets,
                      const double                                    time)
  {
    using Patch = DataOutBase::Patch<dim - 1, dim>;
    std::vector<Patch> patches(facets.size());
    for (unsigned int f = 0; f < facets.size(); ++f)
      {
        patches[f].patch_index    = f;
        patches[f].reference_cell = ReferenceCells::get_simplex<dim - 1>();
        std::copy(facets[f].begin(),
                  facets[f].end(),
                  std::begin(patches[f].vertices));
        patches[f].data.reinit(0, dim);
      }
    DataOutBase::VtkFlags flags;
    flags.time                = time;
    flags.print_date_and_time = false; // equal results, equal files
    write_file_safely(file_name, [&](std::ostream &out) {
      DataOutBase::write_vtu(patches, {}, {}, flags, out);
    });
  }



  template void
  write_rigid_surface<2>(const std::string &,
                         const std::vector<std::array<Point<2>, 2>> &,
                         const double);
  template void
  write_rigid_surface<3>(const std::string &,
                         const std::vector<std::array<Point<3>, 3>> &,
                         const double);
} // namespace isochor
