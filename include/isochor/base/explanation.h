/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_explanation_h
#define isochor_explanation_h

#include <string>
#include <vector>

namespace isochor
{
  /** The longer text of a warning: `isochor --explain NAME` prints it, and
   * doc/warnings.md is made of all of them. */
  struct Explanation
  {
    /** As in Warnings::add(); what is in angle brackets stands for any name. */
    std::string name;
    /** Results are wrong without it, or the scene can hardly be meant; others
     * are advice. */
    bool        is_essential;
    std::string when;   ///< what is measured, and what it means for results
    std::string remedy; ///< what to do
  };

  /** Make an explanation known. Called from static objects before main(). */
  bool
  explain(const Explanation &explanation);

  /** Sorted by name. */
  std::vector<Explanation>
  all_explanations();

  /** That of a warning, nullptr if there is none. */
  const Explanation *
  find_explanation(const std::string &warning);

  /** What `--explain` prints: the explanation of @p name; of those that begin
   * with it, if there is none; a list of names if it is empty; "all": the
   * table of doc/warnings.md. @throws ExcMessage with the list if there is no
   * such name. */
  std::string
  explanation_text(const std::string &name);

  /** @p text in lines of at most @p width characters, all but the first one
   * indented. */
  std::string
  wrapped(const std::string &text, const unsigned int width = 100);
} // namespace isochor

/** Explain a warning that is issued in the same file. @p id: any identifier,
 * another one for each. */
#define ISOCHOR_EXPLAIN(id, name, is_essential, when, remedy) \
  [[maybe_unused]] static const bool isochor_explained_##id = \
    ::isochor::explain({name, is_essential, when, remedy});

/** is_essential of ISOCHOR_EXPLAIN. */
#define ISOCHOR_ESSENTIAL true
#define ISOCHOR_ADVICE false

#endif
