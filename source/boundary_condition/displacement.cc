/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition.h>
#include <isochor/expression.h>

#include <set>

namespace isochor
{
  /**
   * Prescribed displacement of the grid nodes on named boundaries, component by
   * component: Δu = u(x, t_{n+1}) - u(x, t_n) with x where the node was
   * generated. With a grid that follows the motion (Grid/Stretch) this is an
   * exact condition on a moving side of the body.
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
        "one at common nodes. 'everywhere' names all nodes of the boundary.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = "Boundary conditions/Displacement";
      for (const auto &entry : split_named_list(prm.get("Displacement"), name))
        for (const auto &item : Utilities::split_string_list(entry.second))
          {
            const std::string axes   = std::string("xyz").substr(0, dim);
            const auto        equals = item.find('=');
            const std::string axis =
              Utilities::trim(item.substr(0, std::min(equals, item.size())));
            AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                          axes.find(axis) != std::string::npos,
                        ExcMessage("The entry <" + item +
                                   "> of the parameter <" + name +
                                   "> must have the form <x = formula>, with a "
                                   "component out of " +
                                   axes + "."));
            conditions.push_back(
              {entry.first,
               static_cast<unsigned int>(axes.find(axis)),
               Expression<dim>(item.substr(equals + 1), name),
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
        }
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      for (const auto &condition : conditions)
        for (const unsigned int vertex : condition.vertices)
          {
            const unsigned int node = step.nodes.node(vertex);
            if (node != numbers::invalid_unsigned_int)
              constraints.constrain(
                node * step.n_components + condition.component,
                condition.displacement(reference[vertex], step.time) -
                  condition.displacement(reference[vertex], step.old_time));
          }
    }

  private:
    struct Condition
    {
      std::string               boundary;
      unsigned int              component;
      Expression<dim>           displacement;
      std::vector<unsigned int> vertices;
    };
    std::vector<Condition>  conditions;
    std::vector<Point<dim>> reference;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 PrescribedDisplacement,
                                 "Displacement")
} // namespace isochor
