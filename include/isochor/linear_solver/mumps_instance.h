/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mumps_instance_h
#define isochor_mumps_instance_h

#include <deal.II/base/mpi.h>

#include <dmumps_c.h>

#include <cstring>

namespace isochor
{
  using namespace dealii;

  /** Where the MUMPS users' guide's 1-based "ICNTL(i)" etc. are found. */
  template <typename Array>
  inline auto &
  entry(Array &array, const unsigned int i)
  {
    return array[i - 1];
  }

  /** One that counts, if it is negative, millions. */
  template <typename Array>
  inline double
  count(Array &array, const unsigned int i)
  {
    const double n = entry(array, i);
    return n < 0 ? -1e6 * n : n;
  }

  /**
   * One MUMPS instance: a factorisation of one matrix pattern. Ends with the
   * object, which has to happen before MPI_Finalize().
   */
  class MumpsInstance
  {
  public:
    MumpsInstance(const MPI_Comm comm, const bool symmetric)
    {
      std::memset(&id, 0, sizeof(id));
      id.comm_fortran = MPI_Comm_c2f(comm);
      id.par          = 1; // rank 0 takes part in the factorisation
      id.sym          = symmetric ? 2 : 0;
      run(-1);
      for (const unsigned int output : {1, 2, 3, 4})
        entry(id.icntl, output) = 0;
    }

    ~MumpsInstance()
    {
      run(-2);
    }

    MumpsInstance(const MumpsInstance &) = delete;
    MumpsInstance &
    operator=(const MumpsInstance &) = delete;

    /** Do a phase and return INFOG(1), the same on all ranks. */
    int
    run(const int job)
    {
      id.job = job;
      dmumps_c(&id);
      return entry(id.infog, 1);
    }

    DMUMPS_STRUC_C id;
  };
} // namespace isochor

#endif
