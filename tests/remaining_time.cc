/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The estimate of the time that a run still takes, from clocks that the test
// makes up.

#include <isochor/base/remaining_time.h>

#include "run_scene.h"

using namespace isochor;

void
test_estimate()
{
  RemainingTime remaining;
  test::check("nothing is known before the start",
              std::isnan(remaining.seconds_to(1)),
              std::to_string(remaining.seconds_to(1)));
  remaining.reached(2, 100);
  test::check("nothing is known before the first step",
              std::isnan(remaining.seconds_to(3)),
              std::to_string(remaining.seconds_to(3)));

  // 0.1 in 5 s, then 0.3 in 3 s: 0.4 in 8 s, so 0.6 in 12 s
  remaining.reached(2.1, 105);
  test::check_error("after one step",
                    std::abs(remaining.seconds_to(3) - 45),
                    1e-10);
  remaining.reached(2.4, 108);
  test::check_error("after two steps",
                    std::abs(remaining.seconds_to(3) - 12),
                    1e-10);
  test::check_error("at the end", std::abs(remaining.seconds_to(2.4)), 0.);

  // ten steps at a new pace, of different sizes, and the old one is forgotten
  double time = 2.4, wall = 108;
  for (unsigned int i = 0; i < 10; ++i)
    {
      const double size = (i % 2 == 0 ? 0.01 : 0.03);
      remaining.reached(time += size, wall += 100 * size);
    }
  test::check_error("after ten steps of another pace",
                    std::abs(remaining.seconds_to(3) - 40),
                    1e-10);
}

void
test_format()
{
  const std::vector<std::pair<double, std::string>> cases = {
    {0., "0 s"},
    {48.4, "48 s"},
    {59.7, "1 min"},
    {65., "1 min 5 s"},
    {599.7, "10 min"},
    {754., "13 min"},
    {3580., "1 h"},
    {4320., "1 h 12 min"},
    {35995., "10 h"},
    {40000., "11 h"},
    {86000., "1 d"},
    {2 * 86400. + 3 * 3600. + 100., "2 d 3 h"},
    {std::numeric_limits<double>::quiet_NaN(), ""}};
  for (const auto &[seconds, text] : cases)
    test::check("<" + text + ">",
                readable_duration(seconds) == text,
                readable_duration(seconds));
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_estimate();
  test_format();
  return 0;
}
