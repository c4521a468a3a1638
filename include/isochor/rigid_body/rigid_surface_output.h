/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_surface_output_h
#define isochor_rigid_surface_output_h

#include <deal.II/base/point.h>

#include <array>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Write the @p facets of a surface, see RigidBody::surface(), as a file
   * `.vtu` of the present @p time. On one rank. @throws ExcMessage if it can't
   * be written. */
  template <int dim>
  void
  write_rigid_surface(const std::string                              &file_name,
                      const std::vector<std::array<Point<dim>, dim>> &facets,
                      const double                                    time);
} // namespace isochor

#endif
