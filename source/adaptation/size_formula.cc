/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/cell_size_criterion.h>
#include <isochor/base/expression.h>

#include <memory>
#include <sstream>

namespace isochor
{
  /** Cells as large as a formula says. */
  template <int dim>
  class SizeFormula : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Cell size",
                        "",
                        Patterns::Anything(),
                        "The largest size of cells (m), a formula in x, y(, z) "
                        "and t: the side of a square or cube of the volume of "
                        "a leaf, which two triangles or six tetrahedra share. "
                        "Empty: any.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string text = Utilities::trim(prm.get("Cell size"));
      if (!text.empty())
        formula =
          std::make_unique<Expression<dim>>(text, "Adaptive grid/Cell size");
    }

    double
    size_at(const Point<dim> &x, const double time) const override
    {
      if (!formula)
        return this->any_size;
      const double size = (*formula)(x, time);
      if (size > 0) // messages are not made for each point
        return size;
      std::ostringstream place;
      place << x;
      AssertThrow(false,
                  ExcMessage("The formula of <Adaptive grid/Cell size> is " +
                             std::to_string(size) + " at (" + place.str() +
                             "), t = " + std::to_string(time) +
                             "; sizes must be positive."));
      return size;
    }

  private:
    std::unique_ptr<Expression<dim>> formula;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion, SizeFormula, "Cell size")
} // namespace isochor
