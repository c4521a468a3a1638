/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/postprocess/postprocessor.h>

#include <set>

namespace isochor
{
  /**
   * Reaction of named boundaries: the sum of the constraint forces at their
   * constrained nodes, the force that the boundary exerts on the body (N, per
   * metre of thickness in plane strain). A node counts for each boundary it is
   * on.
   */
  template <int dim>
  class Reactions : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Reactions",
                        "",
                        Patterns::List(Patterns::Anything()),
                        "Boundaries of the grid, separated by commas, whose "
                        "reaction goes into the statistics: the sum of the "
                        "constraint forces at all of their nodes. Nodes that "
                        "two boundaries share, as at corners, count in both, "
                        "whichever of them holds the node: the sum over "
                        "boundaries that meet is not the whole force, and a "
                        "smooth wall shows what the wall next to it carries at "
                        "the corner. Interactions (also walls with unilateral "
                        "contact) and <Periodic sides> have columns of their "
                        "own.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      names = Utilities::split_string_list(prm.get("Reactions"));
      std::set<std::string> unique;
      for (const std::string &name : names)
        AssertThrow(unique.insert(name).second,
                    ExcMessage("The parameter <" +
                               this->parameter("Reactions") + "> names <" +
                               name + "> twice."));
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      for (const std::string &name : names)
        {
          const std::string parameter = this->parameter("Reactions");
          AssertThrow(grid.boundary_names().count(name) != 0,
                      ExcMessage(
                        "The parameter <" + parameter +
                        "> names the boundary <" + name +
                        ">, which the grid does not have. It has: " +
                        known_names(grid) + ". If <" + name +
                        "> is a surface of the body (<Surfaces of body>), the "
                        "force that holds it needs no entry here: it is in "
                        "the columns <Force x on " +
                        name +
                        " by place (N)>, and so on, with a section "
                        "<Interaction: " +
                        name + " - place>."));
          const types::boundary_id id = grid.boundary_id(name, parameter);
          vertices.emplace_back();
          for (const BoundaryFace &face : grid.boundary_faces())
            if (face.id == id)
              for (unsigned int v = 0; v <= dim; ++v)
                if (v != face.opposite_vertex)
                  vertices.back().insert(
                    grid.geometry().vertex_indices(face.cell)[v]);
        }
    }

    void
    grid_changed(const BackgroundGrid<dim> &grid) override
    {
      vertices.clear();
      initialize(grid);
    }

    std::vector<NamedBoundary>
    named_boundaries() const override
    {
      std::vector<NamedBoundary> boundaries;
      for (const std::string &name : names)
        boundaries.push_back({this->parameter("Reactions"), name});
      return boundaries;
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics            &statistics) override
    {
      const StepContext<dim> &step = result.step;
      for (unsigned int i = 0; i < names.size(); ++i)
        {
          std::array<double, dim> force{};
          for (const unsigned int vertex : vertices[i])
            {
              const unsigned int node = step.nodes.node(vertex);
              if (node >= step.nodes.n_owned())
                continue;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  const unsigned int entry = node * step.n_components + a;
                  if (result.system.is_held(entry))
                    force[a] += result.system.reaction().local_element(entry);
                }
            }
          sum_over_ranks(force, step.grid.communicator());
          for (unsigned int a = 0; a < dim; ++a)
            statistics.set(std::string("Reaction ") + "xyz"[a] + " on " +
                             names[i] + " (N)",
                           force[a]);
        }
    }

  private:
    static std::string
    known_names(const BackgroundGrid<dim> &grid)
    {
      std::string known;
      for (const auto &entry : grid.boundary_names())
        known += (known.empty() ? "" : ", ") + entry.first;
      return known;
    }

    std::vector<std::string>            names;
    std::vector<std::set<unsigned int>> vertices;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Reactions, "Reactions")
} // namespace isochor
