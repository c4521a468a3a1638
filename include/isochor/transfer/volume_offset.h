/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_volume_offset_h
#define isochor_volume_offset_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>

#include <vector>

namespace isochor
{
  /**
   * What the pressure equation of u-p leaves out of a point's elastic volume
   * change: R_p,I = Σ_p V_p N_I (θ^e - b - p/K) - S p, b = 0 at first.
   *
   * The nodes of a grid see of the excess e = θ^e - b - p/K its moments with
   * N_I only. What they don't see stays with the points, and where these flow
   * nothing resists it. Once the grid is put back, other moments are seen: of
   * what was unseen before a part is "corrected", by motions that leave more
   * behind, and volumes drift without bound. So the unseen part of the excess
   * is put into b where the grid is put back: all of it in a material that has
   * no memory of its shape, nothing in an elastic one, whose shear stresses
   * resist. As long as the grid is kept b is constant, and so is what the nodes
   * see.
   *
   * *Seen* is e_s = Σ_I N_I e_I with Σ_p V_p N_I e_s = Σ_p V_p N_I e, the
   * stabilisation's part; from nodal means, by Chebyshev's iteration.
   *
   * *Memory*: the part m of its elastic shear strain that a point brings
   * through a step. With the plastic strain of the step and the elastic one at
   * its end (Maxwell's element, one step of backward Euler),
   *   m = ε_e / (ε_e + Δε_p),  ε_e = |dev τ|/2G,
   *   Δε_p = |dev d - Δ(dev τ)/2G|.
   */
  template <int dim>
  class VolumeOffset
  {
  public:
    /** A new step of @p step.points; holes included. */
    void
    start(const StepContext<dim> &step);

    /** At the end of the step point @p q has the @p excess θ^e - b - p/K and
     * dev τ of @p state; @p properties are still those of its start, of which
     * this changes the memory: that since the last reset of the grid.
     * @p increment: that of the step. */
    void
    set(const StepContext<dim>                      &step,
        const unsigned int                           q,
        const double                                 excess,
        const Kinematics<dim>                       &increment,
        const typename MixedKernel<dim>::PointState &state,
        const PointLayout                           &layout,
        const ArrayView<double>                     &properties);

    /** The grid will be put back: let the @p points, which have moved, forget
     * what was not seen. Collective. */
    void
    apply(const StepContext<dim> &step, MaterialPoints<dim> &points);

  private:
    /** Let @p sums be Σ_q V_q N_I value(q) at the nodes, over the points of
     * occupied cells (a hole has none that could carry anything). Collective.
     */
    template <typename Value>
    void
    sum_to_nodes(const StepContext<dim> &step,
                 const Value            &value,
                 NodalField             &sums) const;

    /** The mean at point @p q of occupied cell @p k. */
    double
    mean_at(const StepContext<dim> &step,
            const unsigned int      k,
            const unsigned int      q) const;

    std::vector<double> unseen; ///< by point; the whole excess at first
    NodalField          mean, weight;
  };
} // namespace isochor

#endif
