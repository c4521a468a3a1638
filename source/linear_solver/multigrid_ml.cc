/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/trilinos_precondition.h>

#include <isochor/linear_solver/multigrid.h>

#include <Teuchos_ParameterList.hpp>

#include <memory>

namespace isochor
{
  /** Smoothed aggregation by ML of Trilinos, smoothed by Chebyshev's
   * polynomials. The finest level is the matrix itself. */
  class SmoothedAggregation : public Multigrid
  {
  public:
    void
    build(const Epetra_CrsMatrix                    &K,
          const unsigned int                         dim,
          const std::function<Epetra_MultiVector()> &near_null_space,
          const bool /*symmetric*/) override
    {
      clear();
      TrilinosWrappers::PreconditionAMG::AdditionalData data;
      data.elliptic              = true;
      data.smoother_sweeps       = 1; // degree of Chebyshev's polynomial
      data.aggregation_threshold = 0.02;

      Teuchos::ParameterList              parameters;
      std::unique_ptr<Epetra_MultiVector> unused;
      data.set_parameters(parameters, unused, K);
      unused.reset();

      const Epetra_MultiVector modes = near_null_space();
      parameters.set("PDE equations", static_cast<int>(dim));
      parameters.set("null space: type", "pre-computed");
      parameters.set("null space: dimension", modes.NumVectors());
      // ML takes a null pointer, which a rank without rows has, for modes that
      // are missing.
      double no_values = 0.;
      parameters.set("null space: vectors",
                     modes.MyLength() > 0 ? modes.Values() : &no_values);
      parameters.set("low memory usage", true);
      // one rank alone factorises the coarsest matrix, and solves with it
      parameters.set("coarse: max size", 500);
      hierarchy.initialize(K, parameters);
    }

    void
    update_finest_level() override
    {} // it is the matrix itself

    void
    clear() override
    {
      hierarchy.clear();
    }

    void
    vmult(TrilinosWrappers::MPI::Vector       &dst,
          const TrilinosWrappers::MPI::Vector &src) const override
    {
      hierarchy.vmult(dst, src);
    }

  private:
    TrilinosWrappers::PreconditionAMG hierarchy;
  };

  ISOCHOR_REGISTER(Multigrid, SmoothedAggregation, "ML")
} // namespace isochor
