/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_h
#define isochor_interaction_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>
#include <isochor/interaction/interaction_law.h>
#include <isochor/interaction/partner.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** A surface, its partner and the law between them: what a subsection
   * "Interaction: BODY - PARTNER" describes. */
  template <int dim>
  class Interaction
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);

    /** @param section "Interaction: BODY - PARTNER", which @p prm is in. */
    Interaction(ParameterHandler &prm, const std::string &section);

    /** Whether it is about a face of the surface with its centre at @p X at
     * t = 0. */
    bool
    has(const Point<dim> &X) const
    {
      return !region || (*region)(X, 0.) > 0;
    }

    /** "BODY - PARTNER". */
    std::string
    name() const
    {
      return body + " - " + partner_name;
    }

    std::string                          section, body, partner_name;
    std::unique_ptr<InteractionLaw<dim>> law;
    std::unique_ptr<Partner<dim>>        partner;

  private:
    std::unique_ptr<Expression<dim>> region;
  };
} // namespace isochor

#endif
