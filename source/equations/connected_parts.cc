/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/disjoint_sets.h>
#include <isochor/equations/connected_parts.h>
#include <isochor/equations/invariants.h>

#include <algorithm>
#include <limits>
#include <vector>

namespace isochor
{
  template <int dim>
  std::vector<unsigned int>
  part_names(const StepContext<dim> &step, const ElementNodes &elements)
  {
    Assert(invariants::is_compressed(elements.start, elements.node.size()),
           ExcInternalError());
    Assert(std::all_of(elements.node.begin(),
                       elements.node.end(),
                       [&](const unsigned int node) {
                         return node < step.nodes.n_local();
                       }),
           ExcMessage("An element has a node that is not active."));
    const unsigned int n_local = step.nodes.n_local();
    DisjointSets       sets(n_local);
    for (unsigned int e = 0; e < elements.size(); ++e)
      for (std::size_t i = elements.start[e] + 1; i < elements.start[e + 1];
           ++i)
        sets.merge(elements.node[elements.start[e]], elements.node[i]);

    // what ranks have in common lets a name go round
    const MPI_Comm comm = step.grid.communicator();
    NodalField     name;
    step.nodes.initialize(name, 1);
    for (unsigned int node = 0; node < n_local; ++node)
      name.local_element(node) = step.nodes.vertex(node);
    for (bool changed = true; changed;)
      {
        std::vector<double> least(n_local, std::numeric_limits<double>::max());
        for (unsigned int node = 0; node < n_local; ++node)
          {
            double &of_part = least[sets.root(node)];
            of_part         = std::min(of_part, name.local_element(node));
          }
        changed = false;
        for (unsigned int node = 0; node < n_local; ++node)
          if (const double least_name = least[sets.root(node)];
              name.local_element(node) != least_name)
            {
              name.local_element(node) = least_name;
              changed                  = true;
            }
        if (Utilities::MPI::n_mpi_processes(comm) == 1)
          break;
        changed = Utilities::MPI::max(changed ? 1 : 0, comm) != 0;
        name.set_ghost_state(false);
        name.compress(VectorOperation::min);
        name.update_ghost_values();
      }
    std::vector<unsigned int> names(n_local);
    for (unsigned int node = 0; node < n_local; ++node)
      names[node] = name.local_element(node);
    return names;
  }



  template <int dim>
  unsigned int
  number_of_parts(const StepContext<dim> &step, const ElementNodes &elements)
  {
    const std::vector<unsigned int> names   = part_names(step, elements);
    unsigned int                    n_parts = 0;
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (step.nodes.control_node(node) == nullptr &&
          names[node] == step.nodes.vertex(node))
        ++n_parts;
    return Utilities::MPI::sum(n_parts, step.grid.communicator());
  }



  template std::vector<unsigned int>
  part_names(const StepContext<2> &, const ElementNodes &);
  template std::vector<unsigned int>
  part_names(const StepContext<3> &, const ElementNodes &);
  template unsigned int
  number_of_parts(const StepContext<2> &, const ElementNodes &);
  template unsigned int
  number_of_parts(const StepContext<3> &, const ElementNodes &);
} // namespace isochor
