/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Rigid sides whose nodes are at walls, too: two walls at a node in 3D, turned
// in space, and curved walls, against the same body along the axes, against
// node by node what has been found, by energies, and by Newton's order.

#include <isochor/base/finite_rotation.h>
#include <isochor/boundary_condition/wall_surface.h>

#include <array>
#include <iomanip>
#include <sstream>

#include "mesh_file.h"

using namespace isochor;
using test::get;
using test::get_vector;
using test::relative;

namespace
{
  using Vector3 = Tensor<1, 3>;

  const std::string newton = "Newton/Tolerance = 1e-11\n"
                             "Newton/Reuse factorisation = 0\n"
                             "Postprocess/Write energies = always\n";

  double
  difference(const Vector3 &value, const Vector3 &expected)
  {
    return (value - expected).norm() / expected.norm();
  }

  std::string
  text(const double value)
  {
    std::ostringstream out;
    out.precision(17);
    out << value;
    return out.str();
  }

  /** "force x = 1*t, force y = ..." */
  std::string
  components(const std::string &name, const Vector3 &v)
  {
    std::string all;
    for (unsigned int a = 0; a < 3; ++a)
      all += (a > 0 ? ", " : "") + name + "xyz"[a] + " = " + text(v[a]) + "*t";
    return all;
  }

  /** Whether residuals of the last step fell quadratically at its end. */
  void
  check_order(const std::string &what)
  {
    const auto         &rows = test::recorded().newton.back().iterations;
    std::vector<double> r;
    for (const auto &row : rows)
      if (row.displacement > 1e-12)
        r.push_back(row.displacement);
    bool        ok = rows.size() < 12;
    std::string list;
    for (unsigned int k = 0; k < r.size(); ++k)
      {
        list += text(r[k]) + " ";
        if (k > 1 && r[k - 1] < 1e-2 && r[k] > 1e-11 &&
            r[k] > 100 * r[k - 1] * r[k - 1])
          ok = false;
      }
    test::check("Newton's order, " + what, ok, list);
  }

  Tensor<2, 3>
  some_turn()
  {
    return FiniteRotation(Vector3({0.4, -0.7, 0.3})).matrix();
  }

  std::string
  turned_box(const Tensor<2, 3> &R)
  {
    return test::write_image_of_box<3>("box.msh",
                                       {2, 2, 3},
                                       [&R](const Point<3> &x) {
                                         return Point<3>(R * Vector3(x));
                                       });
  }

  const std::string top = " of rigid side z1 ";
} // namespace

/** An oedometer between four smooth walls, turned in space: a plate that is
 * free to shift and to turn is pressed into it. At its corners two walls meet.
 * It goes straight on, with the whole force. */
void
test_guided_plate(const std::string &form)
{
  double straight = 0;
  for (const Tensor<2, 3> &R :
       {Tensor<2, 3>(unit_symmetric_tensor<3>()), some_turn()})
    {
      const Vector3 down    = R * Vector3({0, 0, -1});
      const auto    problem = test::run_scene<3>(
        turned_box(R) + test::keep_grid + newton + form +
        "Material/Young modulus = 1e7\nTime/Step size = 0.5\n"
           "Boundary conditions/Walls = x0: n = 0; x1: n = 0; y0: n = 0; y1: n = "
           "0; z0: n = 0\nBoundary conditions/Rigid sides = z1: " +
        components("force ", 3e6 * down) + '\n');
      const Vector3 moved = get_vector(*problem, "Translation x" + top + "(m)"),
                    turn  = get_vector(*problem, "Rotation x" + top + "(rad)"),
                    force = get_vector(*problem, "Force x" + top + "(N)");
      const double way    = moved * down;
      test::check_error("a plate between four walls doesn't turn",
                        turn.norm(),
                        1e-9);
      test::check_error("nor does it slip", (moved - way * down).norm(), 1e-9);
      test::check_error("its force", difference(force, 3e6 * down), 1e-8);
      if (straight == 0)
        straight = way;
      else
        test::check_error("its way", relative(way, straight), 1e-9);
      check_order("four walls");
    }
  // the plate node by node
  const auto by_nodes = test::run_scene<3>(
    turned_box(unit_symmetric_tensor<3>()) + test::keep_grid + newton + form +
    "Material/Young modulus = 1e7\nTime/Step size = 0.5\n"
    "Postprocess/Reactions = z1\n"
    "Boundary conditions/Displacement = x0: x = 0; x1: x = 0; y0: y = 0; y1: "
    "y = 0; z0: z = 0; z1: z = -" +
    text(straight) + "*t\n");
  test::check_error("the force for its way",
                    relative(get(*by_nodes, "Reaction z on z1 (N)"), -3e6),
                    1e-7);
}

/** A block at two smooth walls and on a rough floor, with a plate on top that
 * is shifted and turned by loads at will, and slides along the walls. */
void
test_two_walls(const std::string &name, const std::string &settings)
{
  const Vector3     force({-150, 90, -600}), moment({60, -45, 75});
  const std::string walls =
    "Boundary conditions/Displacement = z0: x = 0, y = 0, z = 0\n"
    "Boundary conditions/Walls = x0: n = 0; y0: n = 0\n";
  const auto run = [&](const Tensor<2, 3> &R,
                       const std::string  &conditions,
                       const std::string  &motion) {
    return test::run_scene<3>(
      turned_box(R) + settings + newton + "Material/Young modulus = 1e4\n" +
      conditions + "Boundary conditions/Rigid sides = z1: " + motion + '\n');
  };
  const auto loads = [&](const Tensor<2, 3> &R) {
    return components("force ", R * force) + ", " +
           components("moment ", R * moment);
  };
  const Tensor<2, 3> no_turn = unit_symmetric_tensor<3>();
  const auto         by_axes =
    run(no_turn,
        "Boundary conditions/Displacement = z0: x = 0, y = 0, z = 0; x0: x = "
        "0; y0: y = 0\n",
        loads(no_turn));
  const auto straight = run(no_turn, walls, loads(no_turn));
  const auto turned   = run(some_turn(), walls, loads(some_turn()));
  check_order("two walls, " + name);
  const Vector3 moved = get_vector(*by_axes, "Translation x" + top + "(m)"),
                turn  = get_vector(*by_axes, "Rotation x" + top + "(rad)");
  double worst        = 0;
  for (const auto *problem : {straight.get(), turned.get()})
    {
      const Tensor<2, 3> R = problem == turned.get() ? some_turn() : no_turn;
      test::add_error(worst,
                      difference(get_vector(*problem,
                                            "Translation x" + top + "(m)"),
                                 R * moved));
      test::add_error(worst,
                      difference(get_vector(*problem,
                                            "Rotation x" + top + "(rad)"),
                                 R * turn));
      test::add_error(worst,
                      relative(get(*problem, "Strain energy (J)"),
                               get(*by_axes, "Strain energy (J)")));
    }
  test::check("the plate moves and turns",
              moved.norm() > 0.02 && turn.norm() > 0.02,
              text(moved.norm()) + ", " + text(turn.norm()));
  test::check_error("two walls and a rigid side, " + name, worst, 1e-8);
  const auto back = run(some_turn(),
                        walls,
                        components("", some_turn() * moved) + ", " +
                          components("rotation ", some_turn() * turn));
  test::check_error(
    "its loads come back, " + name,
    std::max(difference(get_vector(*back, "Force x" + top + "(N)"),
                        some_turn() * force),
             difference(get_vector(*back, "Moment x" + top + "(N m)"),
                        some_turn() * moment)),
    1e-7);
}

namespace
{
  /** A part of a ring between the radii 1 and 2, of a height of 1 in 3D. */
  template <int dim>
  std::string
  ring(const Tensor<2, 3> &R, const double angle)
  {
    return test::write_image_of_box<dim>(
      "ring.msh",
      dim == 2 ? std::vector<unsigned int>{3, 8} :
                 std::vector<unsigned int>{2, 5, 2},
      [&](const Point<dim> &x) {
        const double r = 1 + x[0], phi = angle * x[1];
        Vector3      place({r * std::cos(phi), r * std::sin(phi), 0});
        if (dim == 3)
          place[2] = x[dim - 1];
        place = R * place;
        Point<dim> result;
        for (unsigned int d = 0; d < dim; ++d)
          result[d] = place[d];
        return result;
      });
  }
} // namespace

/** One end of a ring's part is held, the other turns about the axis of the
 * ring, between curved walls. */
void
test_curved_walls_2d(const std::string &name, const std::string &settings)
{
  const std::string body = ring<2>(unit_symmetric_tensor<3>(), 1) + settings +
                           newton + "Material/Young modulus = 1e4\n";
  const std::string walls =
    "Boundary conditions/Walls = x0: n = 0; x1: n = 0\n";
  const auto turned_by = [&](const double angle) {
    return test::run_scene<2>(
      body + walls + "Boundary conditions/Displacement = y1: x = 0, y = 0\n" +
      "Boundary conditions/Rigid sides = y0: centre = (0, 0), x = 0, y = 0, "
      "rotation = " +
      text(angle) + "*t\n");
  };
  const std::string moment = "Moment of rigid side y0 (N m)",
                    energy = "Strain energy (J)";
  const double h           = 1e-4;
  const auto   problem     = turned_by(0.2);
  check_order("curved walls, " + name);
  const double M = get(*problem, moment);
  if (settings.find("Step size") != std::string::npos)
    return;
  test::check_error("moment by energies, " + name,
                    relative((get(*turned_by(0.2 + h), energy) -
                              get(*turned_by(0.2 - h), energy)) /
                               (2 * h),
                             M),
                    1e-6);
  const auto loaded = test::run_scene<2>(
    body + walls + "Boundary conditions/Displacement = y1: x = 0, y = 0\n" +
    "Boundary conditions/Rigid sides = y0: centre = (0, 0), x = 0, y = 0, "
    "moment = " +
    text(M) + "*t\n");
  check_order("curved walls and a moment, " + name);
  test::check_error("its rotation comes back, " + name,
                    relative(get(*loaded, "Rotation of rigid side y0 (rad)"),
                             0.2),
                    1e-8);
  // node by node: those at the walls keep what is along them
  BackgroundGrid<2> grid(MPI_COMM_WORLD);
  ParameterHandler  prm;
  BackgroundGrid<2>::declare_parameters(prm);
  test::set_parameters(prm, ring<2>(unit_symmetric_tensor<3>(), 1));
  grid.parse_parameters(prm);
  grid.create();
  std::string formula[2] = {"x*(cos(0.2*t)-1) - y*sin(0.2*t)",
                            "x*sin(0.2*t) + y*(cos(0.2*t)-1)"};
  for (const std::string wall : {"x0", "x1"})
    {
      WallSurface<2> surface;
      surface.initialize(grid, grid.boundary_id(wall, ""));
      for (const auto &node : surface.nodes())
        {
          const Point<2> x = grid.geometry().vertices()[node.vertex];
          if (std::abs(x[1]) > 1e-9)
            continue;
          const Tensor<1, 2> u(
            {x[0] * (std::cos(0.2) - 1), x[0] * std::sin(0.2)});
          const Tensor<1, 2> along = u - (u * node.normal) * node.normal;
          for (unsigned int a = 0; a < 2; ++a)
            formula[a] = "if(abs(x-" + text(x[0]) + ") < 1e-6, " +
                         text(along[a]) + "*t, " + formula[a] + ")";
        }
    }
  const auto by_nodes = test::run_scene<2>(
    body + walls +
    "Boundary conditions/Displacement = y1: x = 0, y = 0; y0: "
    "x = " +
    formula[0] + ", y = " + formula[1] + '\n');
  test::check_error("curved walls, node by node, " + name,
                    relative(get(*problem, energy), get(*by_nodes, energy)),
                    1e-8);
}

/** The same in 3D between flat walls above and below, so that two walls meet at
 * corners of the side, and turned in space. */
void
test_curved_walls_3d(const std::string &name, const std::string &settings)
{
  const std::string of_side = " of rigid side y0 ",
                    energy  = "Strain energy (J)";
  const auto run = [&](const Tensor<2, 3> &R, const std::string &turn) {
    return test::run_scene<3>(
      ring<3>(R, 1) + settings + newton + "Material/Young modulus = 1e4\n" +
      "Boundary conditions/Walls = x0: n = 0; x1: n = 0; z0: n = 0; z1: n = 0\n"
      "Boundary conditions/Displacement = y1: x = 0, y = 0, z = 0\n"
      "Boundary conditions/Rigid sides = y0: centre = (0, 0, 0), x = 0, y = 0, "
      "z = 0, " +
      turn + '\n');
  };
  const auto by_angle = [&](const Tensor<2, 3> &R, const double angle) {
    return run(R, components("rotation ", R * Vector3({0, 0, angle})));
  };
  const Tensor<2, 3> no_turn  = unit_symmetric_tensor<3>();
  const auto         straight = by_angle(no_turn, 0.2),
             turned           = by_angle(some_turn(), 0.2);
  check_order("curved and flat walls, " + name);
  const Vector3 M = get_vector(*straight, "Moment x" + of_side + "(N m)");
  test::check_error(
    "curved walls, turned, " + name,
    std::max(difference(get_vector(*turned, "Moment x" + of_side + "(N m)"),
                        some_turn() * M),
             relative(get(*turned, energy), get(*straight, energy))),
    1e-8);
  const double h = 1e-4;
  test::check_error("moment by energies, " + name,
                    relative((get(*by_angle(no_turn, 0.2 + h), energy) -
                              get(*by_angle(no_turn, 0.2 - h), energy)) /
                               (2 * h),
                             M[2]),
                    1e-6);
  const auto back = run(some_turn(), components("moment ", some_turn() * M));
  check_order("curved walls and moments, " + name);
  test::check_error("its rotation comes back, " + name,
                    difference(get_vector(*back,
                                          "Rotation x" + of_side + "(rad)"),
                               some_turn() * Vector3({0, 0, 0.2})),
                    1e-7);
}

/** A piece of a ring slides along curved walls, moved by one end, in steps of
 * 0.04. What a step errs (the nodes move along tangents) is corrected by the
 * next one, so that nothing adds up. */
void
test_sliding()
{
  const auto energy_after = [&](const unsigned int n) {
    const auto problem = test::run_scene<2>(
      ring<2>(unit_symmetric_tensor<3>(), 1.6) + test::keep_grid + newton +
      "Material/Young modulus = 1e4\nMaterial points/Region = 0.4 - "
      "atan2(y, x)\nBoundary conditions/Walls = x0: n = 0; x1: n = 0\n"
      "Time/End time = " +
      text(n) +
      "\nBoundary conditions/Rigid sides = y0: centre = (0, 0), x = 0, y = 0, "
      "rotation = 0.04*t\n");
    return get(*problem, "Strain energy (J)");
  };
  const double once = energy_after(2), far = energy_after(22);
  test::check_error("sliding on along curved walls", relative(far, once), 2e-3);
}

/** The work of walls that move a plate's body: the strain energy, whatever
 * the angle at which it stands. */
void
test_work_of_walls()
{
  for (const double degrees : {0., 30.})
    {
      const double c = std::cos(degrees * numbers::PI / 180),
                   s = std::sin(degrees * numbers::PI / 180);
      std::ostringstream corners;
      corners << std::setprecision(17) << "0, 0; " << c << ", " << s << "; "
              << c - s << ", " << s + c << "; " << -s << ", " << c << '\n';
      const auto problem = test::run_scene<2>(
        "Grid/Type = trapezoid\nGrid/Corners = " + corners.str() +
        test::keep_grid +
        "Grid/Subdivisions = 4, 4\nMaterial/Young modulus = 1e6\n"
        "Time/Step size = 0.05\nNewton/Tolerance = 1e-11\n"
        "Postprocess/Write energies = always\n"
        "Boundary conditions/Rigid sides = top: rotation = 0\n"
        "Boundary conditions/Walls = left: n = 0; bottom: n = 0; right: n = "
        "0.02*t\n");
      const double work   = get(*problem, "External work (J)"),
                   energy = get(*problem, "Strain energy (J)");
      test::check("work of walls at a rigid side, " +
                    std::to_string(static_cast<int>(degrees)),
                  energy > 10 && relative(work, energy) < 1e-3,
                  std::to_string(work) + " and " + std::to_string(energy));
    }
}



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string u  = "Formulation/Type = u\nMaterial/Poisson ratio = 0.3\n";
  const std::string up = "Formulation/Type = u-p\nFormulation/Stabilisation = "
                         "PPP\nMaterial/Poisson ratio = 0.45\n";
  const std::string steps = test::keep_grid + "Time/Step size = 0.5\n";
  test_guided_plate(u);
  test_guided_plate(up);
  test_two_walls("u", u);
  test_two_walls("u-p", up);
  test_two_walls("u, on a kept grid", u + steps);
  test_curved_walls_2d("u", u);
  test_curved_walls_2d("u, on a kept grid", u + steps);
  test_curved_walls_3d("u", u);
  test_curved_walls_3d("u-p", up);
  test_sliding();
  test_work_of_walls();
}
