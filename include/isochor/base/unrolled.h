/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_unrolled_h
#define isochor_unrolled_h

#include <deal.II/base/config.h>

#include <type_traits>
#include <utility>

namespace isochor
{
  namespace internal
  {
    template <typename Function, unsigned int... i>
    inline DEAL_II_ALWAYS_INLINE void
    call_with_each(const Function &function,
                   std::integer_sequence<unsigned int, i...>)
    {
      (function(std::integral_constant<unsigned int, i>()), ...);
    }
  } // namespace internal

  /**
   * Call @p function with 0, ..., n - 1, each a constant of the compiler: for
   * the few components of tensors, in what is done at each point in each
   * iteration. A loop over them leaves the tensor in memory, since GCC unrolls
   * it only after it has decided what can be kept in registers; written there
   * by numbers and read as vectors, it stalls the processor.
   */
  template <unsigned int n, typename Function>
  inline DEAL_II_ALWAYS_INLINE void
  unrolled(const Function &function)
  {
    internal::call_with_each(function,
                             std::make_integer_sequence<unsigned int, n>());
  }
} // namespace isochor

#endif
