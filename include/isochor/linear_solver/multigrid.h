/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_multigrid_h
#define isochor_multigrid_h

#include <deal.II/lac/trilinos_vector.h>

#include <isochor/base/plugin_registry.h>

#include <Epetra_CrsMatrix.h>
#include <Epetra_MultiVector.h>

#include <functional>

namespace isochor
{
  /**
   * Interface of the algebraic multigrid methods that approximate the inverse
   * of a stiffness matrix. To add one, write
   * `source/linear_solver/multigrid_<name>.cc` with the class and its
   * registration.
   */
  class Multigrid
  {
  public:
    virtual ~Multigrid() = default;

    static void
    declare_parameters(ParameterHandler &)
    {}

    /**
     * Build the hierarchy for @p K, which has to outlive it and of which each
     * node has @p dim rows one after the other. @p near_null_space gives the
     * motions that K resists little. @p symmetric: vmult() has to be symmetric
     * if K is. Collective.
     */
    virtual void
    build(const Epetra_CrsMatrix                    &K,
          const unsigned int                         dim,
          const std::function<Epetra_MultiVector()> &near_null_space,
          const bool                                 symmetric) = 0;

    /** The matrix has other values: take them over on the finest level. Coarser
     * levels stay. */
    virtual void
    update_finest_level() = 0;

    /** Free the hierarchy. */
    virtual void
    clear() = 0;

    /** dst = one cycle for K dst = src from zero. Collective. */
    virtual void
    vmult(TrilinosWrappers::MPI::Vector       &dst,
          const TrilinosWrappers::MPI::Vector &src) const = 0;
  };
} // namespace isochor

#endif
