/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Bodies with fields of their own: each moves and deforms as it does alone,
// wherever the others are.

#include <isochor/grid/nearest_cells.h>

#include <array>
#include <cstring>
#include <map>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Where a point was at t = 0, in units in which no place is a half. */
  constexpr double units_per_metre = 777777.7;
  template <int dim>
  using Place = std::array<long, dim>;

  /** By place at t = 0, of all ranks: the body, then location and all
   * properties. */
  template <int dim>
  using Points = std::map<Place<dim>, std::vector<double>>;

  template <int dim>
  Points<dim>
  points_of(const MaterialPointMethod<dim> &problem)
  {
    const auto         &points = problem.material_points();
    const unsigned int  first  = points.layout().displacement;
    std::vector<double> values;
    std::size_t         length = 0;
    for (const auto &particle : points.handler())
      {
        const auto       properties = particle.get_properties();
        const Point<dim> x          = particle.get_location();
        for (unsigned int d = 0; d < dim; ++d)
          values.push_back(
            std::round((x[d] - properties[first + d]) * units_per_metre));
        values.push_back(points.body_of(particle));
        for (unsigned int d = 0; d < dim; ++d)
          values.push_back(x[d]);
        values.insert(values.end(), properties.begin(), properties.end());
        // that another body is behind a face isn't alike
        if (const PointLayout &l = points.layout(); l.with_surface)
          {
            double &faces =
              values[values.size() - properties.size() + l.outer_faces];
            faces = static_cast<unsigned int>(faces) % (1u << (dim + 1));
          }
        length = 2 * dim + 1 + properties.size();
      }
    Points<dim> all;
    length = Utilities::MPI::max(length, MPI_COMM_WORLD);
    for (const auto &of_rank :
         Utilities::MPI::all_gather(MPI_COMM_WORLD, values))
      for (std::size_t i = 0; i < of_rank.size(); i += length)
        {
          Place<dim> place;
          std::copy_n(of_rank.begin() + i, dim, place.begin());
          all[place].assign(of_rank.begin() + i + dim,
                            of_rank.begin() + i + length);
        }
    return all;
  }



  /** The largest difference between the points @p alone and those at the same
   * places of @p together, of any field relative to the largest value of this
   * field (or to 1 if that is larger); 1e300 if one is missing. */
  template <int dim>
  double
  difference(const Points<dim> &together, const Points<dim> &alone)
  {
    const std::size_t   n = alone.begin()->second.size();
    std::vector<double> scale(n, 1.);
    for (const auto &point : alone)
      for (std::size_t i = 1; i < n; ++i)
        scale[i] = std::max(scale[i], std::abs(point.second[i]));
    double worst = 0;
    for (const auto &[place, values] : alone)
      {
        const auto other = together.find(place);
        if (other == together.end())
          return 1e300;
        for (std::size_t i = 1; i < n; ++i)
          // a field of bits may be no number
          if (std::memcmp(&other->second[i], &values[i], sizeof(double)) != 0)
            test::add_error(worst,
                            std::abs(other->second[i] - values[i]) / scale[i]);
      }
    return worst;
  }



  /** Let two of @p bodies pass through each other. */
  std::string
  no_interaction(const std::string &bodies)
  {
    const std::string names = bodies == "auto"            ? "body 1 - body 2" :
                              bodies == "left: x < 2"     ? "left - body" :
                              bodies == "second: x > 1.5" ? "second - body" :
                                                            "left - right";
    return "Interaction: " + names + "/Law = none\n";
  }



  /** Run @p settings with the regions @p first and @p second, each alone and
   * both as bodies, and compare. Returns the points of the bodies. */
  template <int dim>
  Points<dim>
  compare(const std::string &name,
          const std::string &settings,
          const std::string &first,
          const std::string &second,
          const std::string &bodies = "auto")
  {
    const std::string common =
      "Newton/Tolerance = 1e-13\nNewton/Inexact = false\n" + settings;
    const auto run = [&](const std::string &more) {
      return points_of<dim>(*test::run_scene<dim>(common + more));
    };
    const auto a = run("Material points/Region = (" + first + ") || 0 > 1\n");
    const auto b = run("Material points/Region = (" + second + ") || 0 > 1\n");
    const auto both = run("Material points/Region = (" + first + ") || (" +
                          second + ")\nMaterial points/Bodies = " + bodies +
                          "\n" + no_interaction(bodies));
    test::check(name + ": all points are there",
                both.size() == a.size() + b.size(),
                std::to_string(both.size()));
    unsigned int n_wrong = 0;
    for (const auto &[place, values] : both)
      n_wrong += values[0] != (a.count(place) == a.count(both.begin()->first) ?
                                 both.begin()->second[0] :
                                 1 - both.begin()->second[0]);
    test::check(name + ": points know their body",
                n_wrong == 0,
                std::to_string(n_wrong));
    test::check_error(name + ": the first as alone",
                      difference<dim>(both, a),
                      1e-10);
    test::check_error(name + ": the second as alone",
                      difference<dim>(both, b),
                      1e-10);
    return both;
  }



  const std::string heavy = "Material/Young modulus = 100\n"
                            "Material/Poisson ratio = 0.3\n"
                            "Material/Density = 1\n"
                            "Boundary conditions/Gravity = 0, -5\n"
                            "Boundary conditions/Displacement = bottom: x=0, "
                            "y=0\n"
                            "Time/End time = 1\nTime/Step size = 0.5\n"
                            "Grid reset/Steps between resets = 1\n";

  void
  test_statics()
  {
    const std::string grid = "Grid/Upper corner = 4, 2\n"
                             "Grid/Subdivisions = 16, 8\n"
                             "Quadrature/Type = CPDI\n" +
                             heavy;
    compare<2>("far apart", grid, "x < 1 && y < 1", "x > 2.5 && y < 1");
    compare<2>("far apart, named",
               grid,
               "x < 1 && y < 1",
               "x > 2.5 && y < 1",
               "left: x < 2");
    compare<2>("in one cell",
               grid + "Material points/Lattice spacing = 0.023\n",
               "x < 1.05 && y < 0.5",
               "x > 1.125 && y < 0.5 && x < 2");
    compare<2>("in one cell, Q1",
               grid + "Material points/Lattice spacing = 0.023\n"
                      "Grid/Shape functions = Q1\n",
               "x < 1.05 && y < 0.5",
               "x > 1.125 && y < 0.5 && x < 2");
    compare<2>("pulled at surfaces",
               grid + "Boundary conditions/Surfaces of body = ends: y > 0.999\n"
                      "Boundary conditions/Traction on body = ends: 1, 2\n",
               "x < 1 && y < 1",
               "x > 1.25 && x < 2.5 && y < 1");
    compare<2>("a grid that is stretched",
               grid + "Grid/Stretch = y: 0 -> 0, 2 -> -0.1*t\n",
               "x < 1 && y < 1",
               "x > 1.25 && x < 2.5 && y < 1");
  }



  const std::string flying = "Grid/Upper corner = 4, 1\n"
                             "Grid/Subdivisions = 32, 8\n"
                             "Quadrature/Type = CPDI\n"
                             "Material/Young modulus = 100\n"
                             "Material/Poisson ratio = 0.3\n"
                             "Material/Density = 1\n"
                             "Dynamics/Inertia = true\n"
                             "Dynamics/Initial velocity = "
                             "if(x < 2, 2, -2) * (1 + 0.1*y), 0\n"
                             "Grid reset/Steps between resets = 1\n"
                             "Time/End time = 1\nTime/Step size = 0.0625\n";
  const std::string adaptive =
    "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
    "Grid/Subdivisions = 16, 4\nAdaptive grid/Maximum level = 1\n"
    "Adaptive grid/Cell size at surface of body = 0.125\n";
  const std::string left  = "x > 0.5 && x < 1.5 && y > 0.25 && y < 0.75";
  const std::string right = "x > 2.5 && x < 3.5 && y > 0.25 && y < 0.75";

  void
  test_crossing()
  {
    // from 0.25 s on they overlap, at 0.5 s they are at the same place
    const auto both = compare<2>("through each other", flying, left, right);
    // mass times mean velocity
    std::array<double, 2> momentum{};
    const PointLayout     layout(
      2, 0, true, true, false, false, false, false, true);
    double mean[2] = {0, 0}, mass[2] = {0, 0};
    for (const auto &[place, values] : both)
      {
        const double *properties = values.data() + 3;
        const int     body       = values[0];
        momentum[body] += properties[layout.mass] * properties[layout.velocity];
        mass[body] += properties[layout.mass];
        mean[body] +=
          properties[layout.mass] * (place[0] < 2 * units_per_metre ? 2 : -2) *
          (1 + 0.1 * (values[2] - properties[layout.displacement + 1]));
      }
    for (unsigned int body = 0; body < 2; ++body)
      test::check_error("body " + std::to_string(body + 1) +
                          " keeps its momentum",
                        std::abs(momentum[body] / mean[body] - 1),
                        1e-10);
    compare<2>("through each other, u",
               flying + "Formulation/Type = u\n",
               left,
               right,
               "left: x < 2; right: x > 2");
    compare<2>("through each other, adaptive", flying + adaptive, left, right);
  }



  void
  test_boundaries()
  {
    compare<2>("round and round",
               flying + "Boundary conditions/Periodic sides = left: right\n"
                        "Dynamics/Initial velocity = if(x < 2, 2, 0), 0\n"
                        "Grid reset/Steps between resets = 0\n"
                        "Grid reset/Smallest element quality = 0\n",
               "x < 4 && y < 0.25",
               "y > 0.375 && y < 0.75");
    const std::string falling =
      flying + "Boundary conditions/Gravity = 0, -5\n";
    const std::string beside = "x > 1.5 && x < 2.5 && y > 0.25 && y < 0.75";
    for (const std::string &grid : {std::string(), adaptive})
      {
        const std::string floor =
          "Boundary conditions/Walls = bottom: n >= 0\n";
        const std::string name = floor.substr(20, floor.size() - 21) +
                                 (grid.empty() ? "" : ", adaptive");
        compare<2>("through each other, " + name,
                   falling + floor + grid,
                   left,
                   right);
        compare<2>("side by side, " + name,
                   falling + "Dynamics/Initial velocity = 0, -0.5\n" + floor +
                     grid,
                   left,
                   beside,
                   "second: x > 1.5");
      }
  }



  void
  test_space()
  {
    compare<3>("3D",
               "Grid/Upper corner = 1, 1, 4\nGrid/Subdivisions = 2, 2, 8\n"
               "Quadrature/Type = CPDI\nMaterial/Young modulus = 100\n"
               "Material/Density = 1\nDynamics/Inertia = true\n"
               "Dynamics/Initial velocity = 0, 0, if(z < 2, 1, -1)\n"
               "Grid reset/Steps between resets = 1\n"
               "Boundary conditions/Displacement = left: x=0\n"
               "Time/End time = 1.5\nTime/Step size = 0.25\n",
               "z > 0.5 && z < 1.5",
               "z > 2.5 && z < 3.5");
  }



  /** Two halves of another material: one part, but two bodies. */
  void
  test_materials()
  {
    const std::string scene =
      "Grid/Upper corner = 2, 1\n"
      "Grid/Subdivisions = 8, 4\n"
      "Quadrature/Type = CPDI\n"
      "Material 2/Young modulus = 10\n"
      "Material points/Materials in zones = 2: x > 1\n" +
      heavy +
      "Material 2/Density = 1\nBoundary conditions/Gravity = 0, -0.01\n"
      "Boundary conditions/Displacement = everywhere: x=0, y=0\n";
    const auto names = [&](const std::string &bodies) {
      std::string text;
      const auto  problem =
        test::run_scene<2>(scene + "Material points/Bodies = " + bodies + "\n");
      for (const auto &name : problem->material_points().bodies().names())
        text += "<" + name + ">";
      return text;
    };
    const auto expect = [&](const std::string &bodies,
                            const std::string &expected) {
      const std::string found = names(bodies);
      test::check("bodies of '" + bodies + "'", found == expected, found);
    };
    expect("", "<body>");
    expect("auto", "<body 1><body 2>");
    expect("all: 1", "<all>");
    expect("upper: y > 0.5", "<body><upper>");
    expect("a: x < 0.5; b: x > 0.5; a: x > 1.5", "<a><b>");
    std::string message;
    try
      {
        names("far: x > 3");
      }
    catch (const StandardExceptions::ExcMessage &exception)
      {
        message = exception.what();
      }
    test::check("a body without points is told",
                message.find("names the body <far>") != std::string::npos,
                message);
  }



  /** The probe belongs to the body that was there at t = 0, also where the
   * other one has come. */
  void
  test_probe()
  {
    const auto displacement = [](const std::string &more) {
      return test::get(*test::run_scene<2>(
                         flying +
                         "Time/End time = 0.5\n"
                         "Postprocess/Point probes = p: 1, 0.5\n" +
                         more),
                       "Displacement x of p (m)");
    };
    const double alone =
      displacement("Material points/Region = " + left + "\n");
    const double crossed =
      displacement(no_interaction("auto") +
                   "Material points/Bodies = auto\nMaterial points/Region = (" +
                   left + ") || (" + right + ")\n");
    test::check_error("a probe stays in its body",
                      std::abs(crossed - alone),
                      1e-10);
  }



  /** Interrupted and resumed: the same to the last bit. */
  void
  test_restart(const std::string &name, const std::string &settings)
  {
    const std::string scene =
      flying + no_interaction("auto") +
      "Material points/Bodies = auto\nMaterial points/Region = (" + left +
      ") || (" + right +
      ")\nCheckpoint/Interval = 4\nLinear solver/Solver = Amesos\n"
      "Postprocess/Point probes = p: 1, 0.5\n" +
      settings;
    const auto all = points_of<2>(*test::run_scene<2>(scene));
    test::run_scene<2>(scene + "Time/End time = 0.5\n");
    const auto resumed =
      points_of<2>(*test::run_scene<2>(scene + "Checkpoint/Resume = true\n"));
    bool same = all.size() == resumed.size();
    for (const auto &[place, values] : all)
      {
        const auto other = resumed.find(place);
        same             = same && other != resumed.end() &&
               std::memcmp(other->second.data(),
                           values.data(),
                           values.size() * sizeof(double)) == 0;
      }
    test::check("resumed, the same to the last bit, " + name,
                same,
                std::to_string(difference<2>(all, resumed)));
  }



  /** The copies of a grid are like the first one. */
  template <int dim>
  void
  test_layers(const std::string &settings)
  {
    ParameterHandler prm;
    BackgroundGrid<dim>::declare_parameters(prm);
    test::set_parameters(prm, settings);
    BackgroundGrid<dim> one(MPI_COMM_WORLD), grid(MPI_COMM_WORLD);
    for (BackgroundGrid<dim> *const g : {&one, &grid})
      {
        g->parse_parameters(prm);
        g->create();
      }
    const unsigned int n_layers = 3;
    grid.set_layers(n_layers);
    const auto        &a = one.geometry(), &b = grid.geometry();
    const unsigned int n = a.n_cells();
    bool               ok =
      grid.n_layers() == n_layers && one.n_layers() == 1 &&
      b.n_cells() == n_layers * n &&
      grid.boundary_faces().size() == n_layers * one.boundary_faces().size();
    for (unsigned int l = 0; l < n_layers; ++l)
      for (unsigned int c = 0; c < n; ++c)
        {
          const unsigned int copy = grid.cell_in_layer(c, l);
          ok                      = ok && grid.layer_of_cell(copy) == l &&
               a.owner(c) == b.owner(copy) &&
               a.cell_iterator(c)->material_id() ==
                 b.cell_iterator(copy)->material_id();
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const unsigned int vertex = b.vertex_indices(copy)[v];
              ok =
                ok && grid.layer_of_vertex(vertex) == l &&
                (grid.is_adaptive() ||
                 vertex == grid.vertex_in_layer(a.vertex_indices(c)[v], l)) &&
                b.vertices()[vertex] == a.vertices()[a.vertex_indices(c)[v]];
              const unsigned int beside = a.neighbours(c)[v];
              ok                        = ok && b.neighbours(copy)[v] ==
                           (beside == SimplexGeometry<dim>::no_cell ?
                              beside :
                              grid.cell_in_layer(beside, l));
            }
        }
    for (unsigned int f = 0; f < grid.boundary_faces().size(); ++f)
      {
        const auto &face = grid.boundary_faces()[f];
        const auto &first =
          one.boundary_faces()[f % one.boundary_faces().size()];
        ok = ok && face.id == first.id && face.cell % n == first.cell &&
             face.opposite_vertex == first.opposite_vertex;
      }
    // the walk from the far end takes more steps than allowed
    const PointLocator<dim> locator(b);
    const Point<dim>        x = cell_centroid(a, 0);
    for (unsigned int l = 0; l < n_layers; ++l)
      {
        const auto place = locator.locate(x, grid.cell_in_layer(n - 1, l));
        ok = ok && place.found && place.cell == grid.cell_in_layer(0, l);
      }
    test::check("layers are copies, " + std::to_string(dim) + "D" +
                  (grid.is_adaptive() ? ", adaptive" : ""),
                ok,
                "");
  }
} // namespace



int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_layers<2>("Grid/Type = box\nGrid/Upper corner = 100, 1\n"
                 "Grid/Subdivisions = 100, 2\n");
  test_layers<3>("Grid/Type = box\nGrid/Subdivisions = 40, 2, 2\n");
  test_layers<2>("Grid/Type = adaptive\nGrid/Coarse cells = box\n"
                 "Grid/Upper corner = 100, 1\nGrid/Subdivisions = 100, 2\n");
  test_materials();
  test_statics();
  test_crossing();
  test_boundaries();
  test_space();
  test_probe();
  test_restart("box", "");
  test_restart("adaptive", adaptive);
  return 0;
}
