/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_partner_h
#define isochor_partner_h

#include <isochor/equations/body_surface.h>
#include <isochor/grid/prescribed_motion.h>
#include <isochor/interaction/interaction_kernel.h>

#include <array>
#include <vector>

namespace isochor
{
  /** What a surface interacts with, other than another body. Poses are those at
   * the end of the step. */
  template <int dim>
  class Partner
  {
  public:
    virtual ~Partner() = default;

    /** A place of the surface at the iterate. */
    struct SurfacePlace
    {
      const typename BodySurface<dim>::Place
                    *start;     ///< at the start of the step
      Tensor<1, dim> increment; ///< Δu (m)
      /** The tangential gap of the last step (m), for laws with friction. */
      Tensor<1, dim> slip;
      Tensor<1, dim> normal; ///< outward, at the start of the step
    };

    /** The grid is made, or has been replaced. Collective. */
    virtual void
    initialize(const BackgroundGrid<dim> & /*grid*/)
    {}

    /** The @p step goes to its end with the nodal @p unknowns: find the pose.
     */
    virtual void
    update(const StepContext<dim> & /*step*/, const NodalField & /*unknowns*/)
    {}

    /** Whether it is moved over the step, other than by forces. */
    virtual bool
    moves(const StepContext<dim> & /*step*/) const
    {
      return true;
    }

    /** A trial step of dynamics begins or, if it has no size, is over. */
    virtual void
    set_trial(const TrialMotion & /*trial*/)
    {}

    /** Where @p place is from the nearest place of the partner, for laws that
     * are unilateral. */
    virtual PartnerPlace<dim>
    nearest(const SurfacePlace &place) const = 0;

    /** Where it is from the place of the partner that it was at, at t = 0. */
    virtual PartnerPlace<dim>
    original(const SurfacePlace &place) const = 0;

    /** Where a place is at the start of the step and at the iterate. */
    using Way = std::array<Point<dim>, 2>;
    /** How deep (m) all @p corners of a subdomain and its centre are in the
     * partner at once, where they are so first on their ways, or at the end. 0:
     * nowhere. */
    virtual double
    depth(const std::array<Way, dim + 1> & /*corners*/) const
    {
      return 0;
    }

    /** Whether moments are about anything. */
    virtual bool
    has_moments() const
    {
      return false;
    }
    /** The moment of @p force (N) at the place @p y, with the lever at the pose
     * that update() has found or, if @p mean, its mean over the step (N m; in
     * 2D the third component counts). */
    virtual Tensor<1, 3>
    moment(const Point<dim> & /*y*/,
           const Tensor<1, dim> & /*force*/,
           const bool /*mean*/) const
    {
      return Tensor<1, 3>();
    }

    /** Append the formulas that tie places to a motion, see
     * ActsByAssembly::append_motions(). */
    virtual void
    append_motions(std::vector<Expression<dim>> & /*motions*/) const
    {}

    /** The vertices of control nodes whose unknowns move the partner. */
    virtual std::vector<unsigned int>
    control_vertices(const ActiveNodes<dim> & /*nodes*/) const
    {
      return {};
    }

    /** How unknowns at the control nodes move the partner where it meets
     * @p place, at the nearest place or at the original one: by node, by
     * component. */
    virtual void
    motion(
      const SurfacePlace & /*place*/,
      const bool /*is_nearest*/,
      std::vector<std::vector<typename InteractionKernel<dim>::PartnerMotion>>
        &motions) const
    {
      motions.clear();
    }
  };

  /** What is left of the distance of a place x from the nearest place of a
   * partner and its slip: g = g_n n + T s with T = 1 - n ⊗ n, n the normal and
   * @p curvature its change with x, s the @p slip that changes by
   * @p slip_by_x. */
  template <int dim>
  PartnerPlace<dim>
  nearest_place(const double                   distance,
                const Tensor<1, dim>          &normal,
                const SymmetricTensor<2, dim> &curvature,
                const Tensor<1, dim>          &slip,
                const Tensor<2, dim>          &slip_by_x);
} // namespace isochor

#endif
