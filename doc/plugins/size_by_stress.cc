/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// What decides the size of cells of an adaptive grid, of one's own: small cells
// where the body is loaded most. With annulus.cc, of which the grid consists at
// first, it makes an adaptive grid of two files (adaptive_annulus.prm).

#include <deal.II/base/exceptions.h>

#include <isochor/adaptation/cell_size_criterion.h>

#include <algorithm>

namespace isochor
{
  template <int dim>
  class SizeByStress : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Cell size by stress",
                        "",
                        Patterns::Anything(),
                        "'stress: size': the largest size of cells (m) at "
                        "points whose von Mises stress exceeds this one (Pa). "
                        "Empty: any size.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const auto values = Utilities::string_to_double(
        Utilities::split_string_list(prm.get("Cell size by stress"), ':'));
      AssertThrow(values.empty() || (values.size() == 2 && values[1] > 0),
                  ExcMessage("<Adaptive grid/Cell size by stress> must be "
                             "'stress: size', with a size above 0."));
      is_active = !values.empty();
      if (is_active)
        {
          limit = values[0];
          size  = values[1];
        }
    }

    bool
    needs_state() const override
    {
      return is_active;
    }

    // limit_sizes() is asked for sizes only, and only when the grid may change
    bool
    writes_statistics() const override
    {
      return false;
    }

    void
    limit_sizes(const BodyState<dim> &state,
                const LevelRule<dim> & /*rule*/,
                std::vector<double> &sizes,
                Statistics & /*statistics*/) const override
    {
      for (unsigned int q = 0; q < state.size(); ++q)
        if (std::sqrt(1.5) * deviator(state.stress[q]).norm() > limit)
          sizes[q] = std::min(sizes[q], size);
    }

  private:
    bool   is_active = false;
    double limit = 0, size = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion,
                                 SizeByStress,
                                 "Cell size by stress")
} // namespace isochor
