/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_load_balance_h
#define isochor_load_balance_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <isochor/base/statistics.h>
#include <isochor/material_points/material_points.h>

#include <vector>

namespace isochor
{
  using namespace dealii;

  /** When the ranks share the body unevenly enough for the grid to be divided
   * among them anew: the same for grids that adapt and for those that stay. */
  class LoadBalance
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** What a cell with material costs besides its points, in points: its share
     * of the unknowns. Three ranks with weights like these were balanced to
     * 0.2 %. */
    static constexpr unsigned int cost_of_cell = 10;

    /** The largest of the @p sums of weights, one a rank, relative to their
     * mean, less one; 0 if there is no weight. */
    static double
    imbalance(const std::vector<double> &sums);

    /** Whether an @p imbalance is worth the search for a better division. */
    bool
    is_too_large(const double imbalance) const
    {
      return imbalance > tolerated;
    }

    /** Whether a division with the imbalance @p next is so much better than the
     * present one with @p now that it is worth setting the grid up again. */
    bool
    is_worth_it(const double now, const double next) const
    {
      return is_too_large(now) && next < now / 2;
    }

  private:
    double tolerated = 0.05;
  };

  /** How the ranks share the @p points, for the statistics. Collective. */
  template <int dim>
  void
  evaluate_balance(const MaterialPoints<dim> &points,
                   const MPI_Comm             comm,
                   Statistics                &statistics);
} // namespace isochor

#endif
