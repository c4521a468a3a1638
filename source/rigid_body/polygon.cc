/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/utilities.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/grid/lattice_source.h>
#include <isochor/rigid_body/outline.h>

#include <algorithm>

namespace isochor
{
  /** A polygon in the plane, or what is on one side of a chain of edges. */
  class Polygon : public RigidShape<2>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Points",
                        "",
                        Patterns::Anything(),
                        "The corners (m) of a polygon, in order: '0, 0; 1, 0; "
                        "1, 1'.");
      prm.declare_entry("Closed",
                        "true",
                        Patterns::Bool(),
                        "Whether an edge leads from the last point of a "
                        "polygon to the first. Otherwise it is an open chain, "
                        "whose first and last edges go on straight without "
                        "end.");
      prm.declare_entry("Solid side",
                        "inside",
                        Patterns::Selection("inside|left|right"),
                        "Where the rigid body is: inside of a closed polygon, "
                        "or on the left or right if one follows the points. A "
                        "container is the outside of a closed polygon.");
      declare_edge_radius(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const bool        is_closed = prm.get_bool("Closed");
      const std::string side      = prm.get("Solid side");
      const double      radius    = prm.get_double("Edge radius");
      check(is_closed || side != "inside",
            "Solid side",
            "must be <left> or <right> with <" + parameter("Closed") +
              " = false>.");
      std::vector<Outline::Corner> corners;
      for (const std::string &point :
           Utilities::split_string_list(prm.get("Points"), ';'))
        corners.push_back({parse_point<2>(point, parameter("Points")), radius});
      const double area = is_closed ? Outline::twice_area(corners) : 0.;
      if (side == "right" || (side == "inside" && area < 0))
        std::reverse(corners.begin(), corners.end());
      is_bounded =
        is_closed && (side == "inside" || (side == "left") == (area > 0));
      outline = Outline(corners, is_closed, "<" + parameter("Points") + ">");
    }

    ClosestPoint<2>
    closest(const Point<2> &x) const override
    {
      return outline.closest(x);
    }

    std::vector<Facet>
    surface(const double reach) const override
    {
      return outline.segments(reach);
    }

    BoundingBox<2>
    box() const override
    {
      return is_bounded ? outline.box() : unbounded();
    }

    Point<2>
    centre() const override
    {
      return outline.box().center();
    }

  private:
    Outline outline;
    bool    is_bounded = true;
  };

  ISOCHOR_REGISTER(RigidShape<2>, Polygon, "polygon")
} // namespace isochor
