/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_command_line_options_h
#define isochor_command_line_options_h

#include <isochor/base/parameter_file.h>

#include <string>
#include <vector>

namespace isochor
{
  /** What a command line asks for. */
  struct CommandLineOptions
  {
    bool         help             = false;
    bool         version          = false;
    bool         print_parameters = false;
    bool         validate         = false;
    bool         quiet            = false;
    bool         explains         = false;
    std::string  explain; ///< the name of a warning, or empty
    unsigned int n_grid_offsets = 0;
    std::string  scene; ///< empty if none is given
    std::vector<ParameterStatement> overrides;
  };

  /** The text of --help. */
  extern const char *const command_line_usage;

  /** Read the arguments behind the program's name. Throws ParameterError for
   * what is not a legal command line. */
  CommandLineOptions
  parse_command_line(const std::vector<std::string> &arguments);
} // namespace isochor

#endif
