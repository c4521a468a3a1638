/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/revolution.h>

#include <cmath>

namespace isochor
{
  /** A cone on a shaft, as the tip of a penetrometer or of a pile. */
  template <int dim>
  class Cone : public ShapeOfRevolution<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      RigidShape<dim>::declare_axis(prm);
      RigidShape<dim>::declare_length(prm,
                                      "Shaft radius",
                                      "The radius (m) of a cone's shaft, which "
                                      "begins where the cone has this radius.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const double angle    = this->get_positive(prm, "Apex angle"),
                   r        = this->get_positive(prm, "Shaft radius"),
                   z        = prm.get_double("Length"),
                   shoulder = r / std::tan(angle * numbers::PI / 360);
      this->check(angle < 180, "Apex angle", "must be less than 180.");
      this->check(z > shoulder,
                  "Length",
                  "must be more than the length of the conical part, " +
                    std::to_string(shoulder) + " m.");
      this->solid.origin = this->get_place(prm, "Apex");
      this->solid.axis   = this->get_direction(prm, "Direction");
      this->solid.outline =
        Outline({{Point<2>(0, 0), prm.get_double("Tip radius")},
                 {Point<2>(r, shoulder)},
                 {Point<2>(r, z)},
                 {Point<2>(-r, z)},
                 {Point<2>(-r, shoulder)}},
                true,
                "<" + this->parameter("Shape") +
                  " = cone> with its <Tip radius>");
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, Cone, "cone")
} // namespace isochor
