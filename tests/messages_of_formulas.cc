/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What is told of mistakes in formulas: words, commas and signs, conditions
// that compare nothing, regions that the points can't show.

#include <filesystem>

#include "scene_messages.h"

using namespace isochor;

namespace
{
  void
  test_formulas()
  {
    const std::string region = good + "Material points/Region = ";
    expect("and",
           messages<2>(region + "x < 1 and y < 1\n"),
           {"ERROR", "Material points/Region", "write '&&' instead of 'and'"});
    expect("OR",
           messages<2>(region + "x < 0.5 OR y < 0.5\n"),
           {"ERROR", "write '||' instead of 'OR'"});
    expect("not",
           messages<2>(region + "not (x > 0.5)\n"),
           {"ERROR", "there is no 'not'", "opposite comparison"});
    expect("what not is replaced by",
           messages<2>(region + "(x > 0.5) == 0\n"),
           {});
    expect("a comma that is missing",
           messages<2>("Grid/Subdivisions = 4, 4\nBoundary "
                       "conditions/Displacement = left: x=0 y=0\n"),
           {"ERROR", "a comma is missing before <y =...>"});
    expect("= for ==",
           messages<2>(region + "x = 1\n"),
           {"ERROR", "'=' assigns", "'=='"});
    const std::vector<std::vector<std::string>> slips = {
      {"y**2 - 0.5", "a^b, not a**b", "variables x,y, the"},
      {"2y < 1", "2*t, not 2t"},
      {"1e-3 + 2(y) < 1", "2*t, not 2t"},
      {"|y| < 1", "abs(a), not |a|"},
      {"log10(y) + .5e-1x < 1", "2*t, not 2t"},
      {"log10(y) + 1e-3*u < 1", "can't be read. Allowed"},
      {"y < time", "The time is t"}};
    for (const auto &slip : slips)
      {
        std::vector<std::string> words = slip;
        words[0]                       = "ERROR";
        expect("the slip " + slip[0],
               messages<2>(region + slip[0] + '\n'),
               words);
      }
    const std::string inside     = region + "x < 0.509\n";
    const std::string no_domains = "Quadrature/Type = points\n"
                                   "Material points/Points per cell = 4\n";
    expect("a region that is a little larger than the points' cells",
           messages<2>(inside + no_domains),
           {}); // 1.8 %
    expect("the same of a body of revolution",
           messages<2>(inside + no_domains +
                       "Formulation/Geometry = axisymmetric\n"),
           {"WARNING rounded to the points",
            "stand for 0.7854 m^3, 3.", // 3.5, by samples of the cells
            "less"});
    expect("... whose domains are cut",
           messages<2>(inside + "Formulation/Geometry = axisymmetric\n"),
           {});
    expect("a region that compares nothing",
           messages<2>(region + "y\n"),
           {"WARNING a condition that compares nothing",
            "<Material points/Region>",
            "'y < 0.5'"});
    for (const std::string formula :
         {"0.25 - y", "if(x, y, x)", "x + y > 0", "2"})
      expect("the region " + formula, messages<2>(region + formula + '\n'), {});
  }

  /** Formulas that stand for conditions hold where they are above 0. */
  void
  test_conditions()
  {
    const std::string zones = "Material points/Materials in zones = 2: ";
    const auto        of    = [&](const std::string &settings) {
      return messages<2>(good + settings + '\n', true, 2);
    };
    expect("a zone that compares nothing",
           of(zones + "y"),
           {"WARNING a condition that compares nothing",
            "<y>",
            "Material points/Materials in zones",
            "in 100 % of the places",
            "values from 0.04167 to 0.9583",
            "'y < 0.5'"});
    expect("... of numbers of points",
           of("Material points/Points per cell in zones = 9: x; 4: x < 2\n" +
              zones + "y < 0.5"),
           {"WARNING", "<x>", "Material points/Points per cell in zones"});
    for (const std::string formula : {"y - 0.5",
                                      "0.5 - y",
                                      "if(y > 0.5, 1, 0)",
                                      "y > 0.5",
                                      "1",
                                      "2",
                                      "floor(y + 0.5)"})
      expect("the zone " + formula, of(zones + formula), {});
    const std::string surface =
      "Boundary conditions/Traction on body = S: 0, "
      "-t\nBoundary conditions/Surfaces of body = S: ";
    expect("a surface that compares nothing",
           of(zones + "y < 0.5\n" + surface + "y"),
           {"WARNING a condition that compares nothing",
            "<y>",
            "Boundary conditions/Surfaces of body",
            "values from 0.04167 to 0.9583"});
    expect("... and one below 0 elsewhere",
           of(zones + "y < 0.5\n" + surface + "y - 0.99"),
           {});
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  std::filesystem::create_directory("scene_checks");
  test_formulas();
  test_conditions();
  return 0;
}
