/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_pair_kernel_h
#define isochor_body_pair_kernel_h

#include <isochor/interaction/face_copies.h>
#include <isochor/interaction/face_projection.h>
#include <isochor/interaction/interaction_kernel.h>
#include <isochor/interaction/pair_laws.h>
#include <isochor/interaction/surface_memory.h>

#include <memory>
#include <vector>

namespace isochor
{
  /** A Gauss point and the faces of other bodies that it may meet. */
  template <int dim>
  struct PairElement
  {
    unsigned int              own; ///< its face, number of the copy
    unsigned int              gauss_point;
    std::vector<unsigned int> others; ///< numbers of copies
    /** At the start of the step: see InteractionKernel::Measure. */
    bool is_farther = false;
    /** Of the others the one that it touches at the start of the step, which it
     * meets as long as it isn't beyond its reach, as traction and normal would
     * jump between iterates; -1: none, it meets the nearest. */
    int touches = -1;
    /** Tied to the only one of the others, at these coordinates of it. */
    bool               is_tied = false;
    Tensor<1, dim - 1> tied_at;
    StartOfStep<dim>   start;
    bool               has_start = false; ///< whether that is known
    /** By vertex of the element; and of each of the others, which of them its
     * vertices are. */
    std::vector<unsigned int>              vertices;
    std::vector<std::vector<unsigned int>> of_other;

    /** Set both. */
    void
    number_vertices(const std::vector<FaceCopy<dim>> &copies);
  };



  /** What an element of BodyPairTerm does at an iterate: a Gauss point of one
   * body's surface, and the nearest of the faces that it may meet. */
  template <int dim>
  class BodyPairKernel
  {
  public:
    /** All are kept by reference. Places farther beyond their nearest face than
     * @p reach and what they slide in the step are not met. */
    BodyPairKernel(const StepContext<dim>           &step,
                   const NodalField                 &unknowns,
                   const std::vector<FaceCopy<dim>> &copies,
                   const PairLaws<dim>              &laws,
                   const InteractionLaw<dim>        &tie,
                   const SurfaceMemory<dim>         &memory,
                   const FaceLoads<dim>             *loads,
                   const double                      reach);

    /** How far the element's Gauss point is from the face that it meets (m);
     * the largest number if it meets none. */
    double
    gap(const PairElement<dim> &element);

    /** Which of the others the element's Gauss point is in contact with; -1:
     * none. At the start of the step. */
    int
    touched(const PairElement<dim> &element);

    /** What acts at a Gauss point, at the iterate. */
    struct Action
    {
      unsigned int other = 0; ///< number of the copy
      /** On the body of the Gauss point (N), the mean over the step. */
      Tensor<1, dim>   force;
      Tensor<1, dim>   remembered;        ///< for the next step (m)
      double           kept      = 1;     ///< SurfaceStress::Flow::kept
      bool             meets     = false; ///< whether there is another face
      bool             is_closed = false; ///< SurfaceState, at the end
      StartOfStep<dim> end;               ///< InteractionKernel::at_end()
    };

    EvaluationStatus
    evaluate(const PairElement<dim> &element, const bool with_matrix);

    /** Of evaluate(), valid where it was successful. */
    const Action &
    action() const
    {
      return result;
    }
    /** The residual and matrix of evaluate(). */
    const InteractionKernel<dim> &
    sums() const
    {
      return kernel;
    }

  private:
    /** One of the two faces, and the place on it. */
    struct Side
    {
      const FaceCopy<dim>      *face = nullptr;
      SurfaceStress<dim>        stress;
      std::vector<unsigned int> nodes; ///< of the element
      std::vector<double>       N;
      double                    p = 0; ///< in u-p (Pa)
      Tensor<1, dim>            r;     ///< from the subdomain's point (m)
      /** At the start of the step, and at t = 0. */
      Tensor<1, dim> start, X;
    };

    /** The face of a pair that acts, and where on it the Gauss point is. */
    struct Meeting
    {
      unsigned int                         place; ///< among PairElement::others
      std::array<Point<dim>, dim>          corners; ///< at the iterate
      std::unique_ptr<FaceProjection<dim>> projection;
    };

    EvaluationStatus
    set_face(const FaceCopy<dim> &face, const bool with_matrix, Side &side);
    /** The place with these weights of the corners, shifted by @p shift. */
    void
    set_place(const std::array<double, dim> &weights,
              const Tensor<1, dim>          &shift,
              Side                          &side) const;
    Meeting
    find_meeting(const PairElement<dim> &element, const Point<dim> &x) const;
    void
    add_sides(const double share);
    /** Of the @p side's material, for ties; none in dynamics, as in
     * InteractionTerm. */
    typename SurfaceStress<dim>::Flow
    flow(const PairElement<dim> &element, const Side &side) const
    {
      return step.has_inertia || !element.is_tied ?
               typename SurfaceStress<dim>::Flow() :
               side.stress.flow(*step.kernel.materials[side.face->material],
                                side.face->history.data());
    }
    /** What turns at the other side with its unknowns: the derivatives of
     * normal and coordinates of the projection. */
    void
    add_motion_of_face(const FaceProjection<dim> &projection,
                       const Tensor<1, dim>      &slip,
                       const unsigned int         n_dofs);
    /** That of the law at the places @p x and @p y of the two sides. */
    PartnerPlace<dim>
    place_of_law(const PairElement<dim>    &element,
                 const InteractionLaw<dim> &law,
                 const FaceProjection<dim> &at,
                 const Tensor<1, dim>      &du,
                 const Tensor<1, dim>      &x,
                 const Tensor<1, dim>      &y,
                 const bool                 with_matrix);
    /** Weight, γ and start of this place of the element, whose other side,
     * @p face_met, takes 1 - @p share of what is averaged. */
    typename InteractionKernel<dim>::Measure
    measure_of(const PairElement<dim> &element,
               const FaceCopy<dim>    &face_met,
               const double            share) const;

    const StepContext<dim>           &step;
    const NodalUnknowns<dim>          nodal;
    const std::vector<FaceCopy<dim>> &copies;
    const PairLaws<dim>              &laws;
    const InteractionLaw<dim>        &tie;
    const SurfaceMemory<dim>         &memory;
    const FaceLoads<dim>             *loads;
    const double                      reach;

    InteractionKernel<dim> kernel;
    Action                 result;
    Side                   own, other;
  };



  /** Of the step, at @p r from the point of the @p face's subdomain (m). */
  template <int dim>
  Tensor<1, dim>
  increment_at(const NodalUnknowns<dim> &nodal,
               const FaceCopy<dim>      &face,
               const Tensor<1, dim>     &r);
} // namespace isochor

#endif
