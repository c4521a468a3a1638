/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_checks_h
#define isochor_interaction_checks_h

#include <isochor/equations/body_surface.h>
#include <isochor/interaction/interaction.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /** By interaction. */
  template <int dim>
  using FacesOfInteractions =
    std::vector<std::vector<typename BodySurface<dim>::Face>>;

  /** Check which faces @p interactions have: by interaction, those @p faces of
   * this rank; @p tied_twice, pairs of interactions that tie the same faces.
   * Returns what is found, a line each: number, area (2D: length, of the
   * section) and the box around them, at t = 0. @throws ExcMessage for an
   * interaction without a face, and for faces that are tied twice. Collective.
   */
  template <int dim>
  std::string
  check_faces(
    const std::vector<std::unique_ptr<Interaction<dim>>>     &interactions,
    const FacesOfInteractions<dim>                           &faces,
    const std::vector<std::pair<unsigned int, unsigned int>> &tied_twice,
    const MPI_Comm                                            comm);
} // namespace isochor

#endif
