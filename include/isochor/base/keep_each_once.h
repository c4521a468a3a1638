/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_keep_each_once_h
#define isochor_keep_each_once_h

#include <algorithm>
#include <vector>

namespace isochor
{
  /** Sort @p numbers, each of which may be there several times, and keep it
   * once. Where there are more of them than the largest one, as all cells of a
   * grid name all of their vertices, marking is faster than sorting. */
  inline void
  keep_each_once(std::vector<unsigned int> &numbers)
  {
    if (numbers.empty())
      return;
    const std::size_t n = *std::max_element(numbers.begin(), numbers.end()) + 1;
    if (numbers.size() < n)
      {
        std::sort(numbers.begin(), numbers.end());
        numbers.erase(std::unique(numbers.begin(), numbers.end()),
                      numbers.end());
        return;
      }
    std::vector<unsigned char> is_there(n, 0);
    for (const unsigned int i : numbers)
      is_there[i] = 1;
    numbers.clear();
    for (std::size_t i = 0; i < n; ++i)
      if (is_there[i])
        numbers.push_back(i);
  }
} // namespace isochor

#endif
