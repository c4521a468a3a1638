/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_seeding_h
#define isochor_body_seeding_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>
#include <isochor/base/warnings.h>
#include <isochor/grid/background_grid.h>
#include <isochor/material_points/seeding.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace isochor
{
  /** A material point about to be. */
  template <int dim>
  struct Seed
  {
    Point<dim>   location;
    unsigned int cell; ///< of the grid
    double       volume;
    /** The corners of its domain relative to it; zero if it has none. */
    CornerVectors<dim> domain;
    unsigned int       material = 0;
    /** See PointArrays::outer_faces. */
    unsigned int outer_faces = 0;
  };

  /**
   * Where the material points are at t = 0, and what volume and material each
   * has: in the cells of the grid or of a mesh of the body, or on a lattice.
   * Reads the subsection "Material points".
   */
  template <int dim>
  class BodySeeding
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** Throws for parameters that exclude each other. */
    void
    parse_parameters(ParameterHandler &prm);

    /** Throw now, and not after an hour of meshing, if there is no way to seed
     * as many points per cell as are asked for. */
    void
    check_numbers(const bool with_domains) const;

    /** All points of the body, the same on all ranks, with simplex domains if
     * @p with_domains. Throws if none lies in the @p grid. */
    std::vector<Seed<dim>>
    seeds(const BackgroundGrid<dim> &grid,
          const bool                 with_domains,
          const unsigned int         n_materials) const;

    /** Warn where simplex domains of cells with different numbers of points
     * divide the face between them differently. */
    void
    check_domains(const BackgroundGrid<dim> &grid, Warnings &warnings) const;

    /** Warn of conditions (region, zones) that compare nothing and leave hardly
     * anything of the @p grid out: a formula is above zero there, but hardly
     * meant so. */
    void
    check_conditions(const BackgroundGrid<dim> &grid, Warnings &warnings) const;

    /** Warn of gaps and parts of the region that are narrower than the distance
     * of the points, so that points don't show them; only of points that are
     * seeded in the cells of the @p grid. Collective. */
    void
    check_fineness(const BackgroundGrid<dim> &grid,
                   const bool                 with_domains,
                   Warnings                  &warnings) const;

    /** Warn if the points of a material have another volume than the region and
     * its zones of 'Materials in zones'; only of points that are seeded in
     * cells. Collective. */
    void
    check_rounding(const BackgroundGrid<dim> &grid,
                   const bool                 with_domains,
                   const bool                 axisymmetric,
                   Warnings                  &warnings) const;

  private:
    /** Cells with the same number of points. */
    struct Zone
    {
      unsigned int                    n_points;
      Quadrature<dim>                 rule;
      std::vector<CornerVectors<dim>> domains; ///< if there are any
      Expression<dim>                 condition;
    };

    /** The last one that holds counts; the first one is everywhere. */
    std::vector<Zone>
    create_zones(const bool with_domains) const;
    /** The zone of a cell with this @p centroid. */
    static unsigned int
    find_zone(const std::vector<Zone> &zones, const Point<dim> &centroid);
    static std::vector<Point<dim>>
    places_in_cell(const SimplexGeometry<dim> &geometry,
                   const unsigned int          cell,
                   const std::vector<Zone>    &zones);
    void
    check_region(const BackgroundGrid<dim> &grid, Warnings &warnings) const;
    /** Call @p check with the cells that the body is seeded in, those of its
     * mesh or of the @p grid, and the names of their groups. */
    void
    check_cells_of_body(
      const BackgroundGrid<dim> &grid,
      const std::function<
        void(const SimplexGeometry<dim> &,
             const std::map<std::string, types::material_id> &)> &check) const;
    void
    check_zones(const SimplexGeometry<dim>                      &geometry,
                const std::map<std::string, types::material_id> &group_ids,
                Warnings &warnings) const;
    void
    check_domains_in_cells(
      const SimplexGeometry<dim>                      &geometry,
      const std::map<std::string, types::material_id> &group_ids,
      Warnings                                        &warnings) const;

    struct Parameters
    {
      unsigned int             points_per_cell = 0; ///< 0: by quadrature
      std::string              zones;
      std::string              region = "1";
      std::vector<std::string> groups;
      std::string              body_mesh;
      double                   lattice_spacing = 0;
      std::string              material_zones;
    } parameters;

    void
    check_combinations() const;
    std::vector<Seed<dim>>
    seeds_in_cells(const SimplexGeometry<dim>                      &geometry,
                   const std::map<std::string, types::material_id> &group_ids,
                   const bool with_domains) const;
    std::vector<Seed<dim>>
    seeds_in_body_mesh(const BackgroundGrid<dim> &grid,
                       const bool                 with_domains) const;
    std::vector<Seed<dim>>
    seeds_on_lattice(const BackgroundGrid<dim> &grid,
                     const bool                 with_domains) const;
    /** Find the grid cell of each seed; drop those outside of the grid. */
    void
    locate(const BackgroundGrid<dim> &grid,
           std::vector<Seed<dim>>    &seeds) const;
    /** By zone: the number of its material, from 1 on, and where it is. */
    using MaterialZones = std::vector<std::pair<int, Expression<dim>>>;
    MaterialZones
    create_material_zones() const;
    /** The material, from 0 on, of the last zone that holds at @p x. */
    static unsigned int
    material_at(const MaterialZones &zones, const Point<dim> &x);
    void
    choose_materials(const unsigned int      n_materials,
                     std::vector<Seed<dim>> &seeds) const;
  };
} // namespace isochor

#endif
