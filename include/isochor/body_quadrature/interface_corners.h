/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interface_corners_h
#define isochor_interface_corners_h

#include <isochor/cut_cells/cell_occupancy.h>
#include <isochor/equations/material_groups.h>
#include <isochor/material_points/point_locator.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <unordered_map>
#include <vector>

namespace isochor
{
  /**
   * The corners of domains in cells that materials of other stiffness share.
   * The functions of such a cell have one gradient for both; a corner of a
   * stiff domain that lies in it by a part d of the cell would strain the
   * domain by d times the strain of the soft material. These corners therefore
   * see the functions of the nearest cell that only holds their own material,
   * continued to where they are; so each material has its own gradient, and the
   * two meet in the domains at the interface: what is linear in each of them,
   * and continuous, is exact, wherever the interface lies in its cells. A
   * corner that domains of both share is one of the stiffest, for all of them,
   * so that the domains go on tiling the body.
   *
   * In statics pressures do so as well, and also where the interface lies on
   * faces of cells: nodes that materials share have the pressures of the
   * softest, and corners of others see the nearest cell of their own without
   * such nodes. See doc/method.md, Materials that meet.
   *
   * What counts as another material says MaterialGroups.
   */
  template <int dim>
  class InterfaceCorners
  {
  public:
    /** Of the @p points, located. Collective. */
    InterfaceCorners(const PointArrays<dim>   &points,
                     const PointLocator<dim>  &locator,
                     const CellOccupancy<dim> &occupancy,
                     const MixedKernel<dim>   &kernel);

    static constexpr unsigned int no_cell = SimplexGeometry<dim>::no_cell;

    /** Whether there are materials that differ. */
    bool
    is_needed() const
    {
      return materials.size() > 1;
    }

    /** Where corner @p c of point @p q is, if is_needed(): @p r from the point
     * at @p x. */
    const LocateResult<dim> &
    place(const unsigned int q,
          const unsigned int c,
          const Point<dim>  &x,
          Tensor<1, dim>    &r) const
    {
      const Corner &corner = corners[q * (dim + 1) + c];
      r                    = corner.x - x;
      return corner.place;
    }

    /** The cell whose functions corner @p c of point @p q sees, if that isn't
     * the one that it lies in; else no_cell. */
    unsigned int
    cell(const unsigned int q, const unsigned int c) const
    {
      return find(others, q * (dim + 1) + c);
    }

    /** The same for pressures; no_cell if it is that for displacements. */
    unsigned int
    pressure_cell(const unsigned int q, const unsigned int c) const
    {
      return find(others_of_pressure, q * (dim + 1) + c);
    }

    /** Whether the pressures of @p cell are those of @p material only: see
     * find_own_functions(). */
    bool
    has_own_pressures(const unsigned int  cell,
                      const unsigned char material) const
    {
      return has_pressures_of(cell, materials.of_material[material]);
    }

    /** Whether pressures see other cells anywhere. */
    bool
    separates_pressures() const
    {
      return !others_of_pressure.empty();
    }

    /** The corner of most weight on this rank that has no cell of its own
     * material nearby, and lies in one that it shares, or one of a domain that
     * has none of its own. */
    const InterfaceCrossing &
    worst_crossing() const
    {
      return worst;
    }

  private:
    /** How far away corners see cells of their own material, in sizes of
     * cells, and where it goes without the nodes at the interface. (Not
     * distances that regular grids have.) */
    static constexpr double reach = 1.53, reach_without_nodes = 2.07;

    /** A set of groups of materials, one bit each. */
    using Groups = std::uint64_t;

    /** What an element holds, of those that hold points or corners. */
    struct Content
    {
      Groups       groups = 0;
      Groups       moving = 0; ///< see find_layers_of_one_domain()
      unsigned int most   = 0; ///< the group of most of the points' volume
      /** Whether its functions are those of one group, the only one, for
       * displacements and for pressures. See find_own_functions(). */
      bool has_own_pressures = false, is_own = false;
      bool meets_others   = false; ///< whether a node sees several groups
      bool is_thin        = false; ///< see find_thin_layers()
      bool keeps_nodes    = false; ///< see find_cells_that_keep_nodes()
      bool is_of_stiffest = false; ///< see give_cells_to_stiffest()
      bool is_at_seam     = false; ///< see is_near_periodic_side()
      /** The part of it that points fill, and those of the group of most. */
      double filled = 0, filled_by_most = 0;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &groups &moving &has_own_pressures &is_own &meets_others;
        archive &is_thin &keeps_nodes &is_of_stiffest      &is_at_seam;
      }
    };

    struct Corner
    {
      Point<dim>        x; ///< where it is
      Point<dim>        X; ///< where it was at t = 0
      LocateResult<dim> place;
      /** Of its domain's material, and the stiffest one of all domains that
       * share the corner. */
      unsigned int group, owner;
    };

    using CellsOfCorners = std::unordered_map<unsigned int, unsigned int>;

    static unsigned int
    find(const CellsOfCorners &cells, const unsigned int corner)
    {
      const auto found = cells.find(corner);
      return found == cells.end() ? no_cell : found->second;
    }

    void
    locate_corners(const PointArrays<dim> &points);
    /** Of the points in each element, of all ranks; by group (m^dim). */
    using Volumes = std::unordered_map<unsigned int, std::vector<double>>;
    Volumes
    volumes_of_groups(const PointArrays<dim> &points) const;
    void
    collect_contents(const PointArrays<dim> &points);
    void
    add_overlaps(const PointArrays<dim> &points);
    /** Whether the domain with the corners from @p of_domain on and @p cell
     * overlap, by more than a little. */
    bool
    reaches_into(const Corner *const of_domain, const unsigned int cell) const;
    /** By vertex, the @p groups of elements around. */
    using GroupsAtVertices = std::unordered_map<unsigned int, Groups>;
    GroupsAtVertices
    groups_at_vertices(
      const std::function<Groups(const Content &)> &groups) const;
    /** Which elements have functions of one group only, if the nodes that
     * several share have the pressures of the softest: it resists changes of
     * shape the least, so that it has to be held by its volume. */
    void
    find_own_functions();
    /** Elements of groups that then have no pressures of their own nearby: they
     * get those of their nodes, the softer group goes without. */
    void
    find_thin_layers();
    void
    give_pressures_to_thin_layers();
    /** Elements of several groups that the stiffest fills by half are to have
     * its functions, so that layers which bend lose no row of cells; not at
     * periodic sides, which have to decide alike. Elements next to
     * them then have nodes of the stiffest. They keep their nodes if their
     * group is stiffer yet, or would not keep three rows of elements nearby,
     * and so do shared ones if another of their groups would not. */
    void
    find_cells_that_keep_nodes();
    void
    give_cells_to_stiffest();
    void
    take_nodes_of_stiffest();
    /** Its group if an element wants the functions of several, else none. */
    static Groups
    group_that_wants(const Content &here);
    /** Whether @p element has a node of a group that it doesn't hold, of the
     * @p groups at vertices. */
    bool
    has_foreign_node(const unsigned int      element,
                     const GroupsAtVertices &groups) const;
    void
    find_owners(const PointArrays<dim> &points);
    /** Remember domains that are strained as stiffer ones around, as those of
     * layers that are one domain thick: they have no corner of their own, and
     * none of their group in the cells around has, but for grains and tips that
     * are hardly anything of the body and less than half of their group. After
     * find_owners(). */
    void
    find_layers_of_one_domain(const PointArrays<dim> &points);
    void
    find_cell(const unsigned int corner);
    void
    find_pressure_cell(const unsigned int corner);
    bool
    is_own(const unsigned int cell, const unsigned int group) const
    {
      const Content here = content(cell);
      return here.is_own &&
             (here.is_of_stiffest ? here.most == group :
                                    here.groups == Groups(1) << group);
    }
    bool
    has_pressures_of(const unsigned int cell, const unsigned int group) const
    {
      const Content here = content(cell);
      return here.has_own_pressures && here.groups == Groups(1) << group;
    }
    void
    remember(const Corner &corner, const Groups groups);
    /** The element of @p cell, named by the first of its cells. */
    unsigned int
    element(const unsigned int cell) const
    {
      const auto &functions = occupancy.grid.shape_functions();
      if (functions.are_linear())
        return cell;
      const auto cells = functions.element(cell);
      return *std::min_element(cells.begin(), cells.end());
    }
    Content
    content(const unsigned int cell) const
    {
      const auto found = contents.find(element(cell));
      return found == contents.end() ? Content() : found->second;
    }
    void
    exchange_contents();
    /** The cell nearest to @p x, which lies in @p start, that is a candidate,
     * or no_cell; of several that one which the way from x leads into. */
    unsigned int
    nearest(const Point<dim>                              &x,
            const unsigned int                             start,
            const std::function<bool(const unsigned int)> &is_candidate,
            const double                                   reach) const;

    const PointLocator<dim>  &locator;
    const CellOccupancy<dim> &occupancy;

    const MaterialGroups                      materials;
    std::vector<Corner>                       corners;
    std::unordered_map<unsigned int, Content> contents; ///< by element
    CellsOfCorners                            others, others_of_pressure;
    InterfaceCrossing                         worst;
  };
} // namespace isochor

#endif
