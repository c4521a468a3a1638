/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A post-processor that hands the nodal unknowns to deal.II's own tools: the
// estimator of Kelly et al. for the error of displacements, VectorTools for the
// norm of the pressure, and DataOut for a picture of both.

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/numerics/data_out.h>
#include <deal.II/numerics/error_estimator.h>
#include <deal.II/numerics/vector_tools.h>

#include <isochor/postprocess/deal_ii_view.h>
#include <isochor/postprocess/postprocessor.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  class DealIITools : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Estimate errors",
                        "false",
                        Patterns::Bool(),
                        "Whether to estimate errors and write them with the "
                        "nodal unknowns.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      is_wanted = prm.get_bool("Estimate errors");
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics            &statistics) override
    {
      if (!is_wanted || !result.step.mixed())
        return;
      const DealIIView<dim>          view(result.step, result.unknowns);
      const auto                    &tria = result.step.grid.triangulation();
      const hp::QCollection<dim>     rules(QGaussSimplex<dim>(2),
                                       QGaussSimplex<dim>(2));
      const hp::QCollection<dim - 1> face_rules(QGaussSimplex<dim - 1>(2),
                                                QGaussSimplex<dim - 1>(2));

      ComponentMask displacements(dim + 1, true);
      displacements.set(dim, false);
      Vector<float> errors(tria.n_active_cells());
      KellyErrorEstimator<dim>::estimate(result.step.grid.mapping(),
                                         view.dof_handler(),
                                         face_rules,
                                         {},
                                         view.solution(),
                                         errors,
                                         displacements);

      const ComponentSelectFunction<dim> pressure(dim, dim + 1);
      Vector<double>                     norms(tria.n_active_cells());
      VectorTools::integrate_difference(view.mappings(),
                                        view.dof_handler(),
                                        view.solution(),
                                        Functions::ZeroFunction<dim>(dim + 1),
                                        norms,
                                        rules,
                                        VectorTools::L2_norm,
                                        &pressure);
      statistics.set("Largest estimate of a cell's error",
                     Utilities::MPI::max(double(errors.linfty_norm()),
                                         tria.get_communicator()));
      statistics.set("L2 norm of the pressure (Pa m)",
                     VectorTools::compute_global_error(tria,
                                                       norms,
                                                       VectorTools::L2_norm));

      DataOut<dim> out;
      out.attach_dof_handler(view.dof_handler());
      out.add_data_vector(view.solution(),
                          view.component_names(),
                          DataOut<dim>::type_dof_data,
                          view.component_interpretation());
      out.add_data_vector(errors, "estimated_error");
      out.build_patches(view.mappings());
      out.write_vtu_in_parallel(result.output_directory + "/deal_ii.vtu",
                                tria.get_communicator());
    }

  private:
    bool is_wanted = false;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, DealIITools, "deal.II tools")
} // namespace isochor
