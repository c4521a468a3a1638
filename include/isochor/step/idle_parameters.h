/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_idle_parameters_h
#define isochor_idle_parameters_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/warnings.h>

namespace isochor
{
  using namespace dealii;

  /**
   * Warn of parameters of @p prm (at its top level) that differ from their
   * defaults but have no effect with what the others say, one warning each.
   * Combinations that can't be meant at all are errors of the classes that own
   * the parameters.
   */
  void
  warn_of_idle_parameters(const ParameterHandler &prm, Warnings &warnings);
} // namespace isochor

#endif
