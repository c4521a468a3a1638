/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/element_sums.h>

namespace isochor
{
  namespace internal
  {
    double
    unseen_stiffness(const double memory,
                     const double inverse_G,
                     const double inverse_K)
    {
      const double stiffness = memory * (1 - memory) / inverse_G;
      return stiffness / (1 + stiffness * inverse_K);
    }
  } // namespace internal
} // namespace isochor
