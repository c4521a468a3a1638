/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/stress_recovery.h>
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
      AssertIndexRange(q, state.size());
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
  double
  energy_norm_square(const BodyState<dim> &state)
  {
    AssertDimension(state.stress.size(), state.size());
    double sum = 0;
    for (unsigned int q = 0; q < state.size(); ++q)
      sum += state.volume[q] * energy(state, q, entries<dim>(state.stress[q]));
    return sum;
  }



  template <int dim>
  StressError
  recovered_error(const BodyState<dim> &state)
  {
    const auto  smoothed = recovered(state);
    StressError error;
    error.norm_square = energy_norm_square(state);
    error.squares.resize(state.size());
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        Entries<dim> difference = entries<dim>(state.stress[q]);
        for (unsigned int i = 0; i < n_entries<dim>; ++i)
          difference[i] -= smoothed[q][i];
        error.squares[q] = state.volume[q] * energy(state, q, difference);
      }
    return error;
  }



  template double
  energy_norm_square(const BodyState<2> &);
  template double
  energy_norm_square(const BodyState<3> &);
  template StressError
  recovered_error(const BodyState<2> &);
  template StressError
  recovered_error(const BodyState<3> &);
} // namespace isochor
