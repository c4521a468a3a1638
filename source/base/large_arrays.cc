/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/large_arrays.h>

#include <cstdlib> // defines __GLIBC__
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace isochor
{
  void
  return_large_arrays()
  {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest one it accepts
    mallopt(M_MMAP_MAX, 65536);          // of the library
#endif
  }
} // namespace isochor
