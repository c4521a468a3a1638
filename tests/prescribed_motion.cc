/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Motions that begin smoothly, of a boundary of the grid or of the body's
// surface, need the force M ü from the first step on. Started with anything but
// what the scheme follows them with, the force alternates about it.

#include <isochor/dynamics/time_integrator.h>
#include <isochor/postprocess/postprocessor.h>

#include "scene.h"

using namespace isochor;

namespace
{
  /** The reaction in each step, by a column of the statistics, and the times.
   */
  std::vector<std::pair<double, double>> reactions;
  std::string                            column;

  std::unique_ptr<TimeIntegrator>
  make_scheme(const std::string &name, const std::string &rho)
  {
    ParameterHandler prm;
    TimeIntegrator::declare_schemes(prm);
    prm.set("Inertia", true);
    prm.set("Scheme", name);
    prm.set("Spectral radius", rho);
    return TimeIntegrator::create(prm);
  }

  /** Places of @p u at the ends of a step from t = 0.3 and between. */
  template <typename Motion>
  MotionAtStart
  motion_of(const Motion &u, const double dt)
  {
    std::array<double, n_motion_places> places;
    for (unsigned int k = 0; k < n_motion_places; ++k)
      places[k] = u(0.3 + k * dt / 3);
    return motion_of_step(places, dt);
  }

  void
  test_places()
  {
    const auto cubic = [](const double t) {
      return 7 + t * (2 - t * (1 - 3 * t));
    };
    const MotionAtStart m   = motion_of(cubic, 0.1);
    const MotionAtStart end = m.after(0.1);
    test::check_error("a cubic motion",
                      std::max({std::abs(m.velocity - (2 - 0.6 + 0.81)),
                                std::abs(m.acceleration - (-2 + 5.4)),
                                std::abs(m.jerk - 18),
                                std::abs(end.velocity - (2 - 0.8 + 1.44)),
                                std::abs(end.acceleration - (-2 + 7.2))}),
                      1e-10);
    const auto line    = [](const double t) { return 7 + t / 3; };
    const auto of_line = motion_of(line, 0.1);
    test::check_error("no acceleration from rounding",
                      std::abs(of_line.velocity - 1. / 3) +
                        std::abs(of_line.acceleration) + std::abs(of_line.jerk),
                      1e-12);
    // the whole increment is that of the places; no change of sign
    const auto bend    = [](const double t) { return std::max(0., t - 0.33); };
    const auto of_bend = motion_of(bend, 0.1), at_end = of_bend.after(0.1);
    test::check_error("a bend in the step",
                      std::abs(0.1 * (of_bend.velocity +
                                      0.1 * (of_bend.acceleration / 2 +
                                             0.1 * of_bend.jerk / 6)) -
                               0.07),
                      1e-14);
    test::check("a bend in the step: no change of sign",
                of_bend.acceleration > -1e-12 && at_end.acceleration > -1e-12,
                std::to_string(at_end.acceleration));
  }

  /** A mass that is made to move by t² + 2 t³. */
  void
  test_scheme(const std::string &name, const std::string &rho)
  {
    const auto   scheme = make_scheme(name, rho);
    const double dt     = 0.1;
    const auto   u      = [](const double t) {
      return (t - 0.3) * (t - 0.3) * (1 + 2 * (t - 0.3));
    };
    auto [v, a]  = scheme->smooth_start(dt).of(motion_of(u, dt));
    double error = 0;
    for (unsigned int i = 0; i < 10; ++i)
      {
        const double t     = 0.3 + i * dt;
        const double new_a = scheme->acceleration(u(t + dt) - u(t), v, a, dt);
        test::add_error(error,
                        std::abs(scheme->inertial_acceleration(a, new_a) -
                                 (2 + 12 * (t + dt - 0.3))));
        v = scheme->velocity(v, a, new_a, dt);
        a = new_a;
      }
    test::check_error(name + ", rho " + rho + ": the force of a motion",
                      error,
                      1e-9);
  }

  /** A block, stiff against anything that the steps resolve, drawn by @p u(t)
   * at its right end; @p acceleration(t) is that of the motion. */
  template <int dim, typename Acceleration>
  void
  test_block(const std::string  &what,
             const std::string  &u,
             const Acceleration &acceleration,
             const std::string  &settings,
             const double        tolerance)
  {
    const bool        solid  = (dim == 3);
    const double      mass   = solid ? 0.25 : 0.5;
    const std::string sides  = "bottom: y=0; top: y=0";
    const std::string width  = solid ? ", 0.5, 0.5" : ", 0.5";
    const std::string across = solid ? ", 2, 2" : ", 4";
    const std::string scene =
      "Material/Young modulus = 1e10\nMaterial/Density = 1\n"
      "Dynamics/Inertia = true\nTime/Step size = 0.005\n"
      "Time/End time = 0.05\n";
    for (const bool of_body : {true, false})
      {
        reactions.clear();
        column =
          of_body ? "Force x on tip by place (N)" : "Reaction x on right (N)";
        test::run_scene<dim>(
          scene + settings +
          (of_body ?
             "Grid/Upper corner = 1.5" + width +
               "\nGrid/Subdivisions = " + (solid ? "6" : "12") + across +
               "\nMaterial points/Region = x < 1\n"
               "Boundary conditions/Displacement = " +
               sides + (solid ? "; front: z=0; back: z=0" : "") +
               "\nQuadrature/Type = CPDI\n"
               "Boundary conditions/Surfaces of body = tip: x > 0.999\n"
               "Interaction: tip - place/Displacement = x=" +
               u + "\n" :
             "Grid/Upper corner = 1" + width +
               "\nGrid/Subdivisions = " + (solid ? "4" : "8") + across + "\n" +
               test::keep_grid + "Boundary conditions/Displacement = " + sides +
               (solid ? "; front: z=0; back: z=0" : "") + "; right: x=" + u +
               "\nPostprocess/Reactions = right\n"));
        double worst = 0;
        for (const auto &[time, force] : reactions)
          test::add_error(worst,
                          test::relative(force, mass * acceleration(time)));
        const std::string name =
          what + (of_body ? ", surface of the body" : ", boundary of the grid");
        test::check(name + ": all steps",
                    reactions.size() == 10,
                    std::to_string(reactions.size()));
        test::check_error(name, worst, tolerance);
      }
  }
} // namespace

namespace isochor
{
  /** Keeps what the force on the right end is. */
  template <int dim>
  class ReactionHistory : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      reactions.emplace_back(result.step.time, statistics.get(column));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor,
                                 ReactionHistory,
                                 "Z: reaction history")
} // namespace isochor

/** A block of 1000 kg whose base is moved on a grid that is refined once around
 * it: the gap that the penalty leaves is that of the cells before. */
void
test_refined_base(const std::string &formulation)
{
  reactions.clear();
  column = "Force y on base by place (N)";
  test::run_scene<2>(
    "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
    "Grid/Upper corner = 1, 1.5\nGrid/Subdivisions = 4, 6\n"
    "Adaptive grid/Maximum level = 2\n"
    "Adaptive grid/Cell size = if(t > 0.19, 0.06, 0.25)\n"
    "Material points/Region = (x < 0.5) * (y < 1)\nQuadrature/Type = CPDI\n"
    "Material/Young modulus = 1e9\nMaterial/Poisson ratio = 0.3\n"
    "Material/Density = 1000\nDynamics/Inertia = true\n"
    "Boundary conditions/Surfaces of body = base: bottom\n"
    "Interaction: base - place/Displacement = x=0, y=0.05*t^3\n"
    "Newton/Tolerance = 1e-12\nTime/Step size = 0.05\nTime/End time = 0.5\n"
    "Formulation/Type = " +
    formulation + '\n');
  double worst = 0;
  for (const auto &[time, force] : reactions)
    test::add_error(worst, test::relative(force, 500 * 0.3 * time));
  test::check_error("a base on a grid that is refined there, " + formulation,
                    worst,
                    0.01);
}

/** A stiff block on a grid that is kept, pushed by what @p conditions say from
 * its end @p side, needs its mass times @p acceleration(t). */
template <int dim, typename Acceleration>
void
test_pushed(const std::string  &what,
            const std::string  &side,
            const std::string  &conditions,
            const Acceleration &acceleration,
            const std::string  &settings)
{
  const bool solid = (dim == 3);
  reactions.clear();
  column = conditions.find("n>=") == std::string::npos ?
             "Reaction x on " + side + " (N)" :
             "Force x on body by boundary " + side + " (N)";
  test::run_scene<dim>(
    "Material/Young modulus = 1e10\nMaterial/Density = 1\n"
    "Dynamics/Inertia = true\nTime/Step size = 0.005\n"
    "Time/End time = 0.05\nPostprocess/Reactions = " +
    side + "\nGrid/Upper corner = 1, 0.5" + (solid ? ", 0.5" : "") +
    "\nGrid/Subdivisions = " + (solid ? "4, 2, 2" : "8, 4") + "\n" +
    test::keep_grid + settings +
    "Boundary conditions/Displacement = bottom: y=0; top: y=0" +
    (solid ? "; front: z=0; back: z=0" : "") + conditions + "\n");
  double     worst   = 0;
  const bool is_wall = conditions.find("n>=") != std::string::npos;
  for (const auto &[time, force] : reactions)
    {
      // interactions report the mean over the step
      const double a = is_wall ?
                         (acceleration(time) + acceleration(time - 0.005)) / 2 :
                         acceleration(time);
      test::add_error(worst,
                      std::abs(force - (solid ? 0.25 : 0.5) * a) /
                        (1e-8 + std::abs(a)));
    }
  test::check(what + ": all steps",
              reactions.size() >= 10,
              std::to_string(reactions.size()));
  test::check_error(what, worst, 1e-3);
}

/** What pushes otherwise than held nodes: one-sided walls. */
template <int dim, typename Acceleration>
void
test_all_pushed(const std::string  &what,
                const std::string  &u,
                const Acceleration &acceleration,
                const std::string  &settings)
{
  // what starts with a jerk pushes with 0.87, 2.44, 3.60 N in place of 0.75,
  // 2.25, 3.75 N first
  if (settings.find("CPDI") != std::string::npos && what[2] != '3')
    test_pushed<dim>(what + ", one-sided wall",
                     "left",
                     "\nBoundary conditions/Walls = left: n>=" + u,
                     acceleration,
                     settings);
}

/** Where the formula of a motion changes its branch, at time @p t, a step ends;
 * where it doesn't (t < 0), there are as many as without. */
void
test_jump(const std::string &conditions, const double t)
{
  reactions.clear();
  column = "Mass (kg)"; // which there is in all scenes
  test::run_scene<2>("Material/Young modulus = 1e10\nMaterial/Density = 1\n"
                     "Dynamics/Inertia = true\nTime/Step size = 0.005\n"
                     "Time/End time = 0.05\nGrid/Upper corner = 1, 0.5\n"
                     "Grid/Subdivisions = 4, 2\n" +
                     std::string(test::keep_grid) +
                     "Boundary conditions/Displacement = bottom: y=0; top: "
                     "y=0" +
                     conditions + "\n");
  const bool lands =
    std::any_of(reactions.begin(), reactions.end(), [t](const auto &row) {
      return std::abs(row.first - t) < 1e-12;
    });
  test::check("a jump of " + conditions.substr(conditions.rfind(':') + 2),
              t < 0 ? reactions.size() == 10 : lands,
              std::to_string(reactions.size()));
}

void
test_jumps()
{
  const std::string start = "\nBoundary conditions/";
  test_jump("; right: x=max(0,t-0.02)", 0.02);
  test_jump("; right: x=max(0,t-0.0223)", 0.0223);
  test_jump(start + "Surfaces of body = tip: right\nQuadrature/Type = CPDI"
                    "\nInteraction: tip - place/Displacement = "
                    "x=max(0,t-0.0211)",
            0.0211);
  test_jump("; right: x=100*max(0,t-0.0223)^2", 0.0223);
  test_jump("; right: x=1e4*max(0,t-0.0223)^3", 0.0223);
  for (const std::string smooth :
       {"t", "1-cos(300*t)", "1e-6*(t+1e-3*sin(100*t))"})
    test_jump("; right: x=" + smooth, -1);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  test_places();
  for (const std::string rho : {"1", "0.9", "0.5", "0"})
    test_scheme("Bossak", rho);
  test_scheme("Newmark", "1");

  const auto jerk     = [](const double t) { return 600 * t; };
  const auto waves    = [](const double t) { return 100 * std::cos(10 * t); };
  const std::string u = "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n",
                    // the stresses are 1e-9 of the modulus: at the default
                    // tolerance forces err by up to 2 % in single steps
    mixed                   = "Formulation/Type = u-p\n"
                              "Material/Poisson ratio = 0.5\n"
                              "Newton/Tolerance = 1e-10\n",
                    domains = "Quadrature/Type = CPDI\n";
  test_block<2>("t^3, 2D, u", "100*t^3", jerk, u + domains, 2e-3);
  test_block<2>("t^3, 2D, u-p", "100*t^3", jerk, mixed + domains, 2e-3);
  test_block<3>("t^3, 3D, u", "100*t^3", jerk, u + domains, 2e-3);
  test_block<3>("t^3, 3D, u-p", "100*t^3", jerk, mixed + domains, 2e-3);
  test_block<2>("1 - cos, 2D, u", "1 - cos(10*t)", waves, u + domains, 2e-3);
  test_all_pushed<2>("t^3, 2D, u", "100*t^3", jerk, u + domains);
  test_all_pushed<2>("t^3, 2D, u-p", "100*t^3", jerk, mixed + domains);
  test_all_pushed<3>("t^3, 3D, u", "100*t^3", jerk, u + domains);
  test_all_pushed<2>(
    "t^2, 2D, u", "10*t^2", [](const double) { return 20.; }, u + domains);
  test_all_pushed<2>("1 - cos, 2D, u", "1 - cos(10*t)", waves, u + domains);
  // a wall that leaves takes nothing along
  const auto rest = [](const double) { return 0.; };
  test_pushed<2>("a wall that leaves",
                 "left",
                 "\nBoundary conditions/Walls = left: n>=-100*t^3",
                 rest,
                 u + domains);
  test_jumps();
  test_refined_base("u");
  test_refined_base("u-p");
  return 0;
}
