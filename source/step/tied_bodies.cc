/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/step/tied_bodies.h>

#include <algorithm>
#include <limits>
#include <sstream>
#include <vector>

namespace isochor
{
  namespace
  {
    /** Call @p visit(part, node) for each node that a point of each part acts
     * on, with local numbers. */
    template <int dim, typename Function>
    void
    for_nodes_of_parts(const std::vector<unsigned int> &parts,
                       const StepContext<dim>          &step,
                       const Function                  &visit)
    {
      const PointArrays<dim> &points = step.points;
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          if (parts[q] == numbers::invalid_unsigned_int)
            continue; // split off one that counts
          else if (points.has_stencils())
            for (std::size_t i = points.stencil_start[q];
                 i < points.stencil_start[q + 1];
                 ++i)
              visit(parts[q], step.nodes.node(points.stencil_vertex[i]));
          else
            for (const unsigned int vertex :
                 step.grid.geometry().vertex_indices(points.cell[k]))
              visit(parts[q], step.nodes.node(vertex));
    }



    /** The numbers of parts that belong together on some rank, as root(i) and i
     * do, merged over all ranks. Collective. */
    unsigned int
    n_sets_over_ranks(DisjointSets      &sets,
                      const unsigned int n_parts,
                      const MPI_Comm     comm)
    {
      std::vector<unsigned int> roots(n_parts);
      for (unsigned int part = 0; part < n_parts; ++part)
        roots[part] = sets.root(part);
      DisjointSets merged(n_parts);
      for (const auto &of_rank : Utilities::MPI::all_gather(comm, roots))
        for (unsigned int part = 0; part < n_parts; ++part)
          merged.merge(part, of_rank[part]);
      return merged.size();
    }
  } // namespace



  template <int dim>
  void
  warn_of_tied_bodies(const MaterialPoints<dim> &body,
                      const StepContext<dim>    &step)
  {
    const unsigned int n_parts = body.n_parts_at_start();
    if (n_parts < 2)
      return;
    const MPI_Comm                  comm  = step.grid.communicator();
    const std::vector<unsigned int> parts = body.parts_at_start();

    // the least and, as its negative, the largest part of each node
    NodalField   range;
    const double none = std::numeric_limits<double>::max();
    step.nodes.initialize(range, 2);
    for (unsigned int i = 0; i < 2 * step.nodes.n_local(); ++i)
      range.local_element(i) = none;
    for_nodes_of_parts(parts, step, [&](const double part, const auto node) {
      double &least = range.local_element(2 * node);
      double &most  = range.local_element(2 * node + 1);
      least         = std::min(least, part);
      most          = std::min(most, -part);
    });
    range.set_ghost_state(false);
    range.compress(VectorOperation::min);
    range.update_ghost_values();

    unsigned int n_shared = 0, first = step.grid.geometry().vertices().size();
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (range.local_element(2 * node) < none &&
          range.local_element(2 * node) != -range.local_element(2 * node + 1))
        {
          ++n_shared;
          first = std::min(first, step.nodes.vertex(node));
        }
    n_shared = Utilities::MPI::sum(n_shared, comm);
    if (n_shared == 0)
      return;
    first = Utilities::MPI::min(first, comm);
    DisjointSets sets(n_parts);
    for_nodes_of_parts(parts, step, [&](const auto part, const auto node) {
      sets.merge(part, range.local_element(2 * node));
    });
    const unsigned int n_bodies = n_sets_over_ranks(sets, n_parts, comm);

    std::ostringstream text;
    text << "At the start the body has " << n_parts
         << " parts whose points (by their domains) have no corner in common, "
            "but they are as "
         << (n_bodies == 1 ? "one body" : std::to_string(n_bodies) + " bodies")
         << ", as " << n_shared
         << " nodes of the grid belong to several, one of them at ("
         << step.grid.geometry().vertices()[first]
         << "). Where parts share nodes they are tied: a gap between them "
            "carries load before it is closed (3.3 times the force, of blocks "
            "half a cell apart that are pressed by 1.4 times that), they pull "
            "at each other, and don't slide. If they are bodies of their own, "
            "take a finer grid or a wider gap: of two cells it is always wide "
            "enough. If they are meant to be one, nothing is wrong, but where "
            "meshes meet whose nodes don't match strains are less accurate.";
    step.warnings.add("bodies that are one", text.str());
  }



  template void
  warn_of_tied_bodies(const MaterialPoints<2> &, const StepContext<2> &);
  template void
  warn_of_tied_bodies(const MaterialPoints<3> &, const StepContext<3> &);
} // namespace isochor
