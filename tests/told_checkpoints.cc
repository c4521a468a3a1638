/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What a run tells of checkpoints: where it goes on from, and which of an
// earlier run it takes the place of.

#include "run_scene.h"

using namespace isochor;

/** What the program prints. */
std::string
printed(const std::string &settings)
{
  std::ostringstream    text;
  std::streambuf *const terminal = std::cout.rdbuf(text.rdbuf());
  test::run_scene<2>("Grid/Subdivisions = 2, 2\nFormulation/Type = u\n"
                     "Material/Young modulus = 1e6\nBoundary conditions/"
                     "Displacement = bottom: x=0, y=0; top: y=-1e-3*t\n"
                     "Time/Step size = 0.25\nCheckpoint/Interval = 1\n"
                     "Output/Terminal = progress\n" +
                     settings);
  std::cout.rdbuf(terminal);
  return test::one_line(text.str());
}

void
expect(const std::string              &what,
       const std::string              &text,
       const std::vector<std::string> &words)
{
  bool has_all = true;
  for (const std::string &word : words)
    has_all = has_all && text.find(word) != std::string::npos;
  test::check(what, has_all, text);
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string slot : {"0", "1"})
    for (const std::string ending : {"", ".old"})
      std::remove(("checkpoint-" + slot + ".0000.bin" + ending).c_str());
  test::check("nothing to tell of a first run",
              printed("Time/End time = 0.75\n").find("heckpoint") ==
                std::string::npos,
              "");
  expect("where a run goes on from",
         printed("Checkpoint/Resume = true\n"),
         {"Resumed after step 3, t = 0.75",
          "What was written after it is replaced"});
  expect("which checkpoints a run takes the place of",
         printed(""),
         {"The checkpoints of an earlier one in",
          "after step 3, t = 0.75",
          "after step 4, t = 1",
          "are kept with the ending '.old'"});
  return 0;
}
