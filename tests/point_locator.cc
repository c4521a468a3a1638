/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// SimplexGeometry, PointLocator and relocation against an oracle that looks at
// all cells and computes barycentric coordinates as ratios of volumes.

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/tria.h>
#include <deal.II/particles/particle_handler.h>

#include <isochor/grid/simplex_geometry.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/relocation.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <set>
#include <sstream>

using namespace isochor;

namespace
{
  constexpr double tolerance = 1e-9;

  /** Counts the failures of a test, on all ranks, and prints the first. */
  class Check
  {
  public:
    Check(const std::string &name)
      : name(name)
    {}

    ~Check()
    {
      const unsigned int n = Utilities::MPI::sum(n_failures, MPI_COMM_WORLD);
      if (Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        {
          std::cout << name << ": ";
          if (n == 0)
            std::cout << "OK" << std::endl;
          else
            std::cout << n << " failures" << std::endl;
        }
    }

    template <typename... Values>
    void
    require(const bool ok, const Values &...values)
    {
      if (ok)
        return;
      if (n_failures++ < 3)
        {
          std::ostringstream text;
          text.precision(17);
          ((text << values << ' '), ...);
          std::cout << "  " << name << " FAILED: " << text.str() << std::endl;
        }
    }

    void
    require_throw(const std::string           &part_of_message,
                  const std::function<void()> &function)
    {
      std::string message = "no exception";
      try
        {
          function();
        }
      catch (const std::exception &exception)
        {
          message = exception.what();
        }
      require(message.find(part_of_message) != std::string::npos,
              "expected an error with '" + part_of_message + "', got",
              message);
    }

  private:
    const std::string name;
    unsigned int      n_failures = 0;
  };



  /** In [0,1), a function of its arguments: the same on all ranks and machines
   * (the finaliser of splitmix64). */
  double
  random(const unsigned int a, const unsigned int b, const unsigned int c)
  {
    std::uint64_t z = 0x9e3779b97f4a7c15ull * (1 + a);
    z += 0xd1342543de82ef95ull * (1 + b) + 0x2545f4914f6cdd1dull * (1 + c);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z = z ^ (z >> 31);
    return (z >> 11) * 0x1p-53;
  }



  template <int dim>
  struct Oracle
  {
    using Cell = std::array<Point<dim>, dim + 1>;

    Oracle(const Triangulation<dim> &tria)
      : Oracle(tria, tria.get_vertices())
    {}

    Oracle(const Triangulation<dim>      &tria,
           const std::vector<Point<dim>> &vertices)
    {
      for (const auto &cell : tria.active_cell_iterators())
        {
          Cell corners;
          for (unsigned int v = 0; v <= dim; ++v)
            corners[v] = vertices[cell->vertex_index(v)];
          cells.push_back(corners);
        }
    }

    static double
    signed_measure(const Cell &x)
    {
      const Tensor<1, dim> a = x[1] - x[0], b = x[2] - x[0];
      if constexpr (dim == 2)
        return (a[0] * b[1] - a[1] * b[0]) / 2;
      else
        return (cross_product_3d(a, b) * (x[3] - x[0])) / 6;
    }

    std::array<double, dim + 1>
    barycentric(const unsigned int c, const Point<dim> &x) const
    {
      std::array<double, dim + 1> lambda;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          Cell part = cells[c];
          part[i]   = x;
          lambda[i] = signed_measure(part) / signed_measure(cells[c]);
        }
      return lambda;
    }

    double
    lowest(const unsigned int c, const Point<dim> &x) const
    {
      const auto lambda = barycentric(c, x);
      return *std::min_element(lambda.begin(), lambda.end());
    }

    /** The cell that holds x best, and its lowest coordinate. */
    std::pair<unsigned int, double>
    best(const Point<dim> &x) const
    {
      std::pair<unsigned int, double> best(0, -1e300);
      for (unsigned int c = 0; c < cells.size(); ++c)
        if (const double value = lowest(c, x); value > best.second)
          best = {c, value};
      return best;
    }

    /** A point in a random cell. */
    Point<dim>
    random_point(const unsigned int a, const unsigned int b) const
    {
      const auto &cell = cells[random(a, b, 90) * cells.size()];
      Point<dim>  x;
      double      sum = 0;
      for (unsigned int i = 0; i <= dim; ++i)
        {
          const double weight = 0.01 + random(a, b, i);
          x += weight * Tensor<1, dim>(cell[i]);
          sum += weight;
        }
      return Point<dim>(x / sum);
    }

    std::vector<Cell> cells;
  };



  template <int dim>
  void
  make_grid(const std::string &name, Triangulation<dim> &tria)
  {
    if (name == "box")
      return GridGenerator::subdivided_hyper_rectangle_with_simplices(
        tria,
        std::vector<unsigned int>(dim, dim == 2 ? 12 : 5),
        Point<dim>(),
        dim == 2 ? Point<dim>(3, 2) : Point<dim>(3, 2, 1));

    Triangulation<dim> hypercubes;
    if (name == "L")
      GridGenerator::hyper_L(hypercubes);
    else if (name == "hole")
      {
        // [0,3]^d without [1,2]^d
        Triangulation<dim> full;
        GridGenerator::subdivided_hyper_cube(full, 3, 0., 3.);
        std::set<typename Triangulation<dim>::active_cell_iterator> removed;
        for (const auto &cell : full.active_cell_iterators())
          {
            Point<dim> middle;
            for (unsigned int d = 0; d < dim; ++d)
              middle[d] = 1.5;
            if (cell->center().distance(middle) < 0.1)
              removed.insert(cell);
          }
        GridGenerator::create_triangulation_with_removed_cells(full,
                                                               removed,
                                                               hypercubes);
      }
    else if (name == "shell")
      GridGenerator::hyper_shell(
        hypercubes, Point<dim>(), 0.5, 1., dim == 2 ? 8 : 6);
    else if (name == "ball")
      GridGenerator::hyper_ball(hypercubes);
    if (dim == 2 && name != "hole")
      hypercubes.refine_global(1);
    GridGenerator::convert_hypercube_to_simplex_mesh(hypercubes, tria);
  }



  template <int dim>
  std::vector<Point<dim>>
  perturbed_vertices(const Triangulation<dim> &tria, const double size)
  {
    std::vector<Point<dim>> vertices    = tria.get_vertices();
    std::vector<bool>       is_boundary = std::vector<bool>(vertices.size());
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int f : cell->face_indices())
        if (cell->at_boundary(f))
          for (unsigned int v = 0; v < dim; ++v)
            is_boundary[cell->face(f)->vertex_index(v)] = true;
    for (unsigned int v = 0; v < vertices.size(); ++v)
      if (!is_boundary[v])
        for (unsigned int d = 0; d < dim; ++d)
          vertices[v][d] += size * (2 * random(v, d, 0) - 1);
    return vertices;
  }



  /** A turn about the last axis, a stretch and a shift. */
  template <int dim>
  Point<dim>
  transformed(const Point<dim> &x, const double t)
  {
    Point<dim> y = x;
    y[0]         = (1 + t) * (std::cos(t) * x[0] - std::sin(t) * x[1]) + t;
    y[1]         = std::sin(t) * x[0] + std::cos(t) * x[1];
    return y;
  }



  template <int dim>
  void
  check_topology(const Triangulation<dim>   &tria,
                 const SimplexGeometry<dim> &geometry,
                 Check                      &check)
  {
    check.require(geometry.n_cells() == tria.n_active_cells(), "n_cells");
    for (const auto &cell : tria.active_cell_iterators())
      {
        const unsigned int c          = cell->active_cell_index();
        unsigned int       n_boundary = 0;
        for (const unsigned int f : cell->face_indices())
          n_boundary += cell->at_boundary(f);
        check.require(geometry.cell_iterator(c) == cell, "iterator", c);

        for (unsigned int i = 0; i <= dim; ++i)
          {
            const unsigned int n = geometry.neighbours(c)[i];
            if (n == SimplexGeometry<dim>::no_cell)
              {
                --n_boundary;
                continue;
              }
            const auto               &theirs = geometry.vertex_indices(n);
            std::set<unsigned int>    common(theirs.begin(), theirs.end());
            std::array<bool, dim + 1> shared;
            for (unsigned int v = 0; v <= dim; ++v)
              {
                shared[v] = common.count(cell->vertex_index(v)) == 1;
                check.require(shared[v] == (v != i), "neighbour", c, n, i, v);
              }
            const auto &back = geometry.neighbours(n);
            check.require(std::count(back.begin(), back.end(), c) == 1,
                          "not mutual",
                          c,
                          n);
          }
        check.require(n_boundary == 0, "boundary faces of", c, n_boundary);
      }
  }



  template <int dim>
  void
  check_maps(const Oracle<dim>          &oracle,
             const SimplexGeometry<dim> &geometry,
             Check                      &check)
  {
    for (unsigned int c = 0; c < geometry.n_cells(); ++c)
      {
        const double measure = Oracle<dim>::signed_measure(oracle.cells[c]);
        check.require(geometry.is_positively_oriented(c) == (measure > 0),
                      "orientation",
                      c);
        check.require(std::abs(geometry.measure(c) - std::abs(measure)) <
                        1e-12 * std::abs(measure),
                      "measure",
                      geometry.measure(c),
                      measure);
        for (unsigned int k = 0; k < 3; ++k)
          {
            const auto x      = oracle.random_point(c, k);
            const auto lambda = geometry.barycentric(c, x);
            const auto exact  = oracle.barycentric(c, x);
            for (unsigned int i = 0; i <= dim; ++i)
              check.require(std::abs(lambda[i] - exact[i]) <
                              tolerance * (1 + std::abs(exact[i])),
                            "lambda",
                            lambda[i],
                            exact[i]);
          }
        // The gradients of an affine function from its values at the vertices.
        for (unsigned int i = 0; i <= dim; ++i)
          for (unsigned int j = 1; j <= dim; ++j)
            {
              const double difference =
                geometry.gradients(c)[i] *
                (oracle.cells[c][j] - oracle.cells[c][0]);
              const double exact = (i == j) - double(i == 0);
              check.require(std::abs(difference - exact) < tolerance,
                            "gradient",
                            difference,
                            exact);
            }
      }
  }



  template <int dim>
  void
  check_result(const Oracle<dim>       &oracle,
               const Point<dim>        &x,
               const LocateResult<dim> &result,
               Check                   &check)
  {
    check.require(result.found, "not found:", x);
    if (!result.found)
      return;
    check.require(oracle.lowest(result.cell, x) > -tolerance,
                  "wrong cell for",
                  x,
                  result.cell);
    const auto exact = oracle.barycentric(result.cell, x);
    for (unsigned int i = 0; i <= dim; ++i)
      check.require(result.barycentric[i] >= 0. &&
                      std::abs(result.barycentric[i] - exact[i]) < tolerance,
                    "barycentric of",
                    x,
                    result.barycentric[i],
                    exact[i]);
  }



  /** Points in and around the grid, from any hint. */
  template <int dim>
  void
  check_random_points(const Oracle<dim>       &oracle,
                      const PointLocator<dim> &locator,
                      Check                   &check)
  {
    const unsigned int n_cells  = oracle.cells.size();
    unsigned int       n_inside = 0, n_outside = 0;
    for (unsigned int k = 0; k < 1000; ++k)
      {
        Point<dim> x = oracle.random_point(k, 1);
        if (k % 2 == 0) // anywhere between and beyond two points of the grid
          {
            const Point<dim> y = oracle.random_point(k, 2);
            const double     s = 1.8 * random(k, 3, 0) - 0.4;
            x                  = x + s * (y - x);
          }
        const unsigned int hint =
          k % 10 == 9 ? SimplexGeometry<dim>::no_cell :
                        static_cast<unsigned int>(random(k, 4, 0) * n_cells);
        const auto best   = oracle.best(x);
        const auto result = locator.locate(x, hint);
        if (best.second > tolerance)
          {
            ++n_inside;
            check_result(oracle, x, result, check);
            check.require(result.cell == best.first, "not the best cell", x);
          }
        else if (best.second < -tolerance)
          {
            ++n_outside;
            check.require(!result.found &&
                            result.cell == SimplexGeometry<dim>::no_cell,
                          "found outside:",
                          x,
                          best.second);
          }
      }
    check.require(n_inside > 500 && n_outside > 20,
                  "the samples",
                  n_inside,
                  n_outside);
  }



  /** Vertices and the centres of edges and faces. */
  template <int dim>
  void
  check_faces(const Oracle<dim>       &oracle,
              const PointLocator<dim> &locator,
              Check                   &check)
  {
    const unsigned int n_cells = oracle.cells.size();
    for (unsigned int c = 0; c < n_cells; ++c)
      for (unsigned int set = 1; set < (1u << (dim + 1)) - 1; ++set)
        {
          Point<dim>   x;
          unsigned int n = 0;
          for (unsigned int i = 0; i <= dim; ++i)
            if (set & (1u << i))
              {
                x += Tensor<1, dim>(oracle.cells[c][i]);
                ++n;
              }
          x /= n;
          check.require(locator.locate(x, c).cell == c, "hint", c, x);
          const unsigned int hint   = random(c, set, 5) * n_cells;
          const auto         result = locator.locate(x, hint);
          check_result(oracle, x, result, check);
          check.require(locator.locate(x, hint).cell == result.cell, "repeat");
        }
  }



  /** Just outside a boundary face: by rounding, and by more. */
  template <int dim>
  void
  check_boundary(const Oracle<dim>       &oracle,
                 const PointLocator<dim> &locator,
                 Check                   &check)
  {
    const auto &geometry = locator.geometry();
    for (unsigned int c = 0; c < oracle.cells.size(); ++c)
      for (unsigned int i = 0; i <= dim; ++i)
        if (geometry.neighbours(c)[i] == SimplexGeometry<dim>::no_cell)
          for (const double lambda : {-1e-11, -1e-6})
            for (const unsigned int hint : {c, geometry.no_cell})
              {
                Point<dim> x =
                  Point<dim>(lambda * Tensor<1, dim>(oracle.cells[c][i]));
                for (unsigned int j = 0; j <= dim; ++j)
                  if (j != i)
                    x +=
                      (1 - lambda) / dim * Tensor<1, dim>(oracle.cells[c][j]);
                const auto result = locator.locate(x, hint);
                if (lambda > -1e-10)
                  check_result(oracle, x, result, check);
                else
                  check.require(!result.found, "found outside", x);
              }
  }



  template <int dim>
  void
  check_grid(const std::string &name, const double exact_measure)
  {
    Check              check("locate " + std::to_string(dim) + "D " + name);
    Triangulation<dim> tria;
    make_grid(name, tria);
    SimplexGeometry<dim>    geometry(tria);
    const PointLocator<dim> locator(geometry);
    check_topology(tria, geometry, check);

    double measure = 0;
    for (unsigned int c = 0; c < geometry.n_cells(); ++c)
      measure += geometry.measure(c);
    if (exact_measure > 0)
      check.require(std::abs(measure - exact_measure) < tolerance,
                    "measure of the grid",
                    measure,
                    exact_measure);

    const auto check_all = [&](const Oracle<dim> &oracle) {
      check_maps(oracle, geometry, check);
      check_random_points(oracle, locator, check);
      check_faces(oracle, locator, check);
      check_boundary(oracle, locator, check);
    };
    check_all(Oracle<dim>(tria));

    // An unstructured grid, moved twice: the search tree must follow.
    auto vertices = perturbed_vertices(tria, name == "box" ? 0.03 : 0.01);
    for (unsigned int repeat = 0; repeat < 2; ++repeat)
      {
        for (auto &vertex : vertices)
          vertex = transformed(vertex, 0.7);
        geometry.set_vertices(vertices);
        check_all(Oracle<dim>(tria, vertices));
      }
    geometry.update();
    check_maps(Oracle<dim>(tria), geometry, check);
  }



  /** Across the hole of [0,3]^d without [1,2]^d, and into it. */
  template <int dim>
  void
  check_hole()
  {
    Check check("locate " + std::to_string(dim) + "D across a hole");
    Triangulation<dim> tria;
    make_grid("hole", tria);
    const SimplexGeometry<dim> geometry(tria);
    const PointLocator<dim>    locator(geometry);
    const Oracle<dim>          oracle(tria);
    for (unsigned int d = 0; d < dim; ++d)
      for (unsigned int k = 0; k < 50; ++k)
        {
          Point<dim> from, to;
          for (unsigned int e = 0; e < dim; ++e)
            {
              from[e] = 1.05 + 0.9 * random(d, k, e);
              to[e]   = 1.05 + 0.9 * random(d, k, 10 + e);
            }
          const Point<dim> inside = from;
          from[d] -= 1;
          to[d] += 1;
          const unsigned int hint = oracle.best(from).first;
          check_result(oracle, to, locator.locate(to, hint), check);
          check.require(!locator.locate(inside, hint).found, "hole", inside);
        }
  }



  template <int dim>
  void
  check_arrays()
  {
    Check              check("relocate_points " + std::to_string(dim) + "D");
    Triangulation<dim> tria;
    make_grid("L", tria);
    const SimplexGeometry<dim> geometry(tria);
    const PointLocator<dim>    locator(geometry);
    const Oracle<dim>          oracle(tria);

    std::vector<Point<dim>>   points;
    std::vector<unsigned int> hints, exact;
    std::vector<std::size_t>  changed, lost;
    for (unsigned int k = 0; k < 300; ++k)
      {
        points.push_back(oracle.random_point(k, 0));
        exact.push_back(oracle.best(points.back()).first);
        hints.push_back(k % 3 ? exact.back() : (7 * k) % oracle.cells.size());
        if (k % 50 == 1)
          {
            points.back()[0] = (k % 100 == 1) ? 10. : std::nan("");
            exact.back()     = SimplexGeometry<dim>::no_cell;
            lost.push_back(k);
          }
        else if (hints.back() != exact.back())
          changed.push_back(k);
      }
    const auto result = relocate_points<dim>(locator,
                                             make_array_view(points),
                                             make_array_view(hints));
    check.require(result.cells == exact, "cells");
    check.require(result.changed == changed && changed.size() > 50, "changed");
    check.require(result.lost == lost && lost.size() == 6, "lost");
    for (unsigned int k = 0; k < points.size(); ++k)
      if (exact[k] != SimplexGeometry<dim>::no_cell)
        for (unsigned int i = 0; i <= dim; ++i)
          check.require(std::abs(result.barycentrics[k][i] -
                                 oracle.barycentric(exact[k], points[k])[i]) <
                          tolerance,
                        "barycentric",
                        k);
    hints.pop_back();
    check.require_throw("one hint", [&]() {
      relocate_points<dim>(locator,
                           make_array_view(points),
                           make_array_view(hints));
    });
  }



  /** The square as two triangles, one numbered clockwise. */
  void
  check_orientation()
  {
    Check                       check("orientation");
    Triangulation<2>            tria;
    std::vector<CellData<2>>    cells(2, CellData<2>(3));
    const std::vector<Point<2>> vertices = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    cells[0].vertices                    = {0, 1, 2};
    cells[1].vertices                    = {1, 2, 3};
    tria.create_triangulation(vertices, cells, SubCellData());
    const SimplexGeometry<2> geometry(tria);
    const PointLocator<2>    locator(geometry);
    const Oracle<2>          oracle(tria);
    check.require(geometry.is_positively_oriented(0), "cell 0");
    check.require(!geometry.is_positively_oriented(1), "cell 1");
    check.require(std::abs(geometry.measure(1) - 0.5) < 1e-14, "measure");
    check_topology(tria, geometry, check);
    check_maps(oracle, geometry, check);
    check.require(locator.locate({0.8, 0.7}, 0).cell == 1, "locate in 1");
    check.require(locator.locate({0.2, 0.1}, 1).cell == 0, "locate in 0");
  }



  template <int dim>
  void
  check_errors()
  {
    Check              check("errors " + std::to_string(dim) + "D");
    Triangulation<dim> hypercube, tria;
    GridGenerator::hyper_cube(hypercube);
    check.require_throw("triangles",
                        [&]() { SimplexGeometry<dim> geometry(hypercube); });

    make_grid("box", tria);
    SimplexGeometry<dim> geometry(tria);
    const auto           before   = geometry.vertices();
    const auto           indices  = geometry.vertex_indices(3);
    auto                 vertices = before;
    vertices.pop_back();
    check.require_throw("vertices", [&]() { geometry.set_vertices(vertices); });

    vertices             = before;
    vertices[indices[0]] = vertices[indices[1]];
    check.require_throw("Degenerate",
                        [&]() { geometry.set_vertices(vertices); });

    vertices[indices[0]][0] = std::nan("");
    check.require_throw("Degenerate",
                        [&]() { geometry.set_vertices(vertices); });

    vertices = before;
    for (auto &vertex : vertices)
      vertex[0] = -vertex[0];
    check.require_throw("inside out",
                        [&]() { geometry.set_vertices(vertices); });

    check.require(geometry.vertices() == before, "vertices kept");
    check_maps(Oracle<dim>(tria), geometry, check);

    Triangulation<dim> refined;
    make_grid("box", refined);
    if (dim == 2)
      {
        refined.begin_active()->set_refine_flag();
        refined.execute_coarsening_and_refinement();
        check.require_throw("hanging nodes",
                            [&]() { SimplexGeometry<dim> hanging(refined); });
      }
  }



  /** Particles that drift and jump on a grid that moves, compared with a copy
   * of all of them that every rank keeps. */
  template <int dim>
  class ParticleTest
  {
  public:
    ParticleTest(const Triangulation<dim> &tria, const std::string &name)
      : check("relocate " + std::to_string(dim) + "D " + name)
      , tria(tria)
      , mapping(FE_SimplexP<dim>(1))
      , handler(tria, mapping, n_properties)
      , geometry(tria)
      , locator(geometry)
      , comm(geometry.communicator())
      , rank(Utilities::MPI::this_mpi_process(comm))
      , n_ranks(Utilities::MPI::n_mpi_processes(comm))
    {}

    void
    run()
    {
      seed();
      compare(0);
      for (unsigned int step = 1; step <= 20; ++step)
        {
          if (step % 5 == 0)
            move_grid(0.01 * step);
          move(step, step == 8);
          const RelocationReport<dim> report = relocate(handler, locator);
          compare_report(report);
          compare(step);
        }
      check.require(n_moved > 2000, "too few moves:", n_moved);
      check.require(n_ranks == 1 || n_shipped > 300, "shipped", n_shipped);
    }

  private:
    struct Expected
    {
      Point<dim>   location;
      unsigned int cell;
    };

    static constexpr unsigned int n_particles  = 600;
    static constexpr unsigned int n_properties = 3;

    static double
    property(const unsigned int id, const unsigned int k)
    {
      return random(id, k, 77);
    }

    void
    seed()
    {
      const Oracle<dim> oracle(tria);
      for (unsigned int id = 0; id < n_particles; ++id)
        {
          const auto x    = oracle.random_point(id, 0);
          const auto cell = oracle.best(x).first;
          expected[id]    = {x, cell};
          if (geometry.cell_iterator(cell)->is_locally_owned())
            {
              std::vector<double> values;
              for (unsigned int k = 0; k < n_properties; ++k)
                values.push_back(property(id, k));
              handler.insert_particle(x,
                                      geometry.reference_location(
                                        oracle.barycentric(cell, x)),
                                      id,
                                      geometry.cell_iterator(cell),
                                      make_array_view(values));
            }
        }
      handler.update_cached_numbers();
    }

    void
    move_grid(const double amount)
    {
      auto vertices = tria.get_vertices();
      for (auto &vertex : vertices)
        vertex = transformed(vertex, amount);
      geometry.set_vertices(vertices);
    }

    /** Small moves, unless they lead out; jumps to anywhere for every fifth;
     * every 97th leaves the grid if @p lose is set. */
    void
    move(const unsigned int step, const bool lose)
    {
      const Oracle<dim> oracle(tria, geometry.vertices());
      n_changes = n_handed_over = 0;
      expected_lost.clear();
      for (auto entry = expected.begin(); entry != expected.end();)
        {
          const unsigned int id = entry->first;
          Point<dim>         x  = entry->second.location;
          for (unsigned int d = 0; d < dim; ++d)
            x[d] += 0.2 * (2 * random(id, step, d) - 1);
          if (oracle.best(x).second < tolerance || (id + step) % 5 == 0)
            x = oracle.random_point(id, step);
          if (lose && id % 97 == 0)
            {
              expected_lost[id] = {x + Point<dim>::unit_vector(0) * 100,
                                   entry->second.cell};
              entry             = expected.erase(entry);
              continue;
            }
          const unsigned int old_cell = entry->second.cell;
          const unsigned int cell     = oracle.best(x).first;
          n_changes += (cell != old_cell);
          n_handed_over += (geometry.cell_iterator(cell)->subdomain_id() !=
                            geometry.cell_iterator(old_cell)->subdomain_id());
          entry->second = {x, cell};
          ++entry;
        }
      for (auto &particle : handler)
        {
          const unsigned int id   = particle.get_id();
          const bool         gone = expected_lost.count(id) == 1;
          particle.set_location(gone ? expected_lost[id].location :
                                       expected[id].location);
        }
    }

    void
    compare_report(const RelocationReport<dim> &report)
    {
      check.require(report.n_moved == n_changes,
                    "n_moved",
                    report.n_moved,
                    n_changes);
      check.require(report.n_shipped == n_handed_over,
                    "n_shipped",
                    report.n_shipped,
                    n_handed_over);
      n_moved += report.n_moved;
      n_shipped += report.n_shipped;

      check.require(report.n_lost == expected_lost.size(),
                    "n_lost",
                    report.n_lost);
      check.require(Utilities::MPI::sum(report.lost.size(), comm) ==
                      report.n_lost,
                    "list of lost particles");
      for (unsigned int i = 0; i < report.lost.size(); ++i)
        {
          const unsigned int id = report.lost.ids[i];
          check.require(expected_lost.count(id) == 1 &&
                          expected_lost[id].location ==
                            report.lost.locations[i] &&
                          expected_lost[id].cell == report.lost.cells[i],
                        "lost",
                        id,
                        report.lost.locations[i]);
          for (unsigned int k = 0; k < n_properties; ++k)
            check.require(report.lost.payload(i)[k] == property(id, k),
                          "payload of lost",
                          id);
        }
    }

    void
    compare(const unsigned int step)
    {
      const Oracle<dim>                  oracle(tria, geometry.vertices());
      std::vector<types::particle_index> ids;
      for (auto &particle : handler)
        {
          const unsigned int id   = particle.get_id();
          const auto         cell = particle.get_surrounding_cell();
          ids.push_back(id);
          check.require(expected.count(id) == 1, "stranger", step, id);
          if (expected.count(id) == 0)
            continue;
          const Point<dim> x = expected[id].location;
          check.require(particle.get_location() == x, "location", step, id);
          check.require(cell->active_cell_index() == expected[id].cell,
                        "cell",
                        step,
                        id);
          check.require(cell->is_locally_owned(), "owner", step, id);
          const auto lambda = oracle.barycentric(expected[id].cell, x);
          for (unsigned int d = 0; d < dim; ++d)
            check.require(std::abs(particle.get_reference_location()[d] -
                                   lambda[d + 1]) < tolerance,
                          "reference location",
                          step,
                          id);
          for (unsigned int k = 0; k < n_properties; ++k)
            check.require(particle.get_properties()[k] == property(id, k),
                          "property",
                          step,
                          id);
        }

      std::multiset<unsigned int> all_ids;
      for (const auto &theirs : Utilities::MPI::all_gather(comm, ids))
        all_ids.insert(theirs.begin(), theirs.end());
      for (const auto &entry : expected)
        check.require(all_ids.count(entry.first) == 1,
                      "times present:",
                      step,
                      entry.first,
                      all_ids.count(entry.first));
      check.require(handler.n_global_particles() == expected.size(),
                    "count",
                    step,
                    handler.n_global_particles());
      check.require(handler.n_locally_owned_particles() == ids.size(),
                    "local count",
                    step);
    }

    Check                            check;
    const Triangulation<dim>        &tria;
    MappingFE<dim>                   mapping;
    Particles::ParticleHandler<dim>  handler;
    SimplexGeometry<dim>             geometry;
    PointLocator<dim>                locator;
    const MPI_Comm                   comm;
    const unsigned int               rank;
    const unsigned int               n_ranks;
    std::map<unsigned int, Expected> expected, expected_lost;
    unsigned int                     n_changes = 0, n_handed_over = 0;
    unsigned int                     n_moved = 0, n_shipped = 0;
  };



  template <int dim>
  void
  check_particles(const std::string &name)
  {
    parallel::shared::Triangulation<dim> shared(
      MPI_COMM_WORLD,
      Triangulation<dim>::none,
      false,
      parallel::shared::Triangulation<dim>::partition_metis);
    make_grid(name, shared);
    ParticleTest<dim>(shared, name + ", shared grid").run();

    Triangulation<dim> serial;
    make_grid(name, serial);
    ParticleTest<dim>(serial, name + ", serial grid").run();
  }



  /** Without a hint a vertex belongs to the first of its cells. The
   * coordinates are such that there is no rounding. */
  void
  check_ties()
  {
    Check            check("ties");
    Triangulation<2> tria;
    GridGenerator::subdivided_hyper_cube_with_simplices(tria, 8);
    const SimplexGeometry<2>  geometry(tria);
    const PointLocator<2>     locator(geometry);
    std::vector<unsigned int> first(tria.n_vertices(), geometry.no_cell);
    for (const auto &cell : tria.active_cell_iterators())
      for (const unsigned int v : cell->vertex_indices())
        first[cell->vertex_index(v)] =
          std::min(first[cell->vertex_index(v)], cell->active_cell_index());
    for (unsigned int v = 0; v < first.size(); ++v)
      check.require(locator.locate(geometry.vertices()[v], geometry.no_cell)
                        .cell == first[v],
                    "vertex",
                    v);
  }



  /** Every rank sends a record to each rank; without payload, too. */
  void
  check_exchange()
  {
    Check                              check("exchange_points");
    parallel::shared::Triangulation<2> tria(
      MPI_COMM_WORLD,
      Triangulation<2>::none,
      false,
      parallel::shared::Triangulation<2>::partition_metis);
    make_grid("box", tria);
    const SimplexGeometry<2> geometry(tria);
    const unsigned int rank = Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);

    for (const unsigned int n_payload : {0, 2})
      {
        PointRecords<2> records(n_payload);
        for (unsigned int c = 0; c < geometry.n_cells(); ++c)
          {
            const std::vector<double> values = {c + 0.25, -1. * rank};
            records.push_back(c,
                              rank * geometry.n_cells() + c,
                              Point<2>(0.1 * c, 0.3 * rank),
                              ArrayView<const double>(values.data(),
                                                      n_payload));
          }
        std::size_t  n_shipped = 0;
        const auto   received  = exchange_points(records, geometry, n_shipped);
        unsigned int n_mine    = 0;
        for (const auto &cell : tria.active_cell_iterators())
          n_mine += cell->is_locally_owned();
        check.require(received.size() == n_mine * n_ranks, "received");
        check.require(n_shipped == geometry.n_cells() - n_mine, "shipped");
        for (unsigned int i = 0; i < received.size(); ++i)
          {
            const unsigned int c      = received.cells[i];
            const unsigned int origin = received.ids[i] / geometry.n_cells();
            check.require(geometry.cell_iterator(c)->is_locally_owned() &&
                            received.ids[i] % geometry.n_cells() == c &&
                            received.locations[i] ==
                              Point<2>(0.1 * c, 0.3 * origin),
                          "record",
                          i);
            check.require(received.payload(i).size() == n_payload, "size", i);
            if (n_payload == 2)
              check.require(received.payload(i)[0] == c + 0.25 &&
                              received.payload(i)[1] == -1. * origin,
                            "payload",
                            i);
          }
      }
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);

  check_grid<2>("box", 6);
  check_grid<2>("L", 3);
  check_grid<2>("hole", 8);
  check_grid<2>("shell", -1);
  check_grid<2>("ball", -1);
  check_grid<3>("box", 6);
  check_grid<3>("L", 7);
  check_grid<3>("hole", 26);
  check_grid<3>("shell", -1);
  check_hole<2>();
  check_hole<3>();
  check_arrays<2>();
  check_arrays<3>();
  check_orientation();
  check_ties();
  check_errors<2>();
  check_errors<3>();
  check_exchange();
  check_particles<2>("box");
  check_particles<2>("hole");
  check_particles<3>("box");
  check_particles<3>("L");
}
