/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_tests_elasticity_system_h
#define isochor_tests_elasticity_system_h

#include <deal.II/base/point.h>
#include <deal.II/base/utilities.h>
#include <deal.II/lac/full_matrix.h>

#include <isochor/linear_solver/sparse_system.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

namespace isochor
{
  /** What linear system to make. */
  struct ElasticitySystemOptions
  {
    unsigned int n_cells_per_edge = 8;
    double       poisson_ratio    = 0.499;
    double       alpha            = 1.; ///< of the PPP stabilisation
    bool         mixed            = true;
    bool         clamped          = true;  ///< fix the nodes at x_dim = 0
    double       skewness         = 0.;    ///< if not 0: an unsymmetric matrix
    bool         idle_rank        = false; ///< the last of several has no cells
  };

  /**
   * The linear elastic matrix [[K, B], [B^T, -C]] (or K alone) of P1/P1
   * elements on the unit square or cube, shear modulus one, each subcube cut
   * into dim! simplices (Kuhn). The ranks take slices of cells along x_1. Each
   * call draws a new pattern_id.
   */
  template <int dim>
  class ElasticitySystem
  {
  public:
    ElasticitySystem(const MPI_Comm comm, const ElasticitySystemOptions &o)
      : options(o)
      , n_edge(o.n_cells_per_edge + 1)
    {
      A.comm      = comm;
      A.dim       = dim;
      A.symmetric = (o.skewness == 0.);

      static unsigned long n_patterns = 0;
      A.pattern_id                    = ++n_patterns;

      number_equations();
      assemble();
    }

    SparseSystem A;

  private:
    using Node = std::array<unsigned int, dim>;

    static constexpr unsigned int n_vertices = dim + 1;
    static constexpr auto         no_equation =
      static_cast<types::global_dof_index>(-1);

    unsigned int
    n_fields() const
    {
      return options.mixed ? dim + 1 : dim;
    }

    /** First slice of cells of a rank. */
    unsigned int
    first_slice(const unsigned int rank) const
    {
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(A.comm);
      const unsigned int n_busy =
        (options.idle_rank && n_ranks > 1 ? n_ranks - 1 : n_ranks);
      return (options.n_cells_per_edge * std::min(rank, n_busy)) / n_busy;
    }

    /** A node belongs to the lowest of the ranks whose cells touch it. As the
     * slices ascend, numbering by planes x_1 = const makes ranges of the ranks
     * contiguous. */
    void
    number_equations()
    {
      const unsigned int rank    = Utilities::MPI::this_mpi_process(A.comm);
      const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(A.comm);
      const unsigned int begin   = first_slice(rank);
      const unsigned int end     = first_slice(rank + 1);
      const unsigned int per_plane =
        Utilities::fixed_power<dim - 1>(static_cast<int>(n_edge));

      equation.assign(n_edge * per_plane * n_fields(), no_equation);
      types::global_dof_index next = 0, owned_begin = 0;
      for (unsigned int node = 0; node < n_edge * per_plane; ++node)
        {
          const Node         i     = position_of(node);
          const unsigned int plane = i[0];
          if (node % per_plane == 0 && plane == (rank == 0 ? 0 : begin + 1))
            owned_begin = next;
          for (unsigned int c = 0; c < n_fields(); ++c)
            if (c == dim || i[dim - 1] > 0 || !options.clamped)
              {
                if (plane >= begin && plane <= end && begin < end)
                  add_local_equation(node, c, next);
                equation[node * n_fields() + c] = next++;
              }
          if (node % per_plane == per_plane - 1 && plane == end)
            owned_end = next;
        }
      A.n_equations   = next;
      A.locally_owned = IndexSet(next);
      AssertThrow(n_ranks <= options.n_cells_per_edge, ExcInternalError());
      if (begin < end)
        A.locally_owned.add_range(owned_begin, owned_end);
    }

    Node
    position_of(unsigned int node) const
    {
      Node i;
      for (int d = dim - 1; d >= 0; --d, node /= n_edge)
        i[d] = node % n_edge;
      return i;
    }

    Point<dim>
    point(const Node &i) const
    {
      Point<dim> x;
      for (unsigned int d = 0; d < dim; ++d)
        x[d] = double(i[d]) / options.n_cells_per_edge;
      return x;
    }

    void
    add_local_equation(const unsigned int            node,
                       const unsigned int            c,
                       const types::global_dof_index global)
    {
      A.global_equation.push_back(global);
      A.field.push_back(c == dim ? SparseSystem::Field::pressure :
                                   SparseSystem::Field::displacement);
      const Point<dim> x = point(position_of(node));
      if (A.node.empty())
        last_node = node;
      A.node.push_back(A.node.empty() ? 0 :
                                        A.node.back() + (node != last_node));
      last_node = node;
      A.component.push_back(c);
      for (unsigned int d = 0; d < dim; ++d)
        A.position.push_back(x[d]);
    }

    /** The element matrix; gradients are constant. */
    FullMatrix<double>
    element_matrix(const std::array<Node, n_vertices> &simplex) const
    {
      FullMatrix<double> edges(dim), inverse(dim);
      for (unsigned int v = 0; v < dim; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          edges(v, d) = point(simplex[v + 1])[d] - point(simplex[0])[d];
      inverse.invert(edges);
      const double volume =
        std::abs(edges.determinant()) / (dim == 2 ? 2. : 6.);

      std::array<Tensor<1, dim>, n_vertices> gradient;
      for (unsigned int v = 0; v < dim; ++v)
        for (unsigned int d = 0; d < dim; ++d)
          {
            gradient[v + 1][d] = inverse(d, v);
            gradient[0][d] -= inverse(d, v);
          }

      const double nu              = options.poisson_ratio;
      const double bulk_compliance = 1.5 * (1. - 2. * nu) / (1. + nu);
      const double volumetric_coeff =
        -2. / 3. + (options.mixed ? 0. : 1. / bulk_compliance);
      const unsigned int n = n_fields();
      FullMatrix<double> m(n_vertices * n);
      for (unsigned int v = 0; v < n_vertices; ++v)
        for (unsigned int w = 0; w < n_vertices; ++w)
          {
            for (unsigned int a = 0; a < dim; ++a)
              for (unsigned int b = 0; b < dim; ++b)
                m(v * n + a, w * n + b) =
                  volume *
                  ((a == b ? gradient[v] * gradient[w] : 0.) +
                   gradient[v][b] * gradient[w][a] +
                   volumetric_coeff * gradient[v][a] * gradient[w][b] +
                   (a == b ? options.skewness * gradient[w][0] / n_vertices :
                             0.));
            if (options.mixed)
              {
                for (unsigned int a = 0; a < dim; ++a)
                  {
                    const double b = volume * gradient[v][a] / n_vertices;
                    m(v * n + a, w * n + dim) = b;
                    m(w * n + dim, v * n + a) = (1. + options.skewness) * b;
                  }
                const double mass =
                  volume * (v == w ? 2. : 1.) / ((dim + 1) * (dim + 2));
                const double projected      = volume / ((dim + 1) * (dim + 1));
                m(v * n + dim, w * n + dim) = -(
                  bulk_compliance * mass + options.alpha * (mass - projected));
              }
          }
      return m;
    }

    /** Call @p action(simplex) for this rank's simplices. */
    template <typename Action>
    void
    for_each_simplex(const Action &action) const
    {
      const unsigned int rank = Utilities::MPI::this_mpi_process(A.comm);
      const unsigned int m    = options.n_cells_per_edge;
      const unsigned int per_slice =
        Utilities::fixed_power<dim - 1>(static_cast<int>(m));
      for (unsigned int cell = first_slice(rank) * per_slice;
           cell < first_slice(rank + 1) * per_slice;
           ++cell)
        {
          Node         corner;
          unsigned int rest = cell;
          for (int d = dim - 1; d >= 0; --d, rest /= m)
            corner[d] = rest % m;
          std::array<unsigned int, dim> path;
          std::iota(path.begin(), path.end(), 0);
          do
            {
              std::array<Node, n_vertices> simplex;
              simplex[0] = corner;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  simplex[d + 1] = simplex[d];
                  ++simplex[d + 1][path[d]];
                }
              action(simplex);
            }
          while (std::next_permutation(path.begin(), path.end()));
        }
    }

    /** Local equation numbers of a simplex; -1: none. */
    std::vector<unsigned int>
    local_equations(const std::array<Node, n_vertices> &simplex) const
    {
      std::vector<unsigned int> local;
      for (const Node &i : simplex)
        {
          unsigned int node = 0;
          for (unsigned int d = 0; d < dim; ++d)
            node = node * n_edge + i[d];
          for (unsigned int c = 0; c < n_fields(); ++c)
            {
              const auto global = equation[node * n_fields() + c];
              local.push_back(global == no_equation ?
                                numbers::invalid_unsigned_int :
                                std::lower_bound(A.global_equation.begin(),
                                                 A.global_equation.end(),
                                                 global) -
                                  A.global_equation.begin());
            }
        }
      return local;
    }

    bool
    is_stored(const unsigned int row, const unsigned int col) const
    {
      return row != numbers::invalid_unsigned_int &&
             col != numbers::invalid_unsigned_int &&
             (!A.symmetric || col >= row);
    }

    void
    assemble()
    {
      std::vector<std::vector<unsigned int>> columns(A.global_equation.size());
      for_each_simplex([&](const auto &simplex) {
        const auto local = local_equations(simplex);
        for (const auto row : local)
          for (const auto col : local)
            if (is_stored(row, col))
              columns[row].push_back(col);
      });
      A.row_start.assign(1, 0);
      for (auto &row : columns)
        {
          std::sort(row.begin(), row.end());
          row.erase(std::unique(row.begin(), row.end()), row.end());
          A.column.insert(A.column.end(), row.begin(), row.end());
          A.row_start.push_back(A.column.size());
        }
      A.values.assign(A.column.size(), 0.);
      for_each_simplex([&](const auto &simplex) {
        const auto               local = local_equations(simplex);
        const FullMatrix<double> m     = element_matrix(simplex);
        for (unsigned int i = 0; i < local.size(); ++i)
          for (unsigned int j = 0; j < local.size(); ++j)
            if (is_stored(local[i], local[j]))
              A.values[std::lower_bound(
                         A.column.begin() + A.row_start[local[i]],
                         A.column.begin() + A.row_start[local[i] + 1],
                         local[j]) -
                       A.column.begin()] += m(i, j);
      });
    }

    const ElasticitySystemOptions        options;
    const unsigned int                   n_edge;
    std::vector<types::global_dof_index> equation;
    types::global_dof_index              owned_end = 0;
    unsigned int                         last_node = 0;
  };
} // namespace isochor

#endif
