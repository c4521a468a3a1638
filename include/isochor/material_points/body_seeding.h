/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_seeding_h
#define isochor_body_seeding_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>
#include <isochor/grid/background_grid.h>
#include <isochor/material_points/seeding.h>

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
    /** Of <Material points/Bodies>, from 1 on; 0 outside of all. */
    unsigned int zone = 0;
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
     * @p with_domains. These are cut by the borders of the region, of the zones
     * of materials, and of @p zones, of which the last one that holds is the
     * seed's. Throws if no point lies in the @p grid. */
    std::vector<Seed<dim>>
    seeds(const BackgroundGrid<dim>      &grid,
          const bool                      with_domains,
          const unsigned int              n_materials,
          const std::vector<std::string> &zones) const;

    /** What of the body the parameters say. */
    struct Parameters
    {
      unsigned int             points_per_cell = 0; ///< 0: by quadrature
      std::string              zones;
      std::string              region = "1";
      std::vector<std::string> groups;
      std::string              body_mesh;
      double                   lattice_spacing = 0;
      std::string              material_zones;
    };
    const Parameters &
    parameters_read() const
    {
      return parameters;
    }

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

    /** By zone: the number of its material, from 1 on, and where it is. */
    using MaterialZones = std::vector<std::pair<int, Expression<dim>>>;
    MaterialZones
    create_material_zones() const;
    /** The material, from 0 on, of the last zone that holds at @p x. */
    static unsigned int
    material_at(const MaterialZones &zones, const Point<dim> &x);

  private:
    Parameters parameters;

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
    void
    choose_materials(const unsigned int      n_materials,
                     const bool              with_domains,
                     std::vector<Seed<dim>> &seeds) const;
    /** Find the cells of those that the cut has moved out of theirs. */
    static void
    relocate(const SimplexGeometry<dim> &geometry,
             std::vector<Seed<dim>>     &seeds);
  };
} // namespace isochor

#endif
