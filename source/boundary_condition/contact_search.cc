/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/boundary_condition/contact_search.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

namespace isochor
{
  void
  WallNode::save(std::ostream &state) const
  {
    state << released << ' ' << touched << ' ' << gap << ' ' << held_body
          << ' ';
  }



  void
  WallNode::load(std::istream &state)
  {
    state >> released >> touched >> gap >> held_body;
    was_released = released;
  }



  void
  ContactSearch::start()
  {
    n_sets          = 0;
    fewest_objected = std::numeric_limits<unsigned int>::max();
    n_patience      = most_patience;
  }



  bool
  ContactSearch::may_change_all(const unsigned int n_objections)
  {
    if (n_objections < fewest_objected)
      {
        fewest_objected = n_objections;
        n_patience      = most_patience;
        return true;
      }
    if (n_patience == 0)
      return false;
    --n_patience;
    return true;
  }



  ContactChange
  ContactSearch::change(const std::vector<unsigned int> &objections,
                        const bool                       converged,
                        const std::vector<WallNode *>   &nodes,
                        const std::string               &parameter,
                        const std::string               &boundaries)
  {
    const unsigned int n_pull =
      std::count(objections.begin(), objections.end(), Objection::pulls);
    const unsigned int n_penetrate =
      std::count(objections.begin(), objections.end(), Objection::penetrates);
    const unsigned int n_object = n_pull + n_penetrate;
    if (n_object == 0)
      return {};
    if (converged && ++n_sets > most_sets)
      return {false,
              "the contact of <" + parameter + "> on <" + boundaries +
                "> does not settle: with the last of " +
                std::to_string(most_sets) + " sets of held nodes " +
                std::to_string(n_pull) + " pull at their wall and " +
                std::to_string(n_penetrate) + " went through it"};

    const bool  all_at_once = !converged || may_change_all(n_object);
    std::size_t last        = objections.size() - 1;
    while (objections[last] == 0)
      --last;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (objections[k] != 0 && (all_at_once || k == last))
        nodes[k]->released = !nodes[k]->released;
    return {true, {}};
  }



  template <int dim>
  double
  largest_increment(const StepContext<dim> &step, const NodalField &unknowns)
  {
    double largest = 0;
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      for (unsigned int a = 0; a < dim; ++a)
        largest = std::max(largest,
                           std::abs(unknowns.local_element(
                             node * step.n_components + a)));
    return Utilities::MPI::max(largest, step.grid.communicator());
  }



  std::vector<unsigned char>
  tied_nodes(const NodalTies &ties, const unsigned int n_nodes)
  {
    std::vector<unsigned char> is_tied(n_nodes, 0);
    for (const unsigned int node : ties.node)
      is_tied[node] = 1;
    return is_tied;
  }



  double
  gap_after(const double moved, const double to_wall)
  {
    constexpr double rounding = 1e-8;
    const double     gap      = moved - to_wall;
    return std::abs(gap) <= rounding * (std::abs(moved) + std::abs(to_wall)) ?
             gap_unknown :
             gap;
  }



  void
  update_gaps(std::vector<double>   &gaps,
              const MPI_Comm         comm,
              std::vector<WallNode> &nodes)
  {
    Utilities::MPI::max(gaps, comm, gaps);
    for (unsigned int i = 0; i < gaps.size(); ++i)
      {
        WallNode  &node       = nodes[i];
        const bool is_at_wall = gaps[i] == gap_unknown || !node.released;
        node.gap              = is_at_wall ? 0. : gaps[i];
        node.touched          = node.touched || is_at_wall;
      }
  }



  template double
  largest_increment(const StepContext<2> &, const NodalField &);
  template double
  largest_increment(const StepContext<3> &, const NodalField &);
} // namespace isochor
