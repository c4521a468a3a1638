/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The scenes of prm/billet on coarse grids: between smooth plates the closed
// form, between rough ones the same force in space and as a body of revolution.
// The meshes come from
//   gmsh -3 billet.geo -setnumber n 3 -setnumber room 0.016 -o billet.msh
//   gmsh -2 section.geo -setnumber n 3 -setnumber room 0.016
//     -o billet_section.msh

#include <deal.II/base/numbers.h>

#include "scene.h"

using namespace isochor;

/** The force (N) on the plate at a reduction @p t of the height. @p conditions:
 * another value of <Displacement>, if not empty. */
template <int dim>
double
force(const double t, const std::string &conditions)
{
  const bool       solid = (dim == 3);
  ParameterHandler prm;
  MaterialPointMethod<dim>::declare_parameters(prm);
  prm.declare_entry("Dimension", std::to_string(dim));
  prm.parse_input(std::string(SOURCE_DIR "/../prm/billet/") +
                  (solid ? "billet.prm" : "axisymmetric.prm"));
  test::set_parameters(
    prm,
    "Output/Terminal = quiet\nOutput/Directory = .\n"
    "Postprocess/Write grid = false\nPostprocess/Write material points = false\n"
    "Time/Step size = 0.02\nTime/End time = " +
      std::to_string(t) + "\nGrid/File = " SOURCE_DIR "/billet" +
      (solid ? "" : "_section") + ".msh\n" +
      (conditions.empty() ?
         "" :
         "Boundary conditions/Displacement = " + conditions + '\n'));
  MaterialPointMethod<dim> problem(MPI_COMM_WORLD);
  problem.parse_parameters(prm);
  problem.run();
  // in space the plate has four quarters
  return -(solid ? 4 : 1) *
         problem.last_statistics().get("Reaction y on plate (N)");
}

/** Between smooth plates a billet stays a cylinder in uniaxial compression:
 * F l = τ A L, τ the Kirchhoff stress, and its plastic strain is -ln(l/L) less
 * the elastic part τ/E. Terms of second order in the elastic strain are left
 * out, which is 3e-4 of the force; the return map is of first order in the size
 * of steps, and those of 2 % add 1e-3. */
double
smooth_plates(const double t)
{
  const double E = 200e9, yield = 700e6, hardening = 300e6;
  const double tau =
    (yield - hardening * std::log(1 - t)) / (1 + hardening / E);
  return tau * numbers::PI * 0.01 * 0.01 / (1 - t);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const double                     t = 0.2, exact = smooth_plates(t);
  test::check_error("smooth plates, in space",
                    std::abs(force<3>(t,
                                      "bottom: y=0; left: x=0; front: z=0; "
                                      "plate: y=-0.015*t") /
                               exact -
                             1),
                    2e-3);
  test::check_error(
    "smooth plates, axisymmetric",
    std::abs(force<2>(t, "bottom: y=0; plate: y=-0.015*t") / exact - 1),
    2e-3);
  const double solid = force<3>(t, ""), section = force<2>(t, "");
  test::check_error("rough plates, in space against axisymmetric",
                    std::abs(solid / section - 1),
                    0.03);
  // with cells of a tenth of the size, axisymmetric
  test::check_error("rough plates, against a fine grid",
                    std::abs(section / 0.3075e6 - 1),
                    0.1);
  return 0;
}
