/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/equations/connected_parts.h>
#include <isochor/step/left_out_weight.h>

#include <cmath>

namespace isochor
{
  namespace
  {
    /** Whether a condition that holds now holds the body up against @p gravity:
     * prescribed components, walls that it touches, surfaces
     * with a prescribed component or a load. Collective. */
    template <int dim>
    bool
    is_supported(const Scene<dim>       &scene,
                 const NodalConstraints &constraints,
                 const Tensor<1, dim>   &gravity)
    {
      const unsigned int n_components = scene.n_components;
      const auto         along = [&](const unsigned int entry, const double x) {
        const unsigned int d = entry % n_components;
        return d < dim ? x * gravity[d] : 0.;
      };
      bool supported = false;
      for (unsigned int i = 0; i < constraints.constrained.size(); ++i)
        supported = supported || (constraints.constrained[i] ==
                                    NodalConstraints::prescribed &&
                                  along(i, 1.) != 0.);
      // a relation between nodes adds up to nothing, a wall doesn't
      for (const NodalConstraints::Equation &equation : constraints.equations)
        {
          if (equation.precedence == Precedence::tie)
            continue;
          double sum = 0;
          for (std::size_t j = equation.first; j < equation.last; ++j)
            sum += along(constraints.entry[j], constraints.coefficient[j]);
          supported =
            supported || std::abs(sum) > rounding::accumulated * gravity.norm();
        }
      for (const auto *const condition :
           with_role<const ActsByAssembly<dim>>(scene.boundary_conditions))
        {
          const bool holds = condition->supports_body(gravity); // on all ranks
          supported        = supported || holds;
        }
      return Utilities::MPI::max(static_cast<int>(supported),
                                 scene.grid.communicator()) == 1;
    }
  } // namespace



  template <int dim>
  void
  LeftOutWeight<dim>::set(Scene<dim>             &scene,
                          const StepSetup<dim>   &setup,
                          const NodalConstraints &constraints,
                          bool                   &were_apart)
  {
    if (!scene.leaves_out_weight)
      return;
    const StepContext<dim> step = setup.context();
    Tensor<1, dim>         gravity;
    for (const auto &condition : scene.boundary_conditions)
      gravity += condition->body_acceleration(step.time);
    Tensor<1, dim> &weight = scene.kernel.hydrostatic_acceleration;
    weight                 = gravity;
    if (scene.has_inertia() && gravity.norm() > 0)
      {
        // In free fall there is no weight; of bodies apart from each other some
        // may fall. What depends on accelerations would feed them. They stay
        // with that when they meet: a pressure that is at rest under the weight
        // all at once knocks at what holds it.
        if (setup.was_laid_out() || n_parts == 0)
          n_parts = number_of_parts(step, setup.all_elements());
        were_apart = were_apart || n_parts > 1;
        if (were_apart || !is_supported(scene, constraints, gravity))
          weight = Tensor<1, dim>();
      }
    if (scene.kernel.axisymmetric)
      weight[0] = 0.; // radial accelerations add up to none
  }



  template class LeftOutWeight<2>;
  template class LeftOutWeight<3>;
} // namespace isochor
