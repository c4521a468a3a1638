/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/threads.h>

#include <dlfcn.h>

#include <cstdlib>

namespace isochor
{
  void
  use_one_thread_per_rank()
  {
    for (const char *variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"})
      if (std::getenv(variable) != nullptr)
        return;
    // The libraries read these variables when they are loaded: to set them now
    // is too late. Which BLAS it is, is not known before.
    for (const char *name : {"openblas_set_num_threads", "omp_set_num_threads"})
      if (void *const function = dlsym(RTLD_DEFAULT, name))
        reinterpret_cast<void (*)(int)>(function)(1);
  }
} // namespace isochor
