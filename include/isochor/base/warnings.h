/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_warnings_h
#define isochor_warnings_h

#include <string>
#include <vector>

namespace isochor
{
  /**
   * What a run has to say of results that should not be trusted without a
   * look, or of a scene that can hardly be meant. A warning doesn't stop the
   * run. Its text says in at most three lines what was measured, with its
   * number, what that means for the results, and what to do; everything else
   * is said by its Explanation.
   */
  class Warnings
  {
  public:
    struct Warning
    {
      /** What the warning is about: the same from step to step. */
      std::string subject;
      /** As it was first said. */
      std::string  text;
      unsigned int n_times = 0;
    };

    /** @p print: whether this rank writes them to the standard error, whatever
     * else of the run is printed. */
    void
    print_here(const bool print)
    {
      prints = print;
    }

    /** How a warning is printed: "warning [subject]: text", in lines of at
     * most 100 characters. */
    static std::string
    printed(const std::string &subject, const std::string &text);

    /**
     * Warn of @p subject, which has an Explanation. All ranks call it with the
     * same arguments, or rank 0 alone does. The text is printed the first time
     * that the subject comes up; later calls are counted.
     */
    void
    add(const std::string &subject, const std::string &text);

    const std::vector<Warning> &
    all() const
    {
      return warnings;
    }

    /** How many different ones there were, as the last line of a run: "No
     * warnings." or "2 warnings, see above: <subject> (7 times), <subject>." */
    std::string
    summary() const;

  private:
    std::vector<Warning> warnings;
    bool                 prints = false;
  };
} // namespace isochor

#endif
