/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/material_points/material_points.h>

#include <algorithm>
#include <map>

namespace isochor
{
  PointLayout::PointLayout(const unsigned int dim,
                           const unsigned int n_history,
                           const bool         dynamic,
                           const bool         with_domains,
                           const bool         with_cell_size,
                           const bool         with_ancestry,
                           const bool         with_excess,
                           const bool         with_surface,
                           const bool         mixed)
    : with_excess(with_excess)
    , n_history(n_history)
    , dynamic(dynamic)
    , with_domains(with_domains)
    , with_cell_size(with_cell_size)
    , with_ancestry(with_ancestry)
    , with_surface(with_surface)
  {
    const auto place = [this](unsigned int &field, const unsigned int size) {
      field = n_properties;
      n_properties += size;
    };
    place(volume, 1);
    place(mass, 1);
    place(material, 1);
    place(displacement, dim);
    place(F, dim * dim);
    place(pressure, 1);
    if (mixed)
      place(volume_gain, 1);
    place(stress, dim == 2 ? 4 : 6);
    if (dynamic)
      {
        place(velocity, dim);
        place(acceleration, dim);
      }
    if (with_excess)
      place(excess, dim);
    place(history, n_history);
    if (with_domains)
      place(domain, dim * dim);
    if (with_cell_size)
      place(cell_size, 1);
    if (with_ancestry)
      place(ancestry, 1);
    if (with_surface)
      place(outer_faces, 1);
  }



  template <int dim>
  void
  PointArrays<dim>::set_overlapped_cells(
    const SimplexGeometry<dim>                   &geometry,
    const std::map<unsigned int, CellCompliance> &compliance)
  {
    overlapped_cells.clear();
    for (const auto &[c, sum] : compliance)
      {
        OverlappedCell<dim> overlapped{c, sum, {}};
        for (unsigned int v = 0; v <= dim; ++v)
          overlapped.corners[v] =
            geometry.vertices()[geometry.vertex_indices(c)[v]];
        overlapped_cells.push_back(overlapped);
      }
  }



  template <int dim>
  unsigned int
  PointArrays<dim>::most_nodes() const
  {
    std::size_t most = 0;
    for (std::size_t q = 1; q < stencil_start.size(); ++q)
      most = std::max(most, stencil_start[q] - stencil_start[q - 1]);
    return most;
  }



  template struct PointArrays<2>;
  template struct PointArrays<3>;
} // namespace isochor
