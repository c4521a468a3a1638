/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/exceptions.h>

#include <isochor/program/grid_offsets.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <limits>
#include <sstream>

namespace isochor
{
  using namespace dealii;

  std::string
  grid_offset(const unsigned int k, const unsigned int dim)
  {
    double root = 2;
    for (unsigned int i = 0; i < 60; ++i)
      root = std::pow(1 + root, 1. / (dim + 1));
    std::ostringstream offset;
    double             step = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        step /= root;
        const double place = k * step + 0.5;
        offset << (d > 0 ? ", " : "") << std::setprecision(12)
               << place - std::floor(place) - 0.5;
      }
    return offset.str();
  }



  void
  OffsetStatistics::add(const std::string &directory)
  {
    const std::string name = directory + "/statistics.txt";
    std::ifstream     file(name);
    AssertThrow(file, ExcMessage("Can't read the file <" + name + ">."));
    std::vector<std::string> columns;
    std::string              last;
    for (std::string line; std::getline(file, line);)
      if (!line.empty() && line[0] == '#')
        columns.push_back(
          line.substr(std::min(line.find(": ") + 2, line.size())));
      else if (!line.empty())
        last = line;
    AssertThrow(!last.empty(),
                ExcMessage("The file <" + name + "> holds no step."));
    if (names.empty())
      {
        names = columns;
        values.resize(names.size());
      }
    AssertThrow(columns == names,
                ExcMessage("The file <" + name +
                           "> has other columns than those of the other "
                           "offsets."));
    std::istringstream words(last);
    std::string        word;
    for (unsigned int c = 0; c < names.size() && words >> word; ++c)
      {
        char        *end   = nullptr;
        const double value = std::strtod(word.c_str(), &end);
        values[c].push_back(
          *end == '\0' ? value : std::numeric_limits<double>::quiet_NaN());
      }
  }



  void
  OffsetStatistics::add_failure(const unsigned int k,
                                const std::string &message)
  {
    failures.push_back("Offset " + std::to_string(k) + " failed: " + message);
  }



  void
  OffsetStatistics::print(std::ostream &out) const
  {
    std::size_t width = 10;
    for (const std::string &name : names)
      width = std::max(width, name.size());
    out << std::left << std::setw(width) << "statistic" << std::right;
    for (const char *head : {"mean", "std. dev.", "smallest", "largest"})
      out << std::setw(15) << head;
    out << '\n' << std::setprecision(6);
    for (unsigned int c = 0; c < names.size(); ++c)
      {
        const std::vector<double> &v = values[c];
        if (v.empty() || std::any_of(v.begin(), v.end(), [](const double x) {
              return std::isnan(x);
            }))
          continue;
        double mean = 0, square = 0;
        for (const double x : v)
          mean += x / v.size();
        for (const double x : v)
          square += (x - mean) * (x - mean);
        const auto range = std::minmax_element(v.begin(), v.end());
        out << std::left << std::setw(width) << names[c] << std::right
            << std::setw(15) << mean << std::setw(15)
            << (v.size() > 1 ? std::sqrt(square / (v.size() - 1)) : 0.)
            << std::setw(15) << *range.first << std::setw(15) << *range.second
            << '\n';
      }
    for (const std::string &failure : failures)
      out << failure << '\n';
  }
} // namespace isochor
