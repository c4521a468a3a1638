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
    FacesOfInteractions<dim> faces_of_all(interactions.size());
    std::vector<std::pair<unsigned int, unsigned int>> tied_twice;
    for (const FaceElement &element : faces)
      {
        std::vector<unsigned int> ties;
        for (const unsigned int i : element.partners)
          {
            faces_of_all[i].push_back(surface.faces()[element.face]);
            if (!interactions[i]->law->is_unilateral())
              ties.push_back(i);
          }
        if (ties.size() > 1)
          tied_twice.emplace_back(ties[0], ties[1]);
      }
    const MPI_Comm comm = grid->communicator();
    description = check_faces(interactions, faces_of_all, tied_twice, comm);
    const std::string of_loads =
      check_faces(loads.interactions(), loads.faces_of_all(), {}, comm);
    description +=
      (description.empty() || of_loads.empty() ? "" : "\n") + of_loads;
    is_checked = true;
  }



  template void
  InteractionTerm<2>::check_surfaces();
  template void
  InteractionTerm<3>::check_surfaces();
} // namespace isochor
