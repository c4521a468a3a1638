/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/boundary_condition/rigid_side.h>

#include <algorithm>
#include <sstream>

namespace isochor
{
  /**
   * Sides of the grid that move as rigid bodies: the nodes of a side follow its
   * translation u and rotation R about a reference point c,
   *
   *   u_I = u + (R - 1) (x_I - c).
   *
   * u and the rotation vector of the step, times a length, are unknowns of two
   * control nodes, prescribed or loaded by forces and moments. R is finite
   * (FiniteRotation): the equations are linearised anew in each iteration, and
   * the matrix has the term λ_I · ∂²u_I/∂θ∂θ, so that Newton's method converges
   * quadratically.
   *
   * On a grid that is put back, nodes are where the boundary was generated, and
   * get the velocity that the rigid body has there: c moves on. On a grid that
   * is kept they move with it.
   */
  template <int dim>
  class RigidSides : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Rigid sides",
        "",
        Patterns::Anything(),
        dim == 2 ?
          "Boundaries of the grid that move as rigid bodies: 'boundary: "
          "x = formula, y = formula, rotation = formula; boundary: ...', "
          "formulas in t. x and y are the displacement (m) since t = 0 of the "
          "reference point, rotation the angle (rad) since then, "
          "anticlockwise. What is not named is free; 'force x = formula' (N "
          "per metre of thickness) and 'moment = formula' (N m, about the "
          "reference point) act on it then. 'centre = (x, y)' is the "
          "reference point, else the centroid of the side. Force, moment, "
          "translation and rotation go into the statistics. A side that "
          "moves by more than 1 % of the body needs a grid that is kept "
          "(<Grid reset/Steps between resets = 0>, <Smallest element quality "
          "= 0>). In bodies of revolution x = 0 and rotation = 0. "
          "<Displacement> and <Walls> override rigid sides at common nodes." :
          "Boundaries of the grid that move as rigid bodies: 'boundary: "
          "x = formula, rotation z = formula, ...; boundary: ...', formulas in "
          "t. x, y and z are the displacement (m) since t = 0 of the reference "
          "point. rotation x, y and z are the components of the rotation "
          "vector (rad) since then: turns about the axis along it by the angle "
          "that is its length, also by more than a full turn; if only some of "
          "them are prescribed, what they add in a step is that of the step's "
          "rotation vector. What is not named is free; 'force x = formula' (N) "
          "and 'moment x = formula' (N m, about the reference point, along the "
          "axes of space) act on it then. 'centre = (x, y, z)' is the "
          "reference point, else the centroid of the side. Force, moment, "
          "translation and rotation go into the statistics. A side that "
          "moves by more than 1 % of the body needs a grid that is kept "
          "(<Grid reset/Steps between resets = 0>, <Smallest element quality "
          "= 0>). "
          "<Displacement> and <Walls> override rigid sides at common nodes.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      for (const auto &entry :
           split_list_of_unique_names(prm.get("Rigid sides"), parameter()))
        sides.emplace_back(entry.first, entry.second, parameter());
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      for (auto &side : sides)
        side.initialize(grid);
    }

    void
    grid_changed(const BackgroundGrid<dim> &grid,
                 const bool /*at_start*/) override
    {
      for (auto &side : sides)
        side.find_vertices(grid);
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      for (const auto &side : sides)
        AssertThrow(!step.kernel.axisymmetric || side.keeps_to_axis(),
                    ExcMessage(
                      "A body of revolution moves along its axis only: "
                      "<" +
                      side.name() + "> of the parameter <" + parameter() +
                      "> needs <x = 0, rotation = 0>."));
      for (const auto &side : sides)
        warn_if_untouched(step,
                          parameter(),
                          side.name(),
                          step.grid.boundary_id(side.name(), parameter()));
      for (const auto &side : sides)
        side.warn_of_centre_beside_body(step);
    }

    std::vector<ControlNode<dim>>
    control_nodes() const override
    {
      std::vector<ControlNode<dim>> nodes;
      for (const auto &side : sides)
        for (const auto &node : side.control_nodes())
          nodes.push_back(node);
      return nodes;
    }

    void
    set_first_control_node(const unsigned int first) override
    {
      for (unsigned int s = 0; s < sides.size(); ++s)
        sides[s].set_first_control_node(first + 2 * s);
    }

    // the control nodes of a side that holds something, on all ranks
    void
    touch_masters(const ActiveNodes<dim>    &nodes,
                  std::vector<unsigned int> &vertices) override
    {
      if (sides.empty())
        return;
      std::vector<unsigned char> touched(nodes.control_vertex(0), 0);
      for (const unsigned int v : vertices)
        if (v < touched.size())
          touched[v] = 1;
      for (const auto &side : sides)
        {
          const auto &own = side.vertices();
          const int   any =
            std::any_of(own.begin(), own.end(), [&](const unsigned int v) {
              return touched[v] != 0;
            });
          if (Utilities::MPI::max(any, nodes.grid.communicator()) != 0)
            for (const unsigned int k : {0, 1})
              vertices.push_back(
                nodes.control_vertex(side.control_number() + k));
        }
    }

    std::vector<unsigned int>
    held_vertices() const override
    {
      std::vector<unsigned int> held;
      for (const auto &side : sides)
        held.insert(held.end(), side.vertices().begin(), side.vertices().end());
      return held;
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      unsigned int label = 0;
      for (const auto &side : sides)
        {
          constraints.source = this->name + " = " + side.name();
          side.constrain(step, this, label, constraints);
        }
    }

    bool
    relinearises() const override
    {
      return !sides.empty();
    }

    void
    relinearise(const StepContext<dim> &step,
                const NodalField       &unknowns,
                NodalConstraints       &constraints) const override
    {
      for_each_equation(constraints,
                        [&](const auto &side, const unsigned int k) {
                          side.relinearise(step, unknowns, k, constraints);
                        });
    }

    double
    convective_acceleration(
      const StepContext<dim>           &step,
      const NodalField                 &velocity,
      const NodalConstraints           &constraints,
      const NodalConstraints::Equation &equation) const override
    {
      return side_of(equation.label)
        .convective_acceleration(step, velocity, constraints, equation);
    }

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override
    {
      for (const auto &side : sides)
        {
          const unsigned int node = side.rotation_node(step);
          if (node != numbers::invalid_unsigned_int)
            elements.add(&node, &node + 1);
        }
    }

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override
    {
      for (unsigned int s = 0; s < sides.size(); ++s)
        sides[s].add_moment(step,
                            unknowns,
                            pending,
                            first_element + element(s, step),
                            with_matrix,
                            system);
      return EvaluationStatus::success;
    }

    bool
    has_symmetric_matrix() const override
    {
      return std::all_of(sides.begin(), sides.end(), [](const auto &side) {
        return side.is_symmetric();
      });
    }

    bool
    assembles_load(const StepContext<dim> &step) const override
    {
      return std::any_of(sides.begin(), sides.end(), [&](const auto &side) {
        return side.assembles_moment(step.time);
      });
    }

    void
    add_constraint_stiffness(const StepContext<dim> &step,
                             const NodalField       &unknowns,
                             const NodalConstraints &constraints,
                             const unsigned int      first_element,
                             MixedSystem<dim>       &system) const override
    {
      std::vector<std::array<double, dim * dim>> matrices(sides.size());
      for (auto &matrix : matrices)
        matrix.fill(0.);
      for_each_equation(constraints,
                        [&](const auto &side, const unsigned int k) {
                          side.add_curvature(step,
                                             unknowns,
                                             constraints,
                                             k,
                                             system.multiplier(k),
                                             matrices[&side - sides.data()]);
                        });
      for (unsigned int s = 0; s < sides.size(); ++s)
        sides[s].add_matrix(step,
                            matrices[s],
                            first_element + element(s, step),
                            system);
    }

    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      for (const auto &side : sides)
        side.add_force(step, force);
    }

    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override
    {
      for (const auto &side : sides)
        side.add_moment_force(step, unknowns, force);
    }

    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override
    {
      std::vector<std::array<double, 6>> sums(sides.size());
      for (auto &sum : sums)
        sum.fill(0.);
      for_each_equation(constraints,
                        [&](const auto &side, const unsigned int k) {
                          side.add_to_resultant(step,
                                                unknowns,
                                                constraints,
                                                k,
                                                system.multiplier(k),
                                                sums[&side - sides.data()]);
                        });
      for (unsigned int s = 0; s < sides.size(); ++s)
        {
          sum_over_ranks(sums[s], step.grid.communicator());
          if (sides[s].rotation_is_pinned(step, constraints))
            sides[s].take_given_moment(step, sums[s]);
          sides[s].set_statistics(step, unknowns, sums[s], statistics);
        }
    }

    std::string
    why_points_left(const StepContext<dim>         &step,
                    const std::vector<std::string> &boundaries) const override
    {
      std::string text;
      for (const auto &side : sides)
        {
          if (std::find(boundaries.begin(), boundaries.end(), side.name()) ==
              boundaries.end())
            continue;
          const auto place =
            isochor::side_of(step.grid, side.name(), parameter());
          const double outward =
            side.moved_by(step.grid, -place.inwards).second;
          if (outward > 1e-6 * place.cell_size)
            text += (text.empty() ? "" : " ") + ("<" + parameter() + "> has ") +
                    "moved <" + side.name() + "> by " + rounded(outward) +
                    " m out of the grid, whose cells there have a size of " +
                    rounded(place.cell_size) +
                    " m: a side that takes the body along needs a grid that "
                    "is kept, <Grid reset/Steps between resets = 0> and "
                    "<Grid reset/Smallest element quality = 0>.";
        }
      return text;
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      if (step.old_time > 0 && !step.grid_is_kept && !step.grid.is_moving())
        for (const auto &side : sides)
          warn_of_body_left_behind(
            step,
            side.name(),
            parameter() + " = " + side.name() + ": ...",
            side
              .moved_by(
                step.grid,
                isochor::side_of(step.grid, side.name(), parameter()).inwards)
              .second);
      for (auto &side : sides)
        side.advance(step, unknowns);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const auto &side : sides)
        side.save(state);
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      for (auto &side : sides)
        side.load(state);
    }

  private:
    std::string
    parameter() const
    {
      return NamedPlugin::parameter("Rigid sides");
    }

    /** The side of an equation by its label: dim for each vertex. */
    const RigidSide<dim> &
    side_of(const unsigned int label) const
    {
      unsigned int s = 0;
      while (s + 1 < sides.size() && label >= sides[s + 1].first_label())
        ++s;
      return sides[s];
    }

    /** The element of a side: those without material have none. */
    unsigned int
    element(const unsigned int side, const StepContext<dim> &step) const
    {
      return std::count_if(sides.begin(),
                           sides.begin() + side,
                           [&step](const auto &before) {
                             return before.rotation_node(step) !=
                                    numbers::invalid_unsigned_int;
                           });
    }

    template <typename Action>
    void
    for_each_equation(const NodalConstraints &constraints,
                      const Action           &action) const
    {
      for (unsigned int k = 0; k < constraints.equations.size(); ++k)
        if (constraints.equations[k].owner == this)
          action(side_of(constraints.equations[k].label), k);
    }

    std::vector<RigidSide<dim>> sides;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, RigidSides, "Rigid sides")
} // namespace isochor
