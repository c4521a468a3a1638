/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Ties of nodes that carry what they should not. */
  template <int dim>
  class ThinPart : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &step) override
    {
      const double share = step.ties.share_of_work(),
                   n     = step.ties.n_free_nodes();
      if (share <= 0.01 && n == 0)
        return;
      this->warn(
        "at t = " + rounded(step.result.step.time) + " " +
        (share > 0.01 ?
           "nodes with small support hand " + rounded(100 * share) +
             " % of the internal work on to cells they are tied to" :
           rounded(n) +
             " nodes with small support have no cell nearby that they could be "
             "tied to") +
        ". Use smaller cells there.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    ThinPart,
    "a part of the body too thin for the grid",
    ISOCHOR_ESSENTIAL,
    "nodes with small support hand more than 1 % of a step's internal work (in "
    "dynamics: and kinetic energy) on to the cells they are tied to; or nodes "
    "with less than `Cut cells/Smallest support` around them have no well "
    "filled cell nearby, so that the matrix may be badly conditioned. The body "
    "is thin or small against the cells there",
    "smaller cells where the body is thin, or a smaller `Cut cells/Smallest"
    " support`")
} // namespace isochor
