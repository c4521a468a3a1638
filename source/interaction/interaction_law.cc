/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/interaction_law.h>

namespace isochor
{
  template <int dim>
  void
  InteractionLaw<dim>::declare_laws(ParameterHandler  &prm,
                                    const std::string &usual)
  {
    prm.declare_entry(
      "Law",
      usual,
      Patterns::Selection(PluginRegistry<InteractionLaw<dim>>::names()),
      "What the partner does to the surface. unilateral: contact without "
      "friction. Coulomb: the same with friction. tie: the surface stays where "
      "it is on the partner; the only law with 'place'. load: a given "
      "traction; the only law with 'load'. none: nothing; of two bodies, which "
      "pass through each other.");
    PluginRegistry<InteractionLaw<dim>>::declare_parameters(prm);
  }



  template <int dim>
  std::unique_ptr<InteractionLaw<dim>>
  InteractionLaw<dim>::create(ParameterHandler &prm, const std::string &section)
  {
    auto law     = PluginRegistry<InteractionLaw<dim>>::create(prm.get("Law"));
    law->section = section;
    law->parse_parameters(prm);
    return law;
  }



  namespace internal
  {
    template <int dim>
    void
    project_normal(const Tensor<1, dim>                     &w,
                   const Tensor<1, dim>                     &n,
                   typename InteractionLaw<dim>::Projection &result)
    {
      const double w_n = w * n;
      if (!(w_n >= 0))
        return;
      // f = (w·n) n
      result.state  = SurfaceState::slides;
      result.f      = w_n * n;
      result.f_by_w = outer_product(n, n);
      result.f_by_n = outer_product(n, w);
      for (unsigned int i = 0; i < dim; ++i)
        result.f_by_n[i][i] += w_n;
    }

    template void
    project_normal<2>(const Tensor<1, 2> &,
                      const Tensor<1, 2> &,
                      InteractionLaw<2>::Projection &);
    template void
    project_normal<3>(const Tensor<1, 3> &,
                      const Tensor<1, 3> &,
                      InteractionLaw<3>::Projection &);
  } // namespace internal



  template class InteractionLaw<2>;
  template class InteractionLaw<3>;
} // namespace isochor
