/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/earlier_output.h>

#include <filesystem>
#include <fstream>

namespace isochor
{
  std::string
  describe_earlier_output(const std::string &directory)
  {
    unsigned int  n_rows = 0, n_files = 0;
    std::ifstream statistics(directory + "/statistics.txt");
    for (std::string line; std::getline(statistics, line);)
      n_rows += !line.empty() && line[0] != '#';

    std::error_code code; // a directory that can't be read is reported later
    for (const auto &file :
         std::filesystem::directory_iterator(directory, code))
      n_files += file.path().extension() == ".pvtu";
    if (n_rows == 0 && n_files == 0)
      return "";
    return "Replacing the output of an earlier run in <" + directory +
           ">: " + std::to_string(n_rows) + " rows of statistics.txt, " +
           std::to_string(n_files) +
           " outputs of fields. Of these, files with higher numbers than this "
           "run writes stay.";
  }



  std::filesystem::file_time_type
  start_of_output(const std::string &directory)
  {
    std::error_code code;
    return std::filesystem::last_write_time(directory + "/statistics.txt",
                                            code);
  }



  std::string
  describe_results(const std::string                    &directory,
                   const std::filesystem::file_time_type start)
  {
    std::error_code code;
    bool            has_fields = false;
    for (const auto &file :
         std::filesystem::directory_iterator(directory, code))
      has_fields = has_fields || (file.path().extension() == ".pvd" &&
                                  file.last_write_time(code) >= start);
    return "Results: " + directory + "/statistics.txt" +
           (has_fields ? ", " + directory + "/*.pvd" : "");
  }
} // namespace isochor
