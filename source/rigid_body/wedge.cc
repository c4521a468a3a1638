/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/revolution.h>

#include <cmath>

namespace isochor
{
  /** A wedge in the plane, cut off across its axis. */
  class Wedge : public ShapeOfRevolution<2>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      declare_axis(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const double angle = get_positive(prm, "Apex angle"),
                   z     = get_positive(prm, "Length"),
                   r     = z * std::tan(angle * numbers::PI / 360);
      check(angle < 180, "Apex angle", "must be less than 180.");
      solid.origin = get_place(prm, "Apex");
      solid.axis   = get_direction(prm, "Direction");
      solid.outline =
        Outline({{Point<2>(0, 0), prm.get_double("Tip radius")},
                 {Point<2>(r, z)},
                 {Point<2>(-r, z)}},
                true,
                "<" + parameter("Shape") + " = wedge> with its <Tip radius>");
    }
  };

  ISOCHOR_REGISTER(RigidShape<2>, Wedge, "wedge")
} // namespace isochor
