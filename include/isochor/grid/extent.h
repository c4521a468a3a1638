/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_extent_h
#define isochor_extent_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The extent of places, for messages. */
  template <int dim>
  struct Extent
  {
    std::vector<double> lower = std::vector<double>(dim, 1e300),
                        upper = std::vector<double>(dim, -1e300);

    void
    include(const Point<dim> &x)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], x[d]);
          upper[d] = std::max(upper[d], x[d]);
        }
    }

    void
    merge(const MPI_Comm comm)
    {
      Utilities::MPI::min(lower, comm, lower);
      Utilities::MPI::max(upper, comm, upper);
    }

    /** "[0, 1] x [2, 3]", with four digits of the largest difference. */
    std::string
    text() const
    {
      double largest = 0, span = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          largest = std::max({largest, std::abs(lower[d]), std::abs(upper[d])});
          span    = std::max(span, upper[d] - lower[d]);
        }
      std::ostringstream out;
      // more would show what coordinates are rounded to
      constexpr double most = 12;
      out.precision(
        span > 0 ? std::min(4 + std::ceil(std::log10(largest / span)), most) :
                   most);
      for (unsigned int d = 0; d < dim; ++d)
        out << (d > 0 ? " x [" : "[") << lower[d] << ", " << upper[d] << "]";
      return out.str();
    }
  };
} // namespace isochor

#endif
