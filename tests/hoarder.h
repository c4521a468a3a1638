/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_hoarder_h
#define isochor_tests_hoarder_h

#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_model/material_model.h>

namespace isochor
{
  /** A law that wants to remember more than there is room for. */
  template <int dim>
  class Hoarder : public MaterialModel<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &)
    {}
    void
    parse_parameters(ParameterHandler &) override
    {}
    StressStatus
    evaluate(const Kinematics<dim> &,
             const double *,
             double *,
             StressResponse<dim> &) const override
    {
      return StressStatus::success;
    }
    std::vector<std::string>
    history_names() const override
    {
      return std::vector<std::string>(max_history + 1, "junk");
    }
    double
    shear_modulus() const override
    {
      return 1;
    }
    double
    inverse_bulk_modulus() const override
    {
      return 1;
    }
    double
    density() const override
    {
      return 1;
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(MaterialModel, Hoarder, "Hoarder")
} // namespace isochor

#endif
