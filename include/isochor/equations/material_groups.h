/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_material_groups_h
#define isochor_material_groups_h

#include <isochor/equations/mixed_kernel.h>

#include <array>
#include <vector>

namespace isochor
{
  /** Up to this ratio of stiffnesses materials may share the functions of
   * cells. */
  constexpr double nearly_alike = 1.05;

  /**
   * The materials of a scene in groups, first what resists a shear of a
   * hundredth the least, which is called the softest. Stresses and strains
   * jump where groups meet, so that they should not share the functions of a
   * cell. Elastic materials whose shear and bulk moduli differ by no more than
   * the factor @p same_stiffness are one group; those that dissipate are
   * one only if they have the same stiffness and strengths and dilate alike, as
   * their stiffness may vanish.
   */
  struct MaterialGroups
  {
    template <int dim>
    MaterialGroups(const MixedKernel<dim> &kernel, const double same_stiffness);

    unsigned int
    size() const
    {
      return moduli.size();
    }

    /** The larger of the ratios of shear and of bulk moduli of two groups; 2 at
     * least if one of them dissipates. */
    double
    ratio(const unsigned int a, const unsigned int b) const;

    std::vector<unsigned int> of_material; ///< by number of the material

    /** There are at most as many as an integer has bits; others are counted as
     * the last one. */
    static constexpr unsigned int most = 64;

  private:
    /** G and K (Pa) of the first of each group. */
    std::vector<std::array<double, 2>> moduli;
    std::vector<bool>                  dissipates; ///< by group
  };
} // namespace isochor

#endif
