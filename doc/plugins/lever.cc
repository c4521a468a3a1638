/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_condition.h>

#include <set>

namespace isochor
{
  /**
   * A link between two sides: all nodes of the first one have the same
   * displacement u in y, and those of the second one the displacement -r u, as
   * at the ends of a lever. The shortest example of linear equations between
   * nodal unknowns. u is the unknown of a control node, on which a load may
   * act.
   */
  template <int dim>
  class Lever : public BoundaryCondition<dim>,
                public ConstrainsNodes<dim>,
                public HasControlNodes<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.enter_subsection("Lever");
      prm.declare_entry("Boundaries",
                        "",
                        Patterns::Anything(),
                        "The two boundaries of the grid. Empty: no lever.");
      prm.declare_entry("Ratio", "1", Patterns::Double(), "r.");
      prm.declare_entry("Force",
                        "0",
                        Patterns::Anything(),
                        "On u (N), a formula in t.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("Lever");
      names = Utilities::split_string_list(prm.get("Boundaries"));
      ratio = prm.get_double("Ratio");
      load.emplace_back(prm.get("Force"),
                        this->parameter("Lever/Force"),
                        FormulaVariables::time);
      prm.leave_subsection();
      AssertThrow(names.empty() || names.size() == 2,
                  ExcMessage("<" + this->parameter("Lever/Boundaries") +
                             "> are two, not " + std::to_string(names.size()) +
                             "."));
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      for (unsigned int k = 0; k < names.size(); ++k)
        {
          const types::boundary_id id =
            grid.boundary_id(names[k], this->parameter("Lever/Boundaries"));
          vertices[k].clear(); // an adaptive grid has others from time to time
          for (const BoundaryFace &face : grid.boundary_faces())
            for (unsigned int v = 0; v <= dim && face.id == id; ++v)
              if (v != face.opposite_vertex)
                vertices[k].insert(
                  grid.geometry().vertex_indices(face.cell)[v]);
        }
    }

    // the unknown u, which is a displacement
    std::vector<ControlNode<dim>>
    control_nodes() const override
    {
      return std::vector<ControlNode<dim>>(names.empty() ? 0 : 1);
    }

    void
    set_first_control_node(const unsigned int first) override
    {
      control = first;
    }

    // what the equations refer to has to be known on all ranks that have a node
    // of the sides
    void
    touch_masters(const ActiveNodes<dim>    &nodes,
                  std::vector<unsigned int> &touched) override
    {
      if (!names.empty())
        touched.push_back(nodes.control_vertex(control));
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      if (names.empty())
        return;
      constexpr unsigned int y = 1;
      const unsigned int     n = step.n_components;
      const unsigned int     u =
        step.nodes.node(step.nodes.control_vertex(control)) * n;
      for (unsigned int a = 0; a < n; ++a)
        if (a != y)
          constraints.constrain(u + a, 0.); // not used
      for (unsigned int k = 0; k < 2; ++k)
        for (const unsigned int vertex : vertices[k])
          if (const unsigned int node = step.nodes.node(vertex);
              node != numbers::invalid_unsigned_int)
            // u_I - (1 or -r) u = 0
            constraints.add(Precedence::periodic,
                            {{node * n + y, 1.}, {u + y, k == 0 ? -1. : ratio}},
                            0.);
    }

    // a dead load on the unknown, by the rank that owns it
    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      if (names.empty())
        return;
      constexpr unsigned int y = 1;
      const unsigned int     node =
        step.nodes.node(step.nodes.control_vertex(control));
      if (node < step.nodes.n_owned())
        force.local_element(node * step.n_components + y) +=
          load[0](Point<dim>(), step.time);
    }

  private:
    std::vector<std::string>     names;
    double                       ratio = 1;
    std::vector<Expression<dim>> load; // one
    std::set<unsigned int>       vertices[2];
    unsigned int                 control = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Lever, "Lever")
} // namespace isochor
