/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InteractionTerm that look at the scene at its start.
#include <isochor/interaction/interaction_checks.h>
#include <isochor/interaction/interaction_term.h>

#include <algorithm>
#include <utility>

namespace isochor
{
  template <int dim>
  void
  InteractionTerm<dim>::check_surfaces()
  {
    std::vector<std::vector<SurfacePiece<dim>>> pieces;
    for (unsigned int i = 0; i < interactions.size(); ++i)
      pieces.push_back(pieces_of(i));
    std::vector<std::pair<unsigned int, unsigned int>> tied_twice;
    for (const FaceElement &element : faces)
      {
        std::vector<unsigned int> ties;
        for (const unsigned int i : element.partners)
          if (!interactions[i]->law->is_unilateral())
            ties.push_back(i);
        if (ties.size() > 1)
          tied_twice.emplace_back(ties[0], ties[1]);
      }
    description =
      check_faces(interactions, pieces, tied_twice, grid->communicator());
    is_checked = true;
  }



  template <int dim>
  std::vector<SurfacePiece<dim>>
  InteractionTerm<dim>::pieces_of(const unsigned int interaction) const
  {
    std::vector<SurfacePiece<dim>> pieces;
    for (const FaceElement &element : faces)
      {
        const auto &face = surface.faces()[element.face];
        if (std::find(element.partners.begin(),
                      element.partners.end(),
                      interaction) != element.partners.end())
          pieces.push_back(
            {BodySurface<dim>::centre(face), face.normal, face.area});
      }
    return pieces;
  }



  template <int dim>
  void
  InteractionTerm<dim>::check_scene(const StepContext<dim> &step) const
  {
    for (unsigned int i = 0; i < interactions.size(); ++i)
      if (interactions[i]->region)
        warn_of_faces_round_an_edge(step,
                                    *interactions[i]->region,
                                    pieces_of(i));
  }



  template void
  InteractionTerm<2>::check_surfaces();
  template std::vector<SurfacePiece<2>>
  InteractionTerm<2>::pieces_of(const unsigned int) const;
  template void
  InteractionTerm<2>::check_scene(const StepContext<2> &) const;
  template void
  InteractionTerm<3>::check_surfaces();
  template std::vector<SurfacePiece<3>>
  InteractionTerm<3>::pieces_of(const unsigned int) const;
  template void
  InteractionTerm<3>::check_scene(const StepContext<3> &) const;
} // namespace isochor
