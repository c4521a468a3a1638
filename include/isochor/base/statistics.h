/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_statistics_h
#define isochor_statistics_h

#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * One row of named values per step, appended to `statistics.txt` in the
   * output directory: a comment line per column, then the rows. A column that
   * comes up later than in the first row, as that of a probe added at a
   * restart, is appended, the file written anew with nan in the rows before; a
   * value that isn't set in a row is nan there. Only the rank that calls open()
   * writes.
   */
  class Statistics
  {
  public:
    /** Write to @p file_name; after @p n_rows rows that are already there when
     * a run is resumed. */
    void
    open(const std::string &file_name, const unsigned int n_rows = 0);

    /** Columns are called "<owner>: <column>" from now on; not, if @p owner is
     * empty. */
    void
    set_owner(const std::string &owner)
    {
      prefix = owner.empty() ? "" : owner + ": ";
    }

    /** Set a value of the present row. */
    void
    set(const std::string &column, const double value);

    /** The value in the present row or, if it isn't set there (yet), in the
     * last one; for terminal output and tests. Throws if there is none. */
    double
    get(const std::string &column) const;

    /** Finish the row. Throws if it can't be written (full disk). */
    void
    end_row();

  private:
    /** Write the file anew with the present columns. */
    void
    rewrite();

    std::string                   file_name, prefix;
    std::ofstream                 file;
    std::vector<std::string>      columns;
    std::map<std::string, double> row, last_row;
    /** How many of the columns stand in the file. */
    std::size_t n_columns_written = 0;
  };
} // namespace isochor

#endif
