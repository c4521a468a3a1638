/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Coulomb friction on a rigid half plane: the force of a block that slides,
// when it begins to, what it dissipates; adhesion and the cap on the shear
// stress; restart, units and where the origin is.

#include <array>
#include <exception>

#include "run_scene.h"

using namespace isochor;

namespace
{
  const std::string floor_at = "Interaction: foot - floor/";

  std::string
  number(const double value)
  {
    std::ostringstream text;
    text.precision(17);
    text << '(' << value << ')';
    return text.str();
  }

  /** A block on a half plane; lengths in units of @p L, stresses in units of
   * @p P; @p X: where its corner is; @p swap: x and y exchanged. */
  struct Block
  {
    double L = 1, P = 1, X = 0, Y = 0;
    bool   swap = false;

    std::string
    pair(const double x, const double y) const
    {
      const auto text = [](const double value) {
        std::ostringstream out;
        out.precision(17);
        out << value;
        return out.str();
      };
      return swap ? text(y) + ", " + text(x) : text(x) + ", " + text(y);
    }

    std::string
    scene(const std::string &law) const
    {
      const std::string x =
                          (swap ? "(y-" : "(x-") + number(X) + ")/" + number(L),
                        y =
                          (swap ? "(x-" : "(y-") + number(Y) + ")/" + number(L),
                        in = x + ">0 && " + x + "<1 && " + y + ">0 && " + y +
                             "<0.5";
      return "Quadrature/Type = CPDI\nGrid/Lower corner = " +
             pair(X - 0.32 * L, Y - 0.23 * L) +
             "\nGrid/Upper corner = " + pair(X + 2.08 * L, Y + 0.77 * L) +
             "\nGrid/Subdivisions = " + (swap ? "10, 24" : "24, 10") +
             "\nMaterial points/Region = " + in +
             "\nMaterial points/Points per cell = 4\n"
             "Newton/Tolerance = 1e-10\n"
             "Material/Poisson ratio = 0.3\nMaterial/Young modulus = " +
             number(1000 * P).substr(1, number(1000 * P).size() - 2) +
             "\nRigid body: floor/Shape = half plane\n"
             "Rigid body: floor/Point = " +
             pair(X, Y) + "\nRigid body: floor/Normal = " + pair(0, 1) + '\n' +
             "Boundary conditions/Surfaces of body = foot: " + y +
             "<0.2; top: " + y + ">0.45\n" + floor_at + "Law = Coulomb\n" + law;
    }

    /** Its upper side is pressed down and then moved along. */
    std::string
    dragged(const std::string &law) const
    {
      const std::string l = number(L);
      return scene(law) +
             "Interaction: top - place/Displacement = " + (swap ? "y" : "x") +
             "=if(t>0.4,0.4*(t-0.4),0)*" + l + ", " + (swap ? "x" : "y") +
             "=-0.05*min(t/0.4,1)*" + l + "\nTime/Step size = 0.1\n";
    }

    /** Along and across. */
    std::array<double, 2>
    force(const MaterialPointMethod<2> &problem) const
    {
      std::array<double, 2> f;
      for (unsigned int a = 0; a < 2; ++a)
        f[a] = test::get(problem,
                         std::string("Force ") + "xy"[swap ? 1 - a : a] +
                           " on foot by floor (N)") /
               (P * L);
      return f;
    }
  };

  const std::string mu = floor_at + "Friction coefficient = 0.3\n";

  void
  test_dragged()
  {
    const Block block;
    for (const std::string form : {"u", "u-p"})
      {
        const auto problem = test::run_scene<2>(
          block.dragged(mu) + "Formulation/Type = " + form + '\n');
        const auto f = block.force(*problem);
        test::check("a block is pressed on, " + form,
                    f[1] > 50,
                    test::in_short(f[1]));
        test::check_error("T/N of a block that slides, " + form,
                          std::abs(f[0] / f[1] + 0.3),
                          1e-8);
        const auto sticks = block.force(*test::run_scene<2>(
          block.dragged(mu) +
          "Time/End time = 0.5\nFormulation/Type = " + form + '\n'));
        test::check("it sticks before, " + form,
                    std::abs(sticks[0] / sticks[1]) < 0.29,
                    test::in_short(sticks[0] / sticks[1]));
      }
    const auto f = block.force(
      *test::run_scene<2>(block.dragged(mu + floor_at + "Adhesion = 5\n")));
    // on 1 m² at t = 0, which is now a little longer
    test::check_error("adhesion", std::abs(-f[0] - 0.3 * f[1] - 5), 0.3);
    const auto capped = block.force(*test::run_scene<2>(
      block.dragged(mu + floor_at + "Largest shear stress = 10\n")));
    test::check_error("the cap on the shear stress",
                      std::abs(-capped[0] - 10),
                      0.6);
  }

  /** Whether a block on a slope, its gravity turned instead, finds an
   * equilibrium at tan = @p slope. */
  bool
  stays(const double slope)
  {
    try
      {
        test::run_scene<2>(Block().scene(mu) +
                           "Material/Density = 1\nTime/Step size = 0.25\n"
                           "Time/Minimum step size = 0.05\n"
                           "Boundary conditions/Gravity = " +
                           number(20 * slope) +
                           "*max(0, 2*t-1), -20*min(1, 2*t)\n");
      }
    catch (const std::exception &)
      {
        return false;
      }
    return true;
  }

  /** While the block slides steadily the work of what moves it goes into
   * friction: μ N s, but for what the strain energy changes by. */
  void
  test_dissipation()
  {
    test::record_columns({"Force x on top by place (N)",
                          "Force x on foot by floor (N)",
                          "Force y on foot by floor (N)",
                          "Strain energy (J)"});
    const auto problem = test::run_scene<2>(
      Block().dragged(mu) + "Time/End time = 2\n"
                            "Postprocess/Write energies = always\n");
    const auto &columns = test::recorded().columns;
    const auto &pull    = columns.at("Force x on top by place (N)"),
               &N       = columns.at("Force y on foot by floor (N)"),
               &energy  = columns.at("Strain energy (J)");
    const double s      = 0.04;
    double       work = 0, friction = 0;
    unsigned int first = pull.size() / 2;
    for (unsigned int i = first + 1; i < pull.size(); ++i)
      {
        work += s * (pull[i] + pull[i - 1]) / 2;
        friction += s * 0.3 * (N[i] + N[i - 1]) / 2;
      }
    test::check_error("friction dissipates μ N s",
                      test::relative(work - (energy.back() - energy[first]),
                                     friction),
                      0.01);
    test::record_columns({});
  }

  void
  test_alike()
  {
    const auto reference =
      Block().force(*test::run_scene<2>(Block().dragged(mu)));
    const auto error = [&](const Block &block) {
      const auto f = block.force(*test::run_scene<2>(block.dragged(mu)));
      return std::max(std::abs(f[0] - reference[0]),
                      std::abs(f[1] - reference[1])) /
             reference[1];
    };
    Block mm, far, swapped;
    mm.L         = 1000;
    mm.P         = 1e-6;
    far.X        = 1000;
    far.Y        = -500;
    swapped.swap = true;
    test::check_error("in mm and MPa", error(mm), 1e-9);
    test::check_error("moved by 1000 sizes", error(far), 1e-10);
    test::check_error("x and y exchanged", error(swapped), 1e-9);
    std::ostringstream out;
    out.precision(7);
    out << reference[0] << ' ' << reference[1];
    if (test::this_rank() == 0)
      std::cout << "Forces: " << out.str() << std::endl;
  }

  void
  test_restart()
  {
    const std::string scene = Block().dragged(mu) + "Checkpoint/Interval = 1\n";
    for (const std::string &grid : {std::string(), test::keep_grid})
      {
        const std::string what =
          grid.empty() ? "a run that is resumed" : "and on a grid that is kept";
        const auto whole = Block().force(*test::run_scene<2>(scene + grid));
        test::run_scene<2>(scene + grid + "Time/End time = 0.7\n");
        const auto resumed = Block().force(
          *test::run_scene<2>(scene + grid + "Checkpoint/Resume = true\n"));
        const double difference = std::max(std::abs(resumed[0] - whole[0]),
                                           std::abs(resumed[1] - whole[1]));
        test::check_error(what, difference, test::n_ranks() == 1 ? 0 : 1e-7);
      }
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_dragged();
  test::check("a block on a slope of 0.99 of its friction",
              stays(0.99 * 0.3),
              "slides");
  test::check("a block on a slope of 1.01 of it", !stays(1.01 * 0.3), "stays");
  test_dissipation();
  test_alike();
  test_restart();
  return 0;
}
