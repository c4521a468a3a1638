/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// SimplexGeometry and PointLocator against an oracle that looks at all cells.

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/shared_tria.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/mapping_fe.h>

#include <isochor/material_points/point_locator.h>

#include <map>

#include "locator_tools.h"

namespace
{
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
  check_errors<2>();
  check_errors<3>();
  return 0;
}
