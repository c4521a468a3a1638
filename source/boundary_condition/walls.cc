/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_checks.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/contact_search.h>
#include <isochor/boundary_condition/wall_joints.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace isochor
{
  /**
   * Smooth walls on named boundaries of the grid, of any direction and shape:
   * the displacement of a node along the normal n into the grid is prescribed,
   * n·Δu = g, or may not be less; tangential to the wall it is free. Where the
   * boundary has a corner, and where two walls meet, there are several normals
   * at a node (see WallSurface), and all of the conditions hold.
   *
   * A step is linear: the wall is the tangential plane at the place of the node
   * where the step starts. On a grid that is put back that is a vertex of the
   * boundary. On a grid that is kept nodes slide along the wall; if it is
   * curved, normal and distance are those of the place that the node has
   * reached, on the smooth surface through the vertices. What a step errs the
   * next one corrects (grids that are put back: see SmoothWall::takes_back()).
   *
   * One-sided walls find their set of nodes by ContactSearch. Nodes begin a
   * step with the gap of the body (BodyAtWalls); where it isn't known, those
   * that have not touched the wall yet remember their distance from it, others
   * begin at the wall, on a kept grid where the last step left them.
   *
   * What is one surface may have several names (see WallJoints): its nodes
   * belong to the wall named first.
   */
  template <int dim>
  class Walls : public BoundaryCondition<dim>, public HasOneSidedWalls<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Walls",
        "",
        Patterns::Anything(),
        "Smooth walls on boundaries of the grid, inclined and curved ones, too: "
        "'boundary: n = formula; boundary: n >= formula'. n is the displacement "
        "(m) since t = 0 along the boundary's normal into the grid, a formula in "
        "x, y(, z), t; along the boundary the body slides. With 'n = 0' it "
        "stays at the wall, with 'n = 0.1*t' the wall pushes it. With 'n >= "
        "formula' the wall only pushes: nodes that would have to be pulled "
        "leave it. At vertices normals are the mean of the faces that meet at "
        "less than 40 degrees, also of several boundaries with the same "
        "formula; at a sharper corner those of both sides count. "
        "<Boundary conditions/Displacement> overrides walls. A wall that pushes "
        "the body by more than a hundredth of its length needs a grid that is "
        "kept (<Grid reset/Steps between resets>).");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      for (const auto &entry :
           split_list_of_unique_names(prm.get("Walls"), parameter()))
        {
          const std::string &item   = entry.second;
          const auto         equals = item.find('=');
          std::string        left =
            Utilities::trim(item.substr(0, std::min(equals, item.size())));
          const bool one_sided = !left.empty() && left.back() == '>';
          if (one_sided)
            left = Utilities::trim(left.substr(0, left.size() - 1));
          AssertThrow(equals != std::string::npos && left == "n",
                      ExcMessage("The entry <" + entry.first + ": " + item +
                                 "> of the parameter <" + parameter() +
                                 "> must have the form <boundary: n = formula> "
                                 "or <boundary: n >= formula>."));
          std::string           formula = item.substr(equals + 1);
          const Expression<dim> displacement(formula, parameter());
          formula.erase(std::remove(formula.begin(), formula.end(), ' '),
                        formula.end());
          this->pushes_only |= one_sided;
          walls.push_back(
            {entry.first, one_sided, formula, displacement, {}, {}});
        }
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      reference = grid.vertices_at_time(0.);
      for (unsigned int w = 0; w < walls.size(); ++w)
        {
          Wall &wall   = walls[w];
          wall.surface = joints().surface(grid, w);
          wall.nodes.clear();
          for (const auto &at : wall.surface.nodes())
            {
              Node node = Wall::node_at(at.vertex, at.normal, grid);
              if (wall.one_sided)
                {
                  // a node in the wall is pushed out by the first step
                  WallNode &contact = node.contact;
                  contact.gap = -wall.displacement(reference[at.vertex], 0.);
                  contact.touched  = (contact.gap == 0);
                  contact.released = contact.was_released = (contact.gap > 0);
                }
              wall.nodes.push_back(node);
            }
        }
    }

    void
    grid_changed(const BackgroundGrid<dim> &grid,
                 const bool /*at_start*/) override
    {
      const std::vector<Wall>       old           = walls;
      const std::vector<Point<dim>> old_reference = reference;
      initialize(grid);
      for (unsigned int w = 0; w < walls.size(); ++w)
        walls[w].take_over(old[w], old_reference, reference);
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      for (const Wall &wall : walls)
        warn_if_untouched(step,
                          parameter(),
                          wall.boundary,
                          step.grid.boundary_id(wall.boundary, parameter()));
      joints().warn_of_seams(step);
    }

    std::vector<unsigned int>
    held_vertices() const override
    {
      std::vector<unsigned int> held;
      for (const Wall &wall : walls)
        wall.add_vertices(held);
      return held;
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      std::vector<std::pair<unsigned int, double>> terms;
      unsigned int                                 label = 0;
      for (const Wall &wall : walls)
        {
          constraints.source = this->name + " = " + wall.boundary;
          const std::vector<Tensor<1, dim>> normals = normals_of(wall, step);
          for (unsigned int i = 0; i < wall.nodes.size(); ++i, ++label)
            {
              const unsigned int node = step.nodes.node(wall.nodes[i].vertex);
              if (node == numbers::invalid_unsigned_int ||
                  wall.nodes[i].contact.released)
                continue;
              terms.clear();
              for (unsigned int a = 0; a < dim; ++a)
                if (normals[i][a] != 0.)
                  terms.emplace_back(node * step.n_components + a,
                                     normals[i][a]);
              auto &equation    = constraints.add(Precedence::wall,
                                               terms,
                                               increment(wall, i, step));
              equation.n_pivots = terms.size();
              equation.how   = wall.one_sided ? NodalConstraints::in_contact :
                                                NodalConstraints::prescribed;
              equation.owner = this;
              equation.label = label;
            }
        }
    }

    void
    prepare_contact(const StepContext<dim> &step) override
    {
      BodyAtWalls<dim> body;
      for (Wall &wall : walls)
        wall.add_to(body, reference, step);
      body.find(step);
    }

    void
    start_contact() override
    {
      for (Wall &wall : walls)
        for (Node &node : wall.nodes)
          node.contact.start();
      search.start();
    }

    ContactChange
    check_contact(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const MixedSystem<dim> &system,
                  const NodalConstraints &constraints,
                  const typename BoundaryCondition<dim>::ContactTolerance
                    &tolerance) override
    {
      if (std::none_of(walls.begin(), walls.end(), [](const Wall &wall) {
            return wall.one_sided;
          }))
        return {};
      const auto objections =
        find_objections(step, unknowns, system, constraints, tolerance);
      std::vector<WallNode *> nodes;
      std::string             names;
      for (Wall &wall : walls)
        {
          bool objects = false;
          for (Node &node : wall.nodes)
            {
              objects = objects || objections[nodes.size()] != Objection::none;
              nodes.push_back(&node.contact);
            }
          if (objects)
            names += (names.empty() ? "" : ", ") + wall.boundary;
        }
      return search.change(
        objections, tolerance.converged, nodes, parameter(), names);
    }

    void
    append_contacts(const StepContext<dim>         &step,
                    const MixedSystem<dim>         &system,
                    const NodalConstraints         &constraints,
                    std::vector<WallContacts<dim>> &contacts) const override
    {
      const std::vector<double> force =
        forces_at_nodes(step, system, constraints);
      unsigned int k = 0;
      for (const Wall &wall : walls)
        {
          const std::vector<Tensor<1, dim>> normals = normals_of(wall, step);
          if (wall.is_judged())
            contacts.push_back(
              {parameter(), wall.boundary, {}, !wall.one_sided});
          for (unsigned int i = 0; i < wall.nodes.size(); ++i, ++k)
            if (wall.is_judged() && !wall.nodes[i].contact.released)
              contacts.back().nodes.push_back(
                {wall.nodes[i].vertex,
                 normals[i],
                 force[k],
                 wall.distance_of_held(i, reference, step)});
        }
    }

    void
    append_one_sided_walls(
      const StepContext<dim>         &step,
      std::vector<OneSidedWall<dim>> &result) const override
    {
      for (const Wall &wall : walls)
        wall.append_wall(parameter(), reference, step, result);
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      for (Wall &wall : walls)
        {
          if (step.old_time > 0 && !step.grid_is_kept && !step.grid.is_moving())
            wall.warn_if_body_is_lost(parameter(), reference, step);
          follow_nodes(wall, step, unknowns);
          for (Node &node : wall.nodes)
            node.contact.accept();
        }
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const Wall &wall : walls)
        for (const Node &node : wall.nodes)
          {
            node.contact.save(state);
            state << node.moved << ' ' << node.normal_now << ' ' << node.offset
                  << ' ';
          }
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      for (Wall &wall : walls)
        {
          for (Node &node : wall.nodes)
            {
              node.contact.load(state);
              for (unsigned int a = 0; a < 2 * dim; ++a)
                state >> (a < dim ? node.moved : node.normal_now)[a % dim];
              state >> node.offset;
            }
          wall.locate_nodes(reference);
        }
    }

  private:
    using Wall = SmoothWall<dim>;
    using Node = typename Wall::Node;

    std::string
    parameter() const
    {
      return NamedPlugin::parameter("Walls");
    }

    WallJoints<dim>
    joints() const
    {
      return WallJoints<dim>(walls, reference, parameter());
    }

    /** By node of the wall, at the start of the step. */
    std::vector<Tensor<1, dim>>
    normals_of(const Wall &wall, const StepContext<dim> &step) const
    {
      std::vector<Tensor<1, dim>> normals;
      if (step.grid.is_moving())
        {
          const WallSurface<dim> moved =
            joints().surface(step.grid, &wall - walls.data());
          for (const auto &node : moved.nodes())
            normals.push_back(node.normal);
          if (normals.size() == wall.nodes.size())
            return normals;
          normals.clear();
        }
      for (const Node &node : wall.nodes)
        normals.push_back(follows_curve(wall, step) ? node.normal_now :
                                                      node.normal);
      return normals;
    }

    /** Whether a step starts away from the vertices of a curved wall. */
    static bool
    follows_curve(const Wall &wall, const StepContext<dim> &step)
    {
      return step.grid_is_kept && !wall.surface.is_flat() &&
             !step.grid.is_moving();
    }

    /** The distance of node i from the wall at the start of the step. */
    double
    gap(const Wall             &wall,
        const unsigned int      i,
        const StepContext<dim> &step) const
    {
      const Node &node = wall.nodes[i];
      if (follows_curve(wall, step) || wall.takes_back(step))
        return node.gap_now;
      return node.contact.gap_at_start(step.grid_is_kept);
    }

    double
    increment(const Wall             &wall,
              const unsigned int      i,
              const StepContext<dim> &step) const
    {
      return wall.motion(reference[wall.nodes[i].vertex], step) -
             gap(wall, i, step);
    }

    /** By walls and nodes one after the other: the force of the wall (N) on
     * nodes that this rank owns, else 0. */
    std::vector<double>
    forces_at_nodes(const StepContext<dim> &step,
                    const MixedSystem<dim> &system,
                    const NodalConstraints &constraints) const
    {
      std::vector<double> force;
      for (const Wall &wall : walls)
        force.resize(force.size() + wall.nodes.size());
      for (unsigned int k = 0; k < constraints.equations.size(); ++k)
        if (constraints.equations[k].owner == this)
          force[constraints.equations[k].label] = system.multiplier(k);
      auto f = force.begin();
      for (const Wall &wall : walls)
        for (const Node &node : wall.nodes)
          *f++ *= step.nodes.node(node.vertex) < step.nodes.n_owned();
      return force;
    }

    /** By walls and nodes one after the other. Collective. */
    std::vector<unsigned int>
    find_objections(
      const StepContext<dim>                                  &step,
      const NodalField                                        &unknowns,
      const MixedSystem<dim>                                  &system,
      const NodalConstraints                                  &constraints,
      const typename BoundaryCondition<dim>::ContactTolerance &tolerance) const
    {
      const double penetration =
        tolerance.relative * largest_increment(step, unknowns);
      const std::vector<unsigned char> is_tied =
        tied_nodes(constraints.ties, step.nodes.n_local());
      const std::vector<double> force =
        forces_at_nodes(step, system, constraints);
      std::vector<unsigned int> objections;
      for (const Wall &wall : walls)
        {
          const std::vector<Tensor<1, dim>> normals = normals_of(wall, step);
          for (unsigned int i = 0; i < wall.nodes.size(); ++i)
            {
              const unsigned int k = objections.size();
              objections.push_back(Objection::none);
              const unsigned int node = step.nodes.node(wall.nodes[i].vertex);
              if (!wall.one_sided || node >= step.nodes.n_owned())
                continue;
              const bool released = wall.nodes[i].contact.released;
              if (!released && force[k] < -tolerance.force)
                objections.back() = Objection::pulls;
              if (released && !is_tied[node] &&
                  Wall::along(normals[i], node, step, unknowns) -
                      increment(wall, i, step) <
                    -penetration)
                objections.back() = Objection::penetrates;
            }
        }
      Utilities::MPI::max(objections, step.grid.communicator(), objections);
      return objections;
    }

    /** The step has converged: where the nodes and the wall are now. */
    void
    follow_nodes(Wall                   &wall,
                 const StepContext<dim> &step,
                 const NodalField       &unknowns) const
    {
      const MPI_Comm                    comm    = step.grid.communicator();
      const std::vector<Tensor<1, dim>> normals = normals_of(wall, step);
      const unsigned int                n       = wall.nodes.size();
      // by node: where it has moved, and on how many ranks it is active
      constexpr unsigned int stride = dim + 1;
      std::vector<double>    gaps(n, gap_unknown), moved(n * stride, 0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int node = step.nodes.node(wall.nodes[i].vertex);
          if (node >= step.nodes.n_owned())
            continue;
          gaps[i] = gap_after(Wall::along(normals[i], node, step, unknowns),
                              increment(wall, i, step));
          for (unsigned int a = 0; a < dim; ++a)
            moved[i * stride + a] =
              unknowns.local_element(node * step.n_components + a);
          moved[i * stride + dim] = 1;
        }
      if (!wall.surface.is_flat())
        {
          Utilities::MPI::sum(moved, comm, moved);
          for (unsigned int i = 0; i < n; ++i)
            {
              Node &node = wall.nodes[i];
              if (!step.grid_is_kept)
                {
                  const double before = gap(wall, i, step);
                  node.moved          = 0.;
                  node.offset         = -before;
                  // of the body nothing is known where there is none
                  if (wall.takes_back(step) && moved[i * stride + dim] == 0)
                    {
                      node.offset = 0.;
                      continue;
                    }
                }
              node.offset += wall.motion(reference[node.vertex], step);
              for (unsigned int a = 0; a < dim; ++a)
                node.moved[a] += moved[i * stride + a];
            }
          wall.locate_nodes(reference);
        }
      if (!wall.one_sided)
        return;
      std::vector<WallNode> contact(n);
      for (unsigned int i = 0; i < n; ++i)
        contact[i] = wall.nodes[i].contact;
      update_gaps(gaps, comm, contact);
      for (unsigned int i = 0; i < n; ++i)
        wall.nodes[i].contact = contact[i];
    }

    std::vector<Wall>       walls;
    std::vector<Point<dim>> reference;
    ContactSearch           search;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Walls, "Walls")
} // namespace isochor
