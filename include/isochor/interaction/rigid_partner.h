/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_partner_h
#define isochor_rigid_partner_h

#include <isochor/interaction/partner.h>
#include <isochor/interaction/rigid_body_term.h>

#include <memory>

namespace isochor
{
  /** A rigid body as what a surface interacts with. */
  template <int dim>
  class RigidPartner : public Partner<dim>
  {
  public:
    explicit RigidPartner(const std::shared_ptr<RigidBodyInScene<dim>> &rigid)
      : rigid(rigid)
    {}

    void
    update(const StepContext<dim> &step, const NodalField &unknowns) override;
    bool
    moves(const StepContext<dim> &step) const override
    {
      return rigid->body.is_moved(step.old_time, step.time);
    }
    PartnerPlace<dim>
    nearest(const typename Partner<dim>::SurfacePlace &place) const override;
    PartnerPlace<dim>
    original(const typename Partner<dim>::SurfacePlace &place) const override;
    double
    depth(const std::array<typename Partner<dim>::Way, dim + 1> &corners)
      const override;
    bool
    has_moments() const override
    {
      return true;
    }
    /** About the reference point. */
    Tensor<1, 3>
    moment(const Point<dim>     &y,
           const Tensor<1, dim> &force,
           const bool            mean) const override;
    std::vector<unsigned int>
    control_vertices(const ActiveNodes<dim> &nodes) const override;
    void
    motion(
      const typename Partner<dim>::SurfacePlace &place,
      const bool                                 is_unilateral,
      std::vector<std::vector<typename InteractionKernel<dim>::PartnerMotion>>
        &motions) const override;

  private:
    /** 1 - R_n Rᵀ, of the rotations at the start and the end of the step. */
    Tensor<2, dim>
    turned() const;
    /** How the slip changes with x, see nearest_place(). */
    Tensor<2, dim>
    slip_by_x(const ClosestPoint<dim> &closest) const;
    /** What the place has slipped on the rigid body, of which it is nearest to
     * what is at @p y. */
    Tensor<1, dim>
    slip(const typename Partner<dim>::SurfacePlace &place,
         const Point<dim>                          &y) const;

    const std::shared_ptr<RigidBodyInScene<dim>> rigid;
    /** Of the step as it is now. */
    std::unique_ptr<RigidMove<dim>> move;
  };
} // namespace isochor

#endif
