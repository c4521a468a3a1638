/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/base/rounding.h>
#include <isochor/equations/constraint_conflicts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace isochor
{
  namespace
  {
    /** Winner, loser, whether they are of the same precedence. */
    using Conflicts = std::map<std::tuple<std::string, std::string, bool>,
                               ConflictOfConditions>;

    void
    add(const ConflictOfConditions &conflict, Conflicts &all)
    {
      const auto known = all.emplace(std::make_tuple(conflict.winner,
                                                     conflict.loser,
                                                     conflict.equal_rank),
                                     conflict);
      if (known.second)
        return;
      ConflictOfConditions &sum = known.first->second;
      sum.n += conflict.n;
      sum.difference = std::max(sum.difference, conflict.difference);
    }

    template <int dim>
    std::string
    place_of(const StepContext<dim> &step, const unsigned int entry)
    {
      AssertIndexRange(entry, step.nodes.n_local() * step.n_components);
      const Point<dim> x    = step.nodes.position(entry / step.n_components);
      std::string      text = "(";
      for (unsigned int d = 0; d < dim; ++d)
        text += (d > 0 ? ", " : "") + rounded(x[d]);
      return text + ")";
    }
  } // namespace



  std::string
  parameter_of(const std::string &source)
  {
    const auto        sign = std::min(source.find(" = "), source.size());
    const std::string name = source.substr(0, sign), item = source.substr(sign);
    const auto        colon = name.find(": ");
    return (colon == std::string::npos ?
              "Boundary conditions/" + name :
              "Boundary conditions: " + name.substr(colon + 2) + "/" +
                name.substr(0, colon)) +
           item;
  }



  std::string
  ConflictOfConditions::names() const
  {
    return "<" + parameter_of(winner) + "> and <" + parameter_of(loser) + ">";
  }



  std::string
  ConflictOfConditions::where() const
  {
    return std::to_string(n) + " displacement components of nodes, as at " +
           place;
  }



  template <int dim>
  std::vector<ConflictOfConditions>
  find_conflicts(const StepContext<dim> &step,
                 const NodalConstraints &constraints)
  {
    AssertDimension(constraints.constrained.size(),
                    step.nodes.n_local() * step.n_components);
    // formulas that mean the same differ by rounding: of what they prescribe,
    // and of the places of nodes
    const MPI_Comm comm = step.grid.communicator();
    if (Utilities::MPI::max(constraints.conflicts.size(), comm) == 0)
      return {};
    double largest = 0, farthest = 0;
    for (const Point<dim> &vertex : step.grid.geometry().vertices())
      for (unsigned int d = 0; d < dim; ++d)
        farthest = std::max(farthest, std::abs(vertex[d]));
    for (const double increment : constraints.increment)
      largest = std::max(largest, std::abs(increment));
    for (const double value : constraints.followers.value)
      largest = std::max(largest, std::abs(value));
    largest = Utilities::MPI::max(largest, comm);
    const double smallest =
      rounding::accumulated * largest + rounding::arithmetic * farthest;
    Conflicts own, all;
    for (const auto &conflict : constraints.conflicts)
      if (conflict.entry < step.nodes.n_owned() * step.n_components &&
          (conflict.difference == 0. || conflict.difference > smallest))
        add({conflict.winner,
             conflict.loser,
             conflict.equal_rank,
             1,
             conflict.difference,
             place_of(step, conflict.entry)},
            own);
    std::vector<ConflictOfConditions> found;
    for (const auto &entry : own)
      found.push_back(entry.second);
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, found))
      for (const auto &conflict : of_rank)
        add(conflict, all);
    found.clear();
    for (const auto &entry : all)
      {
        const ConflictOfConditions &conflict = entry.second;
        AssertThrow(!conflict.equal_rank,
                    ExcMessage(
                      conflict.names() + " prescribe " + conflict.where() +
                      ", otherwise" +
                      (conflict.difference > 0 ?
                         ", by up to " + rounded(conflict.difference) + " m" :
                         "") +
                      ". Nothing tells which one is meant: leave "
                      "these nodes out of one of them."));
        found.push_back(conflict);
      }
    return found;
  }



  template std::vector<ConflictOfConditions>
  find_conflicts(const StepContext<2> &, const NodalConstraints &);
  template std::vector<ConflictOfConditions>
  find_conflicts(const StepContext<3> &, const NodalConstraints &);
} // namespace isochor
