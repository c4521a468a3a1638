/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/adaptation/load_balance.h>

#include <algorithm>
#include <numeric>

namespace isochor
{
  void
  LoadBalance::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid reset");
    prm.declare_entry("Tolerated imbalance",
                      "0.05",
                      Patterns::Double(0),
                      "On several ranks: at a reset, the first one included, "
                      "the grid is divided among them anew if one of them has "
                      "more work than the mean by more than this part of it, "
                      "and a new division at least halves that. Work is "
                      "counted in material points; a cell with material counts "
                      "as ten more. Of any type of grid. A large number, such "
                      "as the number of ranks: grids that do not adapt stay "
                      "divided as they were made, into parts of as many cells "
                      "each, whether there is material in them or not.");
    prm.leave_subsection();
  }



  void
  LoadBalance::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Grid reset");
    tolerated = prm.get_double("Tolerated imbalance");
    prm.leave_subsection();
  }



  double
  LoadBalance::imbalance(const std::vector<double> &sums)
  {
    Assert(!sums.empty(), ExcInternalError());
    const double total = std::accumulate(sums.begin(), sums.end(), 0.);
    return total > 0 ?
             *std::max_element(sums.begin(), sums.end()) * sums.size() / total -
               1 :
             0.;
  }



  template <int dim>
  void
  evaluate_balance(const MaterialPoints<dim> &points,
                   const MPI_Comm             comm,
                   Statistics                &statistics)
  {
    const double n_own  = points.handler().n_locally_owned_particles();
    const auto   counts = Utilities::MPI::min_max_avg(n_own, comm);
    statistics.set("Largest share of points on a rank",
                   counts.max / counts.sum);
    statistics.set("Imbalance of points", counts.max / counts.avg - 1);
  }



  template void
  evaluate_balance(const MaterialPoints<2> &, const MPI_Comm, Statistics &);
  template void
  evaluate_balance(const MaterialPoints<3> &, const MPI_Comm, Statistics &);
} // namespace isochor
