/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/dynamics/field_followers.h>

namespace isochor
{
  namespace
  {
    /** Those of @p all that have a @p place in another field, which an equation
     * has all or none of its entries in. */
    template <typename Place>
    Followers
    select_followers(const Followers &all, const Place &place)
    {
      Followers result;
      for (unsigned int k = 0; k < all.size(); ++k)
        {
          if (place(all.entry[k]) == numbers::invalid_unsigned_int)
            continue;
          result.entry.push_back(place(all.entry[k]));
          result.value.push_back(all.value[k]);
          result.flags.push_back(all.flags[k]);
          for (std::size_t i = all.start[k]; i < all.start[k + 1]; ++i)
            {
              result.master.push_back(place(all.master[i]));
              result.weight.push_back(all.weight[i]);
            }
          result.start.push_back(result.master.size());
        }
      return result;
    }
  } // namespace



  template <int dim>
  Followers
  displacement_followers(const NodalConstraints &constraints,
                         const unsigned int      n_components)
  {
    AssertDimension(constraints.constrained.size() % n_components, 0u);
    return select_followers(constraints.followers,
                            [n_components](const unsigned int entry) {
                              return entry % n_components == dim ?
                                       numbers::invalid_unsigned_int :
                                       entry / n_components * dim +
                                         entry % n_components;
                            });
  }



  template <int dim>
  Followers
  pressure_followers(const NodalConstraints &constraints)
  {
    AssertDimension(constraints.constrained.size() % (dim + 1), 0u);
    return select_followers(constraints.followers,
                            [](const unsigned int entry) {
                              return entry % (dim + 1) == dim ?
                                       entry / (dim + 1) :
                                       numbers::invalid_unsigned_int;
                            });
  }



  void
  hand_on(const Followers &followers, NodalField &load)
  {
    AssertDimension(followers.start.size(), followers.size() + 1);
    for (unsigned int k = 0; k < followers.size(); ++k)
      if (const unsigned int entry = followers.entry[k];
          entry < load.locally_owned_size())
        {
          const double value        = load.local_element(entry);
          load.local_element(entry) = 0.;
          for (std::size_t i = followers.start[k]; i < followers.start[k + 1];
               ++i)
            load.local_element(followers.master[i]) +=
              followers.weight[i] * value;
        }
    load.compress(VectorOperation::add);
  }



  void
  set_followers(const Followers           &followers,
                const std::vector<double> &given,
                NodalField                &field)
  {
    Assert(given.empty() || given.size() == followers.size(),
           ExcInternalError());
    field.update_ghost_values();
    for (unsigned int k = 0; k < followers.size(); ++k)
      field.local_element(followers.entry[k]) =
        (given.empty() ? 0. : given[k]) +
        followers.sum(k, [&field](const unsigned int entry) {
          return field.local_element(entry);
        });
  }



  template Followers
  displacement_followers<2>(const NodalConstraints &, const unsigned int);
  template Followers
  displacement_followers<3>(const NodalConstraints &, const unsigned int);
  template Followers
  pressure_followers<2>(const NodalConstraints &);
  template Followers
  pressure_followers<3>(const NodalConstraints &);
} // namespace isochor
