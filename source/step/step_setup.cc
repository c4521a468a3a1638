/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/keep_each_once.h>
#include <isochor/boundary_condition/control_nodes.h>
#include <isochor/boundary_condition/periodic_vertices.h>
#include <isochor/equations/held_directions.h>
#include <isochor/equations/invariants.h>
#include <isochor/step/step_setup.h>
#include <isochor/step/why_to_reset.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/array.hpp>
#include <boost/serialization/utility.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  StepSetup<dim>::StepSetup(Scene<dim> &scene, TimerOutput &timer)
    : scene(scene)
    , timer(timer)
    , occupancy(scene.grid)
    , extension(scene.grid, occupancy)
    , nodes(scene.grid)
  {}



  template <int dim>
  void
  StepSetup<dim>::declare_parameters(ParameterHandler &prm)
  {
    DiscreteExtension<dim>::declare_parameters(prm);
    PointRefinement<dim>::declare_parameters(prm);
    GridReset<dim>::declare_parameters(prm);
    GridPartition<dim>::declare_parameters(prm);
  }



  template <int dim>
  void
  StepSetup<dim>::parse_parameters(ParameterHandler &prm)
  {
    extension.parse_parameters(prm);
    refinement.parse_parameters(prm);
    grid_reset.parse_parameters(prm, why_to_reset(scene));
    partition.parse_parameters(prm);
    extends         = extension.is_active(scene.ties_cut_cells());
    needs_occupancy = scene.quadrature->needs_occupancy() || extends;
  }



  template <int dim>
  void
  StepSetup<dim>::initialize()
  {
    locator = std::make_unique<PointLocator<dim>>(scene.grid.geometry());
    number_control_nodes(scene.boundary_conditions);
    share_held_vertices(scene.boundary_conditions);
    if (needs_occupancy)
      find_walls();
  }



  template <int dim>
  void
  StepSetup<dim>::find_walls()
  {
    // what the boundary conditions hold, asked with all nodes of the grid
    ActiveNodes<dim> all_nodes(scene.grid);
    all_nodes.set_control_nodes(control_nodes(scene.boundary_conditions));
    std::vector<unsigned int> vertices(all_nodes.control_vertex(
      control_nodes(scene.boundary_conditions).size()));
    std::iota(vertices.begin(), vertices.end(), 0);
    all_nodes.update(vertices);
    const unsigned int     n_components = scene.n_components;
    const StepContext<dim> step{scene.grid,
                                all_nodes,
                                arrays,
                                scene.kernel,
                                n_components,
                                scene.time.time,
                                scene.time.next_time()};
    NodalConstraints       held;
    held.reinit(all_nodes.n_local() * n_components,
                all_nodes.control_entries(n_components));
    constrain_nodes(scene.boundary_conditions, step, held);
    held.resolve(n_components);
    const HeldDirections<dim> directions(held, n_components);
    occupancy.initialize(
      [&](const unsigned int v, const Tensor<1, dim> &n) {
        return directions.free_part(all_nodes.node(v), n);
      },
      find_periodic_vertices(scene.boundary_conditions));
  }



  template <int dim>
  void
  StepSetup<dim>::restore_moved_grid()
  {
    BackgroundGrid<dim> &grid = scene.grid;
    if (grid.is_moving() && !grid_reset.due())
      grid.set_vertices(grid.vertices_at_time(grid_reset.start_time()));
  }



  template <int dim>
  StepContext<dim>
  StepSetup<dim>::context() const
  {
    return {scene.grid,
            nodes,
            arrays,
            scene.kernel,
            scene.n_components,
            scene.time.time,
            scene.inertia.in_trial() ? scene.time.time : scene.time.next_time(),
            !grid_reset.due(),
            scene.has_inertia(),
            scene.inertia.unknowns_at_start(),
            scene.inertia.end_weight()};
  }



  template <int dim>
  void
  StepSetup<dim>::start_step(const std::vector<EquationTerm<dim> *> &terms,
                             LastMotion &last_motion)
  {
    Assert(locator != nullptr, ExcMessage("initialize() comes first."));
    // the initial acceleration, found in the first step, is the points'
    const bool dynamic  = scene.has_inertia(),
               repeated = is_current && !(dynamic && scene.time.step == 0);
    laid_out            = !repeated && grid_reset.due();
    nodes_changed       = false;
    if (repeated && dynamic && scene.time.starts_anew)
      scene.points.update(arrays);
    if (repeated)
      return;
    disturbed = false;
    if (laid_out)
      reset_grid(terms, last_motion);
    else
      scene.points.update(arrays);
    nodes.set_control_nodes(control_nodes(scene.boundary_conditions));
    nodes_changed = nodes.update(touched_vertices) || is_fresh;
    if (laid_out && scene.inertia.is_from_stresses())
      {
        const std::uint64_t before = free_nodes;
        free_nodes                 = extension.hash_free_nodes(nodes);
        disturbed                  = disturbed || free_nodes != before;
      }
    is_fresh   = false;
    is_current = true;
  }



  template <int dim>
  void
  StepSetup<dim>::reset_grid(const std::vector<EquationTerm<dim> *> &terms,
                             LastMotion &last_motion)
  {
    TimerOutput::Scope scope(timer, "grid reset");
    const double       time = scene.time.time;
    if (scene.grid.is_moving())
      scene.grid.set_vertices(scene.grid.vertices_at_time(time));
    grid_reset.start(time);
    // here and not after the last step, which may end outside of the grid
    {
      TimerOutput::Scope scope(timer, "relocation");
      scene.points.relocate(*locator);
    }
    const bool is_due = scene.grid.is_adaptive() && scene.adaptation.is_due();
    if (is_due)
      {
        TimerOutput::Scope scope(timer, "grid adaptation");
        const GridChange   change = scene.adaptation.adapt(
          scene.grid, scene.points, *locator, time, last_motion);
        if (change != GridChange::none)
          grid_changed();
        // other owners of the same cells must not matter
        disturbed |= (change == GridChange::cells);
      }
    if (partition.is_needed(scene.grid))
      {
        TimerOutput::Scope scope(timer, "division among ranks");
        if (partition.rebalance(
              scene.grid, scene.points, *locator, last_motion))
          owners_changed();
      }
    {
      TimerOutput::Scope scope(timer, "splitting and merging of points");
      // what is split at once disturbs the next step the less, the less it is
      const bool merges = is_due || !scene.adaptation.has_more_changes();
      if (refinement.refine(
            scene.points, scene.grid, *locator, scene.kernel.materials, merges))
        disturbed = true;
    }
    scene.points.gather(arrays);
    scene.quadrature->set_up(
      arrays, *locator, scene.kernel, needs_occupancy, occupancy);
    touched_vertices.clear();
    for (EquationTerm<dim> *term : terms)
      term->touch_vertices(touched_vertices);
    keep_each_once(touched_vertices);
    touched_vertices.shrink_to_fit(); // each cell has named its own
    if (extends)
      {
        extension.exempt(find_periodic_vertices(scene.boundary_conditions));
        extension.update(arrays, touched_vertices);
      }
    touch_masters(scene.boundary_conditions,
                  nodes,
                  scene.grid.communicator(),
                  touched_vertices);
  }



  template <int dim>
  void
  StepSetup<dim>::grid_changed()
  {
    for (const auto &condition : scene.boundary_conditions)
      condition->grid_changed(scene.grid, scene.time.step == 0);
    for (const auto &postprocessor : scene.postprocessors)
      postprocessor->grid_changed(scene.grid);
    share_held_vertices(scene.boundary_conditions);
    if (needs_occupancy)
      find_walls();
  }



  template <int dim>
  void
  StepSetup<dim>::owners_changed()
  {
    for (const auto &postprocessor : scene.postprocessors)
      postprocessor->owners_changed(scene.grid);
    if (needs_occupancy)
      occupancy.owners_changed();
  }



  template <int dim>
  bool
  StepSetup<dim>::repeats_first_step(const NodalField &unknowns)
  {
    Assert(invariants::fits(unknowns, nodes, scene.n_components),
           ExcOtherNodes());
    if (scene.time.step > 0 ||
        !scene.adaptation.repeats_first_step(++n_first_solutions))
      return false;
    TimerOutput::Scope scope(timer, "grid adaptation");
    Statistics         not_of_a_step;
    LastMotion         none;
    scene.adaptation.set_sizes(context(),
                               unknowns,
                               scene.points,
                               not_of_a_step);
    if (scene.adaptation.adapt(
          scene.grid, scene.points, *locator, scene.time.time, none, false) ==
        GridChange::none)
      return false;
    scene.points.seed(scene.kernel.materials,
                      scene.has_inertia(),
                      scene.inertia.initial_velocity,
                      scene.points_have_domains(),
                      scene.kernel.axisymmetric,
                      scene.mixed(),
                      scene.inertia.is_from_stresses());
    grid_changed();
    is_current = false;
    return true;
  }



  template <int dim>
  void
  StepSetup<dim>::collect_elements(
    const std::vector<EquationTerm<dim> *> &terms)
  {
    if (!laid_out && !is_resumed)
      return;
    is_resumed = false;
    TimerOutput::Scope     scope(timer, "grid reset");
    const StepContext<dim> step = context();
    elements.clear();
    first_element.clear();
    for (EquationTerm<dim> *term : terms)
      {
        first_element.push_back(elements.size());
        term->collect_elements(step, elements);
      }
  }



  template <int dim>
  void
  StepSetup<dim>::constrain(const StepContext<dim> &step,
                            NodalConstraints       &constraints) const
  {
    AssertDimension(constraints.constrained.size(),
                    step.nodes.n_local() * step.n_components);
    if (extends)
      extension.constrain(step, constraints);
  }



  template <int dim>
  void
  StepSetup<dim>::advance(const StepContext<dim> &step,
                          const NodalField       &unknowns)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(invariants::is_consistent(step.points),
           ExcMessage("The arrays are of different points."));
    bool is_asked_for = false;
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
      is_asked_for |= condition->needs_reset();
    grid_reset.advance(step, unknowns, is_asked_for, arrays);
    is_current = false;
  }



  template <int dim>
  std::pair<types::global_dof_index, types::global_dof_index>
  StepSetup<dim>::n_active_cells_and_nodes() const
  {
    const MPI_Comm          comm    = scene.grid.communicator();
    types::global_dof_index n_nodes = 0;
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      n_nodes += nodes.control_node(node) == nullptr;
    return {Utilities::MPI::sum(
              static_cast<types::global_dof_index>(arrays.cell.size()), comm),
            Utilities::MPI::sum(n_nodes, comm)};
  }



  template <int dim>
  void
  StepSetup<dim>::evaluate(Statistics &statistics)
  {
    partition.evaluate(scene.grid, scene.points, statistics);
    if (!scene.grid.is_adaptive())
      return;
    scene.adaptation.evaluate(scene.grid, scene.points, arrays, statistics);
    refinement.evaluate(statistics);
  }



  template <int dim>
  std::string
  StepSetup<dim>::save_state() const
  {
    std::ostringstream              stream(std::ios::binary);
    boost::archive::binary_oarchive archive(stream);
    archive << scene.adaptation.save_state(scene.grid) << partition.save_state()
            << grid_reset << free_nodes;
    if (!grid_reset.due())
      archive << touched_vertices << arrays << extension;
    return stream.str();
  }



  template <int dim>
  void
  StepSetup<dim>::load_state(const std::string &state)
  {
    std::istringstream              stream(state, std::ios::binary);
    boost::archive::binary_iarchive archive(stream);
    std::string                     mesh, division;
    archive >> mesh >> division;
    if (scene.adaptation.load_state(mesh, scene.grid, scene.points, *locator))
      grid_changed();
    if (partition.load_state(division, scene.grid, scene.points, *locator))
      owners_changed();
    archive >> grid_reset >> free_nodes;
    is_current = false;
    is_resumed = true;
    if (!grid_reset.due())
      archive >> touched_vertices >> arrays >> extension;
  }



  template class StepSetup<2>;
  template class StepSetup<3>;
} // namespace isochor
