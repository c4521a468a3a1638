/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_work_tally_h
#define isochor_work_tally_h

#include <ostream>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * How often each kind of work was done in a run, and how often it could be
   * left out because what is there still holds. All ranks decide alike, so that
   * the numbers of one rank are those of all.
   */
  class WorkTally
  {
  public:
    struct Row
    {
      std::string        work;
      unsigned long long done = 0, skipped = 0;
    };

    /** Count @p work, a short phrase in the plural, @p times times. */
    void
    count(const std::string       &work,
          const bool               done,
          const unsigned long long times = 1);

    /** What was @p done of @p work, and what was not; all of it is 0 for work
     * that nobody has counted. */
    Row
    row(const std::string &work) const;

    const std::vector<Row> &
    rows() const
    {
      return table;
    }

    /** The table, and what the scene never needs, a list of phrases. */
    void
    print(std::ostream &out, const std::vector<std::string> &not_needed) const;

  private:
    std::vector<Row> table; ///< in the order in which they came up
  };
} // namespace isochor

#endif
