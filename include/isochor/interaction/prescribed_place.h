/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_prescribed_place_h
#define isochor_prescribed_place_h

#include <isochor/base/expression.h>
#include <isochor/interaction/partner.h>

#include <array>
#include <string>

namespace isochor
{
  /** Each place X of the surface has the place X + ū(X, t) to go to, or some
   * components of it. */
  template <int dim>
  class PrescribedPlace : public Partner<dim>
  {
  public:
    /** @param displacement Formulas "x=..., y=...", in m since t = 0.
     * @param parameter Their origin, for messages. */
    PrescribedPlace(const std::string &displacement,
                    const std::string &parameter);

    void
    update(const StepContext<dim> &step, const NodalField &) override
    {
      time = step.time;
    }

    void
    set_trial(const TrialMotion &next) override
    {
      trial = next;
    }

    /** A prescribed place is no surface that could be left. */
    PartnerPlace<dim>
    nearest(const typename Partner<dim>::SurfacePlace &place) const override
    {
      return original(place);
    }
    PartnerPlace<dim>
    original(const typename Partner<dim>::SurfacePlace &place) const override;

    void
    append_motions(std::vector<Expression<dim>> &motions) const override;

  private:
    std::array<std::vector<Expression<dim>>, dim> components; ///< one or none
    double                                        time = 0;
    TrialMotion                                   trial;
  };
} // namespace isochor

#endif
