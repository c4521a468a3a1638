/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <isochor/dynamics/field_followers.h>
#include <isochor/dynamics/mass_matrix.h>
#include <isochor/equations/invariants.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace isochor
{
  template <int dim>
  void
  MassMatrix<dim>::reinit(const StepContext<dim>    &step,
                          const std::vector<double> &weights,
                          const unsigned int         components)
  {
    Assert(components == 1 || components == dim, ExcInternalError());
    const PointArrays<dim> &points = step.points;
    weight                         = weights;
    n_components                   = components;
    step.nodes.initialize(lumped, 1);
    step.nodes.initialize(diagonal, 1);
    cell_mass.clear();
    if (!points.has_stencils())
      cell_mass.resize(points.cell.size());
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto   stencil = points.stencil(step.grid.geometry(), k, q);
          const double m       = weight[q];
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              const double       N    = stencil.shape[I];
              lumped.local_element(node) += m * N;
              diagonal.local_element(node) += m * N * N;
            }
          if (!points.has_stencils())
            for (unsigned int I = 0, entry = 0; I <= dim; ++I)
              for (unsigned int J = 0; J <= I; ++J, ++entry)
                cell_mass[k][entry] += m * stencil.shape[I] * stencil.shape[J];
        }
    lumped.compress(VectorOperation::add);
    diagonal.compress(VectorOperation::add);
  }



  template <int dim>
  void
  MassMatrix<dim>::reinit(const StepContext<dim> &step, const bool with_domains)
  {
    reinit(step, step.points.mass.values(), dim);
    if (with_domains)
      domains.find(step);
  }



  template <int dim>
  void
  MassMatrix<dim>::element_nodes(const StepContext<dim>    &step,
                                 const unsigned int         element,
                                 std::vector<unsigned int> &nodes) const
  {
    AssertIndexRange(element, n_elements(step));
    const PointArrays<dim> &points = step.points;
    nodes.clear();
    if (points.has_stencils())
      for (std::size_t i = points.stencil_start[element];
           i < points.stencil_start[element + 1];
           ++i)
        nodes.push_back(step.nodes.node(points.stencil_vertex[i]));
    else
      for (const unsigned int vertex :
           step.grid.geometry().vertex_indices(points.cell[element]))
        nodes.push_back(step.nodes.node(vertex));
  }



  template <int dim>
  void
  MassMatrix<dim>::element_matrix(const StepContext<dim> &step,
                                  const unsigned int      element,
                                  std::vector<double>    &matrix) const
  {
    AssertIndexRange(element, n_elements(step));
    const PointArrays<dim> &points = step.points;
    if (points.has_stencils())
      {
        const auto stencil   = points.stencil(step.grid.geometry(), 0, element);
        const unsigned int n = stencil.n_nodes;
        matrix.resize(n * n);
        for (unsigned int I = 0; I < n; ++I)
          for (unsigned int J = 0; J < n; ++J)
            matrix[I * n + J] =
              weight[element] * stencil.shape[I] * stencil.shape[J];
        return;
      }
    constexpr unsigned int n = dim + 1;
    matrix.resize(n * n);
    for (unsigned int I = 0, entry = 0; I < n; ++I)
      for (unsigned int J = 0; J <= I; ++J, ++entry)
        matrix[I * n + J] = matrix[J * n + I] = cell_mass[element][entry];
  }



  template <int dim>
  template <typename Field>
  void
  MassMatrix<dim>::collect_components(const StepContext<dim> &step,
                                      const Field            &field,
                                      NodalField             &result) const
  {
    const PointArrays<dim> &points = step.points;
    step.nodes.initialize(result, n_components);
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              for (unsigned int a = 0; a < n_components; ++a)
                result.local_element(node * n_components + a) +=
                  weight[q] * stencil.shape[I] * field(q, a);
            }
        }
    result.compress(VectorOperation::add);
  }



  template <int dim>
  void
  MassMatrix<dim>::collect(const StepContext<dim>            &step,
                           const std::vector<Tensor<1, dim>> &field,
                           NodalField                        &result) const
  {
    AssertDimension(n_components, dim);
    collect_components(
      step,
      [&](const unsigned int q, const unsigned int a) { return field[q][a]; },
      result);
  }



  template <int dim>
  void
  MassMatrix<dim>::collect(const StepContext<dim>    &step,
                           const std::vector<double> &field,
                           NodalField                &result) const
  {
    AssertDimension(n_components, 1);
    collect_components(
      step,
      [&](const unsigned int q, const unsigned int) { return field[q]; },
      result);
  }



  template <int dim>
  void
  MassMatrix<dim>::add_product(const StepContext<dim> &step,
                               const NodalField       &field,
                               NodalField             &result) const
  {
    if (n_components == 1)
      add_product_of_components<1>(step, field, result);
    else
      add_product_of_components<dim>(step, field, result);
  }



  template <int dim>
  template <int n>
  void
  MassMatrix<dim>::add_product_of_components(const StepContext<dim> &step,
                                             const NodalField       &field,
                                             NodalField &result) const
  {
    const PointArrays<dim> &points = step.points;
    const double *const     x      = field.begin();
    double *const           y      = result.begin();
    if (points.has_stencils())
      {
        for (unsigned int q = 0; q < points.n_points(); ++q)
          {
            const auto   stencil = points.stencil(step.grid.geometry(), 0, q);
            Tensor<1, n> value;
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              {
                const double *const nodal =
                  x + step.nodes.node(stencil.vertex[I]) * n;
                for (unsigned int a = 0; a < n; ++a)
                  value[a] += stencil.shape[I] * nodal[a];
              }
            value *= weight[q];
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              {
                double *const nodal =
                  y + step.nodes.node(stencil.vertex[I]) * n;
                for (unsigned int a = 0; a < n; ++a)
                  nodal[a] += stencil.shape[I] * value[a];
              }
          }
        return;
      }
    for (unsigned int k = 0; k < cell_mass.size(); ++k)
      {
        const auto &vertices =
          step.grid.geometry().vertex_indices(points.cell[k]);
        std::array<unsigned int, dim + 1> first;
        for (unsigned int I = 0; I <= dim; ++I)
          first[I] = step.nodes.node(vertices[I]) * n;
        for (unsigned int I = 0, entry = 0; I <= dim; ++I)
          for (unsigned int J = 0; J <= I; ++J, ++entry)
            for (unsigned int a = 0; a < n; ++a)
              {
                const double m = cell_mass[k][entry];
                y[first[I] + a] += m * x[first[J] + a];
                if (J < I)
                  y[first[J] + a] += m * x[first[I] + a];
              }
      }
  }



  template <int dim>
  void
  MassMatrix<dim>::vmult(const StepContext<dim> &step,
                         const NodalField       &field,
                         NodalField             &result) const
  {
    Assert(invariants::fits(field, step.nodes, n_components), ExcOtherNodes());
    step.nodes.initialize(result, n_components);
    add_product(step, field, result);
    result.compress(VectorOperation::add);
  }



  template <int dim>
  void
  MassMatrix<dim>::set_lumped_solution(const NodalField                 &load,
                                       const std::vector<unsigned char> &held,
                                       NodalField &solution) const
  {
    AssertDimension(load.size(), solution.size());
    Assert(held.size() >= solution.locally_owned_size(), ExcInternalError());
    for (unsigned int i = 0; i < solution.locally_owned_size(); ++i)
      if (const double m = lumped.local_element(i / n_components);
          !held[i] && m > 0 && m >= diagonal.local_element(i / n_components))
        solution.local_element(i) = load.local_element(i) / m;
  }



  /** Scaled to a unit diagonal, so that residuals of nodes with little mass
   * count for what they do to their points. */
  template <int dim>
  struct MassMatrix<dim>::ScaledMatrix
  {
    const MassMatrix<dim>  &mass;
    const StepContext<dim> &step;
    const Followers        &followers;
    const NodalField       &scale;
    const bool              with_domains;
    mutable NodalField      scaled;

    void
    vmult(NodalField &result, const NodalField &x) const
    {
      scaled.zero_out_ghost_values();
      scaled = x;
      scaled.scale(scale);
      set_followers(followers, {}, scaled);
      result = 0.;
      mass.add_product(step, scaled, result);
      if (with_domains)
        mass.domains.add_product(step, scaled, result);
      result.compress(VectorOperation::add);
      hand_on(followers, result);
      result.scale(scale);
    }
  };



  template <int dim>
  void
  MassMatrix<dim>::scale_diagonal(const StepContext<dim>           &step,
                                  const std::vector<unsigned char> &held,
                                  const Followers                  &followers,
                                  const bool  with_domains,
                                  NodalField &scale,
                                  NodalField &solution) const
  {
    const unsigned int n = step.nodes.n_owned() * n_components;
    AssertIndexRange(n, held.size() + 1);
    step.nodes.initialize(scale, n_components);
    for (unsigned int i = 0; i < n; ++i)
      scale.local_element(i) =
        diagonal.local_element(i / n_components) +
        (with_domains ? domains.diagonal.local_element(i / n_components) : 0.);
    for (unsigned int k = 0; k < followers.size(); ++k)
      if (const unsigned int entry = followers.entry[k]; entry < n)
        {
          for (std::size_t i = followers.start[k]; i < followers.start[k + 1];
               ++i)
            scale.local_element(followers.master[i]) +=
              followers.weight[i] * followers.weight[i] *
              scale.local_element(entry);
          scale.local_element(entry) = 0.;
        }
    scale.compress(VectorOperation::add);
    for (unsigned int i = 0; i < n; ++i)
      {
        const double m         = scale.local_element(i);
        scale.local_element(i) = (!held[i] && m > 0) ? 1 / std::sqrt(m) : 0.;
        if (!held[i] && m == 0)
          solution.local_element(i) = 0;
      }
  }



  template <int dim>
  double
  MassMatrix<dim>::solve(const StepContext<dim>           &step,
                         const NodalField                 &load,
                         const std::vector<unsigned char> &held,
                         const Followers                  &followers,
                         const std::vector<double>        &given,
                         NodalField                       &solution,
                         const bool                        with_domains) const
  {
    Assert(invariants::fits(load, step.nodes, n_components), ExcOtherNodes());
    Assert(invariants::fits(solution, step.nodes, n_components),
           ExcOtherNodes());
    NodalField scale, residual, correction;
    scale_diagonal(step, held, followers, with_domains, scale, solution);
    set_followers(followers, given, solution);
    step.nodes.initialize(residual, n_components);
    add_product(step, solution, residual);
    if (with_domains)
      domains.add_product(step, solution, residual);
    residual.compress(VectorOperation::add);
    residual.sadd(-1., 1., load);
    hand_on(followers, residual);
    residual.scale(scale);
    correction = load;
    hand_on(followers, correction);
    correction.scale(scale);
    const double size = correction.l2_norm();
    correction        = 0.;
    if (size == 0. && residual.l2_norm() == 0.)
      return 0.;

    const double goal = std::max(size, residual.l2_norm());
    ScaledMatrix matrix{*this, step, followers, scale, with_domains, scale};
    IterationNumberControl control(200, 1e-14 * goal, false, false);
    SolverCG<NodalField>   cg(control);
    try
      {
        cg.solve(matrix, correction, residual, PreconditionIdentity());
      }
    catch (const SolverControl::NoConvergence &)
      {
        // not a number: the matrix is singular, the load not in its range
        return std::numeric_limits<double>::infinity();
      }
    correction.scale(scale);
    solution.zero_out_ghost_values();
    solution += correction;
    set_followers(followers, given, solution);
    return control.last_value() / goal;
  }



  template class MassMatrix<2>;
  template class MassMatrix<3>;
} // namespace isochor
