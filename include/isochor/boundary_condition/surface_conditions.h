/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_conditions_h
#define isochor_surface_conditions_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/material_points/surface_seeding.h>

#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The loads on a surface of the body, and where that is. */
  template <int dim>
  struct SurfaceCondition
  {
    SurfaceRegion<dim> place;
    SurfaceLoad<dim>   load;
  };

  /** A boundary condition whose parameters may name such loads. */
  template <int dim>
  class HasSurfaceLoads
  {
  public:
    virtual ~HasSurfaceLoads() = default;

    /** Leave the loads to the caller, who sees to them from now on. */
    virtual std::vector<SurfaceCondition<dim>>
    take_loads() = 0;
  };

  /** The parameters of the loads on the body's surface, in a subsection
   * like "Boundary conditions". */
  template <int dim>
  struct SurfaceConditions
  {
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Look up the boundaries of the grid. */
    void
    find_boundaries(const BackgroundGrid<dim> &grid);

    /** Of the parameters, for messages. */
    std::string section = "Boundary conditions";

    /** All that `Surfaces of body` names. */
    std::vector<SurfaceRegion<dim>> named;
    /** Those with a load. */
    std::vector<SurfaceCondition<dim>> surfaces;
    unsigned int                       points_per_face = 3;
    std::string                        body_mesh;

  private:
    void
    parse_tractions(ParameterHandler &prm);
    void
    parse_loads(ParameterHandler &prm);
    SurfaceCondition<dim> &
    find_surface(const std::string &name, const std::string &parameter);
  };
} // namespace isochor

#endif
