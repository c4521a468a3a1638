/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/rigid_body/revolution.h>

namespace isochor
{
  /** A circular cylinder, whose edges may be rounded. */
  template <int dim>
  class Cylinder : public ShapeOfRevolution<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      RigidShape<dim>::declare_place(prm,
                                     "First end",
                                     "The centre (m) of one end of a "
                                     "cylinder.");
      RigidShape<dim>::declare_place(prm,
                                     "Second end",
                                     "The centre (m) of the other end of a "
                                     "cylinder.");
      RigidShape<dim>::declare_radius(prm);
      RigidShape<dim>::declare_edge_radius(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const double r     = this->get_positive(prm, "Radius"),
                   e     = prm.get_double("Edge radius");
      this->solid.origin = this->get_place(prm, "First end");
      this->solid.axis =
        this->get_place(prm, "Second end") - this->solid.origin;
      const double z = this->solid.axis.norm();
      this->check(z > 0,
                  "Second end",
                  "must be another place than <" +
                    this->parameter("First end") + ">.");
      this->check(e <= r && 2 * e <= z,
                  "Edge radius",
                  "must exceed neither the radius nor half of the length.");
      this->solid.axis /= z;
      this->solid.outline =
        Outline({{Point<2>(-r, 0), e},
                 {Point<2>(r, 0), e},
                 {Point<2>(r, z), e},
                 {Point<2>(-r, z), e}},
                true,
                "<" + this->parameter("Shape") + " = cylinder>");
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(RigidShape, Cylinder, "cylinder")
} // namespace isochor
