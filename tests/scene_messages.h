/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_test_scene_messages_h
#define isochor_test_scene_messages_h

// What the program says of a scene.

#include "run_scene.h"

using namespace isochor;

/** A scene without a mistake. */
inline const std::string good =
  "Grid/Subdivisions = 4, 4\n"
  "Boundary conditions/Displacement = bottom: x = 0, y = 0\n"
  "Boundary conditions/Gravity = 0, -1\n";

/** The warnings and the error of a scene, in one line. */
template <int dim>
std::string
messages(const std::string &settings,
         const bool         validate    = true,
         const unsigned int n_materials = 1);

/** The messages have all @p words, and there is none but this one, or so many
 * in all. */
inline void
expect(const std::string              &what,
       const std::string              &message,
       const std::vector<std::string> &words,
       const unsigned int              n_messages = 1)
{
  std::string missing;
  for (const std::string &word : words)
    if (message.find(word) == std::string::npos)
      missing += " <" + word + ">";
  unsigned int n = 0;
  for (const std::string word : {"WARNING", "ERROR"})
    for (auto place = message.find(word); place != std::string::npos;
         place      = message.find(word, place + 1))
      ++n;
  test::check(what,
              missing.empty() && n == (words.empty() ? 0 : n_messages),
              std::to_string(n) + " messages, missing" + missing + ": " +
                message);
}

#endif
