/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/rounding.h>
#include <isochor/body_quadrature/hole_points.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace isochor
{
  namespace
  {
    /** Sums over the points around one vertex, weighted by N_v(x_p) J_p V0_p:
     * what a state is made of, in quantities that may be averaged. For laws
     * that don't know directions F matters as det F and F F^T only; the mean of
     * F itself would lose stretch where the points have turned differently. */
    template <int dim>
    class MeanState
    {
    public:
      double volume = 0; ///< the sum of the weights

      MeanState(const unsigned int n_history = 0)
        : history(n_history)
      {}

      /** From the other end of values(). */
      MeanState(const double *values, const unsigned int n_history)
        : volume(values[0])
        , volume_ratio(values[1])
        , history(values + 2 + n_entries, values + 2 + n_entries + n_history)
      {
        for (unsigned int i = 0; i < n_entries; ++i)
          stretch.access_raw_entry(i) = values[2 + i];
      }

      static unsigned int
      n_values(const unsigned int n_history)
      {
        return 2 + n_entries + n_history;
      }

      void
      append_values_to(std::vector<double> &values) const
      {
        values.insert(values.end(), {volume, volume_ratio});
        for (unsigned int i = 0; i < n_entries; ++i)
          values.push_back(stretch.access_raw_entry(i));
        values.insert(values.end(), history.begin(), history.end());
      }

      /** Add a point; @p mean_values is its history after
       * MaterialModel::to_mean_values(). */
      void
      add(const double          weight,
          const Tensor<2, dim> &F,
          const double         *mean_values)
      {
        const double J = determinant(F);
        volume += weight;
        volume_ratio += weight * J;
        stretch +=
          weight * std::pow(J, -2. / dim) * symmetrize(F * transpose(F));
        for (unsigned int i = 0; i < history.size(); ++i)
          history[i] += weight * mean_values[i];
      }

      void
      add(const double factor, const MeanState &other)
      {
        volume += factor * other.volume;
        volume_ratio += factor * other.volume_ratio;
        stretch += factor * other.stretch;
        for (unsigned int i = 0; i < history.size(); ++i)
          history[i] += factor * other.history[i];
      }

      /** b^(1/2), b the mean of F F^T, with the mean J. */
      Tensor<2, dim>
      deformation_gradient() const
      {
        Tensor<2, dim> F;
        for (const auto &pair : eigenvectors(stretch))
          F += std::sqrt(pair.first) * outer_product(pair.second, pair.second);
        return std::pow(volume_ratio / volume / determinant(F), 1. / dim) * F;
      }

      /** For MaterialModel::from_mean_values(). */
      std::vector<double>
      mean_history() const
      {
        std::vector<double> mean = history;
        for (double &value : mean)
          value /= volume;
        return mean;
      }

    private:
      static constexpr unsigned int n_entries =
        SymmetricTensor<2, dim>::n_independent_components;

      double                  volume_ratio = 0; ///< J
      SymmetricTensor<2, dim> stretch;          ///< F F^T / J^(2/dim)
      std::vector<double>     history;
    };

    /** By material. */
    template <int dim>
    using MeanStates = std::map<unsigned int, MeanState<dim>>;

    /** By hole and vertex of its cell. */
    template <int dim>
    using VertexStates =
      std::map<std::pair<unsigned int, unsigned int>, MeanStates<dim>>;



    /** Add this rank's points in the cells around @p vertex to @p states. */
    template <int dim>
    void
    add_points_around(const unsigned int        vertex,
                      const PointArrays<dim>   &points,
                      const CellOccupancy<dim> &occupancy,
                      const MixedKernel<dim>   &kernel,
                      MeanStates<dim>          &states)
    {
      std::vector<double> mean_values(points.n_history);
      for (const unsigned int cell : occupancy.cells_at(vertex))
        {
          const unsigned int k = points.position(cell);
          if (k == points.n_occupied_cells || points.cell[k] != cell)
            continue;
          const auto &vertices = occupancy.grid.geometry().vertex_indices(cell);
          const unsigned int v =
            std::find(vertices.begin(), vertices.end(), vertex) -
            vertices.begin();
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            {
              const unsigned int material = points.material[q];
              std::copy_n(points.history.begin() +
                            q * std::size_t(points.n_history),
                          points.n_history,
                          mean_values.begin());
              kernel.materials[material]->to_mean_values(mean_values.data());
              // all points may lie on the faces opposite to the vertex, where
              // N_v is zero or by rounding a little less
              states.emplace(material, MeanState<dim>(points.n_history))
                .first->second.add(std::max(points.shape[q][v],
                                            rounding::accumulated) *
                                     points.volume[q] *
                                     determinant(points.F[q]),
                                   points.F[q],
                                   mean_values.data());
            }
        }
    }



    /** Whether a cell around @p vertex holds points. */
    template <int dim>
    bool
    is_near_points(const unsigned int        vertex,
                   const CellOccupancy<dim> &occupancy)
    {
      for (const unsigned int cell : occupancy.cells_at(vertex))
        if (const auto content = occupancy.content(cell))
          if (!content->is_hole && content->reference_volume > 0)
            return true;
      return false;
    }



    /** The vertices whose states that of @p cell is made of: its own, or, if
     * there are no points around these, of the nearest layer of cells around
     * that has some. */
    template <int dim>
    std::set<unsigned int>
    vertices_near_points(const unsigned int        cell,
                         const CellOccupancy<dim> &occupancy)
    {
      constexpr unsigned int      most_layers = 16; // more than in any hole
      const SimplexGeometry<dim> &geometry    = occupancy.grid.geometry();
      const auto                 &own         = geometry.vertex_indices(cell);
      std::set<unsigned int>      vertices(own.begin(), own.end());
      for (unsigned int layer = 0; layer < most_layers; ++layer)
        {
          if (std::any_of(vertices.begin(), vertices.end(), [&](const auto v) {
                return is_near_points(v, occupancy);
              }))
            break;
          const auto inner = vertices;
          for (const unsigned int v : inner)
            for (const unsigned int other : occupancy.cells_at(v))
              for (const unsigned int w : geometry.vertex_indices(other))
                vertices.insert(w);
        }
      return vertices;
    }



    /** Bring what this rank knows of holes of other ranks to these. */
    template <int dim>
    void
    exchange(const SimplexGeometry<dim> &geometry,
             const unsigned int          n_history,
             VertexStates<dim>          &states)
    {
      const MPI_Comm comm = geometry.communicator();
      if (Utilities::MPI::n_mpi_processes(comm) == 1)
        return;
      const unsigned int me = Utilities::MPI::this_mpi_process(comm);
      std::map<unsigned int, std::vector<double>> messages;
      for (const auto &at_vertex : states)
        {
          const unsigned int owner = geometry.owner(at_vertex.first.first);
          if (owner == me)
            continue;
          for (const auto &state : at_vertex.second)
            {
              std::vector<double> &message = messages[owner];
              message.insert(message.end(),
                             {double(at_vertex.first.first),
                              double(at_vertex.first.second),
                              double(state.first)});
              state.second.append_values_to(message);
            }
        }
      const unsigned int size = 3 + MeanState<dim>::n_values(n_history);
      for (const auto &received : Utilities::MPI::some_to_some(comm, messages))
        for (std::size_t i = 0; i < received.second.size(); i += size)
          {
            const double *const in = &received.second[i];
            states[{static_cast<unsigned int>(in[0]),
                    static_cast<unsigned int>(in[1])}]
              .emplace(static_cast<unsigned int>(in[2]),
                       MeanState<dim>(n_history))
              .first->second.add(1, MeanState<dim>(in + 3, n_history));
          }
    }



    /** The state interpolated from the vertices to the centroid of @p cell: the
     * material with the largest volume there, of equals the first, and the mean
     * of its points. */
    template <int dim>
    typename MeanStates<dim>::value_type
    state_at_centroid(const unsigned int cell, const VertexStates<dim> &states)
    {
      MeanStates<dim> sums;
      for (auto at_vertex = states.lower_bound({cell, 0});
           at_vertex != states.end() && at_vertex->first.first == cell;
           ++at_vertex)
        {
          double volume = 0;
          for (const auto &state : at_vertex->second)
            volume += state.second.volume;
          for (const auto &state : at_vertex->second)
            {
              const auto place = sums.find(state.first);
              if (place == sums.end())
                sums.emplace(state.first, state.second)
                  .first->second.add(1 / volume - 1, state.second);
              else
                place->second.add(1 / volume, state.second);
            }
        }
      auto largest = sums.begin();
      AssertThrow(largest != sums.end(), ExcInternalError());
      // not decided by rounding
      for (auto sum = sums.begin(); sum != sums.end(); ++sum)
        if (sum->second.volume > (1 + 1e-8) * largest->second.volume)
          largest = sum;
      return *largest;
    }
  } // namespace



  template <int dim>
  void
  add_hole_points(PointArrays<dim>         &points,
                  const CellOccupancy<dim> &occupancy,
                  const MixedKernel<dim>   &kernel)
  {
    const BackgroundGrid<dim>  &grid     = occupancy.grid;
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const unsigned int          rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    std::set<unsigned int> holes;
    VertexStates<dim>      states;
    for (const auto &content : occupancy.occupied_cells())
      if (content.is_hole)
        holes.insert(content.cell);
    if (Utilities::MPI::max(holes.size(), grid.communicator()) == 0)
      return;
    for (const unsigned int cell : holes)
      for (const unsigned int v : vertices_near_points(cell, occupancy))
        {
          MeanStates<dim> around;
          add_points_around(v, points, occupancy, kernel, around);
          if (!around.empty())
            states[{cell, v}] = around;
        }
    exchange(geometry, points.n_history, states);

    for (const unsigned int cell : holes)
      {
        if (geometry.owner(cell) != rank)
          continue;
        const auto           state   = state_at_centroid(cell, states);
        const Tensor<2, dim> F       = state.second.deformation_gradient();
        std::vector<double>  history = state.second.mean_history();
        kernel.materials[state.first]->from_mean_values(history.data());

        points.cell.push_back(cell);
        points.cell_start.push_back(points.cell_start.back() + 1);
        points.shape.emplace_back();
        points.shape.back().fill(1. / (dim + 1));
        points.volume.push_back(0);
        points.mass.push_back(0);
        points.weight.push_back(geometry.measure(cell) / determinant(F));
        points.pressure.push_back(0);
        points.F.push_back(F);
        points.material.push_back(state.first);
        points.history.insert(points.history.end(),
                              history.begin(),
                              history.end());
        if (!points.shear_stress.empty())
          points.shear_stress.push_back(0);
        if (!points.velocity.empty())
          {
            points.velocity.emplace_back();
            points.acceleration.emplace_back();
          }
      }
  }



  template void
  add_hole_points(PointArrays<2> &,
                  const CellOccupancy<2> &,
                  const MixedKernel<2> &);
  template void
  add_hole_points(PointArrays<3> &,
                  const CellOccupancy<3> &,
                  const MixedKernel<3> &);
} // namespace isochor
