/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/dynamics/inertia_term.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  bool
  steps_over_waves(const StepContext<dim> &step)
  {
    Assert(step.step_size() > 0, ExcInternalError());
    // of each body: the largest speed of shear waves and of x, -x
    constexpr unsigned int n_entries = 1 + 2 * dim;
    std::vector<double>    most(step.grid.n_layers() * n_entries,
                             -std::numeric_limits<double>::max());
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      for (unsigned int q = step.points.cell_start[k];
           q < step.points.cell_start[k + 1];
           ++q)
        {
          double *const of_body =
            &most[step.grid.layer_of_cell(step.points.cell[k]) * n_entries];
          const auto &material =
            *step.kernel.materials[step.points.material[q]];
          const Point<dim> x = step.points.location(step.grid.geometry(), k, q);
          of_body[0] =
            std::max(of_body[0],
                     std::sqrt(material.shear_modulus() / material.density()));
          for (unsigned int d = 0; d < dim; ++d)
            {
              of_body[1 + 2 * d] = std::max(of_body[1 + 2 * d], x[d]);
              of_body[2 + 2 * d] = std::max(of_body[2 + 2 * d], -x[d]);
            }
        }
    Utilities::MPI::max(most, step.grid.communicator(), most);
    for (std::size_t i = 0; i < most.size(); i += n_entries)
      {
        double extent = std::numeric_limits<double>::max();
        for (unsigned int d = 0; d < dim; ++d)
          extent = std::min(extent, most[i + 1 + 2 * d] + most[i + 2 + 2 * d]);
        if (most[i] >= 0 && most[i] * step.step_size() <= extent / 2)
          return false;
      }
    return true;
  }



  template bool
  steps_over_waves(const StepContext<2> &);
  template bool
  steps_over_waves(const StepContext<3> &);
} // namespace isochor
