/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_quadrature/interface_corners.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/grid/simplex_overlap.h>

#include <algorithm>
#include <numeric>

// What materials cells hold.

namespace isochor
{
  namespace
  {
    /** What domains have in a cell by this part of their size only doesn't keep
     * others from the functions of the cell: they are wrong by as much at
     * most. */
    constexpr double hardly_inside = 0.02;

    /** The part of a cell that a material fills whose gradient it then is. */
    constexpr double well_filled = 0.3;

    const auto all_groups = [](const auto &here) { return here.groups; };
  } // namespace



  template <int dim>
  typename InterfaceCorners<dim>::Volumes
  InterfaceCorners<dim>::volumes_of_groups(const PointArrays<dim> &points) const
  {
    // cells of one element may belong to several ranks
    Volumes volumes;
    std::map<unsigned int,
             std::vector<std::pair<unsigned int, std::vector<double>>>>
      sent;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        const unsigned int   of_element = element(points.cell[k]);
        std::vector<double> &here       = volumes[of_element];
        here.resize(materials.size());
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          here[materials.of_material[points.material[q]]] +=
            determinant(points.F[q]) * points.volume[q];
      }
    const MPI_Comm comm = locator.geometry().communicator();
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return volumes;
    for (const auto &of_element : volumes)
      for (const unsigned int rank :
           occupancy.ranks_near_cell(of_element.first))
        sent[rank].push_back(of_element);
    for (const auto &received : Utilities::MPI::some_to_some(comm, sent))
      for (const auto &[of_element, there] : received.second)
        {
          std::vector<double> &here = volumes[of_element];
          here.resize(materials.size());
          for (unsigned int g = 0; g < materials.size(); ++g)
            here[g] += there[g];
        }
    return volumes;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::collect_contents(const PointArrays<dim> &points)
  {
    const auto measure = [&](const unsigned int of_element) {
      double sum = 0;
      for (const unsigned int cell :
           occupancy.grid.shape_functions().element(of_element))
        sum += locator.geometry().measure(cell);
      return sum;
    };
    const unsigned int n_groups = materials.size();
    for (const Corner &corner : corners) // of a group or, so far, of none
      contents[element(corner.place.cell)];
    for (const auto &[of_element, volume] : volumes_of_groups(points))
      {
        Content &here = contents[of_element];
        here.filled   = std::accumulate(volume.begin(), volume.end(), 0.) /
                      measure(of_element);
        for (unsigned int g = 0; g < n_groups; ++g)
          if (volume[g] > 0)
            {
              here.groups |= Groups(1) << g;
              // of equals, but for rounding, the stiffest
              if (volume[g] >= (1 - 1e-6) * volume[here.most])
                here.most = g;
            }
        here.filled_by_most = volume[here.most] / measure(of_element);
      }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::add_overlaps(const PointArrays<dim> &points)
  {
    // Corners don't tell: a domain may reach into a cell in which it has none.
    const auto groups_at    = groups_at_vertices(all_groups);
    const auto is_at_others = [&](const unsigned int cell, const Groups own) {
      for (const unsigned int v : locator.geometry().vertex_indices(cell))
        if (const auto found = groups_at.find(v);
            found != groups_at.end() && (found->second & ~own) != 0)
          return true;
      return false;
    };
    for (unsigned int q = 0; q < points.domain.size(); ++q)
      {
        const Corner *const of_domain = &corners[q * (dim + 1)];
        const Groups        own       = Groups(1) << of_domain->group;
        for (unsigned int c = 0; c <= dim; ++c)
          if (const unsigned int cell = of_domain[c].place.cell;
              is_at_others(cell, own))
            for (const unsigned int v : locator.geometry().vertex_indices(cell))
              for (const unsigned int other : occupancy.cells_at(v))
                if (const Groups there = content(other).groups;
                    there != 0 && (there & own) == 0 &&
                    reaches_into(of_domain, other))
                  contents[element(other)].groups |= own;
      }
  }



  template <int dim>
  bool
  InterfaceCorners<dim>::reaches_into(const Corner *const of_domain,
                                      const unsigned int  cell) const
  {
    Point<dim> centre;
    for (unsigned int c = 0; c <= dim; ++c)
      centre += of_domain[c].x / (dim + 1.);
    SimplexInCell<dim> simplex;
    for (unsigned int c = 0; c <= dim; ++c)
      simplex[c] = locator.geometry().barycentric(
        cell, centre + (1 - hardly_inside) * (of_domain[c].x - centre));
    return overlap_with_cell<dim>(simplex) > 0;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::exchange_contents()
  {
    const MPI_Comm comm = locator.geometry().communicator();
    if (Utilities::MPI::n_mpi_processes(comm) == 1)
      return;
    std::map<unsigned int, std::vector<std::pair<unsigned int, Content>>> sent;
    for (const auto &of_element : contents)
      for (const unsigned int rank :
           occupancy.ranks_near_cell(of_element.first))
        sent[rank].push_back(of_element);
    for (const auto &received : Utilities::MPI::some_to_some(comm, sent))
      for (const auto &[of_element, there] : received.second)
        {
          Content &here = contents[of_element];
          here.groups |= there.groups;
          here.moving |= there.moving;
          // what is around is best known to the owner
          if (locator.geometry().owner(of_element) == received.first)
            {
              here.has_own_pressures = there.has_own_pressures;
              here.is_own            = there.is_own;
              here.is_thin           = there.is_thin;
              here.keeps_nodes       = there.keeps_nodes;
              here.is_of_stiffest    = there.is_of_stiffest;
              here.meets_others      = there.meets_others;
              here.is_at_seam        = there.is_at_seam;
            }
        }
  }



  template <int dim>
  typename InterfaceCorners<dim>::GroupsAtVertices
  InterfaceCorners<dim>::groups_at_vertices(
    const std::function<Groups(const Content &)> &groups) const
  {
    GroupsAtVertices groups_at;
    for (const auto &[of_element, here] : contents)
      if (const Groups of_here = groups(here); of_here != 0)
        for (const unsigned int v :
             occupancy.grid.shape_functions().nodes(of_element))
          groups_at[v] |= of_here;
    return groups_at;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_own_functions()
  {
    const auto groups_at = groups_at_vertices(all_groups);
    for (auto &[of_element, here] : contents)
      {
        Groups around = here.groups;
        for (const unsigned int v :
             occupancy.grid.shape_functions().nodes(of_element))
          {
            if (const auto found = groups_at.find(v); found != groups_at.end())
              around |= found->second;
            here.is_at_seam =
              here.is_at_seam || occupancy.is_near_periodic_side(v);
          }
        const bool is_one = (here.groups & (here.groups - 1)) == 0;
        here.meets_others = (around & (around - 1)) != 0;
        // A cell at the end of the body that is hardly filled may have nodes
        // beyond the interface.
        here.is_own =
          is_one && (around == here.groups || here.filled > well_filled);
        here.has_own_pressures = is_one && (around & (here.groups - 1)) == 0;
      }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_thin_layers()
  {
    const SimplexGeometry<dim> &geometry = locator.geometry();
    const unsigned int          me =
      Utilities::MPI::this_mpi_process(geometry.communicator());
    for (auto &[of_element, here] : contents)
      if (here.is_own && !here.has_own_pressures &&
          geometry.owner(of_element) == me)
        here.is_thin =
          nearest(
            cell_centroid(geometry, of_element),
            of_element,
            [&, own = here.groups](const unsigned int cell) {
              const Content there = content(cell);
              return there.has_own_pressures && there.groups == own;
            },
            reach_without_nodes) == no_cell;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::give_pressures_to_thin_layers()
  {
    const auto &functions = occupancy.grid.shape_functions();
    std::unordered_map<unsigned int, Groups> owner_at; // vertices; the stiffest
    for (const auto &[of_element, here] : contents)
      if (here.is_thin)
        for (const unsigned int v : functions.nodes(of_element))
          owner_at[v] = std::max(owner_at[v], here.groups);
    if (owner_at.empty())
      return;
    for (const auto &[v, around] : groups_at_vertices(all_groups))
      owner_at.emplace(v, around & ~(around - 1)); // the softest
    for (auto &[of_element, here] : contents)
      {
        here.has_own_pressures = here.groups != 0;
        for (const unsigned int v : functions.nodes(of_element))
          here.has_own_pressures =
            here.has_own_pressures && owner_at.at(v) == here.groups;
      }
  }



  template typename InterfaceCorners<2>::Volumes
  InterfaceCorners<2>::volumes_of_groups(const PointArrays<2> &) const;
  template typename InterfaceCorners<3>::Volumes
  InterfaceCorners<3>::volumes_of_groups(const PointArrays<3> &) const;
  template void
  InterfaceCorners<2>::collect_contents(const PointArrays<2> &);
  template void
  InterfaceCorners<3>::collect_contents(const PointArrays<3> &);
  template void
  InterfaceCorners<2>::add_overlaps(const PointArrays<2> &);
  template void
  InterfaceCorners<3>::add_overlaps(const PointArrays<3> &);
  template void
  InterfaceCorners<2>::exchange_contents();
  template void
  InterfaceCorners<3>::exchange_contents();
  template void
  InterfaceCorners<2>::find_thin_layers();
  template void
  InterfaceCorners<3>::find_thin_layers();
  template void
  InterfaceCorners<2>::give_pressures_to_thin_layers();
  template void
  InterfaceCorners<3>::give_pressures_to_thin_layers();
  template void
  InterfaceCorners<2>::find_own_functions();
  template void
  InterfaceCorners<3>::find_own_functions();
} // namespace isochor
