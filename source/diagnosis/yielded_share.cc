/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/diagnosis/yielded_share.h>
#include <isochor/material_model/plastic_strain.h>

#include <algorithm>
#include <array>

namespace isochor
{
  template <int dim>
  double
  yielded_share(const MaterialPoints<dim> &points,
                const MixedKernel<dim>    &kernel,
                const MPI_Comm             comm)
  {
    constexpr unsigned int none = numbers::invalid_unsigned_int;
    const auto index = entries_of_plastic_strain<dim>(kernel.materials);
    if (std::all_of(index.begin(), index.end(), [](const unsigned int i) {
          return i == none;
        }))
      return -1;
    const PointLayout    &l = points.layout();
    std::array<double, 2> volumes{};
    for (const auto &particle : points.handler())
      {
        const auto         values = particle.get_properties();
        const unsigned int i =
          index[static_cast<unsigned int>(values[l.material])];
        volumes[0] += values[l.volume];
        if (i != none && values[l.history + i] > 0)
          volumes[1] += values[l.volume];
      }
    sum_over_ranks(volumes, comm);
    return volumes[1] / volumes[0];
  }



  template double
  yielded_share<2>(const MaterialPoints<2> &,
                   const MixedKernel<2> &,
                   const MPI_Comm);
  template double
  yielded_share<3>(const MaterialPoints<3> &,
                   const MixedKernel<3> &,
                   const MPI_Comm);
} // namespace isochor
