/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/material_at_nodes.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <array>
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
   */
  template <int dim>
  class PrescribedDisplacement : public BoundaryCondition<dim>,
                                 public ConstrainsNodes<dim>
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
        "...'. What a formula gives at the first step is applied in that step, "
        "a constant, too. Components not named are free. A later entry "
        "overrides an earlier one at common nodes. 'everywhere' names all "
        "nodes of the boundary. What the body may leave, or come to, is a wall "
        "with unilateral contact: <Boundary conditions/Walls = boundary: n >= "
        "formula>. A boundary that pushes the body by more than a hundredth of "
        "its length must take the grid along (<Grid/Stretch>), or not be "
        "reset: after a reset the row of cells there is partly empty and too "
        "soft, beyond half of a cell it loses the body. The same of a boundary "
        "that pulls the body out of the grid: beyond a part of a cell points "
        "are outside, which is an error.");
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
          std::set<unsigned int> vertices;
          for (const BoundaryFace &face : grid.boundary_faces())
            for (unsigned int v = 0; v <= dim; ++v)
              if ((everywhere || face.id == id) && v != face.opposite_vertex)
                vertices.insert(grid.geometry().vertex_indices(face.cell)[v]);
          condition.vertices.assign(vertices.begin(), vertices.end());
        }
      leave_vertices_to_later();
      material.set(conditions, reference);
    }

    std::vector<NamedBoundary>
    named_boundaries() const override
    {
      std::set<std::string> names;
      for (const auto &condition : conditions)
        names.insert(condition.boundary);
      std::vector<NamedBoundary> boundaries;
      for (const std::string &name : names)
        boundaries.push_back({parameter(), name});
      return boundaries;
    }

    std::vector<BoundaryPush>
    pushes(const StepContext<dim> &step) const override
    {
      std::vector<BoundaryPush> all;
      for (const auto &condition : conditions)
        if (condition.boundary != "everywhere")
          all.push_back(push(condition, step));
      return all;
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
            const unsigned int node = step.nodes.node(condition.vertices[i]);
            if (node != numbers::invalid_unsigned_int)
              constraints.constrain(node * step.n_components +
                                      condition.component,
                                    increment(condition, i, step));
          }
    }

    void
    append_motions(std::vector<Expression<dim>> &motions) const override
    {
      for (const auto &condition : conditions)
        motions.push_back(condition.displacement);
    }

    void
    advance(const StepContext<dim> &step,
            const NodalField & /*unknowns*/) override
    {
      material.advance(step);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      state << material.reset_time << ' ';
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      state >> material.reset_time;
    }

  private:
    std::string
    parameter() const
    {
      return NamedPlugin::parameter("Displacement");
    }

    using Condition = PrescribedComponent<dim>;

    /** Up to the start of the step. */
    BoundaryPush
    push(const Condition &condition, const StepContext<dim> &step) const
    {
      const unsigned int component = condition.component;
      BoundaryPush       push      = {condition.boundary,
                                      parameter() + " = " + condition.boundary + ": " +
                                        "xyz"[component] + " = ...",
                                      component,
                                      {}};
      for (const unsigned int v : condition.vertices)
        {
          const double way =
            condition.displacement(reference[v], step.old_time) -
            (step.grid.geometry().vertices()[v][component] -
             reference[v][component]);
          push.ways[0] = std::min(push.ways[0], way);
          push.ways[1] = std::max(push.ways[1], way);
        }
      return push;
    }

    void
    parse_item(const std::string &boundary,
               const std::string &item,
               const std::string &name)
    {
      const std::string axes   = std::string("xyz").substr(0, dim);
      const auto        equals = item.find('=');
      const std::string axis =
        Utilities::trim(item.substr(0, std::min(equals, item.size())));
      AssertThrow(axis.empty() || (axis.back() != '>' && axis.back() != '<'),
                  ExcMessage("The entry <" + boundary + ": " + item +
                             "> of the parameter <" + name +
                             "> asks for unilateral contact with a wall. Write "
                             "<" +
                             NamedPlugin::parameter("Walls") + " = " +
                             boundary +
                             ": n >= formula>, n being the displacement along "
                             "the normal into the grid."));
      AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                    axes.find(axis) != std::string::npos,
                  ExcMessage(
                    "The entry <" + item + "> of the parameter <" + name +
                    "> must have the form <x = formula>, with a component "
                    "out of " +
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
                            Expression<dim>(item.substr(equals + 1), name),
                            {}});
      for (const std::string &word : names_in_formula(item.substr(equals + 1)))
        if (axes.find(word) != std::string::npos)
          conditions.back().depends_on_place = true;
    }

    /** The increment that vertex i of the condition is held at. */
    double
    increment(const Condition        &condition,
              const unsigned int      i,
              const StepContext<dim> &step) const
    {
      return prescribed_increment(condition.displacement,
                                  material.place(condition.vertices[i],
                                                 reference,
                                                 step),
                                  step.old_time,
                                  step.time);
    }

    /** A vertex that several conditions hold the same component of is that of
     * the last one. */
    void
    leave_vertices_to_later()
    {
      std::array<std::set<unsigned int>, dim> taken;
      for (auto condition = conditions.rbegin(); condition != conditions.rend();
           ++condition)
        {
          auto &vertices = condition->vertices;
          auto &by_later = taken[condition->component];
          vertices.erase(std::remove_if(vertices.begin(),
                                        vertices.end(),
                                        [&](const unsigned int v) {
                                          return by_later.count(v) != 0;
                                        }),
                         vertices.end());
          by_later.insert(vertices.begin(), vertices.end());
        }
    }

    std::vector<Condition>  conditions;
    std::vector<Point<dim>> reference;
    MaterialAtNodes<dim>    material;
  };



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 PrescribedDisplacement,
                                 "Displacement")
} // namespace isochor
