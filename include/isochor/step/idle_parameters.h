/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_idle_parameters_h
#define isochor_idle_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/step/scene.h>
#include <isochor/transfer/grid_reset.h>

namespace isochor
{
  using namespace dealii;

  /**
   * Warn of parameters of @p prm (at its top level) that differ from their
   * defaults but have no effect with what the others say, one warning each.
   * Combinations that can't be meant at all are errors of the classes that own
   * the parameters. @p scene has read them; it knows what its plugins use.
   * So has @p reset.
   */
  template <int dim>
  void
  warn_of_idle_parameters(const ParameterHandler &prm,
                          Scene<dim>             &scene,
                          const GridReset<dim>   &reset);
} // namespace isochor

#endif
