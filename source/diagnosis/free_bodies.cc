/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/free_motions.h>

#include <algorithm>

namespace isochor
{
  /** Statics: bodies that nothing holds. */
  template <int dim>
  class FreeBodies : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem &matrix) override
    {
      if (scene.has_inertia())
        return;
      const std::vector<FreeBody> bodies = find_free_bodies(matrix);
      if (bodies.empty())
        return;
      constexpr std::size_t most = 1;
      std::string           text =
        "without support: " +
        (bodies.size() == 1 ? "a body" :
                              std::to_string(bodies.size()) + " bodies") +
        ", free in ";
      for (unsigned int b = 0; b < std::min(bodies.size(), most); ++b)
        {
          for (unsigned int m = 0; m < bodies[b].motions.size(); ++m)
            text += (m > 0 ? ", " : "") + bodies[b].motions[m];
          text += " (the one around (";
          for (unsigned int d = 0; d < bodies[b].centre.size(); ++d)
            text += (d > 0 ? ", " : "") + rounded(bodies[b].centre[d]);
          text += "))";
        }
      this->warn(text + ". Hold it by <Boundary conditions/Displacement> or "
                        "<Interaction: name - place>, or set <Dynamics/Inertia "
                        "= true>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    FreeBodies,
    "rigid-body mode",
    ISOCHOR_ESSENTIAL,
    "quasi-static: a body can move as a rigid one without force (the free "
    "motions of the first of such bodies are listed; several bodies each for "
    "itself; interactions count as supports; mechanisms within a body are not "
    "found). The displacement is then not unique, and there is no equilibrium "
    "if a load acts along such a motion",
    "hold it, or give it inertia")
} // namespace isochor
