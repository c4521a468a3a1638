/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/free_motions.h>
#include <isochor/interaction/interaction_term.h>

namespace isochor
{
  /** An incompressible body that is held all around. */
  template <int dim>
  class FreePressure : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem &matrix) override
    {
      bool may_let_go = false;
      for (const auto &condition : scene.boundary_conditions)
        if (const auto *const interactions =
              dynamic_cast<const InteractionTerm<dim> *>(condition.get()))
          may_let_go = may_let_go || interactions->may_let_go();
      is_free = scene.mixed() && !may_let_go && has_free_pressure(matrix);
      if (is_free)
        this->warn("with <Material/Poisson ratio> = 0.5 and the whole surface "
                   "of the body constrained, pressures are known up to a "
                   "constant, which may be anything in each step. Look at "
                   "differences of pressure, or use 0.4999.");
    }

    std::string
    run_failed() const override
    {
      return is_free ?
               "The material is incompressible and the whole surface of the "
               "body is constrained: if what is prescribed there changes the "
               "volume inside, there is no solution, however small the step. "
               "Leave a part of the surface free, or let <Material/Poisson "
               "ratio> be 0.4999." :
               "";
    }

  private:
    bool is_free = false;
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    FreePressure,
    "undetermined pressure",
    ISOCHOR_ESSENTIAL,
    "u-p with ν = 0.5: the whole surface of the body is constrained, so that a "
    "pressure that is the same everywhere acts on nothing (all bodies "
    "together; one of several is not found)",
    "look at differences of pressure, free a part of the surface, or let the "
    "material be compressible")
} // namespace isochor
