/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/carried_motion.h>
#include <isochor/material_points/point_locator.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  CarriedMotion<dim>::CarriedMotion(const BackgroundGrid<dim> &grid,
                                    const LastMotion          &last_motion)
  {
    if (last_motion.step_size == 0)
      return;
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    leaves                          = forest.leaves();
    for (unsigned int leaf = 0; leaf < leaves.size(); ++leaf)
      first_cells.push_back(forest.first_cell(leaf));
    geometry = std::make_unique<const SimplexGeometry<dim>>(grid.geometry());

    unsigned int n =
      last_motion.vertices.empty() ?
        0 :
        last_motion.unknowns.size() / last_motion.vertices.size();
    n            = Utilities::MPI::max(n, grid.communicator());
    n_components = n;
    const std::size_t   n_vertices = grid.geometry().vertices().size();
    std::vector<double> sums(n_vertices * (n + 1), 0.); // and from how many
    for (unsigned int i = 0; i < last_motion.vertices.size(); ++i)
      {
        if (last_motion.vertices[i] >= n_vertices)
          continue; // a control node
        double *row = &sums[last_motion.vertices[i] * (n + 1)];
        std::copy_n(&last_motion.unknowns[i * n], n, row);
        row[n] = 1;
      }
    Utilities::MPI::sum(sums, grid.communicator(), sums);
    unknowns.resize(n_vertices * n);
    is_known.resize(n_vertices);
    for (std::size_t v = 0; v < n_vertices; ++v)
      {
        const double *row = &sums[v * (n + 1)];
        is_known[v]       = row[n] > 0;
        for (unsigned int a = 0; a < n && row[n] > 0; ++a)
          unknowns[v * n + a] = row[a] / row[n];
      }
  }



  template <int dim>
  void
  CarriedMotion<dim>::hand_over(const BackgroundGrid<dim> &grid,
                                LastMotion                &last_motion) const
  {
    last_motion.vertices.clear();
    last_motion.unknowns.clear();
    if (!geometry)
      return;
    const PointLocator<dim>     locator(*geometry);
    const SimplexGeometry<dim> &target = grid.geometry();
    const AdaptiveGrid<dim>    &forest = grid.adaptive_grid();
    const unsigned int          n      = n_components;
    std::vector<unsigned char>  done(target.vertices().size(), 0);
    std::vector<double>         values(n);
    for (unsigned int i = 0; i < forest.leaves().size(); ++i)
      {
        const Leaf<dim>   &leaf = forest.leaves()[i];
        const unsigned int hint =
          first_cells[find_leaf<dim>(leaves, leaf.tree, leaf.corner)];
        for (unsigned int cell = forest.first_cell(i);
             cell < forest.first_cell(i + 1);
             ++cell)
          for (const unsigned int v : target.vertex_indices(cell))
            {
              if (done[v])
                continue;
              done[v]          = 1;
              const auto place = locator.locate(target.vertices()[v], hint);
              if (!place.found)
                continue;
              const auto &old   = geometry->vertex_indices(place.cell);
              bool        known = true;
              std::fill(values.begin(), values.end(), 0.);
              for (unsigned int w = 0; w <= dim; ++w)
                {
                  known =
                    known && (is_known[old[w]] || place.barycentric[w] < 1e-10);
                  for (unsigned int a = 0; a < n; ++a)
                    values[a] += place.barycentric[w] *
                                 unknowns[old[w] * std::size_t(n) + a];
                }
              if (!known)
                continue;
              last_motion.vertices.push_back(v);
              last_motion.unknowns.insert(last_motion.unknowns.end(),
                                          values.begin(),
                                          values.end());
            }
      }
  }



  template class CarriedMotion<2>;
  template class CarriedMotion<3>;
} // namespace isochor
