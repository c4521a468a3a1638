/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_offsets_h
#define isochor_grid_offsets_h

#include <iosfwd>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * The value of the parameter `Grid/Offset` of run @p k of several: the points
   * of an additive sequence that fill the cube [-1/2, 1/2)^dim evenly, however
   * many there are (the R-sequence: multiples of the powers of 1/g, g the root
   * of g^(dim+1) = g + 1, modulo one). The first is no offset at all.
   */
  std::string
  grid_offset(const unsigned int k, const unsigned int dim);

  /**
   * What the place of the grid below the body decides: mean and spread of each
   * statistic at the end of runs that differ in `Grid/Offset` only. The spread
   * is the error bar of a result, the part of its error that a finer grid would
   * take away.
   */
  class OffsetStatistics
  {
  public:
    /** Read the last line of `statistics.txt` in @p directory, which a run
     * ended with. Throws if it can't be read or has other columns than those
     * before. */
    void
    add(const std::string &directory);

    /** A run that failed. */
    void
    add_failure(const unsigned int k, const std::string &message);

    /** A table: mean, standard deviation, smallest and largest value of each
     * number, then the runs that failed. */
    void
    print(std::ostream &out) const;

    unsigned int
    n_failures() const
    {
      return failures.size();
    }

  private:
    std::vector<std::string>         names;
    std::vector<std::vector<double>> values; ///< by column, then by run
    std::vector<std::string>         failures;
  };
} // namespace isochor

#endif
