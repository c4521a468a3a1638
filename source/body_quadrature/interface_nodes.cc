/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/body_quadrature/interface_corners.h>
#include <isochor/body_quadrature/walls_at_place.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

// Whose functions cells have that materials share.

namespace isochor
{
  template <int dim>
  typename InterfaceCorners<dim>::Groups
  InterfaceCorners<dim>::group_that_wants(const Content &here)
  {
    constexpr double half       = 0.47;
    const bool       is_shared  = (here.groups & (here.groups - 1)) != 0,
               most_is_stiffest = here.groups >> here.most == 1;
    return is_shared && most_is_stiffest && here.filled_by_most > half &&
               !here.is_at_seam ?
             Groups(1) << here.most :
             0;
  }



  template <int dim>
  bool
  InterfaceCorners<dim>::has_foreign_node(const unsigned int      of_element,
                                          const GroupsAtVertices &groups) const
  {
    const Groups own = content(of_element).groups;
    for (const unsigned int v :
         occupancy.grid.shape_functions().nodes(of_element))
      if (const auto found = groups.find(v);
          found != groups.end() && (found->second & ~own) != 0)
        return true;
    return false;
  }



  template <int dim>
  void
  InterfaceCorners<dim>::find_cells_that_keep_nodes()
  {
    const SimplexGeometry<dim> &geometry = locator.geometry();
    const unsigned int          me =
      Utilities::MPI::this_mpi_process(geometry.communicator());
    const auto wanted = groups_at_vertices(group_that_wants);
    if (wanted.empty())
      return;
    const auto is_free = [&](const unsigned int cell, const Groups own) {
      const Content there = content(cell);
      return there.is_own && there.groups == own &&
             !has_foreign_node(element(cell), wanted);
    };
    // with others around it: a layer has to keep three rows
    const auto is_deep = [&](const unsigned int cell, const Groups own) {
      if (!is_free(cell, own))
        return false;
      for (const unsigned int v :
           occupancy.grid.shape_functions().nodes(element(cell)))
        for (const unsigned int other : occupancy.cells_at(v))
          if (content(other).groups != 0 && !is_free(other, own))
            return false;
      return true;
    };
    // searches meet the same elements; each is of one group
    std::unordered_map<unsigned int, bool> known;
    const auto is_known_deep = [&](const unsigned int cell, const Groups own) {
      if (content(cell).groups != own)
        return false;
      const auto [entry, is_new] = known.emplace(element(cell), false);
      if (is_new)
        entry->second = is_deep(cell, own);
      return entry->second;
    };
    const auto has_another = [&](const unsigned int of_element,
                                 const Groups       own,
                                 const double       within) {
      const auto nodes = occupancy.grid.shape_functions().nodes(of_element);
      return std::all_of(nodes.begin(), nodes.end(), [&](const unsigned int v) {
        const WallsAtPlace<dim> walls(occupancy,
                                      occupancy.cells_at(v)[0],
                                      geometry.vertices()[v]);
        return nearest(
                 cell_centroid(geometry, of_element),
                 of_element,
                 [&](const unsigned int cell) {
                   return walls.are_those_of(cell) && is_known_deep(cell, own);
                 },
                 within) != no_cell;
      });
    };
    for (auto &[of_element, here] : contents)
      {
        Groups takers = 0;
        for (const unsigned int v :
             occupancy.grid.shape_functions().nodes(of_element))
          if (const auto found = wanted.find(v); found != wanted.end())
            takers |= found->second;
        const Groups losers    = here.groups & ~takers;
        const bool   is_shared = (here.groups & (here.groups - 1)) != 0;
        if (takers == 0 || losers == 0 || !(here.is_own || is_shared) ||
            geometry.owner(of_element) != me)
          continue;
        here.keeps_nodes = here.is_own && (takers & ~here.groups) < here.groups;
        for (Groups own = 1; own != 0 && own <= losers; own <<= 1)
          if ((losers & own) != 0 &&
              !has_another(of_element,
                           own,
                           is_shared ? reach_without_nodes + 1 :
                                       reach_without_nodes))
            here.keeps_nodes = true;
      }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::give_cells_to_stiffest()
  {
    const auto wanted      = groups_at_vertices(group_that_wants);
    const auto others_keep = [&](const unsigned int v, const Groups own) {
      for (const unsigned int cell : occupancy.cells_at(v))
        if (const Content there = content(cell);
            there.keeps_nodes && there.groups != own)
          return true;
      return false;
    };
    for (auto &[of_element, here] : contents)
      if (const Groups own = group_that_wants(here); own != 0)
        {
          const auto &nodes =
            occupancy.grid.shape_functions().nodes(of_element);
          here.is_of_stiffest =
            !here.keeps_nodes &&
            std::none_of(nodes.begin(), nodes.end(), [&](const unsigned int v) {
              return wanted.at(v) > 2 * own - 1 || others_keep(v, own);
            });
          here.is_own = here.is_of_stiffest;
        }
  }



  template <int dim>
  void
  InterfaceCorners<dim>::take_nodes_of_stiffest()
  {
    const auto given = groups_at_vertices([](const Content &here) {
      return here.is_of_stiffest ? Groups(1) << here.most : 0;
    });
    for (auto &[of_element, here] : contents)
      if (here.is_own && !here.is_of_stiffest &&
          has_foreign_node(of_element, given))
        here.is_own = false;
  }



  template typename InterfaceCorners<2>::Groups
  InterfaceCorners<2>::group_that_wants(const Content &);
  template typename InterfaceCorners<3>::Groups
  InterfaceCorners<3>::group_that_wants(const Content &);
  template bool
  InterfaceCorners<2>::has_foreign_node(const unsigned int,
                                        const GroupsAtVertices &) const;
  template bool
  InterfaceCorners<3>::has_foreign_node(const unsigned int,
                                        const GroupsAtVertices &) const;
  template void
  InterfaceCorners<2>::find_cells_that_keep_nodes();
  template void
  InterfaceCorners<3>::find_cells_that_keep_nodes();
  template void
  InterfaceCorners<2>::give_cells_to_stiffest();
  template void
  InterfaceCorners<3>::give_cells_to_stiffest();
  template void
  InterfaceCorners<2>::take_nodes_of_stiffest();
  template void
  InterfaceCorners<3>::take_nodes_of_stiffest();
} // namespace isochor
