/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_shared_libraries_h
#define isochor_shared_libraries_h

#include <isochor/base/parameter_file.h>

#include <vector>

namespace isochor
{
  /** Declare <Additional shared libraries>, at the top level of @p prm. */
  void
  declare_shared_libraries(ParameterHandler &prm);

  /**
   * Load the libraries that the parameter <Additional shared libraries> of the
   * @p statements names, so that the plugins in them are registered. This has
   * to happen before other parameters are declared, since the plugins have some
   * of their own. The libraries stay loaded until the program ends.
   *
   * A relative path counts from the working directory. Throws ParameterError,
   * with the reason, for a library that can't be loaded.
   */
  void
  load_shared_libraries(const std::vector<ParameterStatement> &statements);
} // namespace isochor

#endif
