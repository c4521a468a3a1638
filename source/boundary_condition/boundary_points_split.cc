/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BoundaryPoints that follow a change of the grid.
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  void
  BoundaryPoints<dim>::change_grid()
  {
    if (on_domains)
      return; // locate() makes new ones
    for (unsigned int &cell : records.cells)
      cell = grid.cells_after_change()[cell];
    // parts may still be too large
    constexpr unsigned int most_rounds = 12;
    for (unsigned int round = 0; round < most_rounds; ++round)
      if (Utilities::MPI::sum(split(), grid.communicator()) == 0)
        return;
  }



  template <int dim>
  unsigned int
  BoundaryPoints<dim>::split()
  {
    // as many as three points on the side of a cell
    constexpr double          share = 0.5;
    constexpr unsigned int    n_new = (1u << (dim - 1)) - 1;
    std::vector<unsigned int> too_large;
    std::vector<std::array<Tensor<1, dim>, dim - 1>> sides; // now
    for (unsigned int b = 0; b < size(); ++b)
      {
        // two or one tangents of the undeformed surface, as long as its part
        std::array<Tensor<1, dim>, dim - 1> tangents;
        const Tensor<1, dim>                A = reference_area(b);
        if constexpr (dim == 2)
          tangents[0] = cross_product_2d(A);
        else
          {
            Tensor<1, 3> axis; // the one that is least along the normal
            unsigned int d = 0;
            for (unsigned int e = 1; e < 3; ++e)
              if (std::abs(A[e]) < std::abs(A[d]))
                d = e;
            axis[d]     = 1;
            tangents[0] = cross_product_3d(A, axis);
            tangents[0] *= std::sqrt(A.norm()) / tangents[0].norm();
            tangents[1] = cross_product_3d(A, tangents[0]) / A.norm();
          }
        double longest = 0;
        for (Tensor<1, dim> &side : tangents)
          {
            side    = F(b) * side;
            longest = std::max(longest, side.norm());
          }
        const auto place =
          locator->locate(records.locations[b], records.cells[b]);
        const double h = cell_size(grid.geometry(),
                                   place.found ? place.cell : records.cells[b]);
        if (longest > share * h)
          {
            too_large.push_back(b);
            sides.push_back(tangents);
          }
      }

    types::particle_index next = new_ids(n_new * too_large.size());
    for (unsigned int i = 0; i < too_large.size(); ++i)
      {
        const unsigned int            b       = too_large[i];
        const Tensor<2, dim>          inverse = invert(F(b));
        const Point<dim>              x       = records.locations[b];
        std::array<double, n_entries> old;
        std::copy_n(records.payload(b).begin(), n_entries, old.begin());
        for (unsigned int part = 0; part <= n_new; ++part)
          {
            Tensor<1, dim> shift;
            for (unsigned int s = 0; s + 1 < dim; ++s)
              shift += (((part >> s) & 1u) ? 0.25 : -0.25) * sides[i][s];
            const Tensor<1, dim> stretch = shift - inverse * shift;
            auto                 payload = old;
            for (unsigned int d = 0; d < dim; ++d)
              {
                payload[area_entry + d] /= n_new + 1;
                payload[displacement_entry + d] += stretch[d];
              }
            if (part == 0)
              {
                records.locations[b] = x + shift;
                std::copy(payload.begin(),
                          payload.end(),
                          records.payloads.begin() + b * n_entries);
              }
            else
              records.push_back(records.cells[b],
                                next++,
                                x + shift,
                                ArrayView<const double>(payload.data(),
                                                        n_entries));
          }
      }
    return too_large.size();
  }



  template <int dim>
  types::particle_index
  BoundaryPoints<dim>::new_ids(const std::size_t n) const
  {
    types::particle_index next = 0;
    for (const types::particle_index id : records.ids)
      next = std::max(next, id + 1);
    return Utilities::MPI::max(next, grid.communicator()) +
           exclusive_and_total_sum(n, grid.communicator()).first;
  }



  template void
  BoundaryPoints<2>::change_grid();
  template unsigned int
  BoundaryPoints<2>::split();
  template types::particle_index
  BoundaryPoints<2>::new_ids(const std::size_t) const;
  template void
  BoundaryPoints<3>::change_grid();
  template unsigned int
  BoundaryPoints<3>::split();
  template types::particle_index
  BoundaryPoints<3>::new_ids(const std::size_t) const;
} // namespace isochor
