/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/stress_recovery.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/material_model/material_model.h>

#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Of a point: dev σ and p. */
    template <int dim>
    constexpr unsigned int n_entries = n_symmetric_components<dim> + 1;
    template <int dim>
    using Entries = std::array<double, n_entries<dim>>;

    template <int dim>
    Entries<dim>
    entries(const SymmetricTensor<2, 3> &stress)
    {
      const double p = trace(stress) / 3;
      Entries<dim> values;
      values[0] = stress[0][0] - p;
      values[1] = stress[1][1] - p;
      values[2] = stress[2][2] - p;
      values[3] = stress[0][1];
      if constexpr (dim == 3)
        {
          values[4] = stress[0][2];
          values[5] = stress[1][2];
        }
      values[n_entries<dim> - 1] = p;
      return values;
    }



    template <int dim>
    double
    energy(const BodyState<dim> &state,
           const unsigned int    q,
           const Entries<dim>   &s)
    {
      double square = 0;
      for (unsigned int i = 0; i + 1 < n_entries<dim>; ++i)
        square += (i < 3 ? 1 : 2) * s[i] * s[i];
      const double p = s[n_entries<dim> - 1];
      return square / (4 * state.shear_modulus[q]) +
             p * p * state.inverse_bulk_modulus[q] / 2;
    }



    template <int dim>
    std::vector<Entries<dim>>
    recovered(const BodyState<dim> &state)
    {
      const SimplexGeometry<dim> &geometry = state.grid.geometry();
      const unsigned int          n = n_entries<dim> + 1; // and the weights
      std::vector<double> sums(geometry.vertices().size() * state.n_materials *
                               n);
      const auto row = [&](const unsigned int q, const unsigned int v) {
        return n * (geometry.vertex_indices(state.cell[q])[v] *
                      std::size_t(state.n_materials) +
                    state.material[q]);
      };
      for (unsigned int q = 0; q < state.size(); ++q)
        {
          const Entries<dim> stress = entries<dim>(state.stress[q]);
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const double weight = state.volume[q] * state.shape[q][v];
              double      *sum    = &sums[row(q, v)];
              for (unsigned int i = 0; i < n_entries<dim>; ++i)
                sum[i] += weight * stress[i];
              sum[n_entries<dim>] += weight;
            }
        }
      Utilities::MPI::sum(sums, state.grid.communicator(), sums);

      std::vector<Entries<dim>> stresses(state.size());
      for (unsigned int q = 0; q < state.size(); ++q)
        {
          stresses[q].fill(0.);
          for (unsigned int v = 0; v <= dim; ++v)
            {
              const double *sum = &sums[row(q, v)];
              if (!(sum[n_entries<dim>] > 0))
                continue; // N_I is zero or by rounding less
              for (unsigned int i = 0; i < n_entries<dim>; ++i)
                stresses[q][i] +=
                  state.shape[q][v] * sum[i] / sum[n_entries<dim>];
            }
        }
      return stresses;
    }
  } // namespace



  template <int dim>
  StressError
  recovered_error(const BodyState<dim> &state)
  {
    const auto  smoothed = recovered(state);
    StressError error;
    error.squares.resize(state.size());
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        Entries<dim> difference = entries<dim>(state.stress[q]);
        error.norm_square += state.volume[q] * energy(state, q, difference);
        for (unsigned int i = 0; i < n_entries<dim>; ++i)
          difference[i] -= smoothed[q][i];
        error.squares[q] = state.volume[q] * energy(state, q, difference);
      }
    return error;
  }



  template <int dim>
  void
  warn_of_coarse_grid(const StepContext<dim> &step, const NodalField &unknowns)
  {
    // Not strains as small as rounding errors of a body that is carried along,
    // nor what is left when the load is gone.
    constexpr double much = 0.36, no_strain = 1e-6, unloaded = 0.5;
    NodalField       at_rest = unknowns;
    for (unsigned int i = 0; i < step.nodes.n_local() * step.n_components; ++i)
      if (i % step.n_components < dim)
        at_rest.local_element(i) = 0;
    const BodyState<dim> state = state_of_body(step, unknowns),
                         start = state_of_body(step, at_rest);
    const StressError error    = recovered_error(state);
    double            sum = 0, least = 0;
    for (unsigned int q = 0; q < start.size(); ++q)
      least += unloaded * start.volume[q] *
               energy<dim>(start, q, entries<dim>(start.stress[q]));
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        sum += error.squares[q];
        least +=
          state.volume[q] * state.shear_modulus[q] * no_strain * no_strain;
      }
    const MPI_Comm comm      = step.grid.communicator();
    sum                      = Utilities::MPI::sum(sum, comm);
    least                    = Utilities::MPI::sum(least, comm);
    const double norm_square = Utilities::MPI::sum(error.norm_square, comm);
    if (norm_square <= least || sum <= much * much * norm_square)
      return;
    step.warnings.add(
      "a grid that is too coarse",
      "At t = " + rounded(step.time) +
        " the stresses are wrong by an estimated " +
        rounded(100 * std::sqrt(sum / norm_square)) +
        " % (energy norm, by recovery): cells are too large for what the body "
        "does. By the square of that, some " +
        rounded(100 * sum / norm_square) +
        " %, an elastic body resists too much: forces are too large where "
        "motions are given, displacements too small where forces are. Use "
        "smaller cells, <Grid/Shape functions = Q1>, or let "
        "them adapt (<Adaptive grid/Target of relative error>).");
  }



  template StressError
  recovered_error(const BodyState<2> &);
  template StressError
  recovered_error(const BodyState<3> &);
  template void
  warn_of_coarse_grid(const StepContext<2> &, const NodalField &);
  template void
  warn_of_coarse_grid(const StepContext<3> &, const NodalField &);
} // namespace isochor
