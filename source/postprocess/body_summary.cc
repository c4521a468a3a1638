/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/thickness.h>
#include <isochor/postprocess/body_summary.h>

#include <limits>
#include <sstream>

namespace isochor
{
  template <int dim>
  std::string
  body_summary(const MaterialPoints<dim> &points, const MPI_Comm comm)
  {
    const PointLayout      &l    = points.layout();
    double                  mass = 0, volume = 0;
    std::array<double, dim> lower, upper;
    lower.fill(std::numeric_limits<double>::max());
    upper.fill(std::numeric_limits<double>::lowest());
    for (const auto &point : points.handler())
      {
        const auto properties = point.get_properties();
        mass += properties[l.mass];
        volume +=
          properties[l.volume] *
          thickness(l.axisymmetric,
                    point.get_location()[0] - properties[l.displacement]);
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], point.get_location()[d]);
            upper[d] = std::max(upper[d], point.get_location()[d]);
          }
      }

    std::ostringstream text;
    text << "Body: " << Utilities::MPI::sum(volume, comm)
         << (dim == 2 && !l.axisymmetric ? " m^2, " : " m^3, ")
         << Utilities::MPI::sum(mass, comm) << " kg, points in ";
    for (unsigned int d = 0; d < dim; ++d)
      text << (d == 0 ? "[" : " x [") << Utilities::MPI::min(lower[d], comm)
           << ", " << Utilities::MPI::max(upper[d], comm) << "]";
    return text.str();
  }



  template std::string
  body_summary(const MaterialPoints<2> &, const MPI_Comm);
  template std::string
  body_summary(const MaterialPoints<3> &, const MPI_Comm);
} // namespace isochor
