/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_checks.h>
#include <isochor/interaction/interaction_term.h>

#include <algorithm>
#include <limits>

// The faces of InteractionTerm: which take part, and what they face.
namespace isochor
{
  template <int dim>
  void
  InteractionTerm<dim>::find_faces()
  {
    surface.find(*points);
    loads.find(surface, *grid, *points);
    faces.clear();
    for (unsigned int f = 0; f < surface.faces().size(); ++f)
      {
        FaceElement        element;
        const Point<dim>   X = BodySurface<dim>::centre(surface.faces()[f]);
        const unsigned int body =
          grid->layer_of_cell(points->cell[surface.faces()[f].k]);
        element.face = f;
        for (unsigned int i = 0; i < interactions.size(); ++i)
          // what is between bodies belongs to no named surface
          if (interactions[i]->has(body, X) &&
              !(interactions[i]->region && surface.faces()[f].meets_other_body))
            element.partners.push_back(i);
        element.is_tied =
          std::any_of(element.partners.begin(),
                      element.partners.end(),
                      [&](const unsigned int i) {
                        return !interactions[i]->law->is_unilateral();
                      });
        if (element.partners.empty())
          continue;
        if (!surface.faces()[f].meets_other_body)
          element.loads = loads.on_face(body, X);
        faces.push_back(element);
      }
    if (!is_checked)
      check_surfaces();
    memory.send(surface, grid->communicator());
    forces.send(surface, grid->communicator());
  }



  template <int dim>
  void
  InteractionTerm<dim>::look_at_partners(const StepContext<dim> &step,
                                         const unsigned int      g,
                                         FaceElement            &element) const
  {
    const auto start =
      BodySurface<dim>::place(step, surface.faces()[element.face], g);
    element.facing[g].assign(element.partners.size(), 1.);
    element.gap[g]            = std::numeric_limits<double>::max();
    element.body_is_nearer[g] = false;
    for (unsigned int i = 0; i < element.partners.size(); ++i)
      {
        const Interaction<dim> &one = *interactions[element.partners[i]];
        if (!one.law->is_unilateral())
          continue;
        element.facing[g][i] = 0;
        if (!one.law->acts())
          continue;
        const auto place =
          one.partner->nearest({&start, {}, {}, element.normal});
        element.facing[g][i] = facing<dim>(element.normal, place.normal);
        if (element.facing[g][i] > 0)
          element.gap[g] = std::min(element.gap[g], place.normal_gap);
      }
  }



  template <int dim>
  typename std::vector<
    typename InteractionTerm<dim>::FaceElement>::const_iterator
  InteractionTerm<dim>::element_of(const unsigned int f) const
  {
    const auto found =
      std::lower_bound(faces.begin(),
                       faces.end(),
                       f,
                       [](const FaceElement &element, const unsigned int face) {
                         return element.face < face;
                       });
    return found != faces.end() && found->face == f ? found : faces.end();
  }



  template <int dim>
  double
  InteractionTerm<dim>::gap(const unsigned int f, const unsigned int g) const
  {
    const auto element = element_of(f);
    return element == faces.end() ? std::numeric_limits<double>::max() :
                                    element->gap[g];
  }



  template <int dim>
  void
  InteractionTerm<dim>::set_nearer_body(const unsigned int f,
                                        const unsigned int g)
  {
    const auto element = element_of(f);
    if (element == faces.end())
      return;
    faces[element - faces.begin()].body_is_nearer[g] = true;
  }



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
  InteractionTerm<2>::find_faces();
  template void
  InteractionTerm<2>::look_at_partners(const StepContext<2> &,
                                       const unsigned int,
                                       FaceElement &) const;
  template double
  InteractionTerm<2>::gap(const unsigned int, const unsigned int) const;
  template void
  InteractionTerm<2>::set_nearer_body(const unsigned int, const unsigned int);
  template void
  InteractionTerm<3>::find_faces();
  template void
  InteractionTerm<3>::look_at_partners(const StepContext<3> &,
                                       const unsigned int,
                                       FaceElement &) const;
  template double
  InteractionTerm<3>::gap(const unsigned int, const unsigned int) const;
  template void
  InteractionTerm<3>::set_nearer_body(const unsigned int, const unsigned int);
} // namespace isochor
