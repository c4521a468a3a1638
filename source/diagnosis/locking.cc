/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Linear displacements that have to keep the volume of each element. */
  template <int dim>
  class Locking : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      // K/G of Poisson's ratio of 0.48
      constexpr double nearly_incompressible = 25;
      bool             locks                 = false;
      for (const auto &material : scene.kernel.materials)
        locks = locks ||
                material->shear_modulus() * material->inverse_bulk_modulus() <
                  1 / nearly_incompressible;
      if (!scene.mixed() && (locks || scene.may_yield))
        this->warn(std::string("<Formulation/Type = u> ") +
                   (locks ? "with a <Poisson ratio> near 0.5" :
                            "where the material yields and keeps its volume") +
                   ": linear displacements are too stiff, forces and limit "
                   "loads too large, by half and more on coarse grids. Use "
                   "<Formulation/Type = u-p>.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    Locking,
    "volumetric locking",
    ISOCHOR_ESSENTIAL,
    "`Formulation/Type = u` with a Poisson ratio above 0.48, or with a law "
    "that yields: linear displacements can't keep the volume of each element "
    "without being too stiff (a bonded pad with ν = 0.4999 is 2.1 times too "
    "stiff, clay around a pile by 36 %)",
    "`u-p`")
} // namespace isochor
