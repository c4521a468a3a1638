/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/cell_size_criterion.h>

#include <algorithm>

namespace isochor
{
  /** Small cells where the material flows. */
  template <int dim>
  class SizeInPlasticZones : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Cell size in plastic zones",
                        "0",
                        Patterns::Double(0),
                        "The largest size of cells (m) at points whose "
                        "equivalent plastic strain grows by more than 'Plastic "
                        "increment' in a step. 0: any.");
      prm.declare_entry("Plastic increment",
                        "0.01",
                        Patterns::Double(0),
                        "See 'Cell size in plastic zones'. Where it is less, "
                        "the size may be larger in inverse proportion.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      size      = prm.get_double("Cell size in plastic zones");
      increment = prm.get_double("Plastic increment");
    }

    bool
    needs_state() const override
    {
      return size > 0;
    }

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
      AssertDimension(sizes.size(), state.size());
      AssertDimension(state.plastic_increment.size(), state.size());
      for (unsigned int q = 0; q < state.size(); ++q)
        if (state.plastic_increment[q] > 0)
          sizes[q] =
            std::min(sizes[q],
                     size *
                       std::max(1., increment / state.plastic_increment[q]));
    }

  private:
    double size = 0, increment = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion,
                                 SizeInPlasticZones,
                                 "Cell size in plastic zones")
} // namespace isochor
