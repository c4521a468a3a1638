/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Parameters of materials in other units. */
  template <int dim>
  class DoubtfulMaterials : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      const auto &materials = scene.kernel.materials;
      for (unsigned int m = 0; m < materials.size(); ++m)
        if (const std::string text = materials[m]->doubts(); !text.empty())
          this->warn("of <Material" +
                     (m == 0 ? "" : " " + std::to_string(m + 1)) +
                     ">: " + text);
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    DoubtfulMaterials,
    "doubtful units",
    ISOCHOR_ESSENTIAL,
    "a yield stress or cohesion above Young's modulus, or below 10⁻⁶ of it (of "
    "a cohesion: without friction), as if one were in MPa or kPa and the other "
    "in Pa; or a friction angle of up to one degree, as if in radians",
    "the same units; degrees")
} // namespace isochor
