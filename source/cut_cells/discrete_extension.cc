/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/cut_cells/discrete_extension.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/grid/nearest_cells.h>

#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_set>

namespace isochor
{
  template <int dim>
  DiscreteExtension<dim>::DiscreteExtension(const BackgroundGrid<dim> &grid,
                                            const CellOccupancy<dim> &occupancy)
    : grid(grid)
    , occupancy(occupancy)
    , support(grid, occupancy)
    , dependent(occupancy)
  {}



  template <int dim>
  void
  DiscreteExtension<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Cut cells");
    prm.declare_entry(
      "Extension",
      "auto",
      Patterns::Selection("auto|always|never"),
      "Whether nodes with small support follow a cell nearby that is better "
      "filled, so that the matrix stays well conditioned however small the "
      "part of a cell is that the body fills. auto: with every "
      "'Quadrature/Type' but 'points', and with that if <Grid/Shape functions> "
      "are not P1.");
    prm.declare_entry("Smallest support",
                      "0.01",
                      Patterns::Double(0, 0.5),
                      "Which nodes these are: those around which the body "
                      "fills less than this part of the cells, weighted with "
                      "the node's shape function.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  DiscreteExtension<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Cut cells");
    const std::string name = prm.get("Extension");
    smallest_support       = prm.get_double("Smallest support");
    prm.leave_subsection();
    use = name == "auto"   ? Use::automatic :
          name == "always" ? Use::always :
                             Use::never;
  }



  template <int dim>
  bool
  DiscreteExtension<dim>::is_active(const bool quadrature_asks) const
  {
    return use == Use::always || (use == Use::automatic && quadrature_asks);
  }



  template <int dim>
  void
  DiscreteExtension<dim>::update(const PointArrays<dim>    &points,
                                 std::vector<unsigned int> &vertices)
  {
    support.find(points);
    dependent.update(points, support, smallest_support);
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()),
                   vertices.end());

    // the owner of a vertex knows enough around it to decide
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::map<unsigned int, Tie>                       ties;
    std::map<unsigned int, std::vector<unsigned int>> questions;
    for (const unsigned int v : vertices)
      if (grid.vertex_owner(v) != rank)
        questions[grid.vertex_owner(v)].push_back(v);
      else if (may_be_tied(v))
        ties.emplace(v, find_tie(v));
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) > 1)
      add_ties_of_others(questions, ties);

    found.clear();
    n_free = 0;
    for (const auto &tie : ties)
      if (!tie.second.masters.empty())
        {
          found.push_back(tie.second);
          for (const unsigned int cell : tie.second.cells)
            for (const unsigned int v : grid.geometry().vertex_indices(cell))
              vertices.push_back(v);
        }
      else if (grid.vertex_owner(tie.first) == rank)
        ++n_free;
  }



  template <int dim>
  bool
  DiscreteExtension<dim>::is_supported(const unsigned int vertex) const
  {
    // rounding must not decide, or a scene that is moved would be another
    return support(vertex) >= (1 - 1e-8) * smallest_support &&
           !dependent.contain(vertex);
  }



  template <int dim>
  void
  DiscreteExtension<dim>::exempt(const std::vector<unsigned int> &vertices)
  {
    exempted.clear();
    exempted.insert(vertices.begin(), vertices.end());
  }



  template <int dim>
  typename DiscreteExtension<dim>::Tie
  DiscreteExtension<dim>::find_tie(const unsigned int vertex) const
  {
    AssertIndexRange(vertex, grid.triangulation().n_vertices());
    const SimplexGeometry<dim> &geometry = grid.geometry();
    std::set<unsigned int>      seen_cells, seen_vertices = {vertex};
    std::vector<unsigned int>   front = {vertex}, best;
    double smallest                   = std::numeric_limits<double>::infinity();
    for (unsigned int layer = 0; layer <= n_layers && best.empty(); ++layer)
      {
        std::vector<unsigned int> next;
        for (const unsigned int v : front)
          for (const unsigned int around : occupancy.cells_at(v))
            for (const unsigned int cell :
                 grid.shape_functions().element(around))
              {
                if (occupancy.content(cell) == nullptr ||
                    !seen_cells.insert(cell).second)
                  continue;
                bool supported = true;
                for (const unsigned int w : geometry.vertex_indices(cell))
                  {
                    supported = supported && is_supported(w);
                    if (seen_vertices.insert(w).second)
                      next.push_back(w);
                  }
                if (!supported)
                  continue;
                double sum = 0;
                for (const double lambda :
                     geometry.barycentric(cell, geometry.vertices()[vertex]))
                  sum += lambda * lambda;
                if (sum < (1 - rounding::places) * smallest)
                  {
                    best.clear();
                    smallest = sum;
                  }
                if (sum < (1 + rounding::places) * smallest)
                  best.push_back(cell);
              }
        front.swap(next);
      }
    return make_tie(vertex, best);
  }



  template <int dim>
  typename DiscreteExtension<dim>::Tie
  DiscreteExtension<dim>::make_tie(const unsigned int               vertex,
                                   const std::vector<unsigned int> &cells) const
  {
    const SimplexGeometry<dim>    &geometry = grid.geometry();
    std::map<unsigned int, double> weights;
    for (const unsigned int cell : cells)
      {
        const auto lambda =
          geometry.barycentric(cell, geometry.vertices()[vertex]);
        for (unsigned int v = 0; v <= dim; ++v)
          weights[geometry.vertex_indices(cell)[v]] += lambda[v] / cells.size();
      }
    Tie tie{vertex, {}, {}, cells};
    for (const auto &weight : weights)
      if (std::abs(weight.second) > 1e-10)
        {
          tie.masters.push_back(weight.first);
          tie.weights.push_back(weight.second);
        }
    return tie;
  }



  template <int dim>
  void
  DiscreteExtension<dim>::add_ties_of_others(
    const std::map<unsigned int, std::vector<unsigned int>> &questions,
    std::map<unsigned int, Tie>                             &ties)
  {
    const MPI_Comm                           comm = grid.communicator();
    std::map<unsigned int, std::vector<Tie>> answers;
    for (const auto &question : Utilities::MPI::some_to_some(comm, questions))
      for (const unsigned int v : question.second)
        if (may_be_tied(v))
          {
            // the node is this rank's, whether it touches it or not
            const auto tie = ties.count(v) ? ties.at(v) : find_tie(v);
            ties.emplace(v, tie);
            answers[question.first].push_back(tie);
          }
    for (const auto &answer : Utilities::MPI::some_to_some(comm, answers))
      for (const Tie &tie : answer.second)
        ties.emplace(tie.vertex, tie);
  }



  template <int dim>
  std::uint64_t
  DiscreteExtension<dim>::hash_free_nodes(const ActiveNodes<dim> &nodes) const
  {
    std::unordered_set<unsigned int> tied;
    for (const Tie &tie : found)
      tied.insert(tie.vertex);
    std::uint64_t sum = 0;
    for (unsigned int node = 0; node < nodes.n_owned(); ++node)
      if (tied.count(nodes.vertex(node)) == 0)
        {
          // the mixing function of splitmix64 (Steele, Lea & Flood 2014)
          std::uint64_t z =
            (nodes.vertex(node) + 1) * UINT64_C(0x9e3779b97f4a7c15);
          z = (z ^ (z >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
          z = (z ^ (z >> 27)) * UINT64_C(0x94d049bb133111eb);
          sum += z ^ (z >> 31);
        }
    return Utilities::MPI::sum(sum, grid.communicator());
  }



  template <int dim>
  void
  DiscreteExtension<dim>::constrain(const StepContext<dim> &step,
                                    NodalConstraints       &constraints) const
  {
    Assert(constraints.ties.size() == 0, ExcMessage("Others tie nodes, too."));
    for (const Tie &tie : found)
      {
        constraints.ties.node.push_back(step.nodes.node(tie.vertex));
        for (unsigned int J = 0; J < tie.masters.size(); ++J)
          {
            constraints.ties.master.push_back(step.nodes.node(tie.masters[J]));
            constraints.ties.weight.push_back(tie.weights[J]);
          }
        constraints.ties.start.push_back(constraints.ties.master.size());
      }
  }



  template <int dim>
  void
  DiscreteExtension<dim>::evaluate(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   const MixedSystem<dim> &system,
                                   const double            energy,
                                   Statistics             &statistics)
  {
    // number of ties, of free nodes; work of the extension and of the body
    std::array<double, 4> sums{
      {0, double(n_free), 0, energy + work_of_rounding(step, unknowns)}};
    for (unsigned int k = 0; k < found.size(); ++k)
      if (step.nodes.node(found[k].vertex) < step.nodes.n_owned())
        {
          Tensor<1, dim> force;
          for (unsigned int a = 0; a < dim; ++a)
            force[a] = system.tie_force(
              step.nodes.node(found[k].vertex) * step.n_components + a);
          sums[0] += 1;
          sums[2] += std::abs(work(step, unknowns, found[k], force));
        }
    sum_over_ranks(sums, grid.communicator());
    share         = sums[3] > 0 ? sums[2] / sums[3] : 0.;
    n_free_of_all = sums[1];
    statistics.set("Tied nodes", sums[0]);
    statistics.set("Share of ties in internal work", share);
  }



  template <int dim>
  double
  DiscreteExtension<dim>::work_of_rounding(const StepContext<dim> &step,
                                           const NodalField &unknowns) const
  {
    // stresses of a body that moves as if rigid are noise
    double largest = 0;
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      for (unsigned int a = 0; a < dim; ++a)
        largest = std::max(largest,
                           std::abs(unknowns.local_element(
                             node * step.n_components + a)));
    largest     = Utilities::MPI::max(largest, grid.communicator());
    double work = 0;
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      {
        const double gradient =
          largest / cell_size(grid.geometry(), step.points.cell[k]);
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          work +=
            step.points.measure(q) * rounding::accumulated * gradient *
            step.kernel.materials[step.points.material[q]]->shear_modulus();
      }
    return work;
  }



  template <int dim>
  double
  DiscreteExtension<dim>::work(const StepContext<dim> &step,
                               const NodalField       &unknowns,
                               const Tie              &tie,
                               const Tensor<1, dim>   &force) const
  {
    Assert(!tie.cells.empty(), ExcInternalError());
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const NodalUnknowns<dim>    nodal(step, unknowns);
    Tensor<2, dim>              gradient;
    for (const unsigned int cell : tie.cells)
      for (unsigned int v = 0; v <= dim; ++v)
        gradient +=
          outer_product(nodal.increment(geometry.vertex_indices(cell)[v]) /
                          double(tie.cells.size()),
                        geometry.gradients(cell)[v]);
    Tensor<1, dim> arm;
    for (const unsigned int master : tie.masters)
      arm += geometry.vertices()[tie.vertex] - geometry.vertices()[master];
    arm /= tie.masters.size();
    return force * (symmetrize(gradient) * arm);
  }



  template class DiscreteExtension<2>;
  template class DiscreteExtension<3>;
} // namespace isochor
