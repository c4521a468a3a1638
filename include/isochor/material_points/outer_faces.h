/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_outer_faces_h
#define isochor_outer_faces_h

#include <isochor/material_points/body_seeding.h>

#include <vector>

namespace isochor
{
  /** What Seed::outer_faces has of the face opposite to corner 0, shifted by c
   * of that opposite to corner c: bit 0, that it is on the surface of the body,
   * and bit 4, that it is where another body is behind it at t = 0. */
  constexpr unsigned int flags_of_face = 0x11, meets_other_body = 0x10;

  /** Set Seed::outer_faces of all @p seeds, which have domains and are those of
   * all ranks: a face is on the surface of a body unless it is one of another
   * domain of this body, too, or there is such a domain on its other side.
   * Bodies are told apart by @p body, the number of each seed's; empty: there
   * is one. */
  template <int dim>
  void
  find_outer_faces(std::vector<Seed<dim>>          &seeds,
                   const std::vector<unsigned int> &body = {});
} // namespace isochor

#endif
