/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_law.h>

namespace isochor
{
  /** f is given: a dead traction, a pressure that follows the surface. */
  template <int dim>
  class Load : public InteractionLaw<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Traction",
                        "",
                        Patterns::Anything(),
                        "Of 'Law = load': a dead load (Pa) per area at t = 0, "
                        "'t_x, t_y(, t_z)', formulas in the position x, y(, z) "
                        "at t = 0 and t.");
      prm.declare_entry("Pressure",
                        "",
                        Patterns::Anything(),
                        "Of 'Law = load': a pressure (Pa) against the surface "
                        "as it is deformed, positive if it pushes; a formula "
                        "in the position x, y(, z) at t = 0 and t.");
    }
    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string traction = this->section + "/Traction",
                        pressure = this->section + "/Pressure";
      for (const auto &formula : split_formulas(prm.get("Traction"), traction))
        given.traction.emplace_back(formula, traction);
      AssertThrow(given.traction.empty() || given.traction.size() == dim,
                  ExcMessage("The parameter <" + traction + "> needs " +
                             std::to_string(dim) + " components."));
      if (!prm.get("Pressure").empty())
        given.pressure.emplace_back(prm.get("Pressure"), pressure);
      AssertThrow(given.traction.size() + given.pressure.size() > 0,
                  ExcMessage("The section <" + this->section +
                             "> needs <Traction> or <Pressure>."));
    }

    SurfaceLoad<dim> *
    load() override
    {
      return &given;
    }

    typename InteractionLaw<dim>::Projection
    project(const Tensor<1, dim> & /*w*/,
            const Tensor<1, dim> & /*n*/,
            const double /*area_ratio*/) const override
    {
      Assert(false, ExcInternalError());
      return {};
    }
    bool
    is_unilateral() const override
    {
      return false;
    }

  private:
    SurfaceLoad<dim> given;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(InteractionLaw, Load, "load")
} // namespace isochor
