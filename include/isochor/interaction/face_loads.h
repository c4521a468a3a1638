/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_face_loads_h
#define isochor_face_loads_h

#include <isochor/boundary_condition/surface_forces.h>
#include <isochor/equations/body_surface.h>
#include <isochor/interaction/interaction.h>

#include <memory>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * The interactions that are loads, at Gauss points of the faces of
   * BodySurface. These see the functions of their subdomain, so that loads are
   * integrated like stresses, and a homogeneous stress is in equilibrium with
   * its traction wherever the surface lies. What is between bodies has none.
   */
  template <int dim>
  class FaceLoads : public SurfaceForces<dim>
  {
  public:
    explicit FaceLoads(
      std::vector<std::unique_ptr<Interaction<dim>>> &&interactions)
      : all(std::move(interactions))
    {}

    const std::vector<std::unique_ptr<Interaction<dim>>> &
    interactions() const
    {
      return all;
    }

    bool
    have_pressures() const;

    /** Find their faces; all arguments outlive this object. */
    void
    find(const BodySurface<dim>    &surface,
         const BackgroundGrid<dim> &grid,
         const PointArrays<dim>    &points);

    /** By interaction, its faces of this rank. */
    std::vector<std::vector<typename BodySurface<dim>::Face>>
    faces_of_all() const;

    /** The numbers of those on a face of @p body with its centre at @p X, at
     * t = 0. */
    std::vector<unsigned int>
    on_face(const unsigned int body, const Point<dim> &X) const;

    /** Of those with the numbers @p which, at @p X of a face whose subdomain is
     * @p stretch times as large as at t = 0 (BodySurface::Face). */
    GivenTraction<dim>
    traction(const std::vector<unsigned int> &which,
             const Point<dim>                &X,
             const double                     stretch,
             const double                     time) const;

    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalConstraints &constraints,
             Statistics             &statistics) const;

  private:
    unsigned int
    n_places() const override
    {
      return BodySurface<dim>::n_gauss * faces.size();
    }
    const SurfaceLoad<dim> &
    load_at(const unsigned int b) const override
    {
      return *all[faces[b / BodySurface<dim>::n_gauss].second]->law->load();
    }
    typename SurfaceForces<dim>::Place
    place(const unsigned int b) const override;

    const std::vector<std::unique_ptr<Interaction<dim>>> all;
    const BodySurface<dim>                              *surface = nullptr;
    const BackgroundGrid<dim>                           *grid    = nullptr;
    const PointArrays<dim>                              *points  = nullptr;
    /** Numbers of face and interaction. */
    std::vector<std::pair<unsigned int, unsigned int>> faces;
  };
} // namespace isochor

#endif
