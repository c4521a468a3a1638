/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/material_at_nodes.h>
#include <isochor/boundary_condition/prescribed_component.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

namespace isochor
{
  /**
   * Prescribed displacement of the grid nodes on named boundaries, component by
   * component. A formula u(X, t) gives the displacement since t = 0 of the
   * material that was at X: Δu = u(X, t_{n+1}) - u(X, t_n), and in the first
   * step u(X, t_1), as nothing has been displaced before. X is that of the
   * material at the node (MaterialAtNodes). Material that reaches the boundary
   * later takes part in what the boundary does from then on. With a grid that
   * follows the motion (Grid/Stretch) this is an exact condition on a moving
   * side of the body.
   *
   * A one-sided condition, u >= or <= a formula, is contact with a frictionless
   * wall that stands in the distance u(x, t) from where the node was generated,
   * see ContactSearch. The set of nodes in contact is kept from step to step.
   *
   * In statics, a step on a reset grid starts with the gap of the body
   * (BodyAtWalls). Where that isn't known, a node that has not yet touched the
   * wall remembers its distance. One that has starts each step on a reset grid
   * at the wall; on a grid that is kept (see GridReset), where the last one
   * left it. So does material that comes to the boundary later.
   */
  template <int dim>
  class PrescribedDisplacement : public BoundaryCondition<dim>,
                                 public HasOneSidedWalls<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Displacement",
        "",
        Patterns::Anything(),
        "Prescribed displacements (m) since t = 0 on boundaries of the grid, "
        "formulas in the place at t = 0 of the material, x, y(, z), and t "
        "(angles in radians): 'boundary: x = formula, y = formula; boundary: "
        "...'. What a formula gives at the first step is applied in "
        "that step, a constant, too. Components not named are free. A later "
        "entry overrides an earlier one at common nodes. 'everywhere' names "
        "all nodes of the boundary. With 'x >= formula' or 'x <= formula' the "
        "boundary only pushes: it is a smooth wall in this distance from where "
        "the grid's boundary is at t = 0, a node that would have to be pulled "
        "leaves it, and is held again when it comes back. On a grid that is put "
        "back in each step it acts where the surface of the body reaches it "
        "with <Quadrature/Type = CPDI> or 'cell-filled + boundary' in statics, "
        "else up to a cell before: impacts last longer. A boundary that "
        "pushes the body by more than a hundredth of its length must take the "
        "grid along (<Grid/Stretch>), or the grid be kept: put back, the row of "
        "cells there is partly empty and too soft, beyond half of a cell it "
        "loses the body. The same of a boundary that pulls the body out of the "
        "grid: beyond a part of a cell points are outside, which is an error.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = parameter();
      for (const auto &entry : split_named_list(prm.get("Displacement"), name))
        for (const auto &item : split_formulas(entry.second, name))
          parse_item(entry.first, item, name);
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      reference = grid.vertices_at_time(0.);
      for (auto &condition : conditions)
        {
          const bool everywhere = condition.boundary == "everywhere";
          const types::boundary_id id =
            everywhere ? 0 : grid.boundary_id(condition.boundary, parameter());
          std::set<unsigned int>    vertices;
          std::vector<BoundaryFace> faces;
          for (const BoundaryFace &face : grid.boundary_faces())
            if (everywhere || face.id == id)
              faces.push_back(face);
          for (const BoundaryFace &face : faces)
            for (unsigned int v = 0; v <= dim; ++v)
              if (v != face.opposite_vertex)
                vertices.insert(grid.geometry().vertex_indices(face.cell)[v]);
          condition.vertices.assign(vertices.begin(), vertices.end());
          condition.find_inward(reference, grid.geometry(), faces);
        }
      leave_vertices_to_later(conditions);
      material.set(conditions, reference);
      for (auto &condition : conditions)
        if (condition.side != 0)
          condition.place_walls(reference, grid);
    }

    void
    grid_changed(const BackgroundGrid<dim> &grid,
                 const bool /*at_start*/) override
    {
      const auto old           = conditions;
      const auto old_reference = reference;
      initialize(grid);
      for (unsigned int c = 0; c < conditions.size(); ++c)
        conditions[c].take_over_walls(old[c], old_reference, reference);
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      std::set<std::string> done;
      for (const auto &condition : conditions)
        if (done.insert(condition.boundary).second)
          {
            const bool everywhere = condition.boundary == "everywhere";
            warn_if_untouched(step,
                              parameter(),
                              condition.boundary,
                              everywhere ?
                                0 :
                                step.grid.boundary_id(condition.boundary,
                                                      parameter()),
                              everywhere);
          }
      for (const auto &condition : conditions)
        if (condition.side != 0 && condition.boundary != "everywhere")
          warn_of_wall_inside(step,
                              parameter(),
                              condition.boundary,
                              condition.component,
                              condition.side);
    }

    std::vector<unsigned int>
    held_vertices() const override
    {
      std::vector<unsigned int> held;
      for (const auto &condition : conditions)
        held.insert(held.end(),
                    condition.vertices.begin(),
                    condition.vertices.end());
      return held;
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      for (const auto &condition : conditions)
        for (unsigned int i = 0; i < condition.vertices.size(); ++i)
          {
            if (condition.side != 0 && condition.wall[i].released)
              continue;
            const unsigned int node = step.nodes.node(condition.vertices[i]);
            if (node != numbers::invalid_unsigned_int)
              constraints.constrain(node * step.n_components +
                                      condition.component,
                                    increment(condition, i, step),
                                    condition.side == 0 ?
                                      NodalConstraints::prescribed :
                                      NodalConstraints::in_contact);
          }
    }

    void
    append_motion(const StepContext<dim> &step,
                  std::vector<double>    &values) const override
    {
      for (const auto &condition : conditions)
        for (const unsigned int vertex : condition.vertices)
          if (step.nodes.node(vertex) != numbers::invalid_unsigned_int)
            values.push_back(
              condition.displacement(reference[vertex], step.time));
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      if (step.old_time > 0 && !step.grid_is_kept)
        for (const auto &condition : conditions)
          if (condition.boundary != "everywhere")
            warn_if_body_is_lost(condition, step);
      material.advance(step);
      for (auto &condition : conditions)
        if (condition.side != 0)
          {
            find_gaps(condition, step, unknowns);
            for (WallNode &node : condition.wall)
              node.accept();
          }
    }

    void
    prepare_contact(const StepContext<dim> &step) override
    {
      BodyAtWalls<dim> body;
      for (auto &condition : conditions)
        condition.add_to(body, reference, step);
      body.find(step);
    }

    void
    start_contact() override
    {
      for (auto &condition : conditions)
        for (WallNode &node : condition.wall)
          node.start();
      search.start();
    }

    ContactChange
    check_contact(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const MixedSystem<dim> &system,
                  const NodalConstraints &constraints,
                  const typename BoundaryCondition<dim>::ContactTolerance
                    &tolerance) override;

    void
    append_contacts(const StepContext<dim>         &step,
                    const MixedSystem<dim>         &system,
                    const NodalConstraints         &constraints,
                    std::vector<WallContacts<dim>> &walls) const override;

    void
    append_one_sided_walls(const StepContext<dim>         &step,
                           std::vector<OneSidedWall<dim>> &walls) const override
    {
      for (const auto &condition : conditions)
        condition.append_wall(parameter(), reference, step, walls);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      state << material.reset_time << ' ';
      for (const auto &condition : conditions)
        for (const WallNode &node : condition.wall)
          node.save(state);
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      state >> material.reset_time;
      for (auto &condition : conditions)
        for (WallNode &node : condition.wall)
          node.load(state);
    }

  private:
    std::string
    parameter() const
    {
      return NamedPlugin::parameter("Displacement");
    }

    using Condition = PrescribedComponent<dim>;

    /** Tell if the body has been pushed out of the row of cells at the
     * boundary, which has been put back since. */
    void
    warn_if_body_is_lost(const Condition        &condition,
                         const StepContext<dim> &step) const
    {
      const std::array<double, 2> push = condition.push(reference, step);
      if (push[0] >= 0 && push[1] <= 0)
        return;
      std::vector<OneSidedWall<dim>> walls;
      condition.append_wall(parameter(), reference, step, walls);
      if (!is_far_from_walls(step, walls))
        warn_of_lost_body(
          step, parameter(), condition.boundary, condition.component, push);
    }

    void
    parse_item(const std::string &boundary,
               const std::string &item,
               const std::string &name)
    {
      const std::string axes   = std::string("xyz").substr(0, dim);
      const auto        equals = item.find('=');
      std::string       axis =
        Utilities::trim(item.substr(0, std::min(equals, item.size())));
      int side = 0;
      if (!axis.empty() && (axis.back() == '>' || axis.back() == '<'))
        {
          side              = (axis.back() == '>' ? 1 : -1);
          axis              = Utilities::trim(axis.substr(0, axis.size() - 1));
          this->pushes_only = true;
        }
      AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                    axes.find(axis) != std::string::npos,
                  ExcMessage("The entry <" + item + "> of the parameter <" +
                             name +
                             "> must have the form <x = formula>, <x >= "
                             "formula> or <x <= formula>, with a "
                             "component out of " +
                             axes + "."));
      const unsigned int component = axes.find(axis);
      for (const auto &condition : conditions)
        AssertThrow(condition.boundary != boundary ||
                      condition.component != component,
                    ExcMessage("The parameter <" + name +
                               "> prescribes the component " + axis +
                               " on the boundary <" + boundary + "> twice."));
      conditions.push_back({boundary,
                            component,
                            side,
                            Expression<dim>(item.substr(equals + 1), name),
                            {},
                            {}});
      for (const std::string &word : names_in_formula(item.substr(equals + 1)))
        if (axes.find(word) != std::string::npos)
          conditions.back().depends_on_place = true;
    }

    /** The increment that vertex i of the condition is held at, or that its
     * wall allows. */
    double
    increment(const Condition        &condition,
              const unsigned int      i,
              const StepContext<dim> &step) const
    {
      const unsigned int vertex = condition.vertices[i];
      if (condition.side == 0)
        return prescribed_increment(condition.displacement,
                                    material.place(vertex, reference, step),
                                    step.old_time,
                                    step.time);
      const Point<dim> &x      = reference[vertex];
      const double      motion = condition.displacement(x, step.time) -
                            condition.displacement(x, step.old_time);
      return motion - condition.wall[i].gap_at_start(step.grid_is_kept);
    }

    void
    find_gaps(Condition              &condition,
              const StepContext<dim> &step,
              const NodalField       &unknowns) const
    {
      std::vector<double> gaps(condition.vertices.size(), gap_unknown);
      for (unsigned int i = 0; i < gaps.size(); ++i)
        {
          const unsigned int node = step.nodes.node(condition.vertices[i]);
          if (node < step.nodes.n_owned())
            gaps[i] =
              gap_after(unknowns.local_element(node * step.n_components +
                                               condition.component),
                        increment(condition, i, step));
        }
      update_gaps(gaps, step.grid.communicator(), condition.wall);
    }

    /** By conditions and vertices one after the other. Collective. */
    std::vector<unsigned int>
    find_objections(
      const StepContext<dim>                                  &step,
      const NodalField                                        &unknowns,
      const NodalField                                        &reaction,
      const NodalTies                                         &ties,
      const typename BoundaryCondition<dim>::ContactTolerance &tolerance) const;

    std::vector<Condition>  conditions;
    std::vector<Point<dim>> reference;
    MaterialAtNodes<dim>    material;
    ContactSearch           search;
  };



  template <int dim>
  std::vector<unsigned int>
  PrescribedDisplacement<dim>::find_objections(
    const StepContext<dim>                                  &step,
    const NodalField                                        &unknowns,
    const NodalField                                        &reaction,
    const NodalTies                                         &ties,
    const typename BoundaryCondition<dim>::ContactTolerance &tolerance) const
  {
    const double penetration =
      tolerance.relative * largest_increment(step, unknowns);
    const std::vector<unsigned char> is_tied =
      tied_nodes(ties, step.nodes.n_local());
    std::vector<unsigned int> objections;
    for (const auto &condition : conditions)
      for (unsigned int i = 0; i < condition.wall.size(); ++i)
        {
          objections.push_back(Objection::none);
          const unsigned int node = step.nodes.node(condition.vertices[i]);
          if (node >= step.nodes.n_owned())
            continue;
          const unsigned int entry =
            node * step.n_components + condition.component;
          if (!condition.wall[i].released)
            objections.back() = condition.side * reaction.local_element(entry) <
                                    -tolerance.force ?
                                  Objection::pulls :
                                  Objection::none;
          else if (!is_tied[node] &&
                   condition.side * (unknowns.local_element(entry) -
                                     increment(condition, i, step)) <
                     -penetration)
            objections.back() = Objection::penetrates;
        }
    Utilities::MPI::max(objections, step.grid.communicator(), objections);
    return objections;
  }



  template <int dim>
  ContactChange
  PrescribedDisplacement<dim>::check_contact(
    const StepContext<dim>                                  &step,
    const NodalField                                        &unknowns,
    const MixedSystem<dim>                                  &system,
    const NodalConstraints                                  &constraints,
    const typename BoundaryCondition<dim>::ContactTolerance &tolerance)
  {
    if (std::none_of(conditions.begin(),
                     conditions.end(),
                     [](const auto &condition) { return condition.side != 0; }))
      return {};
    const auto objections = find_objections(
      step, unknowns, system.residual, constraints.ties, tolerance);
    std::vector<WallNode *> nodes;
    std::string             names;
    for (auto &condition : conditions)
      {
        bool objects = false;
        for (WallNode &node : condition.wall)
          {
            objects = objects || objections[nodes.size()] != Objection::none;
            nodes.push_back(&node);
          }
        if (objects)
          names += (names.empty() ? "" : ", ") + condition.boundary;
      }
    return search.change(
      objections, tolerance.converged, nodes, parameter(), names);
  }



  template <int dim>
  void
  PrescribedDisplacement<dim>::append_contacts(
    const StepContext<dim> &step,
    const MixedSystem<dim> &system,
    const NodalConstraints & /*constraints*/,
    std::vector<WallContacts<dim>> &walls) const
  {
    for (const auto &condition : conditions)
      {
        const bool           holds  = condition.side == 0;
        const Tensor<1, dim> normal = condition.normal();
        const double         sign   = normal[condition.component];
        if (sign == 0)
          continue;
        walls.push_back({parameter(), condition.boundary, {}, holds});
        for (unsigned int i = 0; i < condition.vertices.size(); ++i)
          if (holds || !condition.wall[i].released)
            {
              const unsigned int node = step.nodes.node(condition.vertices[i]);
              const double       force =
                node < step.nodes.n_owned() ?
                        system.residual.local_element(node * step.n_components +
                                                condition.component) :
                        0.;
              walls.back().nodes.push_back(
                {condition.vertices[i],
                 normal,
                 sign * force,
                 condition.distance_of_held(i, reference, step)});
            }
      }
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 PrescribedDisplacement,
                                 "Displacement")
} // namespace isochor
