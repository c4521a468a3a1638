/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_edit_distance_h
#define isochor_edit_distance_h

#include <algorithm>
#include <cctype>
#include <numeric>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The least number of insertions, deletions and replacements of characters
   * that turn one string into the other (Levenshtein 1966), blind to case.
   */
  inline unsigned int
  edit_distance(const std::string &a, const std::string &b)
  {
    const auto same = [](const unsigned char x, const unsigned char y) {
      return std::tolower(x) == std::tolower(y);
    };
    // row[j] is the distance of the first i characters of a to the first j of b
    std::vector<unsigned int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0u);
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        unsigned int diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j)
          {
            const unsigned int replaced = diagonal + !same(a[i], b[j]);
            diagonal                    = row[j + 1];
            row[j + 1] = std::min({replaced, row[j + 1] + 1, row[j] + 1});
          }
      }
    return row.back();
  }
} // namespace isochor

#endif
