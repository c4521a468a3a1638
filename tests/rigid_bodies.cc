/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Rigid bodies: what their parameters mean, motions by formulas and by free
// components, derivatives against differences, and their own equations against
// closed forms.

#include <isochor/rigid_body/rigid_body.h>

#include "rigid_shape_tools.h"

using namespace isochor;

namespace
{
  template <int dim>
  std::unique_ptr<RigidBody<dim>>
  make_body(const std::string &settings)
  {
    ParameterHandler prm;
    RigidBody<dim>::declare_parameters(prm);
    std::string        lines, line;
    std::istringstream text(settings);
    while (std::getline(text, line))
      lines += "set " + line + '\n';
    prm.parse_input_from_string(lines);
    auto body = std::make_unique<RigidBody<dim>>("Rigid body: tool");
    body->parse_parameters(prm);
    return body;
  }

  const std::string box2 =
    "Shape = box\nLower corner = 0, 0\nUpper corner = 2, 1\n";
  const std::string box3 =
    "Shape = box\nLower corner = 0, 0, 0\nUpper corner = 2, 1, 1.5\n"
    "Edge radius = 0.2\n";

  /** A rigid body in a pose as a shape. */
  template <int dim>
  class Posed : public RigidShape<dim>
  {
  public:
    Posed(const RigidBody<dim> &body, const RigidPose<dim> &pose)
      : body(body)
      , pose(pose)
    {}
    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      return body.closest(x, pose);
    }
    std::vector<typename RigidShape<dim>::Facet>
    surface(const double reach) const override
    {
      return body.surface(pose, reach);
    }
    BoundingBox<dim>
    box() const override
    {
      return this->unbounded();
    }

  private:
    const RigidBody<dim> &body;
    RigidPose<dim>        pose;
  };

  void
  test_formulas()
  {
    const auto body = make_body<2>(
      box2 + "Reference point = 2, 1\nMotion = y = -0.1*t, rotation = pi*t/4");
    const auto     pose = body->move(2, {}).pose();
    const Point<2> x    = pose.place({1, 1});
    test::report("a place that turns by 90 degrees and moves",
                 x.distance(Point<2>(2, -0.2)) < 1e-14,
                 std::to_string(x[0]) + ", " + std::to_string(x[1]));
    test::report("back to where it was",
                 pose.original(x).distance({1, 1}) < 1e-14,
                 "");
    test::test_shape<2>(Posed<2>(*body, body->move(0.7, {}).pose()),
                        {"a box that has moved", {2, 0}, 2});
    const auto solid =
      make_body<3>(box3 + "Motion = x = t, rx = 3*t, ry = -2*t, rz = 4*t");
    test::test_shape<3>(
      Posed<3>(*solid, solid->move(0.8, {}).pose()),
      {"a solid that has moved", {1.8, 0.5, 0.75}, 1.3, 5e-3, 40});
    // the exponential by its definition
    const auto   R = solid->move(1, {}).pose().rotation;
    Tensor<2, 3> W, expected = unit_symmetric_tensor<3>();
    W[0][1] = -4;
    W[0][2] = -2;
    W[1][2] = -3;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j < i; ++j)
        W[i][j] = -W[j][i];
    Tensor<2, 3> power = expected;
    for (unsigned int k = 1; k < 60; ++k)
      {
        power = power * W / k;
        expected += power;
      }
    test::report("a rotation vector of 5.4 rad",
                 (R - expected).norm() < 1e-10,
                 std::to_string((R - expected).norm()));
    // of a place that is 2 m from the centre of a turn of 1 rad/s
    const auto wheel =
      make_body<2>(box2 + "Reference point = 0, 0\nMotion = rotation = t");
    const auto v = wheel->move(1e-6, {}).velocity({2, 0}, 1e-6);
    test::report("velocity of a place",
                 (v - Tensor<1, 2>({0, 2})).norm() < 1e-5,
                 std::to_string(v[1]));
  }

  template <int dim>
  typename RigidComponents<dim>::Values
  random_components(test::Random &random, const double size)
  {
    typename RigidComponents<dim>::Values c;
    for (double &value : c)
      value = size * random();
    return c;
  }

  /** Everything free, after a first step with large increments. */
  template <int dim>
  std::unique_ptr<RigidBody<dim>>
  make_free_body(const RigidScheme &scheme, test::Random &random)
  {
    auto body = make_body<dim>(
      (dim == 2 ? box2 + "Free = x, y, rotation\nMoment = rotation = 3 + t\n"
                         "Moment of inertia = 2\nInitial velocity = y = -1, "
                         "rotation = 2\n" :
                  box3 + "Free = x, y, z, rx, ry, rz\nMoment = rx = 2, ry = "
                         "-3, rz = 1 + t\nMoment of inertia = 1, 2, 4\n"
                         "Initial velocity = y = -1, rx = 2, ry = 1, rz = "
                         "-1\n") +
      "Mass = 3\nForce = x = 1 + t");
    body->advance(0.1, scheme, random_components<dim>(random, 0.8));
    return body;
  }

  template <int dim>
  void
  test_derivatives()
  {
    constexpr unsigned int n  = RigidComponents<dim>::n;
    const double           dt = 0.1, time = 0.2, h = 1e-5;
    test::Random           random;
    test::WorstError       motion, second, distance, normal, matrix;
    for (const RigidScheme &scheme : {RigidScheme(), RigidScheme(dt)})
      for (unsigned int k = 0; k < 10; ++k)
        {
          const auto body = make_free_body<dim>(scheme, random);
          const auto c    = random_components<dim>(random, 0.7);
          Point<dim> X;
          for (unsigned int d = 0; d < dim; ++d)
            X[d] = 4 * random();
          const RigidMove<dim> move  = body->move(time, c);
          const auto           x     = move.pose().place(X);
          const auto           at_x  = body->closest(x, move.pose());
          const auto           moves = move.motion(x);
          const auto           turns = move.normal_change(x, at_x);
          typename RigidComponents<dim>::Values residual, ends[2];
          typename RigidComponents<dim>::Matrix K, ignored;
          body->equations(time, scheme, c, residual, K);
          for (unsigned int j = 0; j < n; ++j)
            {
              auto plus = c, minus = c;
              plus[j] += h;
              minus[j] -= h;
              const auto move_p = body->move(time, plus),
                         move_m = body->move(time, minus);
              const auto x_p    = move_p.pose().place(X),
                         x_m    = move_m.pose().place(X);
              motion.add((moves[j] - (x_p - x_m) / (2 * h)).norm(), "x");
              const auto m_p = move_p.motion(x_p), m_m = move_m.motion(x_m);
              for (unsigned int i = 0; i < n; ++i)
                second.add((move.second_motion(x, i, j) -
                            (m_p[i] - m_m[i]) / (2 * h))
                             .norm(),
                           "x");
              const auto n_p = body->closest(x, move_p.pose()),
                         n_m = body->closest(x, move_m.pose());
              // where a face ends the normal has a kink
              if ((n_p.curvature - n_m.curvature).norm() < 1e-2 &&
                  (n_p.normal - n_m.normal).norm() < 1e-2)
                {
                  distance.add(std::abs(at_x.normal * moves[j] +
                                        (n_p.distance - n_m.distance) /
                                          (2 * h)),
                               "x");
                  normal.add(
                    (turns[j] - (n_p.normal - n_m.normal) / (2 * h)).norm(),
                    "x");
                }
              body->equations(time, scheme, plus, ends[0], ignored);
              body->equations(time, scheme, minus, ends[1], ignored);
              for (unsigned int i = 0; i < n; ++i)
                matrix.add(std::abs(K[i][j] -
                                    (ends[0][i] - ends[1][i]) / (2 * h)) /
                             (1 + std::abs(K[i][i])),
                           std::to_string(i) + ' ' + std::to_string(j));
            }
        }
    const std::string in = " in " + std::to_string(dim) + "D";
    motion.report("motion of a place" + in, 1e-8);
    second.report("second derivative of a place" + in, 1e-8);
    distance.report("change of the distance" + in, 1e-7);
    normal.report("change of the normal" + in, 1e-6);
    matrix.report("matrix of the equations" + in, 1e-7);
  }

  /** Newton's method for a rigid body alone. */
  template <int dim>
  void
  step(RigidBody<dim> &body, const double time, const RigidScheme &scheme)
  {
    constexpr unsigned int                n = RigidComponents<dim>::n;
    typename RigidComponents<dim>::Values c{}, residual;
    typename RigidComponents<dim>::Matrix K;
    for (unsigned int iteration = 0; iteration < 10; ++iteration)
      {
        body.equations(time, scheme, c, residual, K);
        // Gauss without pivots: of inertia
        for (unsigned int i = 0; i < n; ++i)
          if (!body.is_free(i))
            K[i][i] = 1;
        for (unsigned int i = 0; i < n; ++i)
          for (unsigned int k = i + 1; k < n; ++k)
            {
              const double factor = K[k][i] / K[i][i];
              for (unsigned int j = i; j < n; ++j)
                K[k][j] -= factor * K[i][j];
              residual[k] -= factor * residual[i];
            }
        for (unsigned int i = n; i-- > 0;)
          {
            for (unsigned int j = i + 1; j < n; ++j)
              residual[i] -= K[i][j] * residual[j];
            residual[i] /= K[i][i];
            c[i] -= residual[i];
          }
      }
    body.advance(time, scheme, c);
  }

  void
  test_dynamics_in_the_plane()
  {
    const auto body = make_body<2>(
      box2 + "Free = y, rotation\nMotion = x = t\nMass = 2\n"
             "Moment of inertia = 0.5\nForce = y = -20\n"
             "Moment = rotation = 3\nInitial velocity = y = 4, rotation = 1");
    body->check_inertia();
    const RigidScheme scheme(0.1);
    for (unsigned int k = 1; k <= 20; ++k)
      step(*body, 0.1 * k, scheme);
    // exact for constant forces; more than one turn
    const auto pose = body->old_pose();
    test::report("free fall",
                 std::abs(pose.displacement[1] - (4 * 2 - 10 * 2)) < 1e-10 &&
                   std::abs(pose.displacement[0] - 2) < 1e-12,
                 std::to_string(pose.displacement[1]));
    Statistics statistics;
    body->set_statistics(2, {}, statistics);
    const double angle = 2 + 6 * 2;
    test::report("a constant moment",
                 std::abs(statistics.get("Rotation of rigid body tool (rad)") -
                          angle) < 1e-9 &&
                   std::abs(pose.rotation[0][0] - std::cos(angle)) < 1e-9,
                 std::to_string(
                   statistics.get("Rotation of rigid body tool (rad)")));
    test::report("statistics of a prescribed motion",
                 std::abs(
                   statistics.get("Translation x of rigid body tool (m)") - 2) <
                   1e-12,
                 "");
  }

  /** The axis of a top without forces goes round the angular momentum L at the
   * rate |L| / J_1. */
  double
  error_of_top(const unsigned int n_steps)
  {
    const auto top =
      make_body<3>(box3 + "Free = rx, ry, rz\nMoment of inertia = 1, 1, 2\n"
                          "Initial velocity = rx = 1, rz = 3");
    const double      dt = 2. / n_steps;
    const RigidScheme scheme(dt);
    for (unsigned int k = 1; k <= n_steps; ++k)
      step(*top, k * dt, scheme);
    const Tensor<1, 3> L({1, 0, 6}), axis({0, 0, 1});
    const Tensor<1, 3> expected = FiniteRotation(2 * L).matrix() * axis;
    return (top->old_pose().rotation * axis - expected).norm();
  }

  void
  test_dynamics_in_space()
  {
    const double coarse = error_of_top(50), fine = error_of_top(100);
    test::report("precession of a top",
                 fine < 1e-2 && std::abs(coarse / fine - 4) < 0.4,
                 std::to_string(coarse) + ", " + std::to_string(fine));
    // a spin about a principal axis that does not change, several turns
    const auto body =
      make_body<3>(box3 + "Free = rx, ry, rz\nMoment of inertia = 1, 2, 3\n"
                          "Initial velocity = rz = 5");
    for (unsigned int k = 1; k <= 40; ++k)
      step(*body, 0.1 * k, RigidScheme(0.1));
    Statistics statistics;
    body->set_statistics(4, {}, statistics);
    test::report(
      "turns are counted in space",
      std::abs(statistics.get("Rotation z of rigid body tool (rad)") - 20) <
        1e-9,
      std::to_string(statistics.get("Rotation z of rigid body tool (rad)")));
  }

  void
  test_state()
  {
    test::Random      random;
    const RigidScheme scheme(0.1);
    const auto        body = make_free_body<3>(scheme, random);
    test::Random      again;
    const auto        copy = make_free_body<3>(scheme, again);
    step(*body, 0.2, scheme);
    copy->load_state(body->save_state());
    step(*body, 0.3, scheme);
    step(*copy, 0.3, scheme);
    test::report(
      "the state is saved",
      (body->old_pose().rotation - copy->old_pose().rotation).norm() +
          (body->old_pose().displacement - copy->old_pose().displacement)
            .norm() <
        1e-14,
      "");
    test::expect_error("a state that is cut off",
                       {"<Rigid body: tool> in the checkpoint is incomplete"},
                       [&]() { copy->load_state("0.1 2 3"); });
  }

  template <int dim>
  void
  test_error(const std::string              &what,
             const std::string              &settings,
             const std::vector<std::string> &words)
  {
    test::expect_error(what, words, [&]() {
      make_body<dim>(settings)->check_inertia();
    });
  }

  void
  test_errors()
  {
    test_error<2>("free and prescribed",
                  "Motion = y = t\nFree = y",
                  {"<y> is both free, in <Rigid body: tool/Free>, and"});
    test_error<2>("an unknown free component",
                  "Free = z",
                  {"<z> in the parameter <Rigid body: tool/Free> is no"});
    test_error<2>("an unknown component",
                  "Motion = rx = t",
                  {"<rx = t>", "<Rigid body: tool/Motion>", "x, y, rotation"});
    test_error<3>("a component twice",
                  "Motion = rx = t, rx = 2",
                  {"<Rigid body: tool/Motion> names <rx> twice"});
    test_error<2>("a motion in x",
                  "Motion = y = x",
                  {"Rigid body: tool/Motion", "depends on x"});
    test_error<2>("a force on what is fixed",
                  "Force = x = 1",
                  {"<Rigid body: tool/Force> acts along the component <x>"});
    test_error<3>("a moment on what is prescribed",
                  "Motion = rx = t\nMoment = rx = 1",
                  {"<Rigid body: tool/Moment> acts along the component <rx>"});
    test_error<2>("an initial velocity of what is fixed",
                  "Initial velocity = x = 1",
                  {"<Rigid body: tool/Initial velocity> names <x>"});
    test_error<2>("no mass",
                  "Free = x",
                  {"<Rigid body: tool/Mass> must be positive"});
    test_error<3>("no moment of inertia",
                  "Free = rz\nMoment of inertia = 1, 1, 0",
                  {"<Rigid body: tool/Moment of inertia> must be positive"});
    test_error<3>("two moments of inertia",
                  "Moment of inertia = 1, 1",
                  {"<Rigid body: tool/Moment of inertia> must be one number"});
    test_error<3>("free and prescribed rotations",
                  "Free = rz\nMotion = rx = t\nMoment of inertia = 1",
                  {"either all that move are free or none"});
    const auto body = make_body<2>("Shape = circle\nRadius = 1");
    const std::set<std::string> expected{
      "Centre", "Free", "Motion", "Radius", "Reference point", "Shape"};
    test::report("parameters in use",
                 body->parameters_in_use() == expected,
                 "");
    make_body<2>("Free = y\nMass = 1")->check_inertia();
  }
} // namespace

int
main()
{
  test_formulas();
  test_derivatives<2>();
  test_derivatives<3>();
  test_dynamics_in_the_plane();
  test_dynamics_in_space();
  test_state();
  test_errors();
  return 0;
}
