/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A block under uniform pressure is carried over ten cells and turned by 360
// degrees: the nodes in its outer part are moved as told, those inside are
// free and have to follow. The motion of a step is linear in place and thus in
// the space of P1 functions, so that the stress should turn with the block.

#include <deal.II/physics/transformations.h>

#include <isochor/boundary_condition/boundary_condition.h>

#include <cmath>
#include <iomanip>

#include "scene.h"

using namespace isochor;

namespace
{
  constexpr double       side = 0.7, cell_size = 0.05, free_radius = 0.15;
  constexpr double       poisson_ratio = 0.3, young_modulus = 70;
  constexpr unsigned int n_steps = 24;
  const Point<2>         start_centre(0.57, 0.61);

  /** Where the block is at a time t in [0, 1]: it is compressed in the first
   * step, keeps that size, and moves steadily. */
  struct Motion
  {
    explicit Motion(const double time)
      : centre(start_centre + time * Point<2>(10 * cell_size, 0.))
      , size(1 - 0.1 * std::min(1., time * n_steps))
      , rotation(Physics::Transformations::Rotations::rotation_matrix_2d(
          2 * numbers::PI * time))
    {}

    Point<2>
    place(const Tensor<1, 2> &relative_place_at_rest) const
    {
      return Point<2>(centre + size * (rotation * relative_place_at_rest));
    }

    Tensor<1, 2>
    relative_place_at_rest(const Point<2> &x) const
    {
      return transpose(rotation) * (x - centre) / size;
    }

    Point<2>     centre;
    double       size;
    Tensor<2, 2> rotation;
  };
} // namespace

namespace isochor
{
  /** Moves all active nodes but those near the block's centre. */
  template <int dim>
  class BlockMotion : public BoundaryCondition<dim>, public ConstrainsNodes<dim>
  {
  public:
    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const override
    {
      if constexpr (dim == 2)
        {
          const Motion now(step.old_time), then(step.time);
          for (unsigned int node = 0; node < step.nodes.n_local(); ++node)
            {
              const Point<2> x =
                step.grid.geometry().vertices()[step.nodes.vertex(node)];
              if (x.distance(now.centre) < free_radius)
                continue;
              const Tensor<1, 2> u =
                then.place(now.relative_place_at_rest(x)) - x;
              for (unsigned int a = 0; a < 2; ++a)
                constraints.constrain(node * step.n_components + a, u[a]);
            }
        }
    }
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, BlockMotion, "Block motion")
} // namespace isochor

namespace
{
  /** Largest deviations of the points' places (m) and stresses (relative to
   * the pressure in the plane) from the closed form. */
  struct Deviations
  {
    double place = 0, stress = 0;
  };

  Deviations
  deviations(const MaterialPointMethod<2> &problem)
  {
    // Neo-Hookean with F = diag(s, s, 1), turned
    const Motion       end(1.);
    const double       s = end.size, J = s * s;
    const double       shear = young_modulus / (2 * (1 + poisson_ratio));
    const double       bulk  = young_modulus / (3 * (1 - 2 * poisson_ratio));
    const double       mean  = bulk * (J - 1);
    const double       dev   = shear * std::pow(J, -5. / 3.) * (s * s - 1) / 3;
    const double       exact[] = {mean + dev, mean + dev, mean - 2 * dev, 0.};
    Deviations         worst;
    const PointLayout &layout = problem.material_points().layout();
    for (const auto &point : problem.material_points().handler())
      {
        const auto     properties = point.get_properties();
        const Point<2> x          = point.get_location();
        Point<2>       at_rest    = x;
        for (unsigned int a = 0; a < 2; ++a)
          at_rest[a] -= properties[layout.displacement + a];
        test::add_error(worst.place,
                        x.distance(end.place(at_rest - start_centre)));
        for (unsigned int i = 0; i < 4; ++i)
          test::add_error(worst.stress,
                          std::abs(properties[layout.stress + i] - exact[i]) /
                            std::abs(exact[0]));
      }
    return worst;
  }

  void
  test_block(const std::string &quadrature,
             const std::string &formulation,
             const unsigned int points_per_cell,
             const double       smallest,
             const double       largest)
  {
    std::ostringstream scene;
    scene << "Quadrature/Type = " << quadrature
          << "\nFormulation/Type = " << formulation
          << "\nGrid/Upper corner = 1.7, 1.2\nGrid/Subdivisions = 34, 24\n"
          << "Material points/Points per cell = " << points_per_cell
          << "\nMaterial points/Region = if(abs(x-" << start_centre[0] << ")<"
          << side / 2 << ", if(abs(y-" << start_centre[1] << ")<" << side / 2
          << ", 1, 0), 0)\n"
          << "Material/Young modulus = " << young_modulus
          << "\nMaterial/Poisson ratio = " << poisson_ratio
          << "\nNewton/Tolerance = 1e-12\nTime/Step size = "
          << std::setprecision(17) << 1. / n_steps << '\n';
    const auto         problem = test::run_scene<2>(scene.str());
    const Deviations   worst   = deviations(*problem);
    std::ostringstream details;
    details << "place " << worst.place << ", stress " << worst.stress;
    test::check("turned block under pressure, " + quadrature + ", " +
                  formulation,
                worst.stress >= smallest && worst.stress <= largest &&
                  (worst.place < 1e-12 || smallest > 0),
                details.str());
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string formulation : {"u", "u-p"})
    {
      test_block("points", formulation, 6, 0.1, 1.);
      test_block("CPDI", formulation, 4, 0., 1e-11);
    }
  return 0;
}
