/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/equations/orthogonal_subscales.h>

#include <algorithm>
#include <set>

namespace isochor
{
  template <int dim>
  OrthogonalSubscales<dim>::OrthogonalSubscales(const BackgroundGrid<dim> &grid,
                                                const PointArrays<dim> &points,
                                                const MixedKernel<dim> &kernel,
                                                const Images &periodic_images)
    : grid(grid)
    , points(points)
    , kernel(kernel)
    , periodic_images(periodic_images)
  {}



  template <int dim>
  void
  OrthogonalSubscales<dim>::touch_vertices(std::vector<unsigned int> &vertices)
  {
    if (!kernel.stabilisation.has_orthogonal_subscales)
      return;
    find_roots();
    for (const auto &cell : cells_at_owned_nodes())
      for (const unsigned int v : grid.geometry().vertex_indices(cell.first))
        vertices.push_back(v);
  }



  template <int dim>
  void
  OrthogonalSubscales<dim>::find_roots()
  {
    const auto images = periodic_images();
    root_of           = {images.begin(), images.end()};
  }



  template <int dim>
  std::array<unsigned int, dim + 1>
  OrthogonalSubscales<dim>::roots(const unsigned int cell) const
  {
    std::array<unsigned int, dim + 1> vertices =
      grid.geometry().vertex_indices(cell);
    if (!root_of.empty())
      for (unsigned int &v : vertices)
        if (const auto root = root_of.find(v); root != root_of.end())
          v = root->second;
    return vertices;
  }



  template <int dim>
  std::map<unsigned int, OverlappedCell<dim>>
  OrthogonalSubscales<dim>::cells_at_owned_nodes() const
  {
    const MPI_Comm     comm = grid.communicator();
    const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
    std::map<unsigned int, OverlappedCell<dim>>              cells;
    std::map<unsigned int, std::vector<OverlappedCell<dim>>> messages;
    for (const OverlappedCell<dim> &cell : points.overlapped_cells)
      {
        std::set<unsigned int> owners;
        for (const unsigned int v : roots(cell.cell))
          owners.insert(grid.vertex_owner(v));
        for (const unsigned int owner : owners)
          if (owner == rank)
            cells.emplace(cell.cell, cell);
          else
            messages[owner].push_back(cell);
      }
    if (Utilities::MPI::n_mpi_processes(comm) > 1)
      for (const auto &received : Utilities::MPI::some_to_some(comm, messages))
        for (const OverlappedCell<dim> &cell : received.second)
          {
            const auto [place, is_new] = cells.emplace(cell.cell, cell);
            if (!is_new)
              place->second.compliance.add(cell.compliance);
          }
    return cells;
  }



  template <int dim>
  void
  OrthogonalSubscales<dim>::add_patch(
    const std::vector<const OverlappedCell<dim> *> &cells)
  {
    std::vector<unsigned int> patch;
    double                    mean_density = 0;
    const auto                density_of = [](const OverlappedCell<dim> &cell) {
      return cell.compliance.mass / cell.compliance.volume;
    };
    for (const OverlappedCell<dim> *cell : cells)
      {
        const auto &vertices = grid.geometry().vertex_indices(cell->cell);
        patch.insert(patch.end(), vertices.begin(), vertices.end());
        mean_density += density_of(*cell) / cells.size();
      }
    std::sort(patch.begin(), patch.end());
    patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
    patches.add(patch.begin(), patch.end());

    // S - D·W⁻¹ D, where only the ratios of densities matter
    const unsigned int          n = patch.size();
    Tensor<2, dim>              W;
    std::vector<Tensor<1, dim>> D(n);
    first_entry.push_back(entries.size());
    entries.resize(entries.size() + n * n);
    double *const S = entries.data() + first_entry.back();
    for (const OverlappedCell<dim> *cell : cells)
      {
        const double density =
          mean_density > 0 ? density_of(*cell) / mean_density : 1.;
        std::array<unsigned int, dim + 1> place;
        for (unsigned int v = 0; v <= dim; ++v)
          place[v] =
            std::lower_bound(patch.begin(),
                             patch.end(),
                             grid.geometry().vertex_indices(cell->cell)[v]) -
            patch.begin();
        for (unsigned int I = 0; I <= dim; ++I)
          for (unsigned int J = 0; J <= dim; ++J)
            {
              const double entry =
                kernel.stabilisation.projection_entry(cell->compliance, I, J) /
                (dim + 1);
              const Tensor<1, dim> x_I = cell->corners[I] - cell->corners[0],
                                   x_J = cell->corners[J] - cell->corners[0];
              S[place[I] * n + place[J]] += entry;
              D[place[J]] += density * entry * x_I;
              W += density * density * entry * outer_product(x_I, x_J);
            }
      }
    // A hair of what there is with c = 0: a pressure that is linear all over
    // the body does no work where nodes are held along its gradient, as in a
    // column one cell wide between walls, and at ν = 1/2 nothing else would
    // determine it.
    const Tensor<2, dim> inverse = invert(W) / (1 + rounding::numbers);
    for (unsigned int I = 0; I < n; ++I)
      {
        const Tensor<1, dim> c = inverse * D[I];
        for (unsigned int J = 0; J < n; ++J)
          S[I * n + J] -= c * D[J];
      }
  }



  template <int dim>
  void
  OrthogonalSubscales<dim>::start_step()
  {
    patches.clear();
    entries.clear();
    first_entry.clear();
    if (!kernel.stabilisation.has_orthogonal_subscales)
      return;
    find_roots(); // a run that is resumed touches no vertices
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    const auto cells = cells_at_owned_nodes();
    std::map<unsigned int, std::vector<const OverlappedCell<dim> *>> at_node;
    for (const auto &cell : cells)
      for (const unsigned int v : roots(cell.first))
        if (grid.vertex_owner(v) == rank)
          at_node[v].push_back(&cell.second);
    for (const auto &node : at_node)
      add_patch(node.second);
  }



  template <int dim>
  void
  OrthogonalSubscales<dim>::collect_elements(const StepContext<dim> &step,
                                             ElementNodes           &elements)
  {
    std::vector<unsigned int> nodes;
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        nodes.clear();
        for (std::size_t i = patches.start[k]; i < patches.start[k + 1]; ++i)
          nodes.push_back(step.nodes.node(patches.node[i]));
        elements.add(nodes.begin(), nodes.end());
      }
  }



  template <int dim>
  void
  OrthogonalSubscales<dim>::evaluate(const unsigned int      k,
                                     const StepContext<dim> &step,
                                     const NodalField       &unknowns,
                                     std::vector<double>    &volume) const
  {
    const NodalUnknowns<dim>  nodal(step, unknowns);
    const unsigned int *const vertex = patches.node.data() + patches.start[k];
    const unsigned int        n      = patches.start[k + 1] - patches.start[k];
    const double             *S      = entries.data() + first_entry[k];
    volume.assign(n, 0.);
    for (unsigned int J = 0; J < n; ++J)
      {
        const double p = nodal.pressure(vertex[J]);
        for (unsigned int I = 0; I < n; ++I)
          volume[I] -= S[J * n + I] * p;
      }
  }



  template <int dim>
  EvaluationStatus
  OrthogonalSubscales<dim>::assemble(const StepContext<dim> &step,
                                     const NodalField       &unknowns,
                                     const NodalField       &pending,
                                     const unsigned int      first_element,
                                     const bool              with_matrix,
                                     MixedSystem<dim>       &system)
  {
    constexpr unsigned int nc = dim + 1;
    std::vector<double>    volume, residual, matrix;
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        const unsigned int n = patches.start[k + 1] - patches.start[k];
        evaluate(k, step, unknowns, volume);
        residual.assign(n * nc, 0.);
        for (unsigned int I = 0; I < n; ++I)
          residual[I * nc + dim] = volume[I];
        if (with_matrix)
          {
            matrix.assign(n * nc * n * nc, 0.);
            const double *S = entries.data() + first_entry[k];
            for (unsigned int I = 0; I < n; ++I)
              for (unsigned int J = 0; J < n; ++J)
                matrix[(I * nc + dim) * n * nc + J * nc + dim] = -S[I * n + J];
          }
        system.add_element(first_element + k,
                           residual.data(),
                           with_matrix ? matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  double
  OrthogonalSubscales<dim>::energy(const StepContext<dim> &step,
                                   const NodalField       &unknowns) const
  {
    if (!kernel.stabilisation.has_orthogonal_subscales)
      return 0;
    const NodalUnknowns<dim> nodal(step, unknowns);
    std::vector<double>      volume;
    double                   sum = 0;
    for (unsigned int k = 0; k < patches.size(); ++k)
      {
        evaluate(k, step, unknowns, volume);
        for (unsigned int I = 0; I < volume.size(); ++I)
          sum -=
            nodal.pressure(patches.node[patches.start[k] + I]) * volume[I] / 2;
      }
    return Utilities::MPI::sum(sum, grid.communicator());
  }



  template class OrthogonalSubscales<2>;
  template class OrthogonalSubscales<3>;
} // namespace isochor
