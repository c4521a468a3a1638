/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/transfer/grid_to_points.h>
#include <isochor/transfer/stress_integral.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** How far the volumes of points are from what the pressure says: the root
     * mean squares of θ^e - p/K over the body, and over where it is sheared. A
     * neck, or the soil around a pile, is a small part of its body. */
    class VolumeErrors
    {
    public:
      /** Of @p n_points points of this rank. */
      VolumeErrors(const unsigned int n_points)
      {
        excesses.reserve(n_points);
      }

      /** The next point has @p excess = θ^e - p/K. */
      void
      add(const double excess)
      {
        excesses.push_back(excess);
        largest = std::max(largest, std::abs(excess));
      }

      /** Tell if the material's own volumes have little to do any more with the
       * pressure. @p points, which have moved, are in the order of add().
       * Collective. */
      template <int dim>
      void
      warn(const StepContext<dim> &step, MaterialPoints<dim> &points) const;

    private:
      std::vector<double> excesses;
      double              largest = 0;

      /** Of this rank: Σ V e², Σ V, Σ V γ e², Σ V γ. */
      template <int dim>
      std::array<double, 4>
      sums(const StepContext<dim> &step, MaterialPoints<dim> &points) const;
    };



    template <int dim>
    std::array<double, 4>
    VolumeErrors::sums(const StepContext<dim> &step,
                       MaterialPoints<dim>    &points) const
    {
      const PointLayout    &l = points.layout();
      std::array<double, 4> result{};
      points.for_each([&](const unsigned int /*k*/,
                          const unsigned int q,
                          Point<dim> & /*location*/,
                          ArrayView<double> properties) {
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
        const double shear  = 3 * std::sqrt(std::max(dev_b_square, 0.)) / tr_b;
        const double volume = properties[l.volume];
        const double square = excesses[q] * excesses[q];
        result[0] += volume * square;
        result[1] += volume;
        result[2] += volume * shear * square;
        result[3] += volume * shear;
      });
      return result;
    }



    template <int dim>
    void
    VolumeErrors::warn(const StepContext<dim> &step,
                       MaterialPoints<dim>    &points) const
    {
      constexpr double tolerated = 0.05;
      // no mean is larger
      if (!(Utilities::MPI::max(largest, step.grid.communicator()) > tolerated))
        return;
      std::array<double, 4> all = sums(step, points);
      sum_over_ranks(all, step.grid.communicator());
      const double in_body  = std::sqrt(all[0] / all[1]),
                   in_shear = all[3] > 0 ? std::sqrt(all[2] / all[3]) : in_body;
      const bool   is_local = !(in_body > tolerated);
      const double difference = is_local ? in_shear : in_body;
      if (!(difference > tolerated))
        return;
      // on a grid that is kept it can be the error of the elements alone
      const std::string cause =
        step.grid_is_kept ?
          " differ from cell to cell more than the pressure can follow, or "
          "motions that no cell feels have grown from one reset of the grid to "
          "the next. Use smaller cells where the deformation is large, or keep "
          "the grid for longer (<Grid reset/Steps between resets>)." :
          " hold the right volume: motions that no cell feels have grown from "
          "one reset of the grid to the next. Loads may still look right, "
          "displacements and stresses are not. Keep the grid for several steps "
          "or all (<Grid reset/Steps between resets>), let it follow the body "
          "(<Grid/Stretch>), use more <Material points/Points per cell>, or "
          "another <Quadrature/Type>.";
      step.warnings.add(
        "volumes of the points wander",
        "At t = " + rounded(step.time) +
          " the volumes of the material points differ by " +
          rounded(100 * difference) + " % (root mean square" +
          (is_local ? " weighted with the shear strain; in the whole body " +
                        rounded(100 * in_body) + " %" :
                      std::string()) +
          ") from what the pressure says, " +
          (step.grid_is_kept ? "as volumes" : "while the cells") + cause);
    }
  } // namespace



  template <int dim>
  void
  GridToPoints<dim>::transfer(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const InertiaTerm<dim> &inertia,
                              MaterialPoints<dim>    &points,
                              PointArrays<dim>       &of_step)
  {
    const PointLayout              &l      = points.layout();
    const PointArrays<dim>         &arrays = step.points;
    const NodalUnknowns<dim>        nodal(step, unknowns);
    std::array<double, max_history> history;
    Kinematics<dim>                 increment;
    SymmetricTensor<2, dim>         strain_increment;
    unsigned int                    last_cell = numbers::invalid_unsigned_int;
    if (step.mixed())
      volume_offset.start(step);
    step_energy = 0;
    VolumeErrors        volume_errors(step.mixed() ? arrays.volume.size() : 0);
    StressIntegral<dim> stress_integral;

    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim>        &location,
                        ArrayView<double>  properties) {
      const auto stencil = arrays.stencil(step.grid.geometry(), k, q);
      if (k != last_cell || arrays.has_stencils())
        {
          increment.set_increment(nodal.deformation_at(stencil));
          if (measures_energy)
            strain_increment = symmetrize(unit_symmetric_tensor<dim>() -
                                          invert(increment.F_increment));
          last_cell = k;
        }

      const Tensor<1, dim> displacement = nodal.increment_at(stencil);
      increment.hoop_increment          = nodal.hoop_at(stencil, arrays, q);
      const auto state                  = step.kernel.final_state(arrays,
                                                 q,
                                                 increment,
                                                 step.mixed(),
                                                 nodal.pressure_at(stencil),
                                                 history.data());
      if (step.mixed())
        {
          const double excess =
            state.volumetric_strain -
            state.pressure *
              step.kernel.materials[arrays.material[q]]->inverse_bulk_modulus();
          volume_errors.add(excess);
          volume_offset.set(step,
                            q,
                            excess - properties[l.volume_offset],
                            increment,
                            state,
                            l,
                            properties);
        }
      location += displacement;
      properties[l.pressure] = state.pressure;
      for (unsigned int a = 0; a < dim; ++a)
        {
          properties[l.displacement + a] += displacement[a];
          for (unsigned int b = 0; b < dim; ++b)
            properties[l.F + a * dim + b] = state.F[a][b];
        }
      of_step.F.refresh(q, state.F);
      store_symmetric<dim>(state.cauchy_stress, &properties[l.stress]);
      if (!l.dynamic)
        stress_integral.add(state.cauchy_stress,
                            state.J,
                            properties[l.volume] * arrays.thickness(q),
                            arrays.measure(q));
      if (measures_energy)
        {
          double work = 0;
          for (unsigned int a = 0; a < dim; ++a)
            for (unsigned int b = 0; b < dim; ++b)
              work += state.cauchy_stress[a][b] * strain_increment[a][b];
          work +=
            state.cauchy_stress[2][2] * (1 - 1 / increment.hoop_increment);
          step_energy += std::abs(work) * state.J * properties[l.volume] *
                         arrays.thickness(q);
        }
      for (unsigned int i = 0; i < l.n_history; ++i)
        properties[l.history + i] = history[i];
      const double kinetic_energy =
        inertia.move_point(step, stencil, q, l, properties);
      if (measures_energy)
        step_energy += kinetic_energy;
    });
    if (step.mixed())
      volume_errors.warn(step, points);
    if (!l.dynamic)
      {
        stress_integral.add_massless_points(step, nodal);
        stress_integral.check(step);
      }
  }



  template <int dim>
  void
  GridToPoints<dim>::forget_unseen_volume(const StepContext<dim> &step,
                                          MaterialPoints<dim>    &points)
  {
    if (step.mixed())
      volume_offset.apply(step, points);
  }



  template class GridToPoints<2>;
  template class GridToPoints<3>;
} // namespace isochor
