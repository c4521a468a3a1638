/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of GridAdaptation that carry the last motion to the next grid.
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/grid_adaptation.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  typename GridAdaptation<dim>::Motion
  GridAdaptation<dim>::motion_in_old_grid(const BackgroundGrid<dim> &grid,
                                          const LastMotion &last_motion)
  {
    Motion motion;
    if (last_motion.step_size == 0)
      return motion;
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    motion.leaves                   = forest.leaves();
    for (unsigned int leaf = 0; leaf < motion.leaves.size(); ++leaf)
      motion.first_cells.push_back(forest.first_cell(leaf));
    motion.geometry =
      std::make_unique<const SimplexGeometry<dim>>(grid.geometry());

    unsigned int n =
      last_motion.vertices.empty() ?
        0 :
        last_motion.unknowns.size() / last_motion.vertices.size();
    n                   = Utilities::MPI::max(n, grid.communicator());
    motion.n_components = n;
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
    motion.unknowns.resize(n_vertices * n);
    motion.is_known.resize(n_vertices);
    for (std::size_t v = 0; v < n_vertices; ++v)
      {
        const double *row  = &sums[v * (n + 1)];
        motion.is_known[v] = row[n] > 0;
        for (unsigned int a = 0; a < n && row[n] > 0; ++a)
          motion.unknowns[v * n + a] = row[a] / row[n];
      }
    return motion;
  }



  template <int dim>
  void
  GridAdaptation<dim>::set_motion_in_new_grid(const Motion              &motion,
                                              const BackgroundGrid<dim> &grid,
                                              LastMotion &last_motion)
  {
    last_motion.vertices.clear();
    last_motion.unknowns.clear();
    if (!motion.geometry)
      return;
    const PointLocator<dim>     locator(*motion.geometry);
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const AdaptiveGrid<dim>    &forest   = grid.adaptive_grid();
    const unsigned int          n        = motion.n_components;
    std::vector<unsigned char>  done(geometry.vertices().size(), 0);
    std::vector<double>         values(n);
    for (unsigned int i = 0; i < forest.leaves().size(); ++i)
      {
        const Leaf<dim>   &leaf = forest.leaves()[i];
        const unsigned int hint =
          motion
            .first_cells[find_leaf<dim>(motion.leaves, leaf.tree, leaf.corner)];
        for (unsigned int cell = forest.first_cell(i);
             cell < forest.first_cell(i + 1);
             ++cell)
          for (const unsigned int v : geometry.vertex_indices(cell))
            {
              if (done[v])
                continue;
              done[v]          = 1;
              const auto place = locator.locate(geometry.vertices()[v], hint);
              if (!place.found)
                continue;
              const auto &old   = motion.geometry->vertex_indices(place.cell);
              bool        known = true;
              std::fill(values.begin(), values.end(), 0.);
              for (unsigned int w = 0; w <= dim; ++w)
                {
                  known = known && (motion.is_known[old[w]] ||
                                    place.barycentric[w] < 1e-10);
                  for (unsigned int a = 0; a < n; ++a)
                    values[a] += place.barycentric[w] *
                                 motion.unknowns[old[w] * std::size_t(n) + a];
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



  template typename GridAdaptation<2>::Motion
  GridAdaptation<2>::motion_in_old_grid(const BackgroundGrid<2> &,
                                        const LastMotion &);
  template void
  GridAdaptation<2>::set_motion_in_new_grid(const Motion &,
                                            const BackgroundGrid<2> &,
                                            LastMotion &);
  template typename GridAdaptation<3>::Motion
  GridAdaptation<3>::motion_in_old_grid(const BackgroundGrid<3> &,
                                        const LastMotion &);
  template void
  GridAdaptation<3>::set_motion_in_new_grid(const Motion &,
                                            const BackgroundGrid<3> &,
                                            LastMotion &);
} // namespace isochor
