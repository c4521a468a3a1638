/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The rigid bodies of a scene and its interactions, as boundary conditions.
#include <isochor/base/parameter_list.h>
#include <isochor/interaction/body_pair_term.h>
#include <isochor/interaction/interaction_term.h>
#include <isochor/interaction/rigid_partner.h>
#include <isochor/scene/scene.h>

#include <string>

namespace isochor
{
  template <int dim>
  void
  Scene<dim>::parse_rigid_bodies(ParameterHandler &prm)
  {
    for (const auto &path : ParameterList(prm).subsections)
      if (path.size() == 1 && path.front().rfind("Rigid body: ", 0) == 0)
        {
          rigid_bodies.push_back(
            std::make_shared<RigidBodyInScene<dim>>(path.front()));
          prm.enter_subsection(path.front());
          rigid_bodies.back()->body.parse_parameters(prm);
          prm.leave_subsection();
          if (has_inertia())
            rigid_bodies.back()->body.check_inertia();
        }
  }



  template <int dim>
  void
  Scene<dim>::find_partner(Interaction<dim> &interaction) const
  {
    for (const auto &rigid : rigid_bodies)
      if (rigid->body.name() == interaction.partner_name)
        {
          interaction.partner = std::make_unique<RigidPartner<dim>>(rigid);
          return;
        }
  }



  template <int dim>
  void
  Scene<dim>::parse_interactions(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundary conditions");
    const auto surfaces =
      SurfaceRegion<dim>::parse(prm.get("Surfaces of body"),
                                "Boundary conditions/Surfaces of body");
    prm.leave_subsection();
    Interactions of_bodies, of_others, loads;
    const auto   walls = find_one_sided_walls(boundary_conditions);
    std::string  asked_by;
    if (points.bodies().are_named())
      asked_by = "parameter <Material points/Bodies>";
    for (const auto &path : ParameterList(prm).subsections)
      if (path.size() == 1 && path.front().rfind("Interaction: ", 0) == 0)
        {
          prm.enter_subsection(path.front());
          auto interaction =
            std::make_unique<Interaction<dim>>(prm, path.front(), surfaces);
          prm.leave_subsection();
          find_partner(*interaction);
          interaction->find_wall(walls);
          (interaction->partner     ? of_others :
           interaction->law->load() ? loads :
                                      of_bodies)
            .push_back(std::move(interaction));
          asked_by = "section <" + path.front() + ">";
        }
    for (const auto &rigid : rigid_bodies)
      AssertThrow(rigid.use_count() > 1,
                  ExcMessage("The section <Rigid body: " + rigid->body.name() +
                             "> describes a rigid body that nothing meets: "
                             "there is no section <Interaction: ... - " +
                             rigid->body.name() + ">."));
    if (!walls.empty())
      asked_by = "wall with unilateral contact <" + walls[0].boundary +
                 ": n >= ...> of <" + walls[0].parameter + '>';
    const bool can_interact = quadrature->is_linear_on_domains();
    if (asked_by.empty() && !can_interact)
      {
        points.share_fields();
        return;
      }
    AssertThrow(can_interact,
                ExcMessage(
                  "The " + asked_by +
                  " needs <Quadrature/Type = CPDI>: only its "
                  "subdomains have the surface of the body as faces."));
    points.keep_surface();
    take_loads(boundary_conditions, loads);
    add_interactions(std::move(of_bodies),
                     std::move(of_others),
                     std::move(loads),
                     walls);
  }



  template <int dim>
  void
  Scene<dim>::add_interactions(Interactions                     of_bodies,
                               Interactions                     of_others,
                               Interactions                     loads,
                               const std::vector<OneSidedWall> &walls)
  {
    if (!rigid_bodies.empty())
      boundary_conditions.push_back(
        std::make_unique<RigidBodyTerm<dim>>(rigid_bodies));
    if (!of_others.empty() || !walls.empty() || !loads.empty())
      {
        auto term = std::make_unique<InteractionTerm<dim>>(std::move(of_others),
                                                           std::move(loads),
                                                           walls);
        surface_interactions = term.get();
        boundary_conditions.push_back(std::move(term));
      }
    auto pairs = std::make_unique<BodyPairTerm<dim>>(std::move(of_bodies));
    if (surface_interactions != nullptr)
      pairs->set_others(*surface_interactions);
    body_pairs = pairs.get();
    boundary_conditions.push_back(std::move(pairs));
  }



  template void
  Scene<2>::parse_rigid_bodies(ParameterHandler &);
  template void
  Scene<2>::parse_interactions(ParameterHandler &);
  template void
  Scene<3>::parse_rigid_bodies(ParameterHandler &);
  template void
  Scene<3>::parse_interactions(ParameterHandler &);
} // namespace isochor
