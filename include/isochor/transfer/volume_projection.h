/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_volume_projection_h
#define isochor_volume_projection_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/body_quadrature/body_quadrature.h>
#include <isochor/equations/active_nodes.h>
#include <isochor/equations/equation_term.h>
#include <isochor/material_points/material_points.h>

#include <vector>

namespace isochor
{
  /**
   * Keeps the volume change that material points carry near that of the mixed
   * field. The pressure equation asks for θ^e = p/K in the mean about each node
   * only; the elements' volume changes scatter about it, and a point adds up
   * those of all cells it passes: det F drifts, without bound where the flow is
   * long and the cells rest. Since cells are filled by weights V_0 and
   * strengths are Kirchhoff stresses, a point whose J is too small counts for
   * more than its share.
   *
   * At the end of a step the excess e = θ^e - p/K of each point is replaced by
   * its nodal means,
   *   e_I = Σ w N_I e / Σ w N_I,   e <- Σ_I N_I e_I,
   * so that what the pressure equation knows about is kept (a patch that has
   * lost volume is pushed back in the next step) and the scatter within is not.
   */
  template <int dim>
  class VolumeProjection
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    /** Whether it is switched on. */
    static bool
    is_asked_for(ParameterHandler &prm);
    /** The same. Throws if it can't be used in the scene. */
    bool
    parse_parameters(ParameterHandler          &prm,
                     const BodyQuadrature<dim> &quadrature);

    /** A new step of @p step.points; holes included. */
    void
    start(const StepContext<dim> &step);

    /** θ^e - p/K at the end of the step of point @p q. */
    void
    set_excess(const unsigned int q, const double value)
    {
      excess[q] = value;
    }

    /** Replace the excess of the @p points, which have moved, by its nodal
     * means: in F, stress and history. Collective. */
    void
    apply(const StepContext<dim> &step, MaterialPoints<dim> &points);

  private:
    /** Find the nodal means. Collective. */
    void
    project(const StepContext<dim> &step);

    /** What has to be added to θ^e of point @p q of occupied cell @p k. */
    double
    correction(const StepContext<dim> &step,
               const unsigned int      k,
               const unsigned int      q) const;

    std::vector<double> excess;
    NodalField          mean, weight;
  };
} // namespace isochor

#endif
