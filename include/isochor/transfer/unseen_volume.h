/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_unseen_volume_h
#define isochor_unseen_volume_h

#include <isochor/equations/active_nodes.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>

#include <vector>

namespace isochor
{
  /**
   * What no node sees of the volumes of points, u-p.
   *
   * The nodes of a grid see of the excess e = θ^e - p/K of points its moments
   * Σ_p V_p N_I e_p only. What they don't see stays with the points, and where
   * these flow nothing resists it. Once the grid is reset, other moments are
   * seen: of what was unseen before a part is "corrected", by motions that
   * leave more behind, and volumes drift without bound. So after each step
   * the shape of a point keeps its volume, and material passes between points,
   * V_0 (1 + x), x the unseen part of (1 - m) e: a material that has no
   * memory of its shape (m = 0) fills the shapes with the density that the
   * pressure asks for; an elastic one (m = 1), whose shear stresses resist,
   * stays as it is. As x has no moments, mass, momentum and centre of mass stay
   * what they are.
   *
   * *Seen* is e_s = Σ_I N_I e_I with Σ_p V_p N_I e_s = Σ_p V_p N_I e, the
   * stabilisation's part; from nodal means, by Chebyshev's iteration.
   *
   * *Memory*: the part m of its elastic shear strain that a point brings
   * through a step, kept_shear_strain(), as in one step of backward Euler with
   * Maxwell's element.
   */
  template <int dim>
  class UnseenVolume
  {
  public:
    /** A new step of @p step.points. */
    void
    start(const StepContext<dim> &step);

    /** At the end of the step point @p q has the @p excess θ^e - p/K, dev τ of
     * @p state and the @p history. */
    void
    set(const StepContext<dim>                      &step,
        const unsigned int                           q,
        const double                                 excess,
        const typename MixedKernel<dim>::PointState &state,
        const double *const                          history);

    /** Let material pass between the @p points, which have moved, and domains
     * follow if the grid will be reset. Collective. */
    void
    apply(const StepContext<dim> &step,
          const bool              grid_is_reset,
          MaterialPoints<dim>    &points,
          PointArrays<dim>       &of_step);

  private:
    /** Let a point have @p factor times as much material in its shape. Without
     * domains points have no shape, and V_0 stays. */
    static void
    fill_shape(const double              factor,
               const MaterialModel<dim> &material,
               const PointLayout        &layout,
               const ArrayView<double>  &properties);
    /** The weight of point @p q in moments. */
    static double
    measure(const PointArrays<dim> &points, const unsigned int q);
    /** Leave in unseen what has no moments. Collective. */
    void
    leave_out_seen(const StepContext<dim> &step);
    /** Points have other masses now than those of @p mass: give back what is
     * missing of the momentum, and of what changes it, by way of the nodes.
     * Collective. */
    void
    keep_momentum(const StepContext<dim>    &step,
                  const std::vector<double> &mass,
                  MaterialPoints<dim>       &points);
    /** Sums at nodes become means. */
    void
    divide_by_weight(const StepContext<dim> &step);
    /** Let @p sums be Σ_q N_I value(q) at the nodes. Collective. */
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

    std::vector<double>       unseen;         ///< by point; all of it at first
    std::vector<unsigned int> plastic_strain; ///< entries, by material
    NodalField                mean, weight;
  };
} // namespace isochor

#endif
