/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_stabilisation_energy_h
#define isochor_stabilisation_energy_h

#include <isochor/equations/equation_term.h>

#include <iosfwd>

namespace isochor
{
  /**
   * What the stabilisation by polynomial pressure projection stores, and what a
   * weight that changes does in it
   * (PressureStabilisation::projection_energy()). Nothing without nodal
   * pressures or stabilisation.
   */
  template <int dim>
  class StabilisationEnergy
  {
  public:
    /** The step from @p old_weight (m/s², of the first step only; later it is
     * that of the last step) has been solved for the @p unknowns. Collective.
     */
    void
    advance(const StepContext<dim> &step,
            const NodalField       &unknowns,
            const Tensor<1, dim>   &old_weight);

    /** Of all ranks at the end of the step (J), without what changes of the
     * weight have done since t = 0: of a load that grows in proportion p·S d /
     * 2, as for any elastic body. Before the first step it is taken for zero,
     * also under a weight that is there at once: volumes can't follow, and the
     * pressure is h then but for what the body's compressibility takes. */
    double stored = 0;

    void
    save(std::ostream &out) const;
    void
    load(std::istream &in);

  private:
    /** What this rank's cells store at the end of the step; before it if
     * @p unknowns is null. */
    static typename PressureStabilisation<dim>::ProjectionEnergy
    sum(const StepContext<dim> &step,
        const NodalField       *unknowns,
        const Tensor<1, dim>   &weight);

    /** At the end of the last step. */
    bool any = false;
    /** What changes of the weight have done (J). */
    double         work = 0;
    Tensor<1, dim> weight, moment;
  };
} // namespace isochor

#endif
