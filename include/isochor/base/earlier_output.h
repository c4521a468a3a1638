/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_earlier_output_h
#define isochor_earlier_output_h

#include <filesystem>
#include <string>

namespace isochor
{
  /** What an earlier run has left in @p directory that a new one replaces, as
   * a sentence for the user; empty if there is nothing. */
  std::string
  describe_earlier_output(const std::string &directory);

  /** When the run began that has just opened its statistics.txt in @p
   * directory, by the clock of the file system. */
  std::filesystem::file_time_type
  start_of_output(const std::string &directory);

  /** Where the results of a run are that began at @p start, in a line:
   * statistics.txt, and .pvd files if it has written any. */
  std::string
  describe_results(const std::string              &directory,
                   std::filesystem::file_time_type start);
} // namespace isochor

#endif
