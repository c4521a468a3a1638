/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/thickness.h>
#include <isochor/postprocess/postprocessor.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  /**
   * The relative L2 error of stress components on the deformed body, for
   * scenes with a known solution:
   *   ( Σ_p V_p (σ - σ_exact)² / Σ_p V_p σ_exact² )^{1/2},  V_p = J_p V0_p.
   */
  template <int dim>
  class StressError : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry(
        "Exact stress",
        "",
        Patterns::Anything(),
        "Known components of the Cauchy stress (Pa), formulas in the place "
        "x, y(, z) of a point at t = 0 and in t: 'yy: formula; xx: formula'. "
        "The root mean square over the body of the difference, relative to "
        "that of the formula, goes into the statistics. It is infinite for "
        "a formula that is zero everywhere.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string                 name = this->parameter("Exact stress");
      const std::array<const char *, 6> components = {
        {"xx", "yy", "zz", "xy", "xz", "yz"}};
      for (const auto &entry :
           split_list_of_unique_names(prm.get("Exact stress"), name))
        {
          const auto end   = components.begin() + n_symmetric_components<dim>;
          const auto found = std::find(components.begin(), end, entry.first);
          AssertThrow(found != end,
                      ExcMessage("The parameter <" + name +
                                 "> names the component <" + entry.first +
                                 ">. There are xx, yy, zz, xy" +
                                 (dim == 3 ? ", xz, yz." : ".")));
          references.push_back(
            {entry.first,
             static_cast<unsigned int>(found - components.begin()),
             Expression<dim>(entry.second, name)});
        }
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      const PointLayout &l = result.points.layout();
      for (const Reference &reference : references)
        {
          std::array<double, 2> squares{}; // of the error, of the solution
          for (const auto &particle : result.points.handler())
            {
              const auto     properties = particle.get_properties();
              Point<dim>     origin     = particle.get_location();
              Tensor<2, dim> F;
              for (unsigned int a = 0; a < dim; ++a)
                {
                  origin[a] -= properties[l.displacement + a];
                  for (unsigned int b = 0; b < dim; ++b)
                    F[a][b] = properties[l.F + a * dim + b];
                }
              const double V =
                determinant(F) * properties[l.volume] *
                thickness(l.axisymmetric, particle.get_location()[0]);
              const double exact = reference.stress(origin, result.step.time);
              const double error =
                properties[l.stress + reference.component] - exact;
              squares[0] += V * error * error;
              squares[1] += V * exact * exact;
            }
          sum_over_ranks(squares, result.step.grid.communicator());
          statistics.set("L2 error of stress " + reference.name,
                         std::sqrt(squares[0] / squares[1]));
        }
    }

  private:
    struct Reference
    {
      std::string     name;
      unsigned int    component;
      Expression<dim> stress;
    };
    std::vector<Reference> references;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, StressError, "Stress error")
} // namespace isochor
