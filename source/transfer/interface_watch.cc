/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/transfer/interface_watch.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  namespace
  {
    /** Ratios of shear moduli up to this are none. */
    constexpr double same_stiffness = 1.5;

    /** Where a corner of a domain lies in a cell of other stiffness. */
    struct Crossing
    {
      double depth = 0, ratio = 0;

      double
      weight() const
      {
        return depth * ratio;
      }
    };

    template <int dim>
    bool
    has_several_stiffnesses(const MixedKernel<dim> &kernel)
    {
      double least = std::numeric_limits<double>::max(), most = 0;
      for (const auto &material : kernel.materials)
        if (material != nullptr)
          {
            least = std::min(least, material->shear_modulus());
            most  = std::max(most, material->shear_modulus());
          }
      return most > same_stiffness * least;
    }

    /** The one of most weight of this rank's points. */
    template <int dim>
    Crossing
    find_crossing(const PointArrays<dim>   &points,
                  const PointLocator<dim>  &locator,
                  const CellOccupancy<dim> &occupancy,
                  const MixedKernel<dim>   &kernel)
    {
      Crossing most;
      for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const double G =
              kernel.materials[points.material[q]]->shear_modulus();
            const Point<dim> x = points.location(locator.geometry(), k, q);
            for (Tensor<1, dim> r : points.domain[q])
              {
                r                = points.F[q] * r;
                const auto place = locator.locate_towards(x, points.cell[k], r);
                const auto *const content = occupancy.content(place.cell);
                if (content == nullptr || !(content->reference_volume > 0))
                  continue;
                const double of_cell =
                  content->volume_times_G / content->reference_volume;
                const Crossing here = {
                  *std::min_element(place.barycentric.begin(),
                                    place.barycentric.end()),
                  std::max(G / of_cell, of_cell / G)};
                if (here.ratio > same_stiffness &&
                    here.weight() > most.weight())
                  most = here;
              }
          }
      return most;
    }
  } // namespace



  template <int dim>
  void
  warn_of_interfaces_in_cells(const PointArrays<dim>   &points,
                              const PointLocator<dim>  &locator,
                              const CellOccupancy<dim> &occupancy,
                              const MixedKernel<dim>   &kernel,
                              const double              time,
                              Warnings                 &warnings)
  {
    constexpr double much = 0.2; // 3 % of the stress
    const MPI_Comm   comm = locator.geometry().communicator();
    if (!has_several_stiffnesses(kernel) ||
        Utilities::MPI::max(points.corner_cells.size(), comm) == 0)
      return;
    const Crossing own    = find_crossing(points, locator, occupancy, kernel);
    const double   weight = Utilities::MPI::max(own.weight(), comm);
    if (weight < much)
      return;
    // of ranks that have found the same the same is told
    const bool   is_mine = own.weight() == weight;
    const double depth   = Utilities::MPI::max(is_mine ? own.depth : 0., comm);
    warnings.add(
      "materials that meet within cells",
      "At t = " + rounded(time) +
        " s materials whose stiffnesses differ by up to " +
        rounded(weight / depth) + " to 1 meet within cells, " + rounded(depth) +
        " of a cell away from its faces. The nodes of these cells strain both, "
        "the stiff one as the soft one: stresses there are wrong, the more the "
        "larger both numbers are (100 to 1, 0.006 and 0.06 of a cell: by 9 and "
        "74 % in the stiff material), and neither more points nor smaller steps "
        "help. Let the interface lie on faces of cells at t = 0, and keep the "
        "grid (<Grid reset/Steps between resets = 0>); or use <Quadrature/Type "
        "= cell-filled + boundary>.");
  }



  template void
  warn_of_interfaces_in_cells(const PointArrays<2> &,
                              const PointLocator<2> &,
                              const CellOccupancy<2> &,
                              const MixedKernel<2> &,
                              const double,
                              Warnings &);
  template void
  warn_of_interfaces_in_cells(const PointArrays<3> &,
                              const PointLocator<3> &,
                              const CellOccupancy<3> &,
                              const MixedKernel<3> &,
                              const double,
                              Warnings &);
} // namespace isochor
