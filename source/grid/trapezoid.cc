/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/lattice_source.h>

namespace isochor
{
  /** A quadrilateral, in 3D extruded along z from z = 0. */
  template <int dim>
  class TrapezoidGrid : public LatticeSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Corners",
                        "0, 0; 1, 0; 1, 1; 0, 1",
                        Patterns::Anything(),
                        "The four corners of a trapezoid, counter-clockwise "
                        "from bottom left (m). In 3D it is extruded from z = 0 "
                        "to 'Depth'.");
      prm.declare_entry("Depth",
                        "1",
                        Patterns::Double(0),
                        "Length of a trapezoid in z, in 3D (m).");
      LatticeSource<dim>::declare_parameters(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      LatticeSource<dim>::parse_parameters(prm);
      for (const auto &corner :
           Utilities::split_string_list(prm.get("Corners"), ';'))
        corners.push_back(parse_point<2>(corner, "Grid/Corners"));
      AssertThrow(corners.size() == 4,
                  ExcMessage(
                    "The parameter <Grid/Corners> must list 4 points."));
      depth = prm.get_double("Depth");
    }

    std::set<std::string>
    parameters_in_use() const override
    {
      std::set<std::string> names = LatticeSource<dim>::parameters_in_use();
      if (dim == 2)
        names.erase("Depth");
      return names;
    }

    Point<dim>
    place(const Point<dim> &unit) const override
    {
      const auto    &c = corners;
      const double   s = unit[0], t = unit[1];
      const Point<2> in_plane =
        (1 - s) * (1 - t) * c[0] + s * (1 - t) * Tensor<1, 2>(c[1]) +
        s * t * Tensor<1, 2>(c[2]) + (1 - s) * t * Tensor<1, 2>(c[3]);
      Point<dim> x;
      x[0] = in_plane[0];
      x[1] = in_plane[1];
      if (dim == 3)
        x[dim - 1] = unit[dim - 1] * depth;
      return x;
    }

  private:
    std::vector<Point<2>> corners;
    double                depth = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, TrapezoidGrid, "trapezoid")
} // namespace isochor
