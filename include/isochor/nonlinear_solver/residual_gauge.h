/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_residual_gauge_h
#define isochor_residual_gauge_h

#include <isochor/equations/mixed_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  /** The residual of an iterate, over all ranks. */
  struct ResidualNorms
  {
    EvaluationStatus status = EvaluationStatus::success;
    /** Euclidean norms over the free unknowns: forces (N) and, in the u-p form,
     * the volume defect of the pressure equation (m^dim). */
    double displacement = 0, pressure = 0;
    /** External forces and reactions (N): what forces are measured against. */
    double force_scale = 0;
    /** In the u-p form: the volume defect (m^dim) of strains over the forces
     * (N) of strains as large, by the shear moduli of the body. */
    double volume_per_force = 0;
    /** Below these a residual is rounding. */
    double displacement_floor = 0, pressure_floor = 0;
    /** Whether prescribed increments are still to be applied. Then the
     * residual is no measure of forces yet. */
    bool pending = false;
  };



  /** Keeps the scales, which may only grow in a step, and measures residuals
   * by them. */
  class ResidualGauge
  {
  public:
    void
    take(const ResidualNorms &norms)
    {
      force    = std::max({force, norms.force_scale, first(norms)});
      pressure = std::max(pressure, norms.pressure);
      started  = started || !norms.pending;
      if (!norms.pending)
        lowest = std::min(lowest, norms.displacement);
    }

    double
    force_scale() const
    {
      return force;
    }

    /** The residual of displacements below which a step has converged. */
    double
    displacement_bound(const ResidualNorms &norms, const double tolerance) const
    {
      return std::max(tolerance * force, norms.displacement_floor);
    }

    /** The same of the pressure equation. */
    double
    pressure_bound(const ResidualNorms &norms, const double tolerance) const
    {
      return std::max(tolerance * pressure, norms.pressure_floor);
    }

    double
    displacement_ratio(const ResidualNorms &norms) const
    {
      return force > 0 ? norms.displacement / force : 0.;
    }

    double
    pressure_ratio(const ResidualNorms &norms) const
    {
      return pressure > 0 ? norms.pressure / pressure : 0.;
    }

    bool
    converged(const ResidualNorms &norms, const double tolerance) const
    {
      return !norms.pending &&
             norms.displacement <= displacement_bound(norms, tolerance) &&
             norms.pressure <= pressure_bound(norms, tolerance);
    }

    /** Whether @p norms are those of an iterate that can be judged and is not
     * the solution. */
    bool
    is_far(const ResidualNorms &norms, const double tolerance) const
    {
      return !norms.pending && std::isfinite(merit(norms)) &&
             !converged(norms, tolerance);
    }

    /** What the line search wants to fall. */
    double
    merit(const ResidualNorms &norms) const
    {
      if (norms.status != EvaluationStatus::success ||
          !std::isfinite(norms.displacement) || !std::isfinite(norms.pressure))
        return std::numeric_limits<double>::infinity();
      return std::max(displacement_ratio(norms), pressure_ratio(norms));
    }

    /**
     * Whether the line search takes @p norms, coming from @p old. The largest
     * residual of the pressure equation is no scale where a body hardly changes
     * its volume, as at Poisson ratio zero: what there is may be rounding, or
     * of higher order in the strains. So it may grow there while forces fall
     * below all before: else the two could fall by turns without end.
     */
    bool
    is_progress(const ResidualNorms &norms, const ResidualNorms &old) const
    {
      constexpr double small = 1e-4; // against strains as large as the forces
      return merit(norms) < merit(old) ||
             (std::isfinite(merit(norms)) && norms.displacement < lowest &&
              norms.pressure < small * force * norms.volume_per_force);
    }

  private:
    double
    first(const ResidualNorms &norms) const
    {
      return started || norms.pending ? 0. : norms.displacement;
    }

    bool   started = false;
    double force = 0, pressure = 0;
    double lowest = std::numeric_limits<double>::max(); ///< of the forces
  };
} // namespace isochor

#endif
