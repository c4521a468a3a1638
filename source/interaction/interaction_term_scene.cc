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
    std::vector<std::vector<double>> areas;
    for (unsigned int i = 0; i < interactions.size(); ++i)
      areas.push_back(areas_of(i));
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
      check_faces(interactions, areas, tied_twice, grid->communicator());
    is_checked = true;
  }



  template <int dim>
  std::vector<double>
  InteractionTerm<dim>::areas_of(const unsigned int interaction) const
  {
    std::vector<double> areas;
    for (const FaceElement &element : faces)
      {
        const auto &face = surface.faces()[element.face];
        if (std::find(element.partners.begin(),
                      element.partners.end(),
                      interaction) != element.partners.end())
          areas.push_back(face.area);
      }
    return areas;
  }



  template void
  InteractionTerm<2>::check_surfaces();
  template std::vector<double>
  InteractionTerm<2>::areas_of(const unsigned int) const;
  template void
  InteractionTerm<3>::check_surfaces();
  template std::vector<double>
  InteractionTerm<3>::areas_of(const unsigned int) const;
} // namespace isochor
