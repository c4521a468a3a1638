/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/expression.h>
#include <isochor/interaction/interaction_law.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  /**
   * Contact with Coulomb friction: f_n = max(0, w·n); the part of w along the
   * surface, w_t, is returned to |f_t| ≤ min(μ f_n + c, τ_max) where f_n > 0,
   * with an adhesion c and a largest shear stress τ_max, such as α c_u of
   * undrained clay.
   */
  template <int dim>
  class Coulomb : public InteractionLaw<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm) override;

    typename InteractionLaw<dim>::Projection
    project(const Tensor<1, dim> &w,
            const Tensor<1, dim> &n,
            const double          area_ratio) const override;

    bool
    constrains_tangent() const override
    {
      return friction > 0 || adhesion > 0;
    }

  private:
    double friction   = 0;                                  ///< μ
    double adhesion   = 0;                                  ///< c (Pa)
    double most_shear = std::numeric_limits<double>::max(); ///< τ_max (Pa)
  };



  template <int dim>
  void
  Coulomb<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry("Friction coefficient",
                      "0",
                      Patterns::Double(0),
                      "Of 'Law = Coulomb': the shear stress at which the "
                      "surface slides, over the pressure.");
    prm.declare_entry("Adhesion",
                      "0",
                      Patterns::Double(0),
                      "Of 'Law = Coulomb': the shear stress (Pa) at which the "
                      "surface slides where it is in contact without pressure. "
                      "It does not resist being pulled off.");
    prm.declare_entry("Largest shear stress",
                      "",
                      Patterns::Anything(),
                      "Of 'Law = Coulomb': a bound of the shear stress (Pa) "
                      "whatever the pressure, such as alpha c_u of undrained "
                      "clay. Empty: none.");
  }



  template <int dim>
  void
  Coulomb<dim>::parse_parameters(ParameterHandler &prm)
  {
    friction               = prm.get_double("Friction coefficient");
    adhesion               = prm.get_double("Adhesion");
    const std::string most = prm.get("Largest shear stress");
    if (!most.empty())
      most_shear = number_in(most, "Largest shear stress");
    AssertThrow(most_shear >= 0,
                ExcMessage("The parameter <Largest shear stress> of an "
                           "interaction must not be negative."));
  }



  template <int dim>
  typename InteractionLaw<dim>::Projection
  Coulomb<dim>::project(const Tensor<1, dim> &w,
                        const Tensor<1, dim> &n,
                        const double          area_ratio) const
  {
    typename InteractionLaw<dim>::Projection result;
    internal::project_normal<dim>(w, n, result);
    if (result.state == SurfaceState::open)
      return result;
    const double         w_n = w * n;
    const Tensor<1, dim> w_t = w - w_n * n;
    const Tensor<2, dim> T =
      Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(n, n);
    // ∂w_t/∂n
    Tensor<2, dim> w_t_by_n = -1. * outer_product(n, w);
    for (unsigned int i = 0; i < dim; ++i)
      w_t_by_n[i][i] -= w_n;

    const double by_friction = friction * w_n + area_ratio * adhesion,
                 bound       = area_ratio * most_shear,
                 limit = std::min(by_friction, bound), size = w_t.norm();
    if (size <= limit)
      {
        result.state = SurfaceState::sticks;
        result.f += w_t;
        result.f_by_w += T;
        result.f_by_n += w_t_by_n;
        return result;
      }
    // f_t = limit w_t/|w_t|
    const Tensor<1, dim> e = w_t / size;
    const Tensor<2, dim> across =
      (limit / size) *
      (Tensor<2, dim>(unit_symmetric_tensor<dim>()) - outer_product(e, e));
    result.f += limit * e;
    result.f_by_w += across * T;
    result.f_by_n += across * w_t_by_n;
    if (by_friction < bound)
      {
        result.f_by_w += friction * outer_product(e, n);
        result.f_by_n += friction * outer_product(e, w);
      }
    return result;
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(InteractionLaw, Coulomb, "Coulomb")
} // namespace isochor
