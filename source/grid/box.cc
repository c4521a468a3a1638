/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/lattice_source.h>

namespace isochor
{
  /** A rectangle or a cuboid along the axes. */
  template <int dim>
  class BoxGrid : public LatticeSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Lower corner",
                        dim == 2 ? "0, 0" : "0, 0, 0",
                        Patterns::List(Patterns::Double(), dim, dim),
                        "The corner of a box with the least coordinates (m).");
      prm.declare_entry("Upper corner",
                        dim == 2 ? "1, 1" : "1, 1, 1",
                        Patterns::List(Patterns::Double(), dim, dim),
                        "The corner of a box with the largest coordinates "
                        "(m).");
      LatticeSource<dim>::declare_parameters(prm);
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      LatticeSource<dim>::parse_parameters(prm);
      lower = parse_point<dim>(prm.get("Lower corner"), "Grid/Lower corner");
      upper = parse_point<dim>(prm.get("Upper corner"), "Grid/Upper corner");
      for (unsigned int d = 0; d < dim; ++d)
        AssertThrow(upper[d] > lower[d],
                    ExcMessage("The parameter <Grid/Upper corner> must exceed "
                               "<Grid/Lower corner> in every coordinate."));
    }

    Point<dim>
    place(const Point<dim> &unit) const override
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = lower[d] + unit[d] * (upper[d] - lower[d]);
      return x;
    }

  private:
    Point<dim> lower, upper;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, BoxGrid, "box")
} // namespace isochor
