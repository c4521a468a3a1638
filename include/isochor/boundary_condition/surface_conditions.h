/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_conditions_h
#define isochor_surface_conditions_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>
#include <isochor/material_points/surface_seeding.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** What is prescribed on a surface of the body. */
  template <int dim>
  struct SurfaceCondition
  {
    SurfaceRegion<dim>           place;
    std::vector<Expression<dim>> traction; ///< dim or none
    std::vector<Expression<dim>> pressure; ///< one or none
    std::array<std::vector<Expression<dim>>, dim>
      displacement; ///< by component: one or none

    bool
    is_fixed() const
    {
      return std::any_of(displacement.begin(),
                         displacement.end(),
                         [](const auto &u) { return !u.empty(); });
    }
  };

  /** The parameters of the conditions on the body's surface, in a subsection
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

    /** Whether a prescribed component or a load can hold the body up against
     * @p gravity. */
    bool
    support(const Tensor<1, dim> &gravity) const;

    /** Whether there are prescribed components at all. */
    bool
    prescribe_displacements() const
    {
      return std::any_of(surfaces.begin(),
                         surfaces.end(),
                         [](const auto &surface) {
                           return surface.is_fixed();
                         });
    }

    /** By surface: whether each face of the cells is held at its centre only,
     * also with domains that have several faces there. What is held at one
     * point may turn around it. */
    std::vector<bool>
    are_held_at_centres() const
    {
      std::vector<bool> result;
      for (const auto &surface : surfaces)
        result.push_back(points_per_face == 1 && surface.is_fixed());
      return result;
    }

    /** Of the parameters, for messages. */
    std::string section = "Boundary conditions";

    std::vector<SurfaceCondition<dim>> surfaces;
    unsigned int                       points_per_face = 3;
    std::string                        body_mesh;
    /** β, see SurfaceForces; none: the default. */
    std::optional<double> given_penalty;

    /** Statics correct what springs stay behind by (SurfaceCorrection), and
     * soft ones do; in dynamics they have to be stiff enough by themselves. */
    double
    penalty(const bool has_inertia) const
    {
      return given_penalty.value_or(has_inertia ? 100. : 10.);
    }

  private:
    void
    parse_penalty(ParameterHandler &prm);
    void
    parse_tractions(ParameterHandler &prm);
    void
    parse_loads(ParameterHandler &prm);
    void
    parse_displacements(ParameterHandler &prm);
    SurfaceCondition<dim> &
    find_surface(const std::string &name, const std::string &parameter);
  };
} // namespace isochor

#endif
