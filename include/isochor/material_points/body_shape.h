/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_shape_h
#define isochor_body_shape_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/grid/background_grid.h>
#include <isochor/material_points/bodies.h>
#include <isochor/material_points/point_locator.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Where the body is at t = 0, as the parameters of "Material points" describe
   * it: the region, within the physical groups of the grid, a body's mesh or
   * the boxes of a lattice. Says of any place whether the body is there, which
   * the points alone don't.
   */
  template <int dim>
  class BodyShape
  {
  public:
    /** Reads what MaterialPoints::declare_parameters() has declared. */
    void
    parse_parameters(ParameterHandler &prm);

    /** After the grid is made, at t = 0; @p grid must outlive this object, as
     * @p bodies. @p with_domains: whether the points of a lattice have simplex
     * domains. */
    void
    initialize(const BackgroundGrid<dim> &grid,
               const bool                 with_domains,
               const Bodies<dim>         &bodies);

    /** Whether all of the grid belongs to the body. */
    bool
    is_everywhere() const
    {
      return everywhere && bodies->size() == 1;
    }

    /** A cell of the layer whose body is at @p x. */
    unsigned int
    cell_of_layer_at(const Point<dim> &x) const
    {
      return grid->geometry().first_cell(bodies->at(x));
    }

    /** Whether the body is at @p x in the grid's cell @p cell, of several the
     * one that the layer of the cell belongs to. Of a lattice:
     * whether the domain around x has its point in the region. */
    bool
    contains(const Point<dim> &x, const unsigned int cell) const;

    /** @throws ExcMessage for a mesh of the body that overlaps itself, where
     * points are seeded twice. */
    void
    check_mesh() const;

  private:
    /** contains(), of any body. */
    bool
    any_contains(const Point<dim> &x, const unsigned int cell) const;

    /** Whether a cell belongs to the physical groups asked for. */
    bool
    belongs(const SimplexGeometry<dim>                      &geometry,
            const unsigned int                               cell,
            const std::map<std::string, types::material_id> &group_ids) const;

    /** The point of the lattice whose box or simplex holds @p x. */
    Point<dim>
    lattice_point(const Point<dim> &x) const;

    std::string              region = "1";
    std::vector<std::string> groups;
    std::string              body_mesh;
    double                   lattice_spacing = 0;

    bool                             everywhere   = true;
    bool                             with_domains = false;
    const BackgroundGrid<dim>       *grid         = nullptr;
    const Bodies<dim>               *bodies       = nullptr;
    std::unique_ptr<Expression<dim>> in_region;
    Point<dim>                       lattice_origin;

    std::unique_ptr<Triangulation<dim>>       mesh;
    std::map<std::string, types::material_id> mesh_groups;
    std::unique_ptr<SimplexGeometry<dim>>     mesh_geometry;
    std::unique_ptr<PointLocator<dim>>        locator;
  };
} // namespace isochor

#endif
