/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of BoundaryPoints that checkpoints need.
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_points.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  std::string
  BoundaryPoints<dim>::save_state() const
  {
    std::map<types::particle_index, std::string> lines;
    for (unsigned int b = 0; b < size(); ++b)
      {
        std::ostringstream line;
        line.precision(std::numeric_limits<double>::max_digits10);
        line << records.ids[b] << ' ' << records.cells[b] << ' '
             << records.locations[b];
        for (const double value : records.payload(b))
          line << ' ' << value;
        const auto nodes = place(b);
        line << ' ' << nodes.n_nodes;
        for (unsigned int I = 0; I < nodes.n_nodes; ++I)
          line << ' ' << nodes.vertex[I] << ' ' << nodes.shape[I] << ' '
               << nodes.gradient[I];
        lines[records.ids[b]] = line.str();
      }
    std::map<types::particle_index, std::string> all_lines;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), lines))
      all_lines.insert(of_rank.begin(), of_rank.end());
    std::string state = std::to_string(all_lines.size()) + '\n';
    for (const auto &line : all_lines)
      state += line.second + '\n';
    return state;
  }



  template <int dim>
  void
  BoundaryPoints<dim>::load_state(const std::string &state)
  {
    records = PointRecords<dim>(n_entries);
    clear_stencils();
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::istringstream text(state);
    std::size_t        n = 0;
    text >> n;
    for (std::size_t b = 0; b < n; ++b)
      {
        types::particle_index         id;
        unsigned int                  cell, n_nodes = 0;
        Point<dim>                    location;
        std::array<double, n_entries> payload;
        text >> id >> cell;
        for (unsigned int d = 0; d < dim; ++d)
          text >> location[d];
        for (double &value : payload)
          text >> value;
        text >> n_nodes;
        for (unsigned int I = 0; I < n_nodes && text; ++I)
          {
            unsigned int   vertex;
            double         shape;
            Tensor<1, dim> gradient;
            text >> vertex >> shape;
            for (unsigned int d = 0; d < dim; ++d)
              text >> gradient[d];
            stencil_vertex.push_back(vertex);
            stencil_shape.push_back(shape);
            stencil_gradient.push_back(gradient);
          }
        AssertThrow(text,
                    ExcMessage("The saved state of the boundary points is "
                               "damaged."));
        if (grid.geometry().owner(cell) != rank)
          {
            stencil_vertex.resize(stencil_start.back());
            stencil_shape.resize(stencil_start.back());
            stencil_gradient.resize(stencil_start.back());
            continue;
          }
        stencil_start.push_back(stencil_vertex.size());
        records.push_back(cell,
                          id,
                          location,
                          ArrayView<const double>(payload.data(), n_entries));
      }
  }



  template std::string
  BoundaryPoints<2>::save_state() const;
  template void
  BoundaryPoints<2>::load_state(const std::string &);
  template std::string
  BoundaryPoints<3>::save_state() const;
  template void
  BoundaryPoints<3>::load_state(const std::string &);
} // namespace isochor
