/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_free_motions_h
#define isochor_free_motions_h

#include <isochor/linear_solver/sparse_system.h>

#include <string>
#include <vector>

namespace isochor
{
  /** A body, or a part that no other is connected with, that can move as a
   * rigid one without any force. */
  struct FreeBody
  {
    types::global_dof_index n_equations = 0;
    /** Mean position of its equations' nodes, dim coordinates (m). */
    std::vector<double> centre;
    /** "translation in x", "rotation about (0.5, 0)", ... */
    std::vector<std::string> motions;
  };

  /**
   * The bodies in the matrix @p A, parts of the graph of its displacements that
   * hang together, and how they can move freely: the combinations v of the
   * rigid body modes, restricted to the equations, for which v·A v vanishes
   * against v·diag(A) v. Constrained unknowns have no equation, so that a
   * motion that a constraint forbids strains the elements beside it; supports
   * of finite stiffness count by their entries in A. Rigid body modes of a body
   * under stress are no null vectors: to be asked with the matrix of the
   * unloaded body. Bodies that are held are left out. Collective.
   */
  std::vector<FreeBody>
  find_free_bodies(const SparseSystem &A);

  /** Whether a pressure that is the same everywhere acts on nothing in the
   * matrix @p A: the bodies are incompressible and held all around, so that
   * their pressure is known up to a constant only. Collective. */
  bool
  has_free_pressure(const SparseSystem &A);
} // namespace isochor

#endif
