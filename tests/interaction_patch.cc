/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Homogeneous deformation of bodies that nothing but interactions moves: ties
// to places that are prescribed, and half planes that press. It is exact
// wherever the grid is and however it is turned relative to the body.

#include <deal.II/grid/grid_generator.h>
#include <deal.II/physics/transformations.h>

#include "mesh_file.h"

using namespace isochor;

namespace
{
  const double E = 1000;

  template <int dim>
  std::string
  text(const Tensor<1, dim> &v)
  {
    std::string result;
    for (unsigned int d = 0; d < dim; ++d)
      result += (d == 0 ? "" : ", ") + Utilities::to_string(v[d], 17);
    return result;
  }

  /** "x=(...)*t, y=(...)*t" */
  template <int dim>
  std::string
  motion(const Tensor<1, dim> &v)
  {
    std::string result;
    for (unsigned int d = 0; d < dim; ++d)
      result += std::string(d == 0 ? "" : ", ") + "xyz"[d] + "=(" +
                Utilities::to_string(v[d], 17) + ")*t";
    return result;
  }

  /** The unit square or cube, turned by @p Q about the origin, with a
   * mesh of its own. */
  template <int dim>
  std::string
  write_block(const Tensor<2, dim> &Q)
  {
    Triangulation<dim> boxes;
    GridGenerator::subdivided_hyper_cube(boxes, dim == 2 ? 4 : 2);
    Triangulation<dim> simplices;
    GridGenerator::convert_hypercube_to_simplex_mesh(boxes, simplices);
    std::vector<Point<dim>> vertices;
    for (const Point<dim> &x : simplices.get_vertices())
      vertices.push_back(Point<dim>(Q * x));
    std::vector<CellData<dim>> cells;
    for (const auto &cell : simplices.active_cell_iterators())
      {
        CellData<dim> data(dim + 1);
        for (const unsigned int v : cell->vertex_indices())
          data.vertices[v] = cell->vertex_index(v);
        cells.push_back(data);
      }
    test::write_mesh<dim>("block.msh",
                          vertices,
                          cells,
                          {},
                          [](const unsigned int, const unsigned int) {
                            return false;
                          });
    return "Material points/Body mesh = block.msh\n";
  }

  /** A grid around the body, moved by @p offset of its cells. */
  template <int dim>
  std::string
  grid(const double offset)
  {
    const unsigned int n = dim == 2 ? 14 : 8;
    const double       h = dim == 2 ? 0.17 : 0.29;
    Tensor<1, dim>     lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = (-3.5 + offset) * h;
        upper[d] = lower[d] + n * h;
      }
    return "Quadrature/Type = CPDI\nGrid/Lower corner = " + text(lower) +
           "\nGrid/Upper corner = " + text(upper) +
           "\nGrid/Subdivisions = " + (dim == 2 ? "14, 14\n" : "8, 8, 8\n") +
           "Material/Young modulus = 1000\nNewton/Tolerance = 1e-11\n";
  }

  /** The largest deviation of a point from the homogeneous deformation. */
  template <int dim>
  double
  deviation(const MaterialPointMethod<dim> &problem, const Tensor<2, dim> &F)
  {
    const PointLayout &l     = problem.material_points().layout();
    double             worst = 0;
    for (const auto &point : problem.material_points().handler())
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          test::add_error(worst,
                          std::abs(point.get_properties()[l.F + a * dim + b] -
                                   F[a][b]));
    return test::max_over_ranks(worst);
  }

  template <int dim>
  void
  test_place(const std::string &form, const double offset)
  {
    Tensor<2, dim> F = unit_symmetric_tensor<dim>();
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        F[a][b] += 0.2 * std::sin(1. + 3 * a + 5 * b);
    std::string where;
    for (unsigned int a = 0; a < dim; ++a)
      {
        where += std::string(a == 0 ? "" : ", ") + "xyz"[a] + "=t*(0";
        for (unsigned int b = 0; b < dim; ++b)
          where += "+(" + Utilities::to_string(F[a][b] - (a == b ? 1 : 0), 17) +
                   ")*" + "xyz"[b];
        where += ")";
      }
    const auto problem = test::run_scene<dim>(
      grid<dim>(offset) + form +
      "Material points/Region = abs(x-0.5)<0.45 && abs(y-0.5)<0.45" +
      (dim == 3 ? " && abs(z-0.5)<0.45" : "") +
      "\nTime/Step size = 0.5\nInteraction: body - place/Displacement = " +
      where + '\n');
    test::check_error("tied to places, offset " + test::in_short(offset) +
                        ", dim " + std::to_string(dim) + ", " +
                        form.substr(0, form.size() - 1),
                      deviation(*problem, F),
                      1e-9);
  }

  /** Cauchy stress over E of the Neo-Hookean law at stretches @p f; @p p is
   * the pressure for nu = 1/2. */
  double
  stress(const unsigned int           i,
         const std::array<double, 3> &f,
         const double                 nu,
         const double                 p = 0)
  {
    const double J = f[0] * f[1] * f[2], G = 0.5 / (1 + nu);
    const double mean = (f[0] * f[0] + f[1] * f[1] + f[2] * f[2]) / 3;
    return G * std::pow(J, -5. / 3) * (f[i] * f[i] - mean) +
           (nu < 0.5 ? (J - 1) / (3 - 6 * nu) : p);
  }

  /** What is above the floor: a lid that presses; a pressure, with the lid at a
   * distance; two bodies, one on the other, below the lid, that may come into
   * contact with everything. */
  enum class Above
  {
    lid,
    pressure,
    two_bodies
  };

  /** The body between half planes, on all sides if @p confined; otherwise free
   * at one end of the others. */
  template <int dim>
  void
  test_half_planes(const std::string &form,
                   const double       nu,
                   const double       offset,
                   const bool         confined,
                   const bool         axisymmetric = false,
                   const Above        above        = Above::lid)
  {
    const double   d = 0.1;
    Tensor<2, dim> Q = unit_symmetric_tensor<dim>();
    if (confined)
      {
        if constexpr (dim == 2)
          Q = Physics::Transformations::Rotations::rotation_matrix_2d(0.35);
        else
          Q = Physics::Transformations::Rotations::rotation_matrix_3d(
            Point<3>(1, 2, 3) / std::sqrt(14.), 0.35);
      }
    // stretch of the sides
    std::array<double, 3> f = {{0.99, 1 - d, dim == 3 ? 0.99 : 1.}};
    if (nu > 0.4 && confined)
      f[0] = dim == 2 ? 1 / 0.9 - 1e-3 : 1 / 0.9 / 0.99 - 1e-3;
    const bool both = dim == 3 || axisymmetric;
    if (!confined && nu == 0.5)
      f[0] = both ? 1 / std::sqrt(1 - d) : 1 / (1 - d);
    else if (!confined)
      {
        double low = 0.5, high = 2;
        for (unsigned int i = 0; i < 60; ++i)
          {
            f[0]                                = (low + high) / 2;
            f[2]                                = both ? f[0] : 1;
            (stress(0, f, nu) > 0 ? high : low) = f[0];
          }
      }
    if (both && !confined)
      f[2] = f[0];
    std::string              scene = write_block<dim>(Q);
    std::vector<std::string> bodies{"body"};
    Tensor<1, dim>           e_1;
    e_1[1]                  = 1;
    const Tensor<1, dim> up = Q * e_1;
    std::string          height;
    for (unsigned int a = 0; a < dim; ++a)
      height += (a > 0 ? " + (" : "(") + Utilities::to_string(up[a], 17) +
                ")*" + "xyz"[a];
    if (above == Above::two_bodies)
      {
        bodies = {"low", "high"};
        scene += "Material points/Bodies = low: " + height +
                 " < 0.5; high: " + height +
                 " > 0.5\nInteraction: low - high/Law = unilateral\n";
      }
    if (above == Above::pressure)
      scene += "Boundary conditions/Surfaces of body = top: " + height +
               " > 1 - 1e-6\nBoundary conditions/Pressure on body = top: " +
               Utilities::to_string(-E * stress(1, f, nu), 17) + "*t\n";
    const auto add =
      [&](const std::string &name, const unsigned int axis, const bool upper) {
        Tensor<1, dim> e;
        e[axis]                = 1;
        const std::string body = "Rigid body: " + name + '/';
        const bool is_apart    = above == Above::pressure && axis == 1 && upper;
        scene += body + "Shape = half plane\n" + body +
                 "Normal = " + text<dim>(Q * ((upper ? -1. : 1.) * e)) + '\n' +
                 body + "Point = " +
                 text<dim>(Q * ((is_apart ? 1.4 :
                                 upper    ? 1. :
                                            0.) *
                                e)) +
                 '\n';
        if (!is_apart)
          scene += body + "Motion = " +
                   motion<dim>(Q * ((upper ? f[axis] - 1 : 0.) * e)) + '\n';
        for (const std::string &of : bodies)
          scene += "Interaction: " + of + " - " + name + "/Law = unilateral\n";
      };
    add("floor", 1, false);
    add("lid", 1, true);
    const std::string sides[] = {"west", "east", "", "", "south", "north"};
    for (unsigned int axis = 0; axis < dim && confined; axis += 2)
      {
        add(sides[2 * axis], axis, false);
        add(sides[2 * axis + 1], axis, true);
      }
    if (!confined && !axisymmetric)
      scene += "Boundary conditions/Surfaces of body = side: x<1e-6\n"
               "Interaction: side - place/Displacement = x=0\n";
    if (!confined && dim == 3)
      scene += "Boundary conditions/Displacement = front: z=0\n";
    std::string settings = grid<dim>(offset);
    if (axisymmetric || (dim == 3 && !confined))
      {
        // the axis and a plane of symmetry are sides of the grid
        Tensor<1, dim> lower, upper;
        for (unsigned int a = 0; a < dim; ++a)
          {
            lower[a] =
              a == (axisymmetric ? 0 : 2) ? 0. : (-2.5 + offset) * 0.17;
            upper[a] = lower[a] + 1.9;
          }
        settings += "Grid/Lower corner = " + text(lower) +
                    "\nGrid/Upper corner = " + text(upper) + '\n';
        if (axisymmetric)
          scene += "Formulation/Geometry = axisymmetric\n"
                   "Boundary conditions/Displacement = left: x=0\n";
      }
    const auto problem = test::run_scene<dim>(
      settings + scene + form + "Material/Poisson ratio = " +
      Utilities::to_string(nu, 17) + '\n' + "Time/Step size = 0.5\n");
    Tensor<2, dim> stretch;
    for (unsigned int a = 0; a < dim; ++a)
      stretch[a][a] = f[a];
    const double p =
      nu == 0.5 ? -stress(0, f, 0.5) : 0; // free of stress along x
    const double force = -E * stress(1, f, nu, p) * f[0] *
                         (axisymmetric ? f[0] * test::pi :
                          dim == 3     ? f[2] :
                                         1.);
    Tensor<1, dim> on_floor;
    for (unsigned int a = 0; a < dim; ++a)
      on_floor[a] = test::get(*problem,
                              std::string("Force ") + "xyz"[a] + " on " +
                                bodies[0] + " by floor (N)") /
                    force;
    const std::string label =
      "half planes, " + std::string(confined ? "confined and turned, " : "") +
      (above == Above::pressure   ? "a pressure, " :
       above == Above::two_bodies ? "two bodies, " :
                                    "") +
      (axisymmetric ? "axisymmetric, " : "") + "offset " +
      test::in_short(offset) + ", nu = " + test::in_short(nu) + ", dim " +
      std::to_string(dim) + ", " + form.substr(0, form.size() - 1);
    test::check_error(label + ": deformation",
                      deviation(*problem,
                                Q * stretch * Tensor<2, dim>(transpose(Q))),
                      1e-8);
    test::check_error(label + ": force", (on_floor - up).norm(), 1e-7);
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                u = "Formulation/Type = u\n",
                    u_p              = "Formulation/Type = u-p\n";
  for (const double offset : {0., 0.3, 0.77})
    for (const std::string &form : {u, u_p})
      {
        test_place<2>(form, offset);
        for (const double nu : {0.3, 0.4999, 0.5})
          {
            if (form == u && nu == 0.5)
              continue;
            test_half_planes<2>(form, nu, offset, false);
            test_half_planes<2>(form, nu, offset, false, true);
            if (nu < 0.5)
              for (const Above above :
                   {Above::lid, Above::pressure, Above::two_bodies})
                test_half_planes<2>(form, nu, offset, true, false, above);
          }
      }
  test_place<3>(u_p, 0.3);
  test_half_planes<3>(u, 0.3, 0.3, true);
  test_half_planes<3>(u_p, 0.4999, 0.3, true);
  test_half_planes<3>(u_p, 0.5, 0.3, false);
  test_half_planes<3>(u_p, 0.3, 0.3, true, false, Above::pressure);
  test_half_planes<3>(u_p, 0.3, 0.3, true, false, Above::two_bodies);
  return 0;
}
