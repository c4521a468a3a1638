/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_newton_report_h
#define isochor_newton_report_h

#include <string>
#include <vector>

namespace isochor
{
  /** A row of the convergence table. */
  struct NewtonIteration
  {
    double       displacement, pressure; ///< relative to their scales
    double       step_length;            ///< 0 for the start
    unsigned int n_linear_iterations;
  };

  /** How a step went. */
  struct NewtonReport
  {
    bool                         converged = false;
    std::string                  failure; ///< why not
    std::vector<NewtonIteration> iterations;
    unsigned int                 n_factorisations = 0;
    /** What forces were measured against (N). */
    double force_scale = 0;

    /** Iterations of an iterative linear solver, of all solves. */
    unsigned int
    n_linear_iterations() const
    {
      unsigned int n = 0;
      for (const NewtonIteration &iteration : iterations)
        n += iteration.n_linear_iterations;
      return n;
    }

    /** Solves made. */
    unsigned int
    n_iterations() const
    {
      return iterations.empty() ? 0 : iterations.size() - 1;
    }
  };
} // namespace isochor

#endif
