/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/periodic_vertices.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace isochor
{
  /**
   * Pairs of sides of the grid that are the same place of a periodic body: the
   * nodes of the second one follow those of the first,
   *
   *   u_+ = u_- + j,   p_+ = p_-,
   *
   * with the jump j of the pair, the mean stretch of the cell times its size.
   * It is prescribed or follows from a force; its increment is the unknown of a
   * control node, the force on which is the one through the sides. Nodes on
   * several pairs follow the one that is left (PeriodicVertices).
   */
  template <int dim>
  class PeriodicSides : public BoundaryCondition<dim>,
                        public ConstrainsNodes<dim>,
                        public HasControlNodes<dim>,
                        public HasPeriods
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Periodic sides",
        "",
        Patterns::Anything(),
        "Pairs of boundaries of the grid that are the same place of a periodic "
        "body: 'first: second, x = formula, force y = formula; ...'. The "
        "vertices of second must be those of first, all moved alike. x, y(, z) "
        "is the displacement (m) of second minus that of first since t = 0, a "
        "formula in t; what is not named is 0. With 'force x = formula' (N, on "
        "second, the opposite on first) the jump is free and has this force. "
        "Pressures are periodic, too. What meets across a pair is one body, and "
        "has one field. Force and jump go into the statistics; "
        "the force is without what nodes carry that <Displacement> or <Walls> "
        "hold, which override at common nodes: add the reaction "
        "there. "
        "Points do not change sides: keep the grid (<Grid reset/Steps between "
        "resets>) if they would leave it.");
      prm.declare_entry("Hold periodic corner",
                        "false",
                        Patterns::Bool(),
                        "Whether the vertices that belong to a pair in each "
                        "direction, the corners of a periodic cell, don't move "
                        "but for the jumps. Without inertia something has to "
                        "support the cell. No effect with one pair only, or "
                        "where no material is at the corners.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      for (const auto &entry :
           split_named_list(prm.get("Periodic sides"), parameter()))
        {
          const auto items = split_formulas(entry.second, parameter());
          AssertThrow(!items.empty() && items[0].find('=') == std::string::npos,
                      ExcMessage(
                        "The entry <" + entry.first + ": " + entry.second +
                        "> of the parameter <" + parameter() +
                        "> must begin with two boundaries and a comma: "
                        "<first: second, ...>."));
          Pair pair;
          pair.first  = entry.first;
          pair.second = items[0];
          for (const Pair &other : pairs)
            AssertThrow(other.second != pair.second,
                        ExcMessage("The parameter <" + parameter() +
                                   "> names <" + pair.second +
                                   "> twice as the second side of a pair, "
                                   "which follows the first one."));
          for (unsigned int i = 1; i < items.size(); ++i)
            parse_item(items[i], pair);
          pairs.push_back(std::move(pair));
        }
      hold_corner = prm.get_bool("Hold periodic corner");
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      vertices.initialize(grid, periodic_sides(), parameter());
    }

    std::vector<std::pair<std::string, std::string>>
    periodic_sides() const override
    {
      std::vector<std::pair<std::string, std::string>> names;
      for (const Pair &pair : pairs)
        names.emplace_back(pair.first, pair.second);
      return names;
    }

    std::vector<unsigned int>
    periodic_vertices() const override
    {
      return vertices.all();
    }

    std::vector<std::pair<unsigned int, unsigned int>>
    periodic_images() const override
    {
      std::vector<std::pair<unsigned int, unsigned int>> images;
      for (const auto &image : vertices.images())
        images.emplace_back(image.vertex, image.root);
      return images;
    }

    void
    grid_changed(const BackgroundGrid<dim> &grid,
                 const bool /*at_start*/) override
    {
      initialize(grid);
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      if (hold_corner)
        check_corner(step);
    }

    std::vector<NamedBoundary>
    named_boundaries() const override
    {
      std::vector<NamedBoundary> boundaries;
      for (const Pair &pair : pairs)
        for (const std::string &side : {pair.first, pair.second})
          boundaries.push_back({parameter(), side, true});
      return boundaries;
    }

    std::string
    why_points_left(const std::vector<std::string> &boundaries) const override
    {
      const auto is_one_of_a_pair = [&](const std::string &name) {
        return std::any_of(pairs.begin(), pairs.end(), [&](const auto &pair) {
          return pair.first == name || pair.second == name;
        });
      };
      return std::none_of(boundaries.begin(),
                          boundaries.end(),
                          is_one_of_a_pair) ?
               "" :
               "Points do not pass from one of <" + parameter() +
                 "> to the other: where a periodic body moves through them, no "
                 "larger grid helps, but one that is kept, <Grid reset/Steps "
                 "between resets = 0> and <Grid reset/Smallest element quality "
                 "= 0>.";
    }

    std::vector<ControlNode<dim>>
    control_nodes() const override
    {
      ControlNode<dim> jump;
      jump.rotation_arm = -1; // neither a displacement nor a rotation
      return std::vector<ControlNode<dim>>(pairs.size(), jump);
    }

    void
    set_first_control_node(const unsigned int first) override
    {
      first_control = first;
    }

    void
    touch_masters(const ActiveNodes<dim>    &nodes,
                  std::vector<unsigned int> &touched) override
    {
      if (pairs.empty())
        return;
      const bool any = vertices.touch_images(nodes.grid, touched);
      if (Utilities::MPI::max(static_cast<int>(any),
                              nodes.grid.communicator()) != 0)
        for (unsigned int k = 0; k < pairs.size(); ++k)
          touched.push_back(nodes.control_vertex(first_control + k));
    }

    void
    set_held_vertices(const std::vector<unsigned int> &held) override
    {
      vertices.share(held);
    }

    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      const unsigned int nc = step.n_components;
      for (unsigned int k = 0; k < pairs.size(); ++k)
        {
          const unsigned int jump = control(step, k);
          if (jump == numbers::invalid_unsigned_int)
            return;
          for (unsigned int a = 0; a < dim; ++a)
            if (!pairs[k].force[a])
              constraints.constrain(jump * nc + a,
                                    increment(pairs[k].jump[a], step));
          if (step.mixed())
            constraints.constrain(jump * nc + dim, 0.);
        }
      std::vector<std::pair<unsigned int, double>> terms;
      for (const auto &image : vertices.images())
        {
          const unsigned int node = step.nodes.node(image.vertex);
          const unsigned int root = step.nodes.node(image.root);
          if (node == numbers::invalid_unsigned_int)
            continue;
          for (unsigned int a = 0; a < nc; ++a)
            {
              terms = {{node * nc + a, 1.}, {root * nc + a, -1.}};
              for (const unsigned int k : image.pairs)
                if (a < dim)
                  terms.emplace_back(control(step, k) * nc + a, -1.);
              auto &equation = constraints.add(Precedence::periodic, terms, 0.);
              equation.n_pivots     = 0;
              equation.known_to_all = image.shared;
            }
        }
      if (hold_corner)
        for (const unsigned int vertex : vertices.corners())
          if (const unsigned int node = step.nodes.node(vertex);
              node != numbers::invalid_unsigned_int)
            for (unsigned int a = 0; a < dim; ++a)
              constraints.constrain(node * nc + a, 0.);
    }

    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      for (unsigned int k = 0; k < pairs.size(); ++k)
        if (const unsigned int jump = control(step, k);
            jump < step.nodes.n_owned())
          for (unsigned int a = 0; a < dim; ++a)
            if (pairs[k].force[a])
              force.local_element(jump * step.n_components + a) +=
                (*pairs[k].force[a])(Point<dim>(), step.time);
    }

    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints & /*constraints*/,
             Statistics &statistics) const override
    {
      for (unsigned int k = 0; k < pairs.size(); ++k)
        {
          std::array<double, 2 * dim> values{};
          if (const unsigned int jump = control(step, k);
              jump < step.nodes.n_owned())
            for (unsigned int a = 0; a < dim; ++a)
              {
                const unsigned int entry = jump * step.n_components + a;
                values[a]                = pairs[k].force[a] ?
                                             (*pairs[k].force[a])(Point<dim>(), step.time) :
                                             system.residual.local_element(entry);
                values[dim + a] =
                  pairs[k].total[a] + unknowns.local_element(entry);
              }
          sum_over_ranks(values, step.grid.communicator());
          const std::string names = pairs[k].first + " and " + pairs[k].second;
          for (unsigned int a = 0; a < dim; ++a)
            statistics.set(std::string("Force ") + "xyz"[a] + " through " +
                             names + " (N)",
                           values[a]);
          for (unsigned int a = 0; a < dim; ++a)
            statistics.set(std::string("Jump ") + "xyz"[a] + " between " +
                             names + " (m)",
                           values[dim + a]);
        }
    }

    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      for (unsigned int k = 0; k < pairs.size(); ++k)
        if (const unsigned int jump = control(step, k);
            jump != numbers::invalid_unsigned_int)
          for (unsigned int a = 0; a < dim; ++a)
            pairs[k].total[a] +=
              unknowns.local_element(jump * step.n_components + a);
    }

    void
    append_motions(std::vector<Expression<dim>> &motions) const override
    {
      for (const Pair &pair : pairs)
        for (const Formula &jump : pair.jump)
          if (jump)
            motions.push_back(*jump);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const Pair &pair : pairs)
        state << pair.total << ' ';
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      for (Pair &pair : pairs)
        for (unsigned int a = 0; a < dim; ++a)
          state >> pair.total[a];
    }

  private:
    void
    check_corner(const StepContext<dim> &step) const
    {
      const auto corners = vertices.corners();
      const int  any =
        std::any_of(corners.begin(), corners.end(), [&](const unsigned int v) {
          return step.nodes.node(v) != numbers::invalid_unsigned_int;
        });
      if (Utilities::MPI::max(any, step.grid.communicator()) != 0)
        return;
      const std::string name = NamedPlugin::parameter("Hold periodic corner");
      AssertThrow(false,
                  ExcMessage(
                    "<" + name + "> holds nothing: " +
                    (corners.empty() ?
                       "no vertex of the grid belongs to one of <" +
                         parameter() + "> in each direction (" +
                         std::to_string(pairs.size()) + " given)" :
                       "there is no material at the corners of the periodic "
                       "cell") +
                    ". Hold the body by <Boundary conditions/Displacement> "
                    "instead."));
    }

    using Formula = std::unique_ptr<Expression<dim>>;

    struct Pair
    {
      std::string              first, second;
      std::array<Formula, dim> jump, force;
      Tensor<1, dim>           total; ///< the jump since t = 0 (m)
    };

    std::string
    parameter() const
    {
      return NamedPlugin::parameter("Periodic sides");
    }

    void
    parse_item(const std::string &item, Pair &pair) const
    {
      const auto        equals = item.find('=');
      const std::string left =
        Utilities::trim(item.substr(0, std::min(equals, item.size())));
      for (unsigned int a = 0; a < dim; ++a)
        for (const bool is_force : {false, true})
          if (left == (is_force ? "force " : "") + std::string(1, "xyz"[a]) &&
              equals != std::string::npos)
            {
              AssertThrow(!pair.jump[a] && !pair.force[a],
                          ExcMessage("The parameter <" + parameter() +
                                     "> has two entries for the direction " +
                                     "xyz"[a] + " of <" + pair.first + ": " +
                                     pair.second +
                                     ">: either the jump or its force."));
              (is_force ? pair.force : pair.jump)[a] =
                std::make_unique<Expression<dim>>(item.substr(equals + 1),
                                                  parameter(),
                                                  FormulaVariables::time);
              return;
            }
      AssertThrow(false,
                  ExcMessage("The entry <" + item + "> of the parameter <" +
                             parameter() +
                             "> must have the form <x = formula> or <force x "
                             "= formula>, with a component out of " +
                             std::string("xyz").substr(0, dim) + "."));
    }

    static double
    increment(const Formula &formula, const StepContext<dim> &step)
    {
      return formula ? prescribed_increment(*formula,
                                            Point<dim>(),
                                            step.old_time,
                                            step.time) :
                       0.;
    }

    /** The local node of the jump of pair k, or invalid. */
    unsigned int
    control(const StepContext<dim> &step, const unsigned int k) const
    {
      return step.nodes.node(step.nodes.control_vertex(first_control + k));
    }

    std::vector<Pair>     pairs;
    PeriodicVertices<dim> vertices;
    bool                  hold_corner   = false;
    unsigned int          first_control = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 PeriodicSides,
                                 "Periodic sides")
} // namespace isochor
