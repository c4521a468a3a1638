/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_partner_h
#define isochor_rigid_partner_h

#include <isochor/base/expression.h>
#include <isochor/interaction/partner.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <memory>
#include <string>

namespace isochor
{
  template <int dim>
  class RigidPartner : public Partner<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    RigidPartner(ParameterHandler &prm, const std::string &section);

    void
    update(const StepContext<dim> &step, const NodalField &) override
    {
      start = pose(step.old_time);
      end   = pose(step.time);
    }
    PartnerPlace<dim>
    nearest(const typename Partner<dim>::SurfacePlace &place) const override;
    PartnerPlace<dim>
    original(const typename Partner<dim>::SurfacePlace &place) const override;

  private:
    struct Pose
    {
      Tensor<1, dim> displacement;
      Tensor<2, dim> rotation;
    };
    Pose
    pose(const double time) const;
    Tensor<1, dim>
    at(const Pose &pose, const Point<dim> &X) const
    {
      return centre + pose.displacement + pose.rotation * (X - centre);
    }

    std::unique_ptr<RigidShape<dim>>                                   shape;
    Point<dim>                                                         centre;
    std::array<std::vector<Expression<dim>>, dim + (dim == 2 ? 1 : 3)> motion;
    Pose start, end;
  };
} // namespace isochor

#endif
