/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_inertia_h
#define isochor_domain_inertia_h

#include <isochor/equations/equation_term.h>

#include <vector>

namespace isochor
{
  /**
   * The inertia B of the points' domains against stretching,
   *   v·B w = Σ_p D_p(v) : (C_p D_p(w)),   C_p = ∫ ρ (x - x_p) ⊗ (x - x_p) dv,
   * D_p the symmetric part of Σ_I v_I ⊗ ∇N_pI. It exerts neither force nor
   * torque: linear and angular momentum are those of MassMatrix.
   */
  template <int dim>
  class DomainInertia
  {
  public:
    /** Of the points of @p step. Collective. */
    void
    find(const StepContext<dim> &step);

    /** @p result += B @p field on this rank, dim components per node. */
    void
    add_product(const StepContext<dim> &step,
                const NodalField       &field,
                NodalField             &result) const;

    /** G·C G that bounds B_II, by node. */
    NodalField diagonal;

  private:
    /** C_p by point (kg m^2). */
    std::vector<SymmetricTensor<2, dim>> inertia;
  };
} // namespace isochor

#endif
