/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_large_arrays_h
#define isochor_large_arrays_h

namespace isochor
{
  /**
   * Let the C library give arrays of 32 MB and more back to the system when
   * they are freed: of a million equations in space the products of matrices
   * behind the multigrid. libsuperlu_dist, which PETSc and hypre bring along,
   * switches this off for all arrays when it is loaded, and holes that are too
   * small for what comes next stay. Smaller ones, vectors among them, stay as
   * they are, as to map their pages again and again costs time. Nothing happens
   * with another C library than that of GNU.
   */
  void
  return_large_arrays();
} // namespace isochor

#endif
