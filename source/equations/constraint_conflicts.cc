/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/explanation.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/constraint_conflicts.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace isochor
{
  namespace
  {
    /** Conflicts of two conditions. */
    struct Group
    {
      unsigned int n          = 0;
      double       difference = 0;
      std::string  place;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &n &difference &place;
      }
    };

    /** Winner, loser, whether they are of the same precedence. */
    using Key = std::tuple<std::string, std::string, bool>;

    template <int dim>
    std::string
    place_of(const StepContext<dim> &step, const unsigned int entry)
    {
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



  template <int dim>
  void
  tell_conflicts(const StepContext<dim> &step,
                 const NodalConstraints &constraints)
  {
    // formulas that mean the same differ by rounding: of what they prescribe,
    // and of the places of nodes
    constexpr double rounding = 1e-10, rounding_of_places = 1e-13;
    double           largest = 0, farthest = 0;
    for (const Point<dim> &vertex : step.grid.geometry().vertices())
      for (unsigned int d = 0; d < dim; ++d)
        farthest = std::max(farthest, std::abs(vertex[d]));
    for (const double increment : constraints.increment)
      largest = std::max(largest, std::abs(increment));
    for (const double value : constraints.followers.value)
      largest = std::max(largest, std::abs(value));
    largest = Utilities::MPI::max(largest, step.grid.communicator());
    const double smallest = rounding * largest + rounding_of_places * farthest;
    std::map<std::pair<std::string, bool>, Group> own;
    for (const auto &conflict : constraints.conflicts)
      if (conflict.entry < step.nodes.n_owned() * step.n_components &&
          (conflict.difference == 0. || conflict.difference > smallest))
        {
          Group &group =
            own[{conflict.winner + "\n" + conflict.loser, conflict.equal_rank}];
          ++group.n;
          group.difference = std::max(group.difference, conflict.difference);
          if (group.place.empty())
            group.place = place_of(step, conflict.entry);
        }
    std::map<Key, Group> all;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(step.grid.communicator(), own))
      for (const auto &entry : of_rank)
        {
          const auto   end   = entry.first.first.find('\n');
          const Group &group = entry.second;
          Group       &sum   = all[{entry.first.first.substr(0, end),
                                    entry.first.first.substr(end + 1),
                                    entry.first.second}];
          sum.n += group.n;
          sum.difference = std::max(sum.difference, group.difference);
          if (sum.place.empty())
            sum.place = group.place;
        }

    for (const auto &entry : all)
      {
        const auto &[winner, loser, equal_rank] = entry.first;
        const Group      &group                 = entry.second;
        const std::string names =
          "<" + parameter_of(winner) + "> and <" + parameter_of(loser) + ">";
        const std::string where = std::to_string(group.n) +
                                  " displacement components of nodes, as at " +
                                  group.place;
        const std::string by =
          group.difference > 0 ?
            ", by up to " + rounded(group.difference) + " m" :
            "";
        AssertThrow(!equal_rank,
                    ExcMessage(names + " prescribe " + where + ", otherwise" +
                               by +
                               ". Nothing tells which one is meant: leave "
                               "these nodes out of one of them."));
        step.warnings.add(
          "contradictory conditions",
          "at t = " + rounded(step.time) + " " + names +
            " determine the same " + where +
            (group.difference > 0 ?
               ", otherwise" + by :
               std::string(", and the second one may part from these")) +
            ". The first one counts. Let both prescribe the same, or leave "
            "these nodes out of one.");
      }
  }



  ISOCHOR_EXPLAIN(
    contradiction,
    "contradictory conditions",
    ISOCHOR_ESSENTIAL,
    "a wall or periodic side asks for something else than a condition that "
    "comes first: displacements, walls, periodic sides; of the same kind "
    "the one named first (\"Conditions on nodes\" in "
    "[method.md](method.md)). Two displacements that differ are an error",
    "let both prescribe the same, or leave the nodes out of one")



  template void
  tell_conflicts(const StepContext<2> &, const NodalConstraints &);
  template void
  tell_conflicts(const StepContext<3> &, const NodalConstraints &);
} // namespace isochor
