/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/equations/final_state.h>
#include <isochor/transfer/volume_error.h>

#include <array>
#include <cmath>

namespace isochor
{
  template <int dim>
  std::vector<double>
  volume_excesses(const StepContext<dim> &step, const NodalField &unknowns)
  {
    Assert(step.mixed(), ExcMessage("There are no pressures."));
    const PointArrays<dim>  &points = step.points;
    const NodalUnknowns<dim> nodal(step, unknowns);
    std::vector<double>      excesses, history(points.n_history);
    excesses.reserve(points.n_points());
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto state =
            final_state<dim>(step, nodal, points, k, q, history.data());
          excesses.push_back(
            excess_of_volume<dim>(state,
                                  *step.kernel.materials[points.material[q]]));
        }
    return excesses;
  }



  template <int dim>
  VolumeError
  volume_error(const StepContext<dim>    &step,
               const MaterialPoints<dim> &points,
               const std::vector<double> &excesses,
               const double               negligible)
  {
    const MPI_Comm comm    = step.grid.communicator();
    double         largest = 0;
    for (const double excess : excesses)
      largest = std::max(largest, std::abs(excess));
    if (!(Utilities::MPI::max(largest, comm) > negligible))
      return {};
    const PointLayout    &l = points.layout();
    std::array<double, 4> sums{}; // Σ V e², Σ V, Σ V γ e², Σ V γ
    points.look_at_each([&](const unsigned int             q,
                            const ArrayView<const double> &properties) {
      // |dev b| / (tr b / 3), √2 γ for a small simple shear γ
      const Tensor<2, dim> F = deformation_gradient<dim>(properties.data(), l);
      const Tensor<2, dim> b = F * transpose(F);
      const double         hoop =
        step.kernel.hoop_stretch(properties.data() + l.history);
      const double b_33 = (dim == 2 ? hoop * hoop : 0.);
      const double tr_b = trace(b) + b_33;
      const double dev_b_square =
        b.norm_square() + b_33 * b_33 - tr_b * tr_b / 3;
      const double shear  = 3 * std::sqrt(std::max(dev_b_square, 0.)) / tr_b;
      const double volume = properties[l.volume];
      const double square = excesses[q] * excesses[q];
      sums[0] += volume * square;
      sums[1] += volume;
      sums[2] += volume * shear * square;
      sums[3] += volume * shear;
    });
    sum_over_ranks(sums, comm);
    return {std::sqrt(sums[0] / sums[1]),
            sums[3] > 0 ? std::sqrt(sums[2] / sums[3]) : 0.};
  }



  template std::vector<double>
  volume_excesses(const StepContext<2> &, const NodalField &);
  template std::vector<double>
  volume_excesses(const StepContext<3> &, const NodalField &);
  template VolumeError
  volume_error(const StepContext<2> &,
               const MaterialPoints<2> &,
               const std::vector<double> &,
               const double);
  template VolumeError
  volume_error(const StepContext<3> &,
               const MaterialPoints<3> &,
               const std::vector<double> &,
               const double);
} // namespace isochor
