/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/one_sided_wall.h>
#include <isochor/boundary_condition/wall_joints.h>

#include <algorithm>
#include <limits>
#include <sstream>

namespace isochor
{
  /**
   * Smooth walls on named boundaries of the grid, of any direction and shape:
   * the displacement of a node along the normal n into the grid is prescribed,
   * n·Δu = g; tangential to the wall it is free. Where the boundary has a
   * corner, and where two walls meet, there are several normals at a node (see
   * WallSurface), and all of the conditions hold.
   *
   * A step is linear: the wall is the tangential plane at the place of the node
   * where the step starts. On a grid that is put back that is a vertex of the
   * boundary. On a grid that is kept nodes slide along the wall; if it is
   * curved, normal and distance are those of the place that the node has
   * reached, on the smooth surface through the vertices. What a step errs the
   * next one corrects (grids that are put back: see SmoothWall::takes_back()).
   *
   * Walls that the body may leave (n >= formula) are no conditions on nodes:
   * see InteractionTerm, GridBoundaryPartner.
   *
   * What is one surface may have several names (see WallJoints): its nodes
   * belong to the wall named first.
   */
  template <int dim>
  class Walls : public BoundaryCondition<dim>,
                public ConstrainsNodes<dim>,
                public HasOneSidedWalls
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Walls",
        "",
        Patterns::Anything(),
        "Smooth walls on boundaries of the grid, inclined and curved ones, "
        "too: 'boundary: n = formula; boundary: n >= formula'. n is the "
        "displacement (m) since t = 0 along the boundary's normal into the "
        "grid, a formula in x, y(, z), t; along the boundary the body slides. "
        "With 'n = 0' it stays at the wall, with 'n = 0.1*t' the wall pushes "
        "it. At vertices normals are the mean of the faces that meet at less "
        "than 40 degrees, also of several boundaries with the same formula; at "
        "a sharper corner those of both sides count. <Boundary "
        "conditions/Displacement> overrides such a wall, and if it pushes the "
        "body by more than a hundredth of its length it needs a grid that is "
        "not reset (<Grid reset/Steps between resets>). With 'n >= formula' "
        "the wall only pushes: bodies may come to it and leave it. It is the "
        "boundary of the grid (if <Grid/Stretch> moves it, where it is then), "
        "shifted by the formula, and acts on the surface of bodies: contact "
        "without friction, or what a section <Interaction: BODY - boundary "
        "NAME> asks for. That needs <Quadrature/Type = CPDI>.");
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
          if (one_sided)
            one_sided_ones.push_back({parameter(), entry.first, formula});
          else
            walls.push_back({entry.first, formula, displacement, {}, {}});
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
          wall.make_nodes(grid);
        }
    }

    const std::vector<OneSidedWall> &
    one_sided_walls() const override
    {
      return one_sided_ones;
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

    std::vector<NamedBoundary>
    named_boundaries() const override
    {
      std::vector<NamedBoundary> boundaries;
      for (const Wall &wall : walls)
        boundaries.push_back({parameter(), wall.boundary});
      return boundaries;
    }

    std::vector<BoundaryPush>
    pushes(const StepContext<dim> &step) const override
    {
      std::vector<BoundaryPush> all;
      if (!step.grid.is_moving())
        for (const Wall &wall : walls)
          all.push_back({wall.boundary,
                         parameter() + " = " + wall.boundary + ": n = ...",
                         BoundaryPush::along_normal,
                         {{0., wall.largest_push(reference, step.old_time)}}});
      return all;
    }

    std::vector<unsigned int>
    held_vertices() const override
    {
      std::vector<unsigned int> held;
      for (const Wall &wall : walls)
        for (const Node &node : wall.nodes)
          held.push_back(node.vertex);
      return held;
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      std::vector<std::pair<unsigned int, double>> terms;
      for (const Wall &wall : walls)
        {
          constraints.source = this->name + " = " + wall.boundary;
          const std::vector<Tensor<1, dim>> normals = normals_of(wall, step);
          for (unsigned int i = 0; i < wall.nodes.size(); ++i)
            {
              const unsigned int node = step.nodes.node(wall.nodes[i].vertex);
              if (node == numbers::invalid_unsigned_int)
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
            }
        }
    }

    void
    append_motions(std::vector<Expression<dim>> &motions) const override
    {
      for (const Wall &wall : walls)
        motions.push_back(wall.displacement);
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      for (Wall &wall : walls)
        if (!wall.surface.is_flat())
          follow_nodes(wall, step, unknowns);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const Wall &wall : walls)
        for (const Node &node : wall.nodes)
          state << node.moved << ' ' << node.normal_now << ' ' << node.offset
                << ' ';
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
      AssertIndexRange(i, wall.nodes.size());
      return follows_curve(wall, step) || wall.takes_back(step) ?
               wall.nodes[i].gap_now :
               0.;
    }

    double
    increment(const Wall             &wall,
              const unsigned int      i,
              const StepContext<dim> &step) const
    {
      AssertIndexRange(i, wall.nodes.size());
      return wall.motion(reference[wall.nodes[i].vertex], step) -
             gap(wall, i, step);
    }

    /** The step has converged: where the nodes of a curved wall are now. */
    void
    follow_nodes(Wall                   &wall,
                 const StepContext<dim> &step,
                 const NodalField       &unknowns) const
    {
      // by node: where it has moved, and on how many ranks it is active
      constexpr unsigned int stride = dim + 1;
      const unsigned int     n      = wall.nodes.size();
      std::vector<double>    moved(n * stride, 0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          const unsigned int node = step.nodes.node(wall.nodes[i].vertex);
          if (node >= step.nodes.n_owned())
            continue;
          for (unsigned int a = 0; a < dim; ++a)
            moved[i * stride + a] =
              unknowns.local_element(node * step.n_components + a);
          moved[i * stride + dim] = 1;
        }
      Utilities::MPI::sum(moved, step.grid.communicator(), moved);
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

    std::vector<OneSidedWall> one_sided_ones;
    std::vector<Wall>         walls;
    std::vector<Point<dim>>   reference;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Walls, "Walls")
} // namespace isochor
