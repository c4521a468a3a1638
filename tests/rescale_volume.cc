/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// 'Project volume change' for every registered material: a change of volume
// moves the elastic volumetric strain by what is asked, and keeps dev τ.

#include <isochor/equations/mixed_kernel.h>

#include <sstream>

#include "material_test_tools.h"

using namespace isochor;

namespace
{
  bool all_passed = true;

  /** Load a point at random, change its volume, and evaluate it again where it
   * is. */
  template <int dim>
  void
  test_material(const std::string &name, const std::string &settings)
  {
    MixedKernel<dim> kernel;
    kernel.materials.push_back(test::make_material<dim>(name, settings));
    MaterialModel<dim> &material = *kernel.materials.front();
    material.prepare_rescaling();
    const double         G = material.shear_modulus();
    test::Random         random;
    test::WorstError     stress, strain;
    const Tensor<2, dim> one(unit_symmetric_tensor<dim>());
    for (unsigned int n = 0; n < 30; ++n)
      {
        test::Point<dim> point(material);
        for (unsigned int step = 0; step < 3; ++step)
          {
            const auto increment = one + random.template gradient<dim>(0.1);
            if (material.depends_on_pressure())
              point.pressure = -0.3 * G;
            point.evaluate(increment);
            point.commit(increment);
          }
        // where it is: what a return map leaves is on the yield surface
        const StressResponse<dim> before = point.evaluate(one);
        const double              J      = determinant(point.F);

        PointArrays<dim> arrays;
        arrays.material                  = {0};
        const double          correction = 0.02 * (n % 2 == 0 ? 1 : -1);
        SymmetricTensor<2, 3> cauchy     = before.deviatoric_stress / J;
        kernel.change_volume(
          arrays, 0, correction, point.F, cauchy, point.history_n.data());
        const StressResponse<dim> after = point.evaluate(one);

        const std::string where = std::to_string(dim) + "D, " + name;
        stress.add((after.deviatoric_stress - before.deviatoric_stress).norm() /
                     G,
                   where);
        stress.add(
          (determinant(point.F) * cauchy - after.deviatoric_stress).norm() / G,
          where + ", stress of the point");
        strain.add(std::abs(after.volumetric_strain - before.volumetric_strain -
                            correction),
                   where);
      }
    for (const auto *error : {&stress, &strain})
      if (!(error->value <= 1e-9))
        {
          all_passed = false;
          error->report(error == &stress ? "dev τ" : "θ^e", 1e-9);
        }
  }
} // namespace



int
main()
{
  const std::string settings =
    "set Young modulus = 1e5\nset Poisson ratio = 0.4\n"
    "subsection J2\nset Yield stress = 4e3\nend\n"
    "subsection Mohr-Coulomb\nset Cohesion = 3e3\nset Friction angle = 20\n"
    "end\n";
  for (const std::string &name :
       Utilities::split_string_list(PluginRegistry<MaterialModel<2>>::names(),
                                    '|'))
    {
      test_material<2>(name, settings);
      test_material<3>(name, settings);
    }
  test::report("dev τ stays, θ^e changes as asked", all_passed, "see above");
}
