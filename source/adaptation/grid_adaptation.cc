/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/carried_motion.h>
#include <isochor/adaptation/grid_adaptation.h>
#include <isochor/adaptation/leaf_weights.h>
#include <isochor/equations/invariants.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  GridAdaptation<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Adaptive grid");
    prm.declare_entry("Minimum level",
                      "0",
                      Patterns::Integer(0, Leaf<dim>::max_level),
                      "How often coarse cells are halved where nothing asks "
                      "for more.");
    prm.declare_entry("Maximum level",
                      "4",
                      Patterns::Integer(0, Leaf<dim>::max_level),
                      "How often coarse cells may be halved. Sizes of "
                      "<Cell size> and at boundaries that would need more "
                      "are as small as this allows.");
    prm.declare_entry("Hysteresis",
                      "0.25",
                      Patterns::Double(0, 1),
                      "Cells are only joined if those that result are smaller "
                      "than necessary by a factor of 2 to this power, so that "
                      "they are not split again at once.");
    prm.declare_entry("Buffer",
                      "1",
                      Patterns::Integer(0, 8),
                      "Layers of cells around those with material that get "
                      "their size.");
    prm.declare_entry("Resets between changes",
                      "1",
                      Patterns::Integer(0),
                      "The grid may change at every so many resets of it, and "
                      "points be merged. 0: the grid stays as it is at t = 0, "
                      "and points may be merged at each reset.");
    prm.declare_entry("Repetitions of first step",
                      "0",
                      Patterns::Integer(0),
                      "Before the points move for the first time, the grid is "
                      "adapted to the solution so often, the body seeded anew "
                      "in it, and the step solved again.");
    PluginRegistry<CellSizeCriterion<dim>>::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  GridAdaptation<dim>::parse_parameters(ParameterHandler &prm)
  {
    balance.parse_parameters(prm);
    prm.enter_subsection("Adaptive grid");
    rule.minimum    = prm.get_integer("Minimum level");
    rule.maximum    = prm.get_integer("Maximum level");
    rule.hysteresis = prm.get_double("Hysteresis");
    n_buffer        = prm.get_integer("Buffer");
    resets_between  = prm.get_integer("Resets between changes");
    n_repetitions   = prm.get_integer("Repetitions of first step");
    AssertThrow(rule.minimum <= rule.maximum,
                ExcMessage("<Adaptive grid/Minimum level> = " +
                           std::to_string(rule.minimum) +
                           " must not exceed <Adaptive grid/Maximum level> = " +
                           std::to_string(rule.maximum) + "."));
    PluginRegistry<CellSizeCriterion<dim>>::create_all(criteria);
    for (const auto &criterion : criteria)
      criterion->parse_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  bool
  GridAdaptation<dim>::needs_state() const
  {
    return std::any_of(criteria.begin(), criteria.end(), [](const auto &c) {
      return c->needs_state();
    });
  }



  template <int dim>
  bool
  GridAdaptation<dim>::needs_sizes() const
  {
    const bool next_reset_is_due =
      resets_between > 0 && n_resets % resets_between == 0;
    return next_reset_is_due ||
           std::any_of(criteria.begin(), criteria.end(), [](const auto &c) {
             return c->needs_state() && c->writes_statistics();
           });
  }



  template <int dim>
  double
  GridAdaptation<dim>::size_at(const Point<dim> &x, const double time) const
  {
    double size = CellSizeCriterion<dim>::any_size;
    for (const auto &criterion : criteria)
      size = std::min(size, criterion->size_at(x, time));
    return size;
  }



  template <int dim>
  void
  GridAdaptation<dim>::make_initial_grid(BackgroundGrid<dim> &grid)
  {
    if (!grid.is_adaptive())
      return;
    for (const auto &criterion : criteria)
      criterion->initialize(grid);
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    // a leaf is asked at this many places a side
    constexpr unsigned int n_places = (dim == 2 ? 9 : 5);
    const auto             leaves   = forest.refine([&](const Leaf<dim> &leaf) {
      if (leaf.level < rule.minimum)
        return true;
      const double size = forest.size(leaf.tree, leaf.level) * (1 - 1e-9);
      if (leaf.level >= rule.maximum)
        return false;
      const unsigned int n = std::pow(n_places, dim) + 0.5;
      for (unsigned int i = 0; i < n; ++i)
        {
          auto         place = leaf.corner;
          unsigned int rest  = i;
          for (unsigned int d = 0; d < dim; ++d, rest /= n_places)
            place[d] +=
              std::uint64_t(rest % n_places) * leaf.size() / (n_places - 1);
          if (size > size_at(forest.position(leaf.tree, place), 0.))
            return true;
        }
      return false;
    });
    if (leaves == forest.leaves())
      return;
    grid.change(leaves,
                partition_leaves(std::vector<double>(leaves.size(), 1.),
                                 Utilities::MPI::n_mpi_processes(
                                   grid.communicator())),
                0.);
  }



  template <int dim>
  void
  GridAdaptation<dim>::set_sizes(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 MaterialPoints<dim>    &points,
                                 Statistics             &statistics)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    if (!step.grid.is_adaptive() || !needs_state())
      return;
    const BodyState<dim> state = state_of_body(step, unknowns);
    std::vector<double>  sizes(state.size(), CellSizeCriterion<dim>::any_size);
    for (const auto &criterion : criteria)
      if (criterion->needs_state())
        criterion->limit_sizes(state, rule, sizes, statistics);
    const AdaptiveGrid<dim> &forest    = step.grid.adaptive_grid();
    double                   n_limited = 0, n = state.size(), smallest = 1e300;
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        const unsigned int tree =
          forest.leaves()[forest.leaf_of_cell(state.cell[q])].tree;
        n_limited += sizes[q] < forest.size(tree, rule.maximum) * (1 - 1e-9);
        smallest = std::min(smallest, sizes[q]);
      }
    const MPI_Comm comm = step.grid.communicator();
    last_limited        = {step.time,
                           Utilities::MPI::sum(n_limited, comm) /
                             Utilities::MPI::sum(n, comm),
                           Utilities::MPI::min(smallest, comm),
                           rule.maximum};
    points.for_each([&](const unsigned int /*k*/,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      properties[points.layout().cell_size] = sizes[q];
    });
  }



  namespace
  {
    /** Where the @p levels of leaves with points would make more than twice as
     * many leaves as the @p largest number, let levels increase by less. Leaves
     * are split as a whole: those that a body takes its finest points to in one
     * step would become very many. */
    template <int dim>
    void
    limit_number_of_leaves(const std::vector<Leaf<dim>> &leaves,
                           const std::vector<double>    &n_points,
                           const double                  largest,
                           std::vector<unsigned int>    &levels)
    {
      AssertDimension(levels.size(), leaves.size());
      AssertDimension(n_points.size(), leaves.size());
      // what a change of the grid may make too much, and the next one takes
      // back
      constexpr double margin   = 2;
      const auto       wanted   = levels;
      const auto       increase = [&](const unsigned int i) {
        return static_cast<int>(wanted[i]) - static_cast<int>(leaves[i].level);
      };
      for (int most = Leaf<dim>::max_level; most > 0; --most)
        {
          double number = 0;
          for (unsigned int i = 0; i < leaves.size(); ++i)
            if (n_points[i] > 0)
              {
                const int by = std::min(increase(i), most);
                levels[i]    = leaves[i].level + by;
                number += std::pow(2., dim * by);
              }
          if (number <= margin * largest)
            return;
        }
    }



    /** Give @p n_buffer layers of leaves around those with points the level of
     * these. */
    template <int dim>
    void
    add_buffer(const BackgroundGrid<dim> &grid,
               const std::vector<double> &n_points,
               const unsigned int         n_buffer,
               std::vector<unsigned int> &levels)
    {
      AssertDimension(levels.size(), grid.adaptive_grid().leaves().size());
      const AdaptiveGrid<dim>    &forest   = grid.adaptive_grid();
      const SimplexGeometry<dim> &geometry = grid.geometry();
      std::vector<unsigned int>   around   = levels, at_vertex;
      for (unsigned int i = 0; i < levels.size(); ++i)
        if (n_points[i] == 0)
          around[i] = 0;
      for (unsigned int layer = 0; layer < n_buffer; ++layer)
        {
          at_vertex.assign(geometry.vertices().size(), 0);
          for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
            for (const unsigned int v : geometry.vertex_indices(cell))
              at_vertex[v] =
                std::max(at_vertex[v], around[forest.leaf_of_cell(cell)]);
          for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
            for (const unsigned int v : geometry.vertex_indices(cell))
              {
                unsigned int &level = around[forest.leaf_of_cell(cell)];
                level               = std::max(level, at_vertex[v]);
              }
        }
      for (unsigned int i = 0; i < levels.size(); ++i)
        if (n_points[i] == 0)
          levels[i] = std::max(levels[i], around[i]);
    }
  } // namespace



  template <int dim>
  std::vector<unsigned int>
  GridAdaptation<dim>::wanted_levels(const BackgroundGrid<dim> &grid,
                                     const MaterialPoints<dim> &points,
                                     const double               time,
                                     std::vector<double>       &n_points) const
  {
    const AdaptiveGrid<dim>      &forest = grid.adaptive_grid();
    const std::vector<Leaf<dim>> &leaves = forest.leaves();
    const bool                    asked  = needs_state();
    const unsigned int            entry  = points.layout().cell_size;
    std::vector<double> sizes(leaves.size(), CellSizeCriterion<dim>::any_size);
    n_points.assign(leaves.size(), 0.);
    for (const auto &particle : points.handler())
      {
        const unsigned int leaf = forest.leaf_of_cell(
          particle.get_surrounding_cell()->active_cell_index());
        double size = size_at(particle.get_location(), time);
        if (asked)
          {
            const double own = particle.get_properties()[entry];
            size             = std::min(size,
                            own > 0 ? own :
                                                  forest.size(leaves[leaf].tree,
                                                  leaves[leaf].level));
          }
        sizes[leaf] = std::min(sizes[leaf], size);
        n_points[leaf] += 1;
      }
    Utilities::MPI::min(sizes, grid.communicator(), sizes);
    Utilities::MPI::sum(n_points, grid.communicator(), n_points);

    std::vector<unsigned int> levels(leaves.size(), rule.minimum);
    for (unsigned int i = 0; i < leaves.size(); ++i)
      if (n_points[i] > 0)
        levels[i] = rule.level(forest, leaves[i], sizes[i]);
    for (const auto &criterion : criteria)
      if (criterion->largest_number_of_leaves() > 0)
        limit_number_of_leaves(leaves,
                               n_points,
                               criterion->largest_number_of_leaves(),
                               levels);
    return levels;
  }



  template <int dim>
  bool
  GridAdaptation<dim>::is_due()
  {
    return resets_between > 0 && n_resets++ % resets_between == 0;
  }



  template <int dim>
  GridChange
  GridAdaptation<dim>::adapt(BackgroundGrid<dim>     &grid,
                             MaterialPoints<dim>     &points,
                             const PointLocator<dim> &locator,
                             const double             time,
                             LastMotion              &last_motion,
                             const bool               keep_points)
  {
    if (!grid.is_adaptive())
      return GridChange::none;
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    const auto               old    = forest.leaves();
    std::vector<double>      n_points;
    auto levels = wanted_levels(grid, points, time, n_points);
    add_buffer(grid, n_points, n_buffer, levels);

    const auto         leaves = forest.refine([&](const Leaf<dim> &leaf) {
      if (leaf.level < rule.minimum)
        return true;
      unsigned int i = find_leaf<dim>(old, leaf.tree, leaf.corner);
      if (old[i].level <= leaf.level)
        return levels[i] > leaf.level;
      for (; i < old.size() && is_within(old[i], leaf); ++i)
        if (levels[i] > leaf.level)
          return true;
      return false;
    });
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(grid.communicator());
    const auto weights    = leaf_weights(old, n_points, leaves);
    const auto owners     = partition_leaves(leaves,
                                         weights,
                                         forest.n_trees() / grid.n_layers(),
                                         n_ranks);
    const bool is_refined = !(leaves == old);
    // the points may have moved, or have been split, so that the same grid has
    // to be divided among the ranks anew
    if (!is_refined &&
        !is_out_of_balance(weights, forest, owners, n_ranks, balance))
      return GridChange::none;
    const CarriedMotion<dim> motion(grid, last_motion);

    points.change_grid(
      locator,
      [&]() { return grid.change(leaves, owners, time); },
      keep_points);
    motion.hand_over(grid, last_motion);
    if (!is_refined)
      return GridChange::owners;
    ++n_changes;
    return GridChange::cells;
  }



  template <int dim>
  void
  GridAdaptation<dim>::evaluate(const BackgroundGrid<dim> &grid,
                                const MaterialPoints<dim> &points,
                                const PointArrays<dim>    &arrays,
                                Statistics                &statistics)
  {
    const AdaptiveGrid<dim> &forest = grid.adaptive_grid();
    const auto              &leaves = forest.leaves();
    // all cells of a leaf belong to one rank
    std::vector<unsigned int> filled;
    for (unsigned int k = 0; k < arrays.cell.size(); ++k)
      filled.push_back(forest.leaf_of_cell(arrays.cell[k]));
    std::sort(filled.begin(), filled.end());
    const types::global_dof_index n_filled =
      std::unique(filled.begin(), filled.end()) - filled.begin();
    const auto [coarsest, finest] =
      std::minmax_element(leaves.begin(),
                          leaves.end(),
                          [](const Leaf<dim> &a, const Leaf<dim> &b) {
                            return a.level < b.level;
                          });
    statistics.set("Cells of grid", grid.geometry().n_cells());
    statistics.set("Leaves of grid", leaves.size());
    statistics.set("Leaves with material",
                   Utilities::MPI::sum(n_filled, grid.communicator()));
    statistics.set("Coarsest level of grid", coarsest->level);
    statistics.set("Finest level of grid", finest->level);
    statistics.set("Changes of grid", n_changes);
    evaluate_balance(points, grid.communicator(), statistics);
  }



  template <int dim>
  std::string
  GridAdaptation<dim>::save_state(const BackgroundGrid<dim> &grid) const
  {
    return std::to_string(n_resets) + ' ' + std::to_string(n_changes) + '\n' +
           (grid.is_adaptive() ? grid.adaptive_grid().save_state() : "");
  }



  template <int dim>
  bool
  GridAdaptation<dim>::load_state(const std::string       &state,
                                  BackgroundGrid<dim>     &grid,
                                  MaterialPoints<dim>     &points,
                                  const PointLocator<dim> &locator)
  {
    std::istringstream(state) >> n_resets >> n_changes;
    if (!grid.is_adaptive())
      return false;
    std::vector<Leaf<dim>>    leaves;
    std::vector<unsigned int> owners;
    AdaptiveGrid<dim>::load_state(state.substr(state.find('\n') + 1),
                                  leaves,
                                  owners);
    points.change_grid(locator,
                       [&]() { return grid.change(leaves, owners, 0.); });
    return true;
  }



  template class GridAdaptation<2>;
  template class GridAdaptation<3>;
} // namespace isochor
