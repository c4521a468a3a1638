/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// The members of InteractionTerm that look at the scene at its start, and at
// prescribed motions.
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



  template <int dim>
  void
  InteractionTerm<dim>::append_motion(const StepContext<dim> &step,
                                      std::vector<double>    &values) const
  {
    for (const FaceElement &element : faces)
      for (const unsigned int i : element.partners)
        for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
          interactions[i]->partner->append_motion(
            BodySurface<dim>::place(step, surface.faces()[element.face], g),
            step.time,
            values);
  }



  template <int dim>
  bool
  InteractionTerm<dim>::starts_suddenly(const StepContext<dim> &step,
                                        const NodalField       &velocity) const
  {
    for (const FaceElement &element : faces)
      {
        const auto &face    = surface.faces()[element.face];
        const auto  stencil = points->stencil(grid->geometry(), face.k, face.q);
        for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
          {
            const auto     place = BodySurface<dim>::place(step, face, g);
            Tensor<1, dim> v;
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              for (unsigned int a = 0; a < dim; ++a)
                v[a] += (stencil.shape[I] + stencil.gradient[I] * place.r) *
                        velocity.local_element(
                          step.nodes.node(stencil.vertex[I]) * dim + a);
            for (const unsigned int i : element.partners)
              if (interactions[i]->partner->starts_suddenly(place, v))
                return true;
          }
      }
    return false;
  }



  template void
  InteractionTerm<2>::check_surfaces();
  template std::vector<double>
  InteractionTerm<2>::areas_of(const unsigned int) const;
  template void
  InteractionTerm<2>::append_motion(const StepContext<2> &,
                                    std::vector<double> &) const;
  template bool
  InteractionTerm<2>::starts_suddenly(const StepContext<2> &,
                                      const NodalField &) const;
  template void
  InteractionTerm<3>::check_surfaces();
  template std::vector<double>
  InteractionTerm<3>::areas_of(const unsigned int) const;
  template void
  InteractionTerm<3>::append_motion(const StepContext<3> &,
                                    std::vector<double> &) const;
  template bool
  InteractionTerm<3>::starts_suddenly(const StepContext<3> &,
                                      const NodalField &) const;
} // namespace isochor
