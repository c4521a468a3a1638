/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/base/thickness.h>
#include <isochor/postprocess/postprocessor.h>

#include <algorithm>
#include <limits>

namespace isochor
{
  /**
   * What the body has in total, after each step: number, mass and current
   * volume of the points, that of the body as the quadrature sees it, the
   * extremes of the points' volume ratio J and, in dynamics, their kinetic
   * energy (per metre of thickness in plane strain).
   */
  template <int dim>
  class Balance : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Write balance",
                        "true",
                        Patterns::Bool(),
                        "Whether number, volume, mass, extreme J and kinetic "
                        "energy of the material points go into the "
                        "statistics.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write balance");
    }

    /** Points in cells that the body fills stand for the whole cell, so that
     * this volume shows what that of the points can't: whether they have been
     * squeezed together or drawn apart. */
    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics            &statistics) override
    {
      if (!enabled)
        return;
      const PointArrays<dim> &points = result.step.points;
      double                  volume = 0;
      for (unsigned int q = 0; q < points.weight.size(); ++q)
        volume += points.measure(q) * determinant(points.F[q]) *
                  result.step.kernel.hoop_stretch(
                    points.history.data() + q * std::size_t(points.n_history));
      statistics.set("Volume in the grid " + unit(result),
                     Utilities::MPI::sum(volume,
                                         result.step.grid.communicator()));
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      if (!enabled)
        return;
      const MPI_Comm        comm    = result.step.grid.communicator();
      const auto           &handler = result.points.handler();
      const PointLayout    &l       = result.points.layout();
      double                min_J   = std::numeric_limits<double>::max();
      double                max_J   = std::numeric_limits<double>::lowest();
      std::array<double, 4> sums{}; // number, volume, mass, energy
      for (const auto &particle : handler)
        {
          const double *values = particle.get_properties().data();
          const double  hoop =
            result.step.kernel.hoop_stretch(values + l.history);
          const double J =
            determinant(deformation_gradient<dim>(values, l)) * hoop;
          min_J = std::min(min_J, J);
          max_J = std::max(max_J, J);
          sums[0] += 1;
          sums[1] +=
            J * values[l.volume] *
            thickness(l.axisymmetric, particle.get_location()[0] / hoop);
          sums[2] += values[l.mass];
          if (l.dynamic)
            for (unsigned int a = 0; a < dim; ++a)
              sums[3] += values[l.mass] / 2 * values[l.velocity + a] *
                         values[l.velocity + a];
        }
      sum_over_ranks(sums, comm);
      statistics.set("Number of material points", sums[0]);
      statistics.set("Material volume " + unit(result), sums[1]);
      statistics.set("Mass (kg)", sums[2]);
      statistics.set("Smallest J", Utilities::MPI::min(min_J, comm));
      statistics.set("Largest J", Utilities::MPI::max(max_J, comm));
      if (l.dynamic)
        statistics.set("Kinetic energy (J)", sums[3]);
    }

  private:
    static std::string
    unit(const StepResult<dim> &result)
    {
      return dim == 3 || result.step.kernel.axisymmetric ? "(m^3)" : "(m^2)";
    }

    bool enabled = true;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Balance, "Balance")
} // namespace isochor
