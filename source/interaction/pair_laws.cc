/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/pair_laws.h>

#include <algorithm>
#include <utility>

namespace isochor
{
  namespace
  {
    template <int dim>
    bool
    is_contact(const InteractionLaw<dim> &law)
    {
      return law.acts() && law.is_unilateral();
    }
  } // namespace



  template <int dim>
  PairLaws<dim>::PairLaws(
    std::vector<std::unique_ptr<Interaction<dim>>> &&interactions)
    : interactions(std::move(interactions))
    , contact(PluginRegistry<InteractionLaw<dim>>::create("unilateral"))
  {
    std::stable_partition(this->interactions.begin(),
                          this->interactions.end(),
                          [](const auto &one) {
                            return one->region.has_value();
                          });
  }



  template <int dim>
  void
  PairLaws<dim>::set_bodies(const std::vector<std::string> &names)
  {
    for (const auto &interaction : interactions)
      interaction->find_bodies(names);
  }



  template <int dim>
  const InteractionLaw<dim> *
  PairLaws<dim>::given(const FaceCopy<dim> &own,
                       const FaceCopy<dim> &other) const
  {
    for (const auto &interaction : interactions)
      if (interaction->is_between(
            own.body, own.centre(), other.body, other.centre()))
        return interaction->law.get();
    return nullptr;
  }



  template <int dim>
  const InteractionLaw<dim> &
  PairLaws<dim>::of(const FaceCopy<dim> &own, const FaceCopy<dim> &other) const
  {
    const InteractionLaw<dim> *const law = given(own, other);
    return law == nullptr ? *contact : *law;
  }



  template <int dim>
  bool
  PairLaws<dim>::have_contact(const unsigned int body,
                              const unsigned int other) const
  {
    // those of parts come first
    for (const auto &interaction : interactions)
      if (interaction->is_between(body, other))
        {
          if (is_contact(*interaction->law))
            return true;
          if (!interaction->region)
            return false;
        }
    return true;
  }



  template class PairLaws<2>;
  template class PairLaws<3>;
} // namespace isochor
