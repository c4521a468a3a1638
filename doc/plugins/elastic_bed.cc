/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_condition.h>

#include <set>

namespace isochor
{
  /**
   * Springs between the nodes of a boundary of the grid and the ground, each of
   * k per node (N/m) against the motion of a step in y: the shortest example of
   * a condition with a stiffness. f_I = -k Δu_I,y.
   */
  template <int dim>
  class ElasticBed : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.enter_subsection("Elastic bed");
      prm.declare_entry("Boundary",
                        "",
                        Patterns::Anything(),
                        "The boundary of the grid. Empty: none.");
      prm.declare_entry("Stiffness",
                        "0",
                        Patterns::Double(0),
                        "Of the spring of each node (N/m).");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("Elastic bed");
      boundary  = prm.get("Boundary");
      stiffness = prm.get_double("Stiffness");
      prm.leave_subsection();
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      vertices.clear(); // an adaptive grid has others from time to time
      if (boundary.empty())
        return;
      const types::boundary_id id =
        grid.boundary_id(boundary, this->parameter("Elastic bed/Boundary"));
      for (const BoundaryFace &face : grid.boundary_faces())
        for (unsigned int v = 0; v <= dim && face.id == id; ++v)
          if (v != face.opposite_vertex)
            vertices.insert(grid.geometry().vertex_indices(face.cell)[v]);
    }

    // the elements of the coming steps: one node each, on the rank that owns it
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override
    {
      nodes.clear();
      for (const unsigned int vertex : vertices)
        if (step.nodes.node(vertex) < step.nodes.n_owned())
          {
            nodes.push_back(step.nodes.node(vertex));
            elements.add(&nodes.back(), &nodes.back() + 1);
          }
    }

    // their residual and matrix, in each iteration of Newton's method
    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override
    {
      const unsigned int                        n = step.n_components, y = 1;
      std::array<double, dim + 1>               residual{};
      std::array<double, (dim + 1) * (dim + 1)> matrix{};
      matrix[y * n + y] = stiffness;
      for (unsigned int e = 0; e < nodes.size(); ++e)
        {
          residual[y] = stiffness * unknowns.local_element(nodes[e] * n + y);
          system.add_element(first_element + e,
                             residual.data(),
                             with_matrix ? matrix.data() : nullptr,
                             pending);
        }
      return EvaluationStatus::success;
    }

  private:
    std::string               boundary;
    double                    stiffness = 0;
    std::set<unsigned int>    vertices;
    std::vector<unsigned int> nodes;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, ElasticBed, "Elastic bed")
} // namespace isochor
