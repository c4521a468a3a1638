/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_tests_bulged_grid_h
#define isochor_tests_bulged_grid_h

// A grid of distorted cells, for tests of shape functions.

#include <isochor/base/plugin_registry.h>
#include <isochor/grid/lattice_source.h>

#include <cmath>
#include <string>

using namespace isochor;

namespace isochor
{
  /** A box none of whose cells is a parallelogram, none of whose hexahedra has
   * plane faces. */
  template <int dim>
  class BulgedGrid : public LatticeSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      LatticeSource<dim>::declare_parameters(prm);
    }

    Point<dim>
    place(const Point<dim> &unit) const override
    {
      Point<dim> x = unit;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] += 0.08 * std::sin(3 * unit[(d + 1) % dim] + 2 * unit[d] + d);
      return x;
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, BulgedGrid, "bulged")
} // namespace isochor

/** Of a box. */
template <int dim>
std::string
subdivisions(const unsigned int n)
{
  const std::string text = std::to_string(n);
  return "Grid/Subdivisions = " + text + ", " + text +
         (dim == 3 ? ", " + text : "") + '\n';
}


#endif
