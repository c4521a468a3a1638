/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_faces_h
#define isochor_interaction_faces_h

#include <isochor/equations/body_surface.h>
#include <isochor/interaction/face_loads.h>
#include <isochor/interaction/interaction.h>
#include <isochor/interaction/interaction_kernel.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  template <int dim>
  using Interactions = std::vector<std::unique_ptr<Interaction<dim>>>;

  /** A face of the surface that takes part, with what is constant in a step. */
  template <int dim>
  struct InteractionFace
  {
    static constexpr unsigned int n_gauss = BodySurface<dim>::n_gauss;

    unsigned int              face;            ///< in the surface
    std::vector<unsigned int> partners;        ///< numbers of its interactions
    std::vector<unsigned int> loads;           ///< FaceLoads::on_face()
    bool                      is_tied = false; ///< by one of them
    /** By Gauss point and partner: facing() with the normals of the body at
     * the start of the step and of the partner where it will be. */
    std::array<std::vector<double>, n_gauss> facing;
    /** By Gauss point: see InteractionFaces::gap(), and whether nothing is
     * near or a body is nearer (InteractionKernel::Measure). */
    std::array<double, n_gauss> gap;
    std::array<bool, n_gauss>   is_farther;
    Tensor<1, dim>              normal; ///< outward, at the start of the step
    double                      gamma      = 0;
    double                      area_ratio = 1;
    std::vector<Tensor<1, dim>> adjoint; ///< B, if θ is not 0
    /** By Gauss point and partner, if it is known. */
    std::vector<StartOfStep<dim>> start;
  };

  /** The faces of the bodies that interactions act on, and the partners that
   * each one faces. */
  template <int dim>
  class InteractionFaces
  {
  public:
    /** @param interactions All, by the numbers that the faces have of them. */
    explicit InteractionFaces(const Interactions<dim> &interactions)
      : interactions(interactions)
    {}

    /** The faces that take part, of the surface of @p points at the start of
     * the step, and those of @p loads.
     * @throws ExcMessage (the first time) for an interaction without a face,
     * and for faces that two of them tie. Collective. */
    void
    find(const BackgroundGrid<dim> &grid,
         const PointArrays<dim>    &points,
         FaceLoads<dim>            &loads);
    bool
    are_known() const
    {
      return is_checked;
    }
    /** What was found the first time, a line for each interaction. */
    const std::string &
    describe() const
    {
      return description;
    }

    std::vector<InteractionFace<dim>> &
    all()
    {
      return faces;
    }
    const std::vector<InteractionFace<dim>> &
    all() const
    {
      return faces;
    }
    const BodySurface<dim> &
    surface() const
    {
      return of_bodies;
    }
    const typename BodySurface<dim>::Face &
    in_surface(const InteractionFace<dim> &face) const
    {
      return of_bodies.faces()[face.face];
    }

    /** Set what the Gauss points of @p face face, and their gaps, with partners
     * in their present poses. */
    void
    look_at_partners(const StepContext<dim> &step,
                     InteractionFace<dim>   &face) const;
    /** How far (m) the nearest of the partners that face @p f of the surface
     * faces and may come into contact with will be from where Gauss point @p g
     * is at the start of the step. */
    double
    gap(const unsigned int f, const unsigned int g) const;
    /** Another body is nearer there. */
    void
    set_farther(const unsigned int f, const unsigned int g);

  private:
    void
    check(const BackgroundGrid<dim> &grid, const FaceLoads<dim> &loads);
    /** That of face @p f of the surface, or null. */
    const InteractionFace<dim> *
    find_face(const unsigned int f) const;

    const Interactions<dim>          &interactions;
    BodySurface<dim>                  of_bodies;
    std::vector<InteractionFace<dim>> faces; ///< by their numbers there
    bool                              is_checked = false;
    std::string                       description;
  };
} // namespace isochor

#endif
