/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_stress_recovery_h
#define isochor_stress_recovery_h

#include <isochor/adaptation/body_state.h>

#include <vector>

namespace isochor
{
  /**
   * The error of the stresses by recovery (Zienkiewicz & Zhu, Int. J. Numer.
   * Meth. Eng. 24 (1987) 337-357): stresses are compared with their means at
   * the nodes, interpolated,
   *
   *   σ*(x) = Σ_I N_I(x) σ_I,  σ_I = Σ_p J_p V_p N_I σ_p / Σ_p J_p V_p N_I,
   *
   * per material, in the energy norm of the elastic law,
   *
   *   η² = Σ_p J_p V_p [ |dev(σ* - σ)|² / (4 G) + (p* - p)² / (2 K) ].
   */
  struct StressError
  {
    std::vector<double> squares;         ///< the terms of η², by point (J)
    double              norm_square = 0; ///< the same of σ, of this rank (J)
  };

  /** That of σ itself, of this rank (J). */
  template <int dim>
  double
  energy_norm_square(const BodyState<dim> &state);

  /** Collective. */
  template <int dim>
  StressError
  recovered_error(const BodyState<dim> &state);
} // namespace isochor

#endif
