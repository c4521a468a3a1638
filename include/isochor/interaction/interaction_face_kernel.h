/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_face_kernel_h
#define isochor_interaction_face_kernel_h

#include <isochor/interaction/interaction_faces.h>
#include <isochor/interaction/interaction_history.h>

#include <vector>

namespace isochor
{
  /**
   * A face of a body with all its partners: residual, matrix and what acts, by
   * InteractionKernel at each Gauss point. The nodes of the element are those
   * of the face's subdomain, and then the control nodes of each partner.
   */
  template <int dim>
  class InteractionFaceKernel
  {
  public:
    InteractionFaceKernel(const Interactions<dim>       &interactions,
                          const FaceLoads<dim>          &loads,
                          const InteractionFaces<dim>   &faces,
                          const InteractionHistory<dim> &history)
      : interactions(interactions)
      , loads(loads)
      , faces(faces)
      , history(history)
    {}

    /** What acts at a Gauss point of a face by one of its interactions. */
    struct Action
    {
      unsigned int partner, gauss_point; ///< partner: of the face
      /** Where it acts on the partner, at the iterate. */
      Point<dim> y;
      /** On the body (N): of contact the mean over the step, of a tie that at
       * its end. */
      Tensor<1, dim>   force;
      Tensor<1, dim>   remembered; ///< for the next step (m)
      double           kept;       ///< SurfaceStress::Flow::kept
      StartOfStep<dim> end;        ///< InteractionKernel::at_end()
    };

    /** Set what is constant in the @p step: the normal, γ and the adjoint. */
    void
    start_step(const StepContext<dim> &step, InteractionFace<dim> &face);
    /** Residual and, @p with_matrix, matrix of @p face. @p actions, if not
     * null, gets what acts. */
    EvaluationStatus
    evaluate(const StepContext<dim>     &step,
             const NodalField           &unknowns,
             const InteractionFace<dim> &face,
             const bool                  with_matrix,
             std::vector<Action>        *actions = nullptr);
    /** As MixedSystem::add_element() wants them. */
    const std::vector<double> &
    residual() const
    {
      return kernel.residual;
    }
    const std::vector<double> &
    matrix() const
    {
      return kernel.matrix;
    }

  private:
    /** A Gauss point at the iterate. */
    struct FacePlace
    {
      unsigned int                        g;
      typename BodySurface<dim>::Place    start;
      typename Partner<dim>::SurfacePlace at; ///< refers to `start`
      double                              p;
      GivenTraction<dim>                  given;
    };
    /** A partner that may act at a Gauss point, by its number in the face. */
    struct ActingPartner
    {
      unsigned int      partner;
      PartnerPlace<dim> place;
      /** It acts where it is open, too: the nearest, and no other is closed. */
      bool is_alone;
    };

    /** The material and the deformation of the face's subdomain. */
    typename SurfaceStress<dim>::Domain
    domain(const StepContext<dim>     &step,
           const InteractionFace<dim> &face) const;
    /** Of the material, whose stress was evaluated last, for ties; none in
     * dynamics, where what acts has to be the gradient of an energy. */
    typename SurfaceStress<dim>::Flow
    flow_at(const StepContext<dim>                    &step,
            const InteractionFace<dim>                &face,
            const typename SurfaceStress<dim>::Domain &domain) const
    {
      return step.has_inertia || !face.is_tied ?
               typename SurfaceStress<dim>::Flow() :
               stress.flow(*domain.material, domain.history);
    }
    void
    start_element(const StepContext<dim>                    &step,
                  const InteractionFace<dim>                &face,
                  const typename SurfaceStress<dim>::Domain &domain,
                  const bool                                 with_matrix);
    /** Set `place` and N to those of Gauss point @p g. */
    void
    go_to(const StepContext<dim>                    &step,
          const NodalField                          &unknowns,
          const InteractionFace<dim>                &face,
          const typename SurfaceStress<dim>::Domain &domain,
          const unsigned int                         g);
    /** Those of the place: the tie or, in contact, all that it faces. The
     * stress is evaluated. */
    void
    find_acting(const InteractionFace<dim> &face);
    typename InteractionKernel<dim>::Measure
    measure_of(const StepContext<dim>     &step,
               const InteractionFace<dim> &face,
               const ActingPartner        &acting) const;
    /** Bring the place and @p partner into the kernel. */
    void
    add_sides(const InteractionFace<dim>                &face,
              const typename SurfaceStress<dim>::Domain &domain,
              const unsigned int                         partner);
    /** Of @p one of the acting partners, after its sides. */
    void
    add_action(const StepContext<dim>                    &step,
               const InteractionFace<dim>                &face,
               const typename SurfaceStress<dim>::Domain &domain,
               const ActingPartner                       &one,
               std::vector<Action>                       *actions);

    const Interactions<dim>       &interactions;
    const FaceLoads<dim>          &loads;
    const InteractionFaces<dim>   &faces;
    const InteractionHistory<dim> &history;
    InteractionKernel<dim>         kernel;
    SurfaceStress<dim>             stress;
    FacePlace                      place;
    std::vector<ActingPartner>     acting;
    std::vector<double>            N;
    /** 0, 1, ..., and the first node of each partner. */
    std::vector<unsigned int> own_nodes, first_of_partner;
    std::vector<std::vector<typename InteractionKernel<dim>::PartnerMotion>>
      motions;
  };
} // namespace isochor

#endif
