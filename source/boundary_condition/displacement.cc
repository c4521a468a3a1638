/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition.h>
#include <isochor/expression.h>
#include <isochor/scene_checks.h>

#include <algorithm>
#include <limits>
#include <set>
#include <sstream>

namespace isochor
{
  /**
   * Prescribed displacement of the grid nodes on named boundaries, component by
   * component: Δu = u(x, t_{n+1}) - u(x, t_n) with x where the node was
   * generated. With a grid that follows the motion (Grid/Stretch) this is an
   * exact condition on a moving side of the body.
   *
   * A one-sided condition, Δu >= or <= the prescribed increment, is contact
   * with a frictionless wall: a set of nodes is held, Newton's method converges
   * with it, and check_contact() changes it until no held node pulls and no
   * free one penetrates (the active set method, Hintermüller, Ito & Kunisch
   * 2003). The set is kept from step to step. Nodes start a step at the wall;
   * on a grid that is kept (see GridReset), those that left it start where they
   * are.
   */
  template <int dim>
  class PrescribedDisplacement : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Displacement",
        "",
        Patterns::Anything(),
        "Prescribed displacements (m) on boundaries of the grid, formulas in "
        "x, y(, z), t: 'boundary: x = formula, y = formula; boundary: ...'. "
        "Components not named are free. A later entry overrides an earlier "
        "one at common nodes. 'everywhere' names all nodes of the boundary. "
        "With 'x >= formula' or 'x <= formula' the boundary only pushes: a "
        "node that would have to be pulled leaves it, and is held again when "
        "it comes back.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = "Boundary conditions/Displacement";
      for (const auto &entry : split_named_list(prm.get("Displacement"), name))
        for (const auto &item : split_formulas(entry.second, name))
          {
            const std::string axes   = std::string("xyz").substr(0, dim);
            const auto        equals = item.find('=');
            std::string       axis =
              Utilities::trim(item.substr(0, std::min(equals, item.size())));
            int side = 0;
            if (!axis.empty() && (axis.back() == '>' || axis.back() == '<'))
              {
                side = (axis.back() == '>' ? 1 : -1);
                axis = Utilities::trim(axis.substr(0, axis.size() - 1));
              }
            AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                          axes.find(axis) != std::string::npos,
                        ExcMessage("The entry <" + item +
                                   "> of the parameter <" + name +
                                   "> must have the form <x = formula>, <x >= "
                                   "formula> or <x <= formula>, with a "
                                   "component out of " +
                                   axes + "."));
            conditions.push_back(
              {entry.first,
               static_cast<unsigned int>(axes.find(axis)),
               side,
               Expression<dim>(item.substr(equals + 1), name),
               {},
               {},
               {},
               {}});
          }
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      reference = grid.geometry().vertices();
      for (auto &condition : conditions)
        {
          const bool everywhere = condition.boundary == "everywhere";
          const types::boundary_id id =
            everywhere ? 0 :
                         grid.boundary_id(condition.boundary,
                                          "Boundary conditions/Displacement");
          std::set<unsigned int> vertices;
          for (const BoundaryFace &face : grid.boundary_faces())
            if (everywhere || face.id == id)
              for (unsigned int v = 0; v <= dim; ++v)
                if (v != face.opposite_vertex)
                  vertices.insert(grid.geometry().vertex_indices(face.cell)[v]);
          condition.vertices.assign(vertices.begin(), vertices.end());
          if (condition.side != 0)
            {
              condition.released.assign(vertices.size(), 0);
              condition.n_changes.assign(vertices.size(), 0);
              condition.gap.assign(vertices.size(), 0.);
            }
        }
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      const std::string     parameter = "Boundary conditions/Displacement";
      std::set<std::string> done;
      for (const auto &condition : conditions)
        if (done.insert(condition.boundary).second)
          {
            const bool everywhere = condition.boundary == "everywhere";
            warn_if_untouched(step,
                              parameter,
                              condition.boundary,
                              everywhere ?
                                0 :
                                step.grid.boundary_id(condition.boundary,
                                                      parameter),
                              Contact::node,
                              everywhere);
          }
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      for (const auto &condition : conditions)
        for (unsigned int i = 0; i < condition.vertices.size(); ++i)
          {
            if (condition.side != 0 && condition.released[i])
              continue;
            const unsigned int vertex = condition.vertices[i];
            const unsigned int node   = step.nodes.node(vertex);
            if (node != numbers::invalid_unsigned_int)
              constraints.constrain(node * step.n_components +
                                      condition.component,
                                    increment(condition, i, step));
          }
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      for (auto &condition : conditions)
        if (condition.side != 0)
          update_gaps(condition, step, unknowns);
    }

    void
    start_contact() override
    {
      for (auto &condition : conditions)
        std::fill(condition.n_changes.begin(), condition.n_changes.end(), 0);
    }

    void
    check_contact(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const NodalField       &reaction,
                  const double            tolerance) override
    {
      for (auto &condition : conditions)
        if (condition.side != 0)
          check_contact(condition, step, unknowns, reaction, tolerance);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const auto &condition : conditions)
        for (unsigned int i = 0; i < condition.released.size(); ++i)
          state << int(condition.released[i]) << ' ' << condition.gap[i] << ' ';
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      for (auto &condition : conditions)
        for (unsigned int i = 0; i < condition.released.size(); ++i)
          {
            int released = 0;
            state >> released >> condition.gap[i];
            condition.released[i] = (released != 0);
          }
    }

  private:
    struct Condition
    {
      std::string  boundary;
      unsigned int component;
      /** 0: held; 1: u >= displacement; -1: u <= displacement. */
      int                       side;
      Expression<dim>           displacement;
      std::vector<unsigned int> vertices;
      /** Of a one-sided condition, by vertex, the same on all ranks: whether
       * the node has left it, and how often that changed in this step. */
      std::vector<unsigned char> released, n_changes;
      /** And how far it is from the wall on a grid that is kept. */
      std::vector<double> gap;
    };

    /** The prescribed increment of vertex i of the condition. */
    double
    increment(const Condition        &condition,
              const unsigned int      i,
              const StepContext<dim> &step) const
    {
      const Point<dim> &x         = reference[condition.vertices[i]];
      const double      increment = condition.displacement(x, step.time) -
                               condition.displacement(x, step.old_time);
      return condition.side != 0 && step.grid_is_kept ?
               increment - condition.gap[i] :
               increment;
    }

    void
    update_gaps(Condition              &condition,
                const StepContext<dim> &step,
                const NodalField       &unknowns) const
    {
      // the owner of a node knows; side * gap > 0
      constexpr double    unknown = std::numeric_limits<double>::lowest();
      std::vector<double> gap(condition.vertices.size(), unknown);
      for (unsigned int i = 0; i < gap.size(); ++i)
        {
          const unsigned int node = step.nodes.node(condition.vertices[i]);
          if (node >= step.nodes.n_owned())
            continue;
          gap[i] = condition.released[i] ?
                     condition.side *
                       (unknowns.local_element(node * step.n_components +
                                               condition.component) -
                        increment(condition, i, step)) :
                     0.;
        }
      Utilities::MPI::max(gap, step.grid.communicator(), gap);
      for (unsigned int i = 0; i < gap.size(); ++i)
        condition.gap[i] = gap[i] == unknown ? 0. : condition.side * gap[i];
    }

    void
    check_contact(Condition              &condition,
                  const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const NodalField       &reaction,
                  const double            tolerance) const
    {
      // A node may leave and come back once in a step, so that this ends.
      constexpr unsigned char   most_changes = 2;
      std::vector<unsigned int> changes(condition.vertices.size(), 0);
      for (unsigned int i = 0; i < condition.vertices.size(); ++i)
        {
          const unsigned int vertex = condition.vertices[i];
          const unsigned int node   = step.nodes.node(vertex);
          if (node >= step.nodes.n_owned() ||
              condition.n_changes[i] == most_changes)
            continue;
          const unsigned int entry =
            node * step.n_components + condition.component;
          if (condition.released[i])
            changes[i] = condition.side * (unknowns.local_element(entry) -
                                           increment(condition, i, step)) <
                         0;
          else
            changes[i] =
              condition.side * reaction.local_element(entry) < -tolerance;
        }
      Utilities::MPI::max(changes, step.grid.communicator(), changes);
      for (unsigned int i = 0; i < changes.size(); ++i)
        if (changes[i])
          {
            condition.released[i] = !condition.released[i];
            ++condition.n_changes[i];
          }
    }

    std::vector<Condition>  conditions;
    std::vector<Point<dim>> reference;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 PrescribedDisplacement,
                                 "Displacement")
} // namespace isochor
