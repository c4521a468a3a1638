/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_file_names_h
#define isochor_file_names_h

#include <isochor/base/parameter_file.h>

#include <string>

namespace isochor
{
  /**
   * The file @p name that @p statement names, as a path from the working
   * directory: a relative name in a parameter file is relative to the folder of
   * that file, one on the command line to the working directory.
   *
   * Throws ParameterError if a name in a parameter file could be meant either
   * way: where another file of this name is in the working directory.
   */
  std::string
  path_of_file(const std::string &name, const ParameterStatement &statement);

  /** The value of @p statement, whose parameter allows what @p pattern
   * describes: path_of_file() of each file that it names, if it names any. */
  std::string
  with_paths_of_files(const ParameterStatement &statement,
                      const std::string        &pattern);

  /** Make the names of files in @p prm, at its top level, absolute: as they are
   * written for a run from elsewhere. */
  void
  make_file_names_absolute(ParameterHandler &prm);
} // namespace isochor

#endif
