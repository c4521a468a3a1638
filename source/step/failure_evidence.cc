/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// What a failed run says of how its body has lost stiffness.
#include <isochor/base/plain_message.h>
#include <isochor/step/failure_report.h>

namespace isochor
{
  template <int dim>
  bool
  FailureReport<dim>::Evidence::has_lost_stiffness() const
  {
    constexpr double significant = 3;
    return growth > significant || growth_of_trial > significant ||
           n_negative_pivots > 0;
  }



  template <int dim>
  std::string
  FailureReport<dim>::Evidence::limit(const double last_equilibrium,
                                      const double failed) const
  {
    if (soft_since < 0 || soft_since >= last_equilibrium)
      return "near t = " + rounded(last_equilibrium);
    return "between t = " + rounded(soft_since) +
           ", when the collapse began, and t = " + rounded(last_equilibrium) +
           ", the last equilibrium that was found (none at t = " +
           rounded(failed) +
           "): nearer to the latter where the body yields bit by bit in small "
           "strains, to the former where it is much deformed in between; a "
           "grid that is too coarse raises both";
  }



  template <int dim>
  std::string
  FailureReport<dim>::Evidence::text() const
  {
    std::string text =
      growth < 0 ?
        "displacements say nothing of it, as the body rests, is in contact, is "
        "moved by what is prescribed, or other loads change than before" :
        "the displacement per " + measure + " was " + rounded(growth) +
          " times that of the stiffest step of this loading in the last step "
          "that converged";
    if (soft_since >= 0)
      text += " (more than " + rounded(Softening::large_growth) +
              " times since t = " + rounded(soft_since) + ")";
    if (growth_of_trial >= 0)
      text += ", " + rounded(growth_of_trial) +
              " times in the last iterate of the one that failed";
    if (plastic_share > 0)
      text +=
        ", " + rounded(100 * plastic_share) + " % of the volume has yielded";
    else if (plastic_share == 0)
      text += ", nothing has yielded up to that step";
    if (n_negative_pivots >= 0)
      text += ", the last matrix has " + std::to_string(n_negative_pivots) +
              " negative pivot(s) of displacements (a stable state has none)";
    return text;
  }



  template <int dim>
  std::string
  FailureReport<dim>::Evidence::advice_on_flow() const
  {
    if (is_associated || plastic_share <= 0)
      return "";
    return " With <Dilation angle> below <Friction angle> a body may also lose "
           "its equilibria before it carries all that it could, and no step is "
           "small enough then: compare with a dilation angle nearer to the "
           "friction angle.";
  }



  template struct FailureReport<2>::Evidence;
  template struct FailureReport<3>::Evidence;
} // namespace isochor
