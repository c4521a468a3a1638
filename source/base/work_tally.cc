/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/work_tally.h>

#include <algorithm>
#include <iomanip>

namespace isochor
{
  void
  WorkTally::count(const std::string       &work,
                   const bool               done,
                   const unsigned long long times)
  {
    auto entry =
      std::find_if(table.begin(), table.end(), [&](const Row &existing) {
        return existing.work == work;
      });
    if (entry == table.end())
      entry = table.insert(table.end(), {work, 0, 0});
    (done ? entry->done : entry->skipped) += times;
  }



  WorkTally::Row
  WorkTally::row(const std::string &work) const
  {
    for (const Row &existing : table)
      if (existing.work == work)
        return existing;
    return {work, 0, 0};
  }



  void
  WorkTally::print(std::ostream                   &out,
                   const std::vector<std::string> &not_needed) const
  {
    out << "Work                                  done     skipped\n";
    for (const Row &entry : table)
      out << "  " << std::left << std::setw(28) << entry.work << std::right
          << std::setw(12) << entry.done << std::setw(12) << entry.skipped
          << '\n';
    if (!not_needed.empty())
      {
        out << "  not needed by this scene:";
        for (const std::string &item : not_needed)
          out << (item == not_needed.front() ? " " : ", ") << item;
        out << '\n';
      }
    out << std::endl;
  }
} // namespace isochor
