/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A grid of one's own: a sector of an annulus around the origin, in 3D extruded
// along z. Its boundaries are left and right (the inner and the outer arc) and
// bottom and top (where the sector begins and ends). With LatticeSource it can
// be used as it is (Grid/Type = annulus) or refined from
// (Grid/Type = adaptive, Grid/Coarse cells = annulus).

#include <isochor/base/plugin_registry.h>
#include <isochor/grid/lattice_source.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  class Annulus : public LatticeSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Radii",
                        "0.5, 1",
                        Patterns::List(Patterns::Double(0), 2, 2),
                        "Inner and outer radius of an annulus (m).");
      prm.declare_entry("Sector",
                        "90",
                        Patterns::Double(0, 180),
                        "Angle of an annulus, from the x axis (degrees).");
      LatticeSource<dim>::declare_parameters(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      LatticeSource<dim>::parse_parameters(prm);
      radii = Utilities::string_to_double(
        Utilities::split_string_list(prm.get("Radii")));
      AssertThrow(radii[1] > radii[0],
                  ExcMessage("The outer one of <Grid/Radii> must be larger "
                             "than the inner one."));
      angle = prm.get_double("Sector") * numbers::PI / 180;
    }

    Point<dim>
    place(const Point<dim> &unit) const override
    {
      const double r   = radii[0] + unit[0] * (radii[1] - radii[0]);
      const double phi = unit[1] * angle;
      Point<dim>   x   = unit; // z from 0 to 1 m
      x[0]             = r * std::cos(phi);
      x[1]             = r * std::sin(phi);
      return x;
    }

  private:
    std::vector<double> radii;
    double              angle = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, Annulus, "annulus")
} // namespace isochor
