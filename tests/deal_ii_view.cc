/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The nodal unknowns as a DoFHandler with its vector: the same values at the
// same vertices, and deal.II's own tools agree with closed forms.

#include <deal.II/base/function_lib.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/hp/q_collection.h>
#include <deal.II/numerics/error_estimator.h>
#include <deal.II/numerics/vector_tools.h>

#include <isochor/postprocess/deal_ii_view.h>

#include "scene.h"

using namespace isochor;
using namespace isochor::test;

namespace
{
  /** What the post-processor has found wrong, of the scene run last. */
  struct Found
  {
    bool   counts_agree = true;
    double values = 0, norm = 0, jumps = 0;
    double n_steps = 0;
  } found;



  /** ∫ u_y² over the cells of this rank that hold material: linear functions
   * have the mass matrix |e| (1 + δ_IJ)/((d+1)(d+2)). */
  template <int dim>
  double
  square_of_y(const StepResult<dim> &result)
  {
    const StepContext<dim> &step = result.step;
    double                  sum  = 0;
    for (const unsigned int cell : step.points.cell)
      {
        const auto &vertices = step.grid.geometry().vertex_indices(cell);
        for (unsigned int I = 0; I <= dim; ++I)
          for (unsigned int J = 0; J <= dim; ++J)
            sum += step.grid.geometry().measure(cell) * (I == J ? 2. : 1.) /
                   ((dim + 1) * (dim + 2)) *
                   result.unknowns.local_element(
                     step.nodes.node(vertices[I]) * step.n_components + 1) *
                   result.unknowns.local_element(
                     step.nodes.node(vertices[J]) * step.n_components + 1);
      }
    return sum;
  }



  /** Whether @p cell and those behind its faces hold material. */
  template <int dim>
  bool
  is_inside(const typename DoFHandler<dim>::active_cell_iterator &cell)
  {
    bool inside = cell->active_fe_index() == 0;
    for (const unsigned int f : cell->face_indices())
      if (!cell->at_boundary(f))
        inside = inside && cell->neighbor(f)->active_fe_index() == 0;
    return inside;
  }



  template <int dim>
  class Viewer : public Postprocessor<dim>
  {
  public:
    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      const StepContext<dim> &step = result.step;
      const MPI_Comm          comm = step.grid.communicator();
      const unsigned int      nc   = step.n_components;
      const DealIIView<dim>   view(step, result.unknowns);
      const DoFHandler<dim>  &dofs = view.dof_handler();
      found.n_steps += 1;
      found.counts_agree = found.counts_agree &&
                           dofs.n_dofs() == nc * step.nodes.n_global() &&
                           view.component_names().size() == nc;

      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned() && cell->active_fe_index() == 0)
          for (unsigned int v = 0; v <= dim; ++v)
            for (unsigned int a = 0; a < nc; ++a)
              add_error(found.values,
                        std::abs(
                          view.solution()(cell->vertex_dof_index(v, a, 0)) -
                          result.unknowns.local_element(
                            step.nodes.node(cell->vertex_index(v)) * nc + a)));

      const auto                        &tria = step.grid.triangulation();
      const hp::QCollection<dim>         rules(QGaussSimplex<dim>(3),
                                       QGaussSimplex<dim>(3));
      const ComponentSelectFunction<dim> y(1, nc);
      Vector<double>                     norms(tria.n_active_cells());
      VectorTools::integrate_difference(view.mappings(),
                                        dofs,
                                        view.solution(),
                                        Functions::ZeroFunction<dim>(nc),
                                        norms,
                                        rules,
                                        VectorTools::L2_norm,
                                        &y);
      const double norm =
        VectorTools::compute_global_error(tria, norms, VectorTools::L2_norm);
      const double expected =
        std::sqrt(Utilities::MPI::sum(square_of_y(result), comm));
      add_error(found.norm,
                expected > 0 ? std::abs(norm / expected - 1) : 1e300);

      // the gradients of a linear function don't jump inside of the body
      auto linear = view.solution();
      linear      = 0;
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned() && cell->active_fe_index() == 0)
          for (unsigned int v = 0; v <= dim; ++v)
            for (unsigned int a = 0; a < nc; ++a)
              {
                const auto dof = cell->vertex_dof_index(v, a, 0);
                if (linear.in_local_range(dof))
                  linear(dof) = 1 + cell->vertex(v)[0] - 2 * cell->vertex(v)[1];
              }
      linear.update_ghost_values();
      const hp::QCollection<dim - 1> face_rules(QGaussSimplex<dim - 1>(2),
                                                QGaussSimplex<dim - 1>(2));
      Vector<float>                  errors(tria.n_active_cells());
      KellyErrorEstimator<dim>::estimate(
        step.grid.mapping(), dofs, face_rules, {}, linear, errors);
      for (const auto &cell : dofs.active_cell_iterators())
        if (cell->is_locally_owned() && is_inside<dim>(cell))
          add_error(found.jumps, errors(cell->active_cell_index()));
      KellyErrorEstimator<dim>::estimate(
        step.grid.mapping(), dofs, face_rules, {}, view.solution(), errors);
      if (!(Utilities::MPI::max(errors.linfty_norm(), comm) > 0))
        found.jumps = 1e300; // the solution is not linear
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Viewer, "Viewer")



  template <int dim>
  void
  test_view(const std::string &type)
  {
    found = {};
    run_scene<dim>("Formulation/Type = " + type +
                   "\nGrid/Upper corner = " + (dim == 2 ? "2, 1" : "2, 1, 1") +
                   "\nGrid/Subdivisions = " + (dim == 2 ? "8, 4" : "6, 3, 3") +
                   "\nMaterial points/Region = (x > 0.3) * (x < 1.6)"
                   "\nQuadrature/Type = points"
                   "\nMaterial/Density = 1"
                   "\nBoundary conditions/Gravity = 0, -10*t" +
                   (dim == 2 ? "" : ", 0") +
                   "\nBoundary conditions/Displacement = bottom: x = 0, y = 0" +
                   (dim == 2 ? "" : ", z = 0") + "\nTime/Step size = 0.5");
    const std::string name = std::to_string(dim) + "D, " + type;
    check(name + ", degrees of freedom of the nodes with material",
          found.counts_agree && found.n_steps == 2,
          std::to_string(found.n_steps));
    check_error(name + ", values at the vertices", found.values, 0);
    check_error(name + ", VectorTools", found.norm, 1e-12);
    check_error(name + ", KellyErrorEstimator", found.jumps, 1e-6);
  }
} // namespace



int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string type : {"u", "u-p"})
    {
      test_view<2>(type);
      test_view<3>(type);
    }
  return 0;
}
