/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** An equilibrium that a body leaves at the least disturbance. */
  template <int dim>
  class UnstableEquilibrium : public Diagnosis<dim>
  {
  public:
    void
    step_converged(const ConvergedStep<dim> &step) override
    {
      if (step.n_unstable_modes > 0)
        this->warn("up to t = " + rounded(step.result.step.time) +
                   " the matrix has " + std::to_string(step.n_unstable_modes) +
                   " negative pivot(s) of displacements: the body would leave "
                   "this equilibrium at the least disturbance. "
                   "Give it an imperfection, prescribe displacements, or set "
                   "<Dynamics/Inertia = true>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    UnstableEquilibrium,
    "unstable equilibrium",
    ISOCHOR_ESSENTIAL,
    "quasi-static, at the first step for which it is so: the matrix at the "
    "equilibrium that was found has more negative pivots than pressure "
    "equations (in `u`: any). By Sylvester's law of inertia the body can then "
    "lower its energy by a small motion, as a column beyond its buckling load. "
    "The factorisation at hand tells; where it is kept for many steps "
    "(`Newton/Reuse factorisation`), that may be late: the last step of a run "
    "is judged by one of its own. Known with direct solvers (MUMPS) and "
    "symmetric matrices: not with a follower pressure, nor with flow that "
    "isn't associated. Where nothing can buckle it may be a mode of the grid, "
    "or homogeneous yielding",
    "a larger imperfection and smaller steps up to there; prescribed "
    "displacements instead of loads; `Dynamics/Inertia = true`; smaller cells "
    "or no resets, which show modes of the grid")
} // namespace isochor
