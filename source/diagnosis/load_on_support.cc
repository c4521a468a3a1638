/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Loads that the body doesn't feel. */
  template <int dim>
  class LoadsOnSupports : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      for (const auto *const condition :
           with_role<const FindsLoadsOnSupports<dim>>(
             step.scene.boundary_conditions))
        for (const auto &load : condition->loads_on_supports())
          this->warn("the load on <" + load.surface + "> of <" +
                     load.parameter + "> acts in " + "xyz"[load.component] +
                     " where this component is prescribed: the body doesn't "
                     "feel it. Leave the component free there.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    LoadsOnSupports,
    "a load on a support",
    ISOCHOR_ESSENTIAL,
    "a load on a surface of the body (`Traction` included) acts, in a "
    "component, only on nodes at which this component is prescribed: it "
    "goes into the support, and the body doesn't feel it",
    "leave the component free there, or put the load elsewhere")
} // namespace isochor
