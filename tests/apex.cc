/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A block between smooth sides is pulled to the apex of the Mohr-Coulomb
// surface, where nothing resists, and pressed back: elastic from the apex on,
// with a closed form. In u-p no step was small enough to leave the apex.

#include "run_scene.h"

using namespace isochor;

namespace
{
  constexpr double E = 1000, nu = 0.3, c = 1, phi = 30;

  /** The stretch at t = 1 and at the end, t = 2. */
  constexpr double longest = 1.01, last = 0.998;

  template <int dim>
  std::string
  block(const std::string &formulation, const double psi)
  {
    const std::string motion = "if(t < 1, 0.01*t, 0.01 - 0.012*(t - 1))";
    return "Formulation/Type = " + formulation +
           "\nGrid/Stretch = y: 0 -> 0, 1 -> " + motion +
           (dim == 2 ? "\nGrid/Subdivisions = 4, 4\n" :
                       "\nGrid/Subdivisions = 3, 3, 3\n") +
           "Boundary conditions/Displacement = left: x=0; right: x=0; " +
           (dim == 3 ? "front: z=0; back: z=0; " : "") +
           "bottom: y=0; top: y=" + motion +
           "\nMaterial/Model = Mohr-Coulomb\n"
           "Material/Young modulus = " +
           std::to_string(E) +
           "\nMaterial/Poisson ratio = " + std::to_string(nu) +
           "\nMaterial/Mohr-Coulomb/Cohesion = " + std::to_string(c) +
           "\nMaterial/Mohr-Coulomb/Friction angle = " + std::to_string(phi) +
           "\nMaterial/Mohr-Coulomb/Dilation angle = " + std::to_string(psi) +
           "\nPostprocess/Reactions = top\nTime/Step size = 0.1\n";
  }

  template <int dim>
  void
  test_block(const std::string &formulation, const double psi)
  {
    const std::string name = std::to_string(dim) + "D, " + formulation +
                             ", dilation " +
                             std::to_string(static_cast<int>(psi)),
                      reaction = "Reaction y on top (N)";
    const double K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu)),
                 apex       = c / std::tan(phi * test::pi / 180);
    const std::string scene = block<dim>(formulation, psi);

    const auto pulled = test::run_scene<dim>(scene + "Time/End time = 1\n");
    test::check_error(name + ", at the apex",
                      test::relative(test::get(*pulled, reaction),
                                     apex / longest),
                      1e-8);
    const auto problem = test::run_scene<dim>(scene + "Time/End time = 2\n");
    test::check_error(name + ", pressed back",
                      test::relative(test::get(*problem, reaction),
                                     (apex + (K + 4 * G / 3) *
                                               std::log(last / longest)) /
                                       last),
                      1e-8);
    test::check(name + ", no step is cut",
                test::recorded().times.size() == 20,
                std::to_string(test::recorded().times.size()) + " steps");
  }
} // namespace

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  for (const std::string formulation : {"u", "u-p"})
    for (const double psi : {30., 10., 0.})
      test_block<2>(formulation, psi);
  test_block<3>("u-p", 30);
  return 0;
}
