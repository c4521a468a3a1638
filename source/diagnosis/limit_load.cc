/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/yielded_share.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** The largest |F - 1| of all material points. Collective. */
    template <int dim>
    double
    largest_distortion(const MaterialPoints<dim> &points, const MPI_Comm comm)
    {
      double largest = 0;
      for (const auto &particle : points.handler())
        {
          Tensor<2, dim> F =
            deformation_gradient<dim>(particle.get_properties().data(),
                                      points.layout());
          for (unsigned int d = 0; d < dim; ++d)
            F[d][d] -= 1;
          largest = std::max(largest, F.norm());
        }
      return Utilities::MPI::max(largest, comm);
    }
  } // namespace



  /** A body that has lost its stiffness. */
  template <int dim>
  class LimitLoad : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &converged) override
    {
      // so many steps one after the other; so far, in cells: where points
      // change cells, a body at rest moves a little in each step, by more or
      // less; and, of a body that doesn't yield, so much strained or turned
      constexpr unsigned int  many_steps = 5;
      constexpr double        far = 0.02, much_distorted = 0.02;
      const StepContext<dim> &step = converged.result.step;
      const Softening        &soft = converged.softening;
      if (soft.n_steps == 0)
        is_told = false;
      if (converged.scene.has_inertia() || is_told || soft.n_steps < many_steps)
        return;
      // with CPDI points that change cells don't move a body at rest
      const MPI_Comm comm    = step.grid.communicator();
      const int      is_cpdi = step.points.has_stencils();
      if (soft.way <= far && Utilities::MPI::max(is_cpdi, comm) == 0)
        return;
      const double yielded =
        yielded_share(converged.result.points, step.kernel, comm);
      if (yielded <= 0 &&
          largest_distortion(converged.result.points, comm) < much_distorted)
        return;
      is_told = true;
      this->warn(
        "since t = " + rounded(soft.since) + " the displacement per " +
        soft.measure + " is more than " + rounded(Softening::large_growth) +
        " times that of the stiffest step (" + rounded(soft.growth) +
        " at t = " + rounded(step.time) + "): " +
        (yielded > 0 ? "the limit load of this grid is reached. Prescribe "
                       "displacements" :
                       "no point has yielded, the body buckles, snaps or is "
                       "deformed far. Take smaller steps") +
        ", or set <Dynamics/Inertia = true>.");
    }

  private:
    bool is_told = false; ///< as long as it goes on
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    LimitLoad,
    "limit load",
    ISOCHOR_ESSENTIAL,
    "quasi-static: in five steps in succession the largest displacement per "
    "time, and per change of the loads where they change, was more than ten "
    "times that of the stiffest step of the same loading (with other "
    "quadratures than CPDI the body has also gone more than a fiftieth of the "
    "smallest cell in them). A loading lasts as long as the loads change in "
    "one direction (all forces on the nodes together, up to 25 degrees). Where "
    "nothing has yielded a point must also be strained or turned by more than "
    "2 %: such a body buckles, snaps or is deformed far. Steps don't count in "
    "which the body rests (less than 1e-9 of a cell), or is moved by what is "
    "prescribed (more than 1 % of the largest displacement). The limit load "
    "lies between the time given (last step before the growth) and the last "
    "equilibrium that is found: of blocks and strip loads that yield within a "
    "few steps 0 to 7 % above the former, of a sphere under inner pressure, "
    "where the plastic zone grows bit by bit, 0.5 % above the latter. Coarse "
    "grids raise both (a slope, φ = ψ = 20° at 45°: by 5 % with 16 cells over "
    "its height)",
    "prescribed displacements, or `Dynamics/Inertia = true` to follow it")
} // namespace isochor
