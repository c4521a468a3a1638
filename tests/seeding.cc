/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Where material points are seeded and which volume and mass they get.

#include <isochor/material_points/seeding.h>

#include <set>

#include "material_test_tools.h"
#include "scene.h"

using namespace isochor;

/** The factorial quotient that is the mean of x^a y^b z^c on the unit simplex
 * of dimension dim: dim! a! b! c! / (dim + a + b + c)!. */
double
monomial_mean(const unsigned int dim, const std::array<unsigned int, 3> &powers)
{
  double mean = std::tgamma(dim + 1.);
  for (const unsigned int power : powers)
    mean *= std::tgamma(power + 1.);
  return mean / std::tgamma(dim + powers[0] + powers[1] + powers[2] + 1.);
}

template <int dim>
void
test_rule(const unsigned int n, const unsigned int degree)
{
  const Quadrature<dim> rule  = material_point_rule<dim>(n);
  double                error = (rule.size() == n ? 0. : 1.);
  bool                  valid = true;
  for (unsigned int q = 0; q < rule.size(); ++q)
    {
      double rest = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          rest -= rule.point(q)[d];
          valid = valid && rule.point(q)[d] > 0.01;
        }
      valid = valid && rest > 0.01 && rule.weight(q) > 0;
      for (unsigned int other = 0; other < q; ++other)
        valid = valid && rule.point(q).distance(rule.point(other)) > 0.02;
    }
  for (unsigned int a = 0; a <= degree; ++a)
    for (unsigned int b = 0; a + b <= degree; ++b)
      for (unsigned int c = 0; a + b + c <= (dim == 3 ? degree : a + b); ++c)
        {
          double mean = 0;
          for (unsigned int q = 0; q < rule.size(); ++q)
            mean += rule.weight(q) * std::pow(rule.point(q)[0], a) *
                    std::pow(rule.point(q)[1], b) *
                    std::pow(rule.point(q)[dim - 1], c);
          test::add_error(error,
                          std::abs(mean - monomial_mean(dim, {{a, b, c}})));
        }
  const std::string label =
    std::to_string(n) + " points, dim " + std::to_string(dim);
  test::check("inside, apart and of positive volume, " + label, valid, "");
  test::check_error("exact for degree " + std::to_string(degree) + ", " + label,
                    error,
                    1e-13);
}

/** The domains of the points tile the cell: they have the points' volumes,
 * which sum to that of the cell, their centroids are the points, none reaches
 * out of the cell, and no two centroids lie in one domain. */
template <int dim>
void
test_domains(const unsigned int n)
{
  const auto [rule, domains] = material_points_with_domains<dim>(n);
  bool   valid               = rule.size() == n && domains.size() == n;
  double error               = 0;
  for (unsigned int q = 0; valid && q < n; ++q)
    {
      Tensor<2, dim> edges;
      Tensor<1, dim> sum;
      for (unsigned int c = 0; c <= dim; ++c)
        {
          sum += domains[q][c];
          double rest = 1;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double x = rule.point(q)[d] + domains[q][c][d];
              valid          = valid && x > -1e-12;
              rest -= x;
              if (c > 0)
                edges[d][c - 1] = domains[q][c][d] - domains[q][0][d];
            }
          valid = valid && rest > -1e-12;
        }
      test::add_error(error, sum.norm());
      test::add_error(error, std::abs(std::abs(determinant(edges)) - 1. / n));
      for (unsigned int other = 0; other < n; ++other)
        {
          const Tensor<1, dim> l =
            invert(edges) * (rule.point(other) - rule.point(q) - domains[q][0]);
          double smallest = 1;
          for (unsigned int d = 0; d < dim; ++d)
            {
              smallest -= l[d];
              valid = valid && (other != q || l[d] > 0.01);
            }
          for (unsigned int d = 0; d < dim; ++d)
            smallest = std::min(smallest, l[d]);
          valid = valid && (smallest > 0) == (other == q);
        }
    }
  const std::string label =
    std::to_string(n) + " points, dim " + std::to_string(dim);
  test::check("domains tile the cell, " + label, valid && error < 1e-13, "");
}

template <int dim>
void
test_refused(const unsigned int n)
{
  std::string message;
  try
    {
      material_point_rule<dim>(n);
    }
  catch (const std::exception &exc)
    {
      message = test::one_line(exc.what());
    }
  test::check(std::to_string(n) + " points are refused, dim " +
                std::to_string(dim),
              message.find("Choose 1, ") != std::string::npos,
              message);
}

/** A grid and the points seeded in it. */
template <int dim>
struct Body
{
  BackgroundGrid<dim>                              grid;
  MaterialPoints<dim>                              points;
  std::vector<std::unique_ptr<MaterialModel<dim>>> materials;

  explicit Body(const std::string &settings,
                const bool         dynamic  = false,
                const std::string &velocity = "")
    : grid(MPI_COMM_WORLD)
    , points(grid)
  {
    ParameterHandler prm;
    MaterialPointMethod<dim>::declare_parameters(prm);
    test::set_parameters(prm, settings);
    grid.parse_parameters(prm);
    points.parse_parameters(prm);
    for (const std::string density : {"1000", "3"})
      materials.push_back(
        test::make_material<dim>("Neo-Hookean", "set Density = " + density));
    grid.create();
    points.seed(materials, dynamic, velocity);
  }

  /** Sum of @p value(location, properties) over the points. */
  template <typename Function>
  double
  sum(const Function &value) const
  {
    double result = 0;
    for (const auto &point : points.handler())
      result += value(point.get_location(), point.get_properties());
    return Utilities::MPI::sum(result, MPI_COMM_WORLD);
  }

  /** Check number and volume of the points, @p first_moment (about x = 0), and
   * that each lies in its cell, with a number of its own. */
  void
  check(const std::string &what,
        const unsigned int n,
        const double       volume,
        const double       first_moment) const
  {
    const PointLayout &l = points.layout();
    const double       V =
      sum([&](const auto &, const auto &data) { return data[l.volume]; });
    const double moment = sum(
      [&](const auto &x, const auto &data) { return x[0] * data[l.volume]; });
    double                          outside = 0;
    std::set<types::particle_index> ids;
    for (const auto &point : points.handler())
      {
        ids.insert(point.get_id());
        const unsigned int cell =
          point.get_surrounding_cell()->active_cell_index();
        for (const double lambda :
             grid.geometry().barycentric(cell, point.get_location()))
          test::add_error(outside, -lambda);
        outside = (point.get_properties()[l.F] == 1. ? outside : 1e300);
      }
    const double largest_id =
      Utilities::MPI::max(ids.empty() ? 0. : static_cast<double>(*ids.rbegin()),
                          MPI_COMM_WORLD);
    const bool own_ids =
      ids.size() == points.handler().n_locally_owned_particles();

    std::ostringstream details;
    details << points.handler().n_global_particles() << " points, volume " << V
            << ", moment " << moment << ", outside " << outside;
    test::check(what,
                points.handler().n_global_particles() == n && own_ids &&
                  largest_id == n - 1. && std::abs(V - volume) < 1e-12 &&
                  std::abs(moment - first_moment) < 1e-12 && outside < 1e-12,
                details.str());
  }
};

template <typename Function>
void
check_message(const std::string &what,
              const Function    &function,
              const std::string &expected)
{
  std::string message = "no error";
  try
    {
      function();
    }
  catch (const std::exception &exc)
    {
      message = test::one_line(exc.what());
    }
  test::check(what, message.find(expected) != std::string::npos, message);
}

void
test_bodies_2d()
{
  const std::string box  = "Grid/Upper corner = 2, 1\nGrid/Subdivisions = 4, 2"
                           "\n",
                    in   = "Material points/",
                    mesh = std::string(SOURCE_DIR) + "/square.msh\n",
                    two  = "Grid/Lower corner = -1, -1\nGrid/Upper corner = 2, "
                           "2\nGrid/Subdivisions = 7, 5\n";
  Body<2>(box + in + "Points per cell = 6").check("box", 96, 2., 2.);
  Body<2>(box + in + "Points per cell = 1\n" + in + "Region = x < 1")
    .check("region", 8, 1., 0.5);
  Body<2>(box + in + "Points per cell = 3\n" + in +
          "Points per cell in zones = 1: x < 1; 16: x < 0.5")
    .check("zones", 4 * 16 + 4 + 8 * 3, 2., 2.);
  Body<2>("Grid/Type = gmsh\nGrid/File = " + mesh + in +
          "Points per cell = 7\n" + in + "Physical groups = body")
    .check("gmsh grid", 42 * 7, 1., 0.5);
  Body<2>(two + in + "Points per cell = 4\n" + in + "Body mesh = " + mesh)
    .check("body mesh in a larger grid", 42 * 4, 1., 0.5);
  Body<2>(box + in + "Lattice spacing = 0.1").check("lattice", 200, 2., 2.);
  Body<2>(two + in + "Lattice spacing = 0.25\n" + in +
          "Region = x > 0 && x < 1 && y > 0 && y < 1")
    .check("lattice in a larger grid", 16, 1., 0.5);

  const Body<2> velocity(box, true, "2*x - y, 3 + x");
  const auto    l = velocity.points.layout();
  test::check_error("initial velocity",
                    velocity.sum([&](const auto &x, const auto &data) {
                      return std::abs(data[l.velocity] - 2 * x[0] + x[1]) +
                             std::abs(data[l.velocity + 1] - 3 - x[0]);
                    }),
                    1e-12);

  const Body<2> materials(box + in + "Materials in zones = 2: x > 1.5");
  test::check_error("mass of two materials",
                    std::abs(materials.sum([&](const auto &, const auto &data) {
                      return data[l.mass];
                    }) - 1501.5),
                    1e-9);

  check_message(
    "no points",
    [&]() { Body<2>(box + in + "Region = x > 3"); },
    "parameters of <Material points>");
  check_message(
    "body outside of the grid",
    [&]() {
      Body<2>("Grid/Upper corner = 0.9, 1\n" + in + "Body mesh = " + mesh);
    },
    "must cover the body");
  check_message(
    "unknown group",
    [&]() {
      Body<2>("Grid/Type = gmsh\nGrid/File = " + mesh + in +
              "Physical groups = boddy");
    },
    "boddy");
  check_message(
    "unknown material",
    [&]() { Body<2>(box + in + "Materials in zones = 3: x > 1"); },
    "there are 2");
}

void
test_bodies_3d()
{
  const std::string in = "Material points/";
  Body<3>("Grid/Subdivisions = 1, 1, 1").check("defaults, dim 3", 24, 1., 0.5);
  Body<3>("Grid/Upper corner = 1, 2, 1\nGrid/Subdivisions = 2, 2, 1\n" + in +
          "Points per cell = 8")
    .check("box, dim 3", 4 * 6 * 8, 2., 1.);
  Body<3>("Grid/Lower corner = -1, -1, -1\nGrid/Upper corner = 2, 2, 2\n"
          "Grid/Subdivisions = 3, 4, 5\n" +
          in + "Points per cell = 4\n" + in + "Body mesh = " + SOURCE_DIR +
          "/cube.msh")
    .check("body mesh in a larger grid, dim 3", 4 * 184, 1., 0.5);
  Body<3>("Grid/Subdivisions = 3, 3, 3\n" + in + "Lattice spacing = 0.25")
    .check("lattice, dim 3", 64, 1., 0.5);
}

/** The centroids of the @p n parts of a tetrahedron are the same, in whatever
 * order its corners come, and its orientation stays. */
void
test_corner_orders(const unsigned int n)
{
  const auto rule  = material_points_with_domains<3>(n).rule;
  double     error = 0;
  bool       kept  = true;
  const std::vector<std::array<Point<3>, 4>> tetrahedra = {
    // of a cube; the one in the middle of a cube of five, with three equal
    // diagonals, and that turned and stretched, with two; one of no particular
    // shape
    {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}}},
    {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}},
    {{{0.5, 0, 0}, {-0.5, 0, 0}, {0, 0.5, 0.9}, {0, -0.5, 0.9}}},
    {{{0, 0, 0}, {1.1, 0.2, 0}, {0.3, 0.9, 0.1}, {0.2, 0.4, 1.3}}}};
  for (const auto &tetrahedron : tetrahedra)
    {
      const auto volume = [](const std::array<Point<3>, 4> &c) {
        return cross_product_3d(c[1] - c[0], c[2] - c[0]) * (c[3] - c[0]);
      };
      std::array<unsigned int, 4> order{{0, 1, 2, 3}};
      std::vector<Point<3>>       first;
      do
        {
          std::array<Point<3>, 4> corners;
          for (unsigned int c = 0; c < 4; ++c)
            corners[c] = tetrahedron[order[c]];
          const double before = volume(corners);
          order_for_subdivision<3>(corners);
          kept = kept && volume(corners) * before > 0;
          std::vector<Point<3>> places;
          for (const Point<3> &x : rule.get_points())
            {
              places.push_back(corners[0]);
              for (unsigned int d = 0; d < 3; ++d)
                places.back() += x[d] * (corners[d + 1] - corners[0]);
            }
          if (first.empty())
            first = places;
          for (const Point<3> &x : places)
            {
              double nearest = 1;
              for (const Point<3> &y : first)
                nearest = std::min(nearest, x.distance(y));
              test::add_error(error, nearest);
            }
        }
      while (std::next_permutation(order.begin(), order.end()));
    }
  test::check("orientation of tetrahedra", kept, "");
  test::check_error("any order of corners, " + std::to_string(n) + " points",
                    error,
                    1e-12);
}

/** A short beam under its weight, and the same with x and y exchanged. */
void
test_exchanged_axes()
{
  const std::string beam   = "Quadrature/Type = CPDI\nMaterial/Young modulus = "
                             "1e4\nMaterial/Poisson ratio = 0.45\n"
                             "Material/Density = 1\nFormulation/Type = u-p\n"
                             "Newton/Tolerance = 1e-11\n",
                    probes = "Postprocess/Point probes = A: ";
  const auto along_x       = test::run_scene<3>(
    beam + probes +
    "1.9, 0.4, 0.9\nGrid/Upper corner = 2, 0.5, 1\n"
          "Grid/Subdivisions = 4, 1, 2\nBoundary conditions/Displacement = left: x "
          "= 0, y = 0, z = 0\nBoundary conditions/Gravity = 0, -100*t, 0\n");
  const auto along_y = test::run_scene<3>(
    beam + probes +
    "0.4, 1.9, 0.9\nGrid/Upper corner = 0.5, 2, 1\n"
    "Grid/Subdivisions = 1, 4, 2\nBoundary conditions/Displacement = bottom: "
    "x = 0, y = 0, z = 0\nBoundary conditions/Gravity = -100*t, 0, 0\n");
  double worst = 0;
  for (const std::string pair : {"xy", "yx", "zz"})
    test::add_error(
      worst,
      std::abs(along_x->last_statistics().get(std::string("Displacement ") +
                                              pair[0] + " of A (m)") /
                 along_y->last_statistics().get(std::string("Displacement ") +
                                                pair[1] + " of A (m)") -
               1));
  test::check_error("x and y exchanged, 8 points per tetrahedron", worst, 1e-7);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const auto &[n, degree] :
       std::vector<std::pair<unsigned int, unsigned int>>{{1, 1},
                                                          {3, 2},
                                                          {4, 1},
                                                          {6, 4},
                                                          {7, 4},
                                                          {9, 1},
                                                          {12, 6},
                                                          {15, 6},
                                                          {16, 1},
                                                          {25, 1},
                                                          {36, 1}})
    test_rule<2>(n, degree);
  for (const auto &[n, degree] :
       std::vector<std::pair<unsigned int, unsigned int>>{
         {1, 1}, {4, 2}, {8, 1}, {14, 5}, {27, 1}, {35, 7}, {64, 1}})
    test_rule<3>(n, degree);
  for (const unsigned int n : {0, 2, 5, 8, 10})
    test_refused<2>(n);
  for (const unsigned int n : {0, 2, 3, 9, 10})
    test_refused<3>(n);
  for (const unsigned int n : {1, 3, 4, 6, 9, 12, 24, 54})
    test_domains<2>(n);
  for (const unsigned int n : {1, 4, 8, 24, 32, 64})
    test_domains<3>(n);
  test_bodies_2d();
  test_bodies_3d();
  for (const unsigned int n : {8, 27, 32, 64})
    test_corner_orders(n);
  test_exchanged_axes();
  return 0;
}
