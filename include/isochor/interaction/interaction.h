/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_h
#define isochor_interaction_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/boundary_condition/one_sided_wall.h>
#include <isochor/boundary_condition/surface_conditions.h>
#include <isochor/interaction/interaction_law.h>
#include <isochor/interaction/partner.h>
#include <isochor/material_points/surface_region.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace isochor
{
  /** A surface, its partner and the law between them: what a subsection
   * "Interaction: NAME - PARTNER" describes, the name being that of a body or
   * of a surface. */
  template <int dim>
  class Interaction
  {
  public:
    /** @param section "Interaction: NAME - PARTNER", which @p prm is in. */
    static void
    declare_parameters(ParameterHandler &prm, const std::string &section);

    /** @param surfaces Those that have a name. */
    Interaction(ParameterHandler                      &prm,
                const std::string                     &section,
                const std::vector<SurfaceRegion<dim>> &surfaces);

    /** What a wall without a section of its own stands for: frictionless
     * contact of a body with it. */
    Interaction(const std::string               &body,
                const std::vector<OneSidedWall> &walls,
                const unsigned int               which);

    /** What a load without a section of its own stands for. */
    explicit Interaction(const SurfaceCondition<dim> &surface);

    /** If the section names a boundary of the grid, this is the partner: as
     * the @p walls have it, else where the grid's boundary is. */
    void
    find_wall(std::vector<OneSidedWall> walls);

    /** Whether the partner is the boundary of this name. */
    bool
    is_with_boundary(const std::string &boundary) const
    {
      return partner_name == of_boundary(boundary);
    }
    static std::string
    of_boundary(const std::string &boundary)
    {
      return "boundary " + boundary;
    }

    /** Whether it is about a face of body number @p of_body with its centre at
     * @p X at t = 0. */
    bool
    has(const unsigned int of_body, const Point<dim> &X) const
    {
      return bodies[of_body] && (!region || region->contains(X));
    }

    /** Find the bodies by their @p names. @throws ExcMessage if there is none
     * of that name, or a surface as well. */
    void
    find_bodies(const std::vector<std::string> &names);

    /** For messages: the section, or the parameter and what of it. */
    std::string
    title() const
    {
      return section.rfind("Interaction: ", 0) == 0 ?
               section :
               section + " = " + body + ": ...";
    }

    /** The error if it has no face. */
    std::string
    what_is_missing() const;

    /** Find the place of its surface, if that is a part of a body's. */
    void
    find_place(const BackgroundGrid<dim> &grid)
    {
      if (region)
        region->find_place(grid);
    }

    /** Whether body number @p a and body number @p b take part. */
    bool
    is_between(const unsigned int a, const unsigned int b) const
    {
      return (bodies[a] && partners[b]) || (bodies[b] && partners[a]);
    }

    /** Whether faces of these bodies, with their centres at @p X_a and @p X_b,
     * do. */
    bool
    is_between(const unsigned int a,
               const Point<dim>  &X_a,
               const unsigned int b,
               const Point<dim>  &X_b) const
    {
      return (partners[b] && has(a, X_a)) || (partners[a] && has(b, X_b));
    }

    /** "NAME - PARTNER". */
    std::string
    name() const
    {
      return body + " - " + partner_name;
    }

    /** Where the statistics have a component of the force on the body. */
    std::string
    force_column(const unsigned int component) const
    {
      return std::string("Force ") + "xyz"[component] + " on " + body + " by " +
             partner_name + " (N)";
    }

    /** The name of the surface is @p body if it has a region, else that is the
     * body's. */
    std::string                          section, body, partner_name;
    std::optional<SurfaceRegion<dim>>    region;
    std::unique_ptr<InteractionLaw<dim>> law;
    std::unique_ptr<Partner<dim>>        partner;

  private:
    /** By number: which are the body, and the partner if it has none else. */
    std::vector<bool> bodies, partners;
  };

  /** Add to the @p interactions those of each of the @p bodies with each of the
   * @p walls that there is none of yet. */
  template <int dim>
  void
  add_walls(const std::vector<OneSidedWall>                &walls,
            const std::vector<std::string>                 &bodies,
            std::vector<std::unique_ptr<Interaction<dim>>> &interactions);

  /** Add to the @p interactions what HasSurfaceLoads of all @p conditions, a
   * list of pointers to them, leave. */
  template <int dim, typename Conditions>
  void
  take_loads(const Conditions                               &conditions,
             std::vector<std::unique_ptr<Interaction<dim>>> &interactions)
  {
    for (auto *const condition : with_role<HasSurfaceLoads<dim>>(conditions))
      for (const SurfaceCondition<dim> &surface : condition->take_loads())
        interactions.push_back(std::make_unique<Interaction<dim>>(surface));
  }
} // namespace isochor

#endif
