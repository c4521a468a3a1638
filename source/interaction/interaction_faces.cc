/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_checks.h>
#include <isochor/interaction/interaction_faces.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  template <int dim>
  void
  InteractionFaces<dim>::find(const BackgroundGrid<dim> &grid,
                              const PointArrays<dim>    &points,
                              FaceLoads<dim>            &loads)
  {
    of_bodies.find(points);
    loads.find(of_bodies, grid, points);
    faces.clear();
    for (unsigned int f = 0; f < of_bodies.faces().size(); ++f)
      {
        const auto          &in_surface = of_bodies.faces()[f];
        InteractionFace<dim> face;
        const Point<dim>     X  = BodySurface<dim>::centre(in_surface);
        const unsigned int body = grid.layer_of_cell(points.cell[in_surface.k]);
        face.face               = f;
        for (unsigned int i = 0; i < interactions.size(); ++i)
          // what is between bodies belongs to no named surface
          if (interactions[i]->has(body, X) &&
              !(interactions[i]->region && in_surface.meets_other_body))
            {
              face.partners.push_back(i);
              face.is_tied |= !interactions[i]->law->is_unilateral();
            }
        if (face.partners.empty())
          continue;
        if (!in_surface.meets_other_body)
          face.loads = loads.on_face(body, X);
        faces.push_back(face);
      }
    if (!is_checked)
      check(grid, loads);
    is_checked = true;
  }



  template <int dim>
  void
  InteractionFaces<dim>::look_at_partners(const StepContext<dim> &step,
                                          InteractionFace<dim>   &face) const
  {
    const auto &corners = in_surface(face).corners;
    double      size    = 0;
    for (unsigned int c = 1; c < dim; ++c)
      size = std::max(
        size,
        (step.points.F[in_surface(face).q] * (corners[c] - corners[0])).norm());
    for (unsigned int g = 0; g < BodySurface<dim>::n_gauss; ++g)
      {
        const auto start = BodySurface<dim>::place(step, in_surface(face), g);
        face.facing[g].assign(face.partners.size(), 1.);
        face.gap[g] = std::numeric_limits<double>::max();
        for (unsigned int i = 0; i < face.partners.size(); ++i)
          {
            const Interaction<dim> &one = *interactions[face.partners[i]];
            if (!one.law->is_unilateral())
              continue;
            face.facing[g][i] = 0;
            if (!one.law->acts())
              continue;
            const auto place =
              one.partner->nearest({&start, {}, {}, face.normal});
            face.facing[g][i] = facing<dim>(face.normal, place.normal);
            if (face.facing[g][i] > 0)
              face.gap[g] = std::min(face.gap[g], place.normal_gap);
          }
        // in dynamics a term that comes and goes would change the energy
        face.is_farther[g] = !step.has_inertia && face.gap[g] > size / 2;
      }
  }



  template <int dim>
  const InteractionFace<dim> *
  InteractionFaces<dim>::find_face(const unsigned int f) const
  {
    const auto found = std::lower_bound(faces.begin(),
                                        faces.end(),
                                        f,
                                        [](const InteractionFace<dim> &face,
                                           const unsigned int          number) {
                                          return face.face < number;
                                        });
    return found != faces.end() && found->face == f ? &*found : nullptr;
  }



  template <int dim>
  double
  InteractionFaces<dim>::gap(const unsigned int f, const unsigned int g) const
  {
    const auto face = find_face(f);
    return face ? face->gap[g] : std::numeric_limits<double>::max();
  }



  template <int dim>
  void
  InteractionFaces<dim>::set_farther(const unsigned int f, const unsigned int g)
  {
    if (const auto face = find_face(f))
      faces[face - faces.data()].is_farther[g] = true;
  }



  template <int dim>
  void
  InteractionFaces<dim>::check(const BackgroundGrid<dim> &grid,
                               const FaceLoads<dim>      &loads)
  {
    FacesOfInteractions<dim> faces_of_all(interactions.size());
    std::vector<std::pair<unsigned int, unsigned int>> tied_twice;
    for (const InteractionFace<dim> &face : faces)
      {
        std::vector<unsigned int> ties;
        for (const unsigned int i : face.partners)
          {
            faces_of_all[i].push_back(in_surface(face));
            if (!interactions[i]->law->is_unilateral())
              ties.push_back(i);
          }
        if (ties.size() > 1)
          tied_twice.emplace_back(ties[0], ties[1]);
      }
    const MPI_Comm comm = grid.communicator();
    description = check_faces(interactions, faces_of_all, tied_twice, comm);
    const std::string of_loads =
      check_faces(loads.interactions(), loads.faces_of_all(), {}, comm);
    description +=
      (description.empty() || of_loads.empty() ? "" : "\n") + of_loads;
  }



  template class InteractionFaces<2>;
  template class InteractionFaces<3>;
} // namespace isochor
