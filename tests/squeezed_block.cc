/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// An incompressible Neo-Hookean block (G = 1 Pa, 1 m x 1 m (x 1 m)) is squeezed
// to 0.6 of its height between smooth plates, which the grid follows; its free
// sides move through adaptive cells. It stays homogeneous and presses with
// λ^-3 - λ N (plane) or λ^-2 - λ N (space) until it loses its stability.

#include <algorithm>
#include <sstream>

#include "run_scene.h"

using namespace isochor;

/** The last step of a squeezed block. */
template <int dim>
struct Squeezed
{
  /** @p axis is that of the load, "x" or "y". */
  Squeezed(const std::string &settings,
           const double       end_time,
           const std::string &axis = "y");

  double
  error_of_force() const
  {
    const double stretch = 1 - 0.5 * end_time;
    return test::get(*problem, force) /
             (std::pow(stretch, dim == 2 ? -3 : -2) - stretch) -
           1;
  }

  double                    end_time;
  std::string               force;
  test::ProblemPointer<dim> problem;
};

template <int dim>
Squeezed<dim>::Squeezed(const std::string &settings,
                        const double       end_time,
                        const std::string &axis)
  : end_time(end_time)
{
  const bool        y      = axis == "y";
  const std::string beside = (y ? "x" : "y"), plate = (y ? "top" : "right"),
                    foot = (y ? "bottom" : "left"),
                    side = (y ? "left" : "bottom");
  // of symmetry at the side, and in space at the front
  force = "Reaction " + axis + " on " + foot + " (N)";
  std::string corner, cells;
  if (dim == 2)
    {
      corner = (y ? "2, 1" : "1, 2");
      cells  = (y ? "8, 4" : "4, 8");
    }
  else
    {
      corner = "1.5, 1, 1.5";
      cells  = "3, 2, 3";
    }
  problem = test::run_scene<dim>(
    "Grid/Type = adaptive\nGrid/Upper corner = " + corner +
    "\nGrid/Subdivisions = " + cells + "\nGrid/Stretch = " + axis +
    ": 0 -> 0, 1 -> -0.5*t\nMaterial points/Region = (" + beside + " < 1)" +
    (dim == 3 ? " * (z < 1)" : "") +
    "\nMaterial/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
    "Material/Density = 0\nBoundary conditions/Displacement = " +
    side + ": " + beside + "=0; " + foot + ": " + axis + "=0; " + plate + ": " +
    axis + "=-0.5*t" + (dim == 3 ? "; front: z=0" : "") +
    "\nQuadrature/Type = CPDI\nTime/Step size = 0.02\nTime/End time = " +
    std::to_string(end_time) + "\nPostprocess/Reactions = " + foot + "\n" +
    settings);
}

const std::string fine_at_surface =
  "Adaptive grid/Maximum level = 1\n"
  "Adaptive grid/Cell size at surface of body = 0.13\n";

/** The quadrature knows where the body ends. */
template <int dim>
void
test_exact(const std::string &axis)
{
  const Squeezed<dim> block(dim == 2 ?
                              fine_at_surface :
                              "Adaptive grid/Maximum level = 1\n"
                              "Adaptive grid/Cell size at surface of body = "
                              "0.3\nTime/Step size = 0.1\n",
                            0.8,
                            axis);
  test::check_error("dim " + std::to_string(dim) + ", along " + axis +
                      ": force",
                    std::abs(block.error_of_force()),
                    1e-6);
}

/** On coarse cells points that have just come into a cell have most of their
 * domain elsewhere: at t = 0.48 all but 0.15 of it. */
void
test_small_parts()
{
  const Squeezed<3> block("Adaptive grid/Resets between changes = 0\n"
                          "Time/Step size = 0.12\n",
                          0.6);
  test::check_error("small parts of domains: force",
                    std::abs(block.error_of_force()),
                    1e-6);
}

/** In the plane the free sides of any such block wrinkle at λ = 0.5437, the
 * root of λ^6 + λ^4 + 3 λ^2 = 1 (Biot, Appl. Sci. Res. A 12 (1963) 168-182):
 * the matrix then has negative pivots of displacements, with elements as small
 * as these a little later. */
void
test_stability()
{
  for (const bool stable : {true, false})
    {
      const unsigned int n = 32;
      const Squeezed<2>  block("Grid/Type = box\nGrid/Upper corner = 1, 1\n"
                               "Grid/Subdivisions = 32, 32\n"
                               "Grid/Stretch = \nMaterial points/Region = 1\n"
                               "Quadrature/Type = points\n"
                               "Cut cells/Extension = never\n"
                               "Newton/Reuse factorisation = 0\n"
                               "Time/Step size = 0.05\n" +
                                test::keep_grid,
                              stable ? 0.9 : 1.);
      // one for each pressure in any case
      const double n_pivots =
        test::get(*block.problem, "Negative pivots") - (n + 1) * (n + 1);
      test::check(stable ? "stable at 0.55 of the height" :
                           "but not at half of it",
                  stable ? n_pivots == 0 : n_pivots > 0,
                  std::to_string(n_pivots) + " negative pivots");
    }
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_exact<2>("y");
  test_exact<2>("x");
  test_exact<3>("y");
  test_small_parts();
  test_stability();
  return 0;
}
