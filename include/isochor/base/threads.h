/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_threads_h
#define isochor_threads_h

namespace isochor
{
  /**
   * Let the BLAS and OpenMP below the linear solvers use one thread per rank,
   * unless OPENBLAS_NUM_THREADS or OMP_NUM_THREADS says otherwise. On the small
   * dense blocks of a sparse factorisation more of them gain nothing, and wait
   * for each other while they use up the processor: in the footing on two idle
   * cores they doubled the CPU time (26 instead of 13 s) and saved none.
   */
  void
  use_one_thread_per_rank();
} // namespace isochor

#endif
