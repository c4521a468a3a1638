/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interface_watch_h
#define isochor_interface_watch_h

#include <isochor/base/warnings.h>
#include <isochor/equations/mixed_kernel.h>
#include <isochor/material_points/point_arrays.h>

namespace isochor
{
  /**
   * Warn where materials of other stiffness share the functions of a cell, as
   * bodies without fields of their own do: the stiff one gets strains of the
   * soft one. The error of its stresses was found to be some 0.15 times the
   * ratio of the stiffnesses, times the part of a cell by which one lies in
   * cells of the other one. Called when the grid has been reset at @p time.
   * Collective.
   */
  template <int dim>
  void
  warn_of_interfaces_in_cells(const PointArrays<dim> &points,
                              const MixedKernel<dim> &kernel,
                              const MPI_Comm          comm,
                              const double            time,
                              Warnings               &warnings);
} // namespace isochor

#endif
