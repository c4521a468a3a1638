/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies whose ends are tied to rigid bodies: against the same motion of the
// surface by formulas, equilibrium of forces and moments, loads instead of
// motions, bending and torsion in closed form, and a mass on a spring.

#include <isochor/base/finite_rotation.h>

#include "round_bar.h"
#include "scene.h"

using namespace isochor;
using test::get;
using test::get_vector;
using test::relative;

namespace
{
  using Vector3 = Tensor<1, 3>;

  /** A rigid body NAME whose reference point is @p centre, with @p settings,
   * that the surface "NAME side" is tied to. */
  std::string
  end(const std::string &name,
      const std::string &centre,
      const std::string &settings = "")
  {
    std::string        text, line;
    std::istringstream lines(settings);
    while (std::getline(lines, line))
      text += "Rigid body: " + name + "/" + line + '\n';
    return "Quadrature/Type = CPDI\nRigid body: " + name +
           "/Shape = half plane\nRigid body: " + name + "/Point = " + centre +
           '\n' + text + "Interaction: " + name + " side - " + name +
           "/Law = tie\n";
  }

  const std::string sides = "Boundary conditions/Surfaces of body = ",
                    up_and_down =
                      sides + "bottom side: y < 0.001; top side: y > 0.999\n";

  /** A unit block with room in the grid; its lower end is fixed. */
  template <int dim>
  std::string
  block()
  {
    return std::string(
             dim == 2 ?
               "Grid/Lower corner = -0.5, -0.25\nGrid/Upper corner = 1.5, "
               "1.5\nGrid/Subdivisions = 8, 7\n"
               "Material points/Region = x>0 && x<1 && y>0 && y<1\n" :
               "Grid/Lower corner = -0.5, -0.5, -0.5\nGrid/Upper corner = 1.5, "
               "1.5, 1.5\nGrid/Subdivisions = 4, 4, 4\nMaterial points/Region "
               "= x>0 && x<1 && y>0 && y<1 && z>0 && z<1\n") +
           "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
           "Formulation/Type = u\nNewton/Tolerance = 1e-11\n"
           "Newton/Reuse factorisation = 0\n" +
           up_and_down + end("bottom", dim == 2 ? "0.5, 0" : "0.5, 0, 0.5");
  }

  template <int dim>
  std::string
  top(const std::string &settings)
  {
    return end("top", dim == 2 ? "0.5, 1" : "0.5, 1, 0.5", settings);
  }

  /** The force on the body by @p end, and the moment about its reference
   * point. */
  template <int dim>
  std::pair<Vector3, Vector3>
  resultant(const MaterialPointMethod<dim> &problem, const std::string &end)
  {
    Vector3 force, moment;
    for (unsigned int a = 0; a < dim; ++a)
      force[a] = get(problem,
                     std::string("Force ") + "xyz"[a] + " on " + end +
                       " side by " + end + " (N)");
    for (unsigned int a = (dim == 2 ? 2 : 0); a < 3; ++a)
      moment[a] = get(problem,
                      "Moment" + (dim == 2 ? "" : std::string(" ") + "xyz"[a]) +
                        " on " + end + " side by " + end + " (N m)");
    return {force, moment};
  }

  /** Translation and rotation of the upper end. */
  template <int dim>
  std::vector<double>
  place(const MaterialPointMethod<dim> &problem)
  {
    std::vector<double> values;
    for (unsigned int a = 0; a < dim; ++a)
      values.push_back(
        get(problem,
            std::string("Translation ") + "xyz"[a] + " of rigid body top (m)"));
    for (unsigned int a = (dim == 2 ? 2 : 0); a < 3; ++a)
      values.push_back(get(problem,
                           "Rotation" +
                             (dim == 2 ? "" : std::string(" ") + "xyz"[a]) +
                             " of rigid body top (rad)"));
    return values;
  }

  /** Whether residuals of the last step fell quadratically at its end. */
  void
  check_order(const std::string &what)
  {
    const auto         &rows = test::recorded().newton.back().iterations;
    std::vector<double> r;
    std::string         list;
    for (const auto &row : rows)
      if (row.displacement > 1e-13)
        r.push_back(row.displacement);
    bool ok = rows.size() < 12;
    for (unsigned int k = 0; k < r.size(); ++k)
      {
        list += test::in_short(r[k]) + " ";
        if (k > 1 && r[k - 1] < 1e-3 && r[k] > 1e-10 &&
            r[k] > 100 * r[k - 1] * r[k - 1])
          ok = false;
      }
    test::check("quadratic convergence, " + what, ok, list);
  }

  std::string
  text(const double value)
  {
    std::ostringstream out;
    out.precision(17);
    out << value << "*t";
    return out.str();
  }
} // namespace

/** A prescribed motion, and the same by formulas for the surface. */
void
test_prescribed(const std::string &name, const std::string &settings)
{
  const auto by_body = test::run_scene<2>(
    block<2>() + settings +
    end("top", "0.3, 0.8", "Motion = x=0.1*t, y=0.05*t, rotation=0.4*t"));
  check_order(name);
  const auto by_formulas = test::run_scene<2>(
    block<2>() + settings +
    "Interaction: top side - place/Displacement = "
    "x = 0.1*t + (cos(0.4*t)-1)*(x-0.3) - sin(0.4*t)*(y-0.8), "
    "y = 0.05*t + sin(0.4*t)*(x-0.3) + (cos(0.4*t)-1)*(y-0.8)\n");
  const Vector3 force = resultant(*by_body, "top").first;
  for (unsigned int a = 0; a < 2; ++a)
    test::check_error(std::string("by a rigid body and formulas, ") + name +
                        ", " + "xy"[a],
                      relative(force[a],
                               get(*by_formulas,
                                   std::string("Force ") + "xy"[a] +
                                     " on top side by place (N)")),
                      1e-9);
}

/** Equilibrium of both ends of a block; then the loads that have been found are
 * applied, and the motion must come back. */
template <int dim>
void
test_loads(const std::string &name,
           const std::string &settings,
           const std::string &motion)
{
  const auto moved           = test::run_scene<dim>(block<dim>() + settings +
                                          top<dim>("Motion = " + motion));
  const auto [force, moment] = resultant(*moved, "top");
  const auto [lower_force, lower_moment] = resultant(*moved, "bottom");
  const auto expected                    = place(*moved);
  Vector3    arm({0, 1, 0});
  for (unsigned int a = 0; a < dim; ++a)
    arm[a] += expected[a];
  test::check_error("forces in equilibrium, " + name,
                    (force + lower_force).norm() / force.norm(),
                    1e-8);
  // on the body the forces act beside where they act on the rigid bodies, by
  // what a tie gives way
  test::check_error(
    "moments in equilibrium, " + name,
    (moment + lower_moment + cross_product_3d(arm, force)).norm() /
      moment.norm(),
    1e-2);

  std::string forces, moments;
  for (unsigned int a = 0; a < dim; ++a)
    forces +=
      (a > 0 ? ", " : "") + std::string(1, "xyz"[a]) + " = " + text(force[a]);
  if (dim == 2)
    moments = "rotation = " + text(moment[2]);
  for (unsigned int a = 0; a < 3 && dim == 3; ++a)
    moments += (a > 0 ? ", r" : "r") + std::string(1, "xyz"[a]) + " = " +
               text(moment[a]);
  const auto loaded = test::run_scene<dim>(
    block<dim>() + settings +
    top<dim>(std::string("Free = ") +
             (dim == 2 ? "x, y, rotation" : "x, y, z, rx, ry, rz") +
             "\nForce = " + forces + "\nMoment = " + moments));
  double     worst = 0;
  const auto found = place(*loaded);
  for (unsigned int i = 0; i < found.size(); ++i)
    test::add_error(worst, std::abs(found[i] - expected[i]));
  test::check_error("loads instead of motions, " + name, worst, 1e-7);
  test::check_error("the moment that acts, " + name,
                    (resultant(*loaded, "top").second - moment).norm() /
                      moment.norm(),
                    1e-8);
  check_order("loads, " + name);
}

/** A motion with all rotations given; then one or two of them are free, with
 * the moments that do the same work, and have to come back. */
void
test_some_rotations_free()
{
  const auto run = [](const std::string &motion, const std::string &free) {
    return test::run_scene<3>(
      block<3>() + top<3>("Motion = x=0.05*t, y=0.03*t, z=-0.02*t" + motion +
                          (free.empty() ? "" : "\nFree = " + free)));
  };
  const Vector3        theta({0.3, 0.25, -0.2});
  const std::string    rotation = "Rotation x of rigid body top (rad)";
  const auto           moved    = run(", rx=0.3*t, ry=0.25*t, rz=-0.2*t", "");
  const FiniteRotation R(theta);
  const Vector3        Q = R.pull_back(resultant(*moved, "top").second);
  const auto work = [&](const unsigned int axis, const unsigned int along) {
    Vector3 e;
    e[axis] = 1;
    return R.pull_back(e)[along];
  };
  const auto one =
    run(", rx=0.3*t, rz=-0.2*t", "ry\nMoment = ry=" + text(Q[1] / work(1, 1)));
  test::check_error("one rotation free",
                    (get_vector(*one, rotation) - theta).norm(),
                    1e-7);
  // (Tᵀ (0, M_y, M_z)) has the components Q_y and Q_z
  const double det = work(1, 1) * work(2, 2) - work(2, 1) * work(1, 2);
  const auto   two =
    run(", rx=0.3*t",
        "ry, rz\nMoment = ry=" +
          text((Q[1] * work(2, 2) - work(2, 1) * Q[2]) / det) +
          ", rz=" + text((work(1, 1) * Q[2] - work(1, 2) * Q[1]) / det));
  test::check_error("two rotations free",
                    (get_vector(*two, rotation) - theta).norm(),
                    1e-7);
  check_order("two rotations free");
  // about y nothing acts
  const auto    free    = run(", rx=0.3*t, rz=-0.2*t", "ry");
  const Vector3 turned  = get_vector(*free, rotation),
                moments = resultant(*free, "top").second;
  test::check("a free rotation turns", std::abs(turned[1]) > 1e-3, "");
  test::check_error("no moment does work on it",
                    std::abs(FiniteRotation(turned).pull_back(moments)[1]) /
                      moments.norm(),
                    1e-8);
  test::check_error("what is given, stays",
                    std::abs(turned[0] - 0.3) + std::abs(turned[2] + 0.2),
                    1e-12);
}

/** A beam whose ends are turned by a little: M = E I κ for ν = 0. */
void
test_bending()
{
  const auto bent = test::run_scene<2>(
    "Grid/Upper corner = 8, 1\nGrid/Subdivisions = 96, 16\nGrid/Diagonals = "
    "alternating\nMaterial/Young modulus = 1e4\nMaterial/Poisson ratio = "
    "0\nFormulation/Type = u\nNewton/Tolerance = 1e-9\n" +
    std::string(test::keep_grid) + sides +
    "left side: x < 0.01; right side: x > 7.99\n" + end("left", "0, 0.5") +
    end("right", "8, 0.5", "Motion = rotation=0.01*t\nFree = x, y"));
  const auto [force, moment] = resultant(*bent, "right");
  test::check_error("bending moment",
                    relative(moment[2], 1e4 / 12. * 0.01 / 8),
                    0.02);
  test::check_error("no force", std::abs(force[1]) / moment[2], 1e-6);
  // the end of an arc of length 8 and angle 0.01
  test::check_error("deflection",
                    relative(get(*bent,
                                 "Translation y of rigid body right (m)"),
                             8 / 0.01 * (1 - std::cos(0.01))),
                    0.01);
}

/** A strip of incompressible rubber, 8 m x 0.5 m, that is bent to a ring: the
 * moment of Rivlin's flexure in plane strain. Two grids, extrapolated by their
 * error of second order. */
void
test_ring()
{
  const auto run = [](const unsigned int n) {
    return test::run_scene<2>(
      "Grid/Upper corner = 8, 0.5\nGrid/Diagonals = alternating\n"
      "Grid/Subdivisions = " +
      std::to_string(16 * n) + ", " + std::to_string(n) + '\n' +
      test::keep_grid +
      "Material points/Points per cell = 3\nFormulation/Type = u-p\n"
      "Formulation/Stabilisation = PPP\nFormulation/PPP coefficient = 1\n"
      "Material/Young modulus = 3000\nMaterial/Poisson ratio = 0.5\n"
      "Time/Step size = 0.05\n" +
      sides + "left side: x < 0.01; right side: x > 7.99\n" +
      end("left", "0, 0.25") +
      end("right", "8, 0.25", "Motion = rotation=2*pi*t\nFree = x, y"));
  };
  // ω² r_1 r_2 = 1, r_2² - r_1² = 2h/ω; σ_θ r by Simpson's rule, the constant
  // of σ_r = μ/2 (ω² r² + 1/(ω² r²)) + C such that σ_r = 0 at r_1 and r_2
  const double w = 2 * numbers::PI / 8, h = 0.5, G = 1000;
  const double r_1 = std::sqrt(std::sqrt(h * h / (w * w) + std::pow(w, -4)) -
                               h / w),
               r_2 = 1 / (w * w * r_1);
  const auto s     = [&](const double r) {
    return w * w * r * r + 1 / (w * w * r * r);
  };
  const unsigned int n = 1000;
  double             M = 0;
  for (unsigned int k = 0; k <= n; ++k)
    {
      const double r      = r_1 + (r_2 - r_1) * k / n,
                   factor = (k == 0 || k == n) ? 1. : (k % 2 == 1 ? 4. : 2.);
      M +=
        factor * (r_2 - r_1) / (3 * n) * r *
        (G / 2 * (s(r) - s(r_1)) + G * (w * w * r * r - 1 / (w * w * r * r)));
    }
  const auto   coarse = run(4), fine = run(8);
  const double m_4 = resultant(*coarse, "right").second[2],
               m_8 = resultant(*fine, "right").second[2];
  test::check_error("moment of a ring", relative((4 * m_8 - m_4) / 3, M), 0.03);
  test::check_error(
    "it closes",
    std::abs(get(*fine, "Translation x of rigid body right (m)") + 8) / 8,
    0.01);
  test::check_error("no force in it",
                    resultant(*fine, "right").first.norm() / M,
                    1e-6);
}

/** Torsion of an incompressible Neo-Hookean bar of radius a, at any twist κ per
 * length: M = π G κ a⁴/2, axial force -π G κ² a⁴/4 (Rivlin). Two meshes,
 * extrapolated by their error of second order. */
void
test_torsion()
{
  const double G = 1e4 / 3, a = 0.5;
  const auto   run =
    [](const unsigned int n, const std::string &angle, const double step) {
      return test::run_scene<3>(
        round_bar(n) + test::keep_grid +
        "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.5\n"
        "Formulation/Type = u-p\nFormulation/Stabilisation = PPP\n"
        "Formulation/PPP coefficient = 1\nNewton/Tolerance = 1e-8\n"
        "Newton/Reuse factorisation = 0\nTime/Step size = " +
        std::to_string(step) + '\n' + up_and_down + end("bottom", "0, 0, 0") +
        end("top", "0, 1, 0", "Motion = ry=" + angle));
    };
  const double M            = numbers::PI * G * std::pow(a, 4) / 2;
  const auto   extrapolated = [](const double coarse, const double fine) {
    return (4 * fine - coarse) / 3;
  };
  const auto moment = [](const auto &problem) {
    return resultant(*problem, "top").second[1];
  };
  test::check_error("torsion, small",
                    relative(extrapolated(moment(run(4, "0.01*t", 1)),
                                          moment(run(8, "0.01*t", 1))),
                             0.01 * M),
                    0.02);
  const auto   coarse = run(4, "pi/2*t", 0.25);
  const auto   fine   = run(8, "pi/2*t", 0.25);
  const double kappa  = numbers::PI / 2;
  test::check_error("torsion by 90 degrees",
                    relative(extrapolated(moment(coarse), moment(fine)),
                             kappa * M),
                    0.03);
  test::check_error("axial force",
                    relative(extrapolated(resultant(*coarse, "top").first[1],
                                          resultant(*fine, "top").first[1]),
                             -kappa * kappa / 2 * M),
                    0.05);
  test::check_error("rotation in the statistics",
                    std::abs(get(*fine, "Rotation y of rigid body top (rad)") -
                             kappa),
                    1e-10);
  check_order("torsion");
}

/** A body that turns freely with a light plate turns on as it does at first. */
void
test_spin()
{
  const auto run = [](const std::string &end_time) {
    return test::run_scene<2>(
      "Grid/Subdivisions = 4, 4\nMaterial/Poisson ratio = 0.3\n"
      "Formulation/Type = u\nNewton/Tolerance = 1e-8\n" +
      std::string(test::keep_grid) +
      "Dynamics/Inertia = true\nDynamics/Spectral radius = 1\n"
      "Material/Density = 1000\nMaterial/Young modulus = 1e7\n"
      "Time/Step size = 0.02\n"
      "Dynamics/Initial velocity = -(y-0.5), x-0.5\nTime/End time = " +
      end_time + '\n' + sides + "top side: y > 0.99\n" +
      end("top",
          "0.5, 1",
          "Free = x, y, rotation\nMass = 1e-3\nMoment of inertia = 1e-4\n"
          "Initial velocity = x=-0.5, rotation=1"));
  };
  const std::string column  = "Angular momentum z (kg m^2/s)";
  const double      before  = get(*run("0.02"), column);
  const auto        problem = run("1");
  test::check_error("angle of a spinning body",
                    std::abs(get(*problem, "Rotation of rigid body top (rad)") -
                             1),
                    1e-3);
  test::check_error("angular momentum", relative(before, 1000. / 6), 5e-3);
  test::check_error("... stays", relative(get(*problem, column), before), 5e-4);
  test::check_error("energy",
                    std::abs(get(*problem, "Energy lost by the scheme (J)")) /
                      (1000. / 12),
                    1e-3);
}

/** A plate of mass m on a light column, ν = 0, to which a force is applied at
 * once: y = F/k (1 - cos ωt), k = E A/L, ω² = k/m. */
void
test_mass()
{
  const double E = 1e4, m = 100, F = -1, omega = std::sqrt(E / m);
  const double end_time = 0.5; // most of a period, 0.63 s
  const auto   problem  = test::run_scene<2>(
    "Grid/Subdivisions = 2, 2\nMaterial/Poisson ratio = 0\n"
       "Formulation/Type = u\nNewton/Tolerance = 1e-10\n" +
    std::string(test::keep_grid) +
    "Dynamics/Inertia = true\nDynamics/Spectral radius = 1\n"
       "Material/Density = 1e-3\nMaterial/Young modulus = 1e4\n"
       "Time/End time = 0.5\nTime/Step size = 0.0025\n" +
    up_and_down + end("bottom", "0.5, 0") +
    end("top", "0.5, 1", "Free = y\nForce = y=-1\nMass = 100"));
  test::check_error("a mass on a spring",
                    relative(get(*problem,
                                 "Translation y of rigid body top (m)"),
                             F / E * (1 - std::cos(omega * end_time))),
                    2e-3);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.5\n";
  test_prescribed("u", "");
  test_prescribed("u-p", up + "Time/Step size = 0.25\n");
  const std::string motion = "x = 0.2*t, y = -0.05*t, rotation = -0.3*t";
  test_loads<2>("2D, u", "", motion);
  test_loads<2>("2D, u-p", up, motion);
  test_loads<2>("2D, u, Block FGMRES",
                "Linear solver/Solver = Block FGMRES\n",
                motion);
  const std::string motion_3d =
    "x = 0.1*t, y = 0.05*t, z = -0.1*t, rx = 0.2*t, ry = 0.4*t, rz = -0.1*t";
  test_loads<3>("3D, u", "", motion_3d);
  test_loads<3>("3D, u, kept grid", test::keep_grid, motion_3d);
  test_loads<3>("3D, u-p, Block FGMRES",
                up + "Linear solver/Solver = Block FGMRES\n",
                motion_3d);
  test_some_rotations_free();
  test_bending();
  test_ring();
  test_torsion();
  test_spin();
  test_mass();
  return 0;
}
