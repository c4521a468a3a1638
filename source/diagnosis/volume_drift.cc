/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  /** How far the volumes of points are from what the pressure says: the root
   * mean squares of θ^e - p/K over the body, and over where it is sheared. A
   * neck, or the soil around a pile, is a small part of its body. */
  template <int dim>
  class VolumeDrift : public Diagnosis<dim>
  {
  public:
    void
    points_moved(const ConvergedStep<dim> &converged) override
    {
      const StepContext<dim> &step = converged.result.step;
      if (!step.mixed())
        return;
      constexpr double tolerated = 0.05;
      double           largest   = 0;
      for (const double excess : converged.volume_excess)
        largest = std::max(largest, std::abs(excess));
      // no mean is larger
      const MPI_Comm comm = step.grid.communicator();
      if (!(Utilities::MPI::max(largest, comm) > tolerated))
        return;
      std::array<double, 4> all =
        sums(step, converged.result.points, converged.volume_excess);
      sum_over_ranks(all, comm);
      const double in_body  = std::sqrt(all[0] / all[1]),
                   in_shear = all[3] > 0 ? std::sqrt(all[2] / all[3]) : in_body;
      const bool   is_local = !(in_body > tolerated);
      const double difference = is_local ? in_shear : in_body;
      if (difference > tolerated)
        this->warn("at t = " + rounded(step.time) +
                   " the volumes of points differ by " +
                   rounded(100 * difference) + " % (root mean square" +
                   (is_local ? ", weighted with the shear strain" : "") +
                   ") from what the pressure asks for: stresses aren't to be "
                   "trusted. " +
                   (step.grid_is_kept ?
                      "Use smaller cells where the deformation is large." :
                      "Keep the grid (<Grid reset/Steps between resets>), or "
                      "let it follow (<Grid/Stretch>)."));
    }

  private:
    /** Of this rank: Σ V e², Σ V, Σ V γ e², Σ V γ. */
    static std::array<double, 4>
    sums(const StepContext<dim>    &step,
         const MaterialPoints<dim> &points,
         const std::vector<double> &excesses)
    {
      const PointLayout    &l = points.layout();
      std::array<double, 4> result{};
      points.look_at_each(
        [&](const unsigned int q, const ArrayView<const double> &properties) {
          // |dev b| / (tr b / 3), √2 γ for a small simple shear γ
          const Tensor<2, dim> F =
            deformation_gradient<dim>(properties.data(), l);
          const Tensor<2, dim> b = F * transpose(F);
          const double         hoop =
            step.kernel.hoop_stretch(properties.data() + l.history);
          const double b_33 = (dim == 2 ? hoop * hoop : 0.);
          const double tr_b = trace(b) + b_33;
          const double dev_b_square =
            b.norm_square() + b_33 * b_33 - tr_b * tr_b / 3;
          const double shear = 3 * std::sqrt(std::max(dev_b_square, 0.)) / tr_b;
          const double volume = properties[l.volume];
          const double square = excesses[q] * excesses[q];
          result[0] += volume * square;
          result[1] += volume;
          result[2] += volume * shear * square;
          result[3] += volume * shear;
        });
      return result;
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    VolumeDrift,
    "volume drift",
    ISOCHOR_ESSENTIAL,
    "u-p: the volumes of the material points differ by more than 5 % (root "
    "mean square, over the body or weighted with the shear strain \\|dev "
    "b\\|/(tr b/3), b = F Fᵀ, which a neck or the soil beside a pile has) from "
    "those of the pressure, θ^e ≠ p/K. In a step after a reset of the grid "
    "motions that no cell feels have grown from one reset to the next: loads "
    "may still look right, displacements and stresses are not. Without resets "
    "volumes differ from cell to cell more than the pressure can follow",
    "no resets (`Steps between resets`), a grid that follows (`Stretch`), more "
    "points; without resets smaller cells where the deformation is large")
} // namespace isochor
