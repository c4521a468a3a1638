/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/equations/constraint_conflicts.h>

namespace isochor
{
  /** Conditions that determine the same unknowns otherwise. */
  template <int dim>
  class ContradictoryConditions : public Diagnosis<dim>
  {
  public:
    void
    step_started(const Scene<dim> & /*scene*/,
                 const StepContext<dim> &step,
                 const NodalConstraints &constraints) override
    {
      for (const auto &conflict : find_conflicts(step, constraints))
        this->warn(
          "at t = " + rounded(step.time) + " " + conflict.names() +
          " determine the same " + conflict.where() +
          (conflict.difference > 0 ?
             ", by up to " + rounded(conflict.difference) + " m apart" :
             "") +
          ". The first one counts: let both prescribe the same, or leave "
          "nodes out of one.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    ContradictoryConditions,
    "contradictory conditions",
    ISOCHOR_ESSENTIAL,
    "a wall or periodic side asks for something else than a condition that "
    "comes first: displacements, walls, periodic sides; of the same kind "
    "the one named first (\"Conditions on nodes\" in "
    "[method.md](method.md)). Two displacements that differ are an error",
    "let both prescribe the same, or leave the nodes out of one")
} // namespace isochor
