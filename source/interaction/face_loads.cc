/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/face_loads.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  template <int dim>
  bool
  FaceLoads<dim>::have_pressures() const
  {
    return std::any_of(all.begin(), all.end(), [](const auto &one) {
      return !one->law->load()->pressure.empty();
    });
  }



  template <int dim>
  void
  FaceLoads<dim>::find(const BodySurface<dim>    &surface,
                       const BackgroundGrid<dim> &grid,
                       const PointArrays<dim>    &points)
  {
    this->surface = &surface;
    this->grid    = &grid;
    this->points  = &points;
    faces.clear();
    for (unsigned int f = 0; f < surface.faces().size() && !all.empty(); ++f)
      {
        const auto &face = surface.faces()[f];
        if (face.meets_other_body)
          continue;
        for (const unsigned int i :
             on_face(grid.layer_of_cell(points.cell[face.k]),
                     BodySurface<dim>::centre(face)))
          faces.emplace_back(f, i);
      }
  }



  template <int dim>
  std::vector<unsigned int>
  FaceLoads<dim>::on_face(const unsigned int body, const Point<dim> &X) const
  {
    std::vector<unsigned int> found;
    for (unsigned int i = 0; i < all.size(); ++i)
      if (all[i]->has(body, X))
        found.push_back(i);
    return found;
  }



  template <int dim>
  GivenTraction<dim>
  FaceLoads<dim>::traction(const std::vector<unsigned int> &which,
                           const Point<dim>                &X,
                           const double                     stretch,
                           const double                     time) const
  {
    GivenTraction<dim> given;
    for (const unsigned int i : which)
      {
        const SurfaceLoad<dim> &load = *all[i]->law->load();
        for (unsigned int a = 0; a < dim && !load.traction.empty(); ++a)
          given.dead[a] +=
            load.traction[a](X, time) / std::pow(stretch, dim - 1.);
        if (!load.pressure.empty())
          given.pressure += load.pressure.front()(X, time);
      }
    return given;
  }



  template <int dim>
  std::vector<std::vector<typename BodySurface<dim>::Face>>
  FaceLoads<dim>::faces_of_all() const
  {
    std::vector<std::vector<typename BodySurface<dim>::Face>> result(
      all.size());
    for (const auto &[f, i] : faces)
      result[i].push_back(surface->faces()[f]);
    return result;
  }



  template <int dim>
  typename SurfaceForces<dim>::Place
  FaceLoads<dim>::place(const unsigned int b) const
  {
    constexpr unsigned int      n_gauss  = BodySurface<dim>::n_gauss;
    const SimplexGeometry<dim> &geometry = grid->geometry();
    const auto &face = surface->faces()[faces[b / n_gauss].first];
    const auto  start =
      BodySurface<dim>::place(geometry, *points, face, b % n_gauss);
    const auto   nodes = points->stencil(geometry, face.k, face.q);
    const double area  = face.area / std::pow(face.stretch, dim - 1.); // t = 0
    typename SurfaceForces<dim>::Place at{start.X,
                                          start.displacement,
                                          start.weight * area * face.normal,
                                          face.stretch * points->F[face.q],
                                          nodes.n_nodes,
                                          nodes.vertex,
                                          {},
                                          nodes.gradient};
    for (unsigned int I = 0; I < nodes.n_nodes; ++I)
      at.shape.push_back(nodes.shape[I] + nodes.gradient[I] * start.r);
    return at;
  }



  template <int dim>
  void
  FaceLoads<dim>::evaluate(const StepContext<dim> &step,
                           const NodalField       &unknowns,
                           const NodalConstraints &constraints,
                           Statistics             &statistics) const
  {
    typename SurfaceForces<dim>::Surfaces surfaces;
    for (const auto &one : all)
      surfaces.push_back(one->law->load());
    SurfaceForces<dim>::evaluate(
      surfaces, step, unknowns, constraints, statistics);
    statistics.set_owner("");
  }



  template class FaceLoads<2>;
  template class FaceLoads<3>;
} // namespace isochor
