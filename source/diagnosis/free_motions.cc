/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/rounding.h>
#include <isochor/diagnosis/free_motions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <sstream>

namespace isochor
{
  namespace
  {
    using Label = types::global_dof_index;
    using Mode  = std::array<double, 6>;

    bool
    is_displacement(const SparseSystem &A, const unsigned int equation)
    {
      return A.field[equation] == SparseSystem::Field::displacement;
    }



    /** For each equation of this rank the smallest number of an equation of the
     * same body. */
    std::vector<Label>
    label_bodies(const SparseSystem &A)
    {
      std::vector<Label> label(A.n_equations);
      std::iota(label.begin(), label.end(), Label(0));
      const auto root = [&label](Label i) {
        while (label[i] != i)
          i = label[i] = label[label[i]];
        return i;
      };
      for (bool changed = true; changed;)
        {
          for (unsigned int i = 0; i + 1 < A.row_start.size(); ++i)
            for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
              if (is_displacement(A, i) && is_displacement(A, A.column[k]))
                {
                  const Label a         = root(A.global_equation[i]);
                  const Label b         = root(A.global_equation[A.column[k]]);
                  label[std::max(a, b)] = std::min(a, b);
                }
          for (Label i = 0; i < label.size(); ++i)
            label[i] = root(i);
          if (Utilities::MPI::n_mpi_processes(A.comm) == 1)
            break;
          // what is one body on another rank
          std::vector<Label> smallest(label.size());
          Utilities::MPI::min(label, A.comm, smallest);
          const std::vector<Label> before = label;
          for (Label i = 0; i < label.size(); ++i)
            {
              const Label a = root(i), b = root(smallest[i]);
              label[std::max(a, b)] = std::min(a, b);
            }
          for (Label i = 0; i < label.size(); ++i)
            label[i] = root(i);
          changed =
            Utilities::MPI::max(static_cast<int>(label != before), A.comm) != 0;
        }
      return label;
    }



    /** What is summed up over a body. */
    struct Body
    {
      double                 n = 0, radius = 0;
      std::array<double, 3>  centre{};
      std::array<double, 36> energy{}, diagonal{};
    };



    /** Entry of an equation in the translations and the rotations about the
     * centre of @p body. */
    Mode
    modes_at(const SparseSystem &A, const unsigned int i, const Body &body)
    {
      Mode mode{};
      for (unsigned int m = 0; m < (A.dim == 2 ? 3 : 6); ++m)
        mode[m] = A.rigid_motion(i, A.component[i], m, body.centre.data()) /
                  (m < A.dim ? 1. : body.radius);
      return mode;
    }



    /** The bodies by their label, the same on all ranks. */
    std::map<Label, Body>
    collect_bodies(const SparseSystem &A, const std::vector<Label> &label)
    {
      std::map<Label, Body> bodies;
      for (unsigned int i = 0; i < A.global_equation.size(); ++i)
        if (is_displacement(A, i) &&
            A.locally_owned.is_element(A.global_equation[i]))
          {
            Body &body = bodies[label[A.global_equation[i]]];
            body.n += 1;
            for (unsigned int d = 0; d < A.dim; ++d)
              body.centre[d] += A.position[A.dim * i + d];
          }
      std::map<Label, std::array<double, 4>> sums;
      for (const auto &body : bodies)
        sums[body.first] = {{body.second.n,
                             body.second.centre[0],
                             body.second.centre[1],
                             body.second.centre[2]}};
      bodies.clear();
      for (const auto &of_rank : Utilities::MPI::all_gather(A.comm, sums))
        for (const auto &sum : of_rank)
          {
            Body &body = bodies[sum.first];
            body.n += sum.second[0];
            for (unsigned int d = 0; d < 3; ++d)
              body.centre[d] += sum.second[1 + d];
          }
      for (auto &body : bodies)
        for (double &x : body.second.centre)
          x /= body.second.n;

      for (unsigned int i = 0; i < A.global_equation.size(); ++i)
        if (is_displacement(A, i))
          {
            Body  &body   = bodies.at(label[A.global_equation[i]]);
            double square = 0;
            for (unsigned int d = 0; d < A.dim; ++d)
              square += std::pow(A.position[A.dim * i + d] - body.centre[d], 2);
            body.radius = std::max(body.radius, std::sqrt(square));
          }
      for (auto &body : bodies)
        {
          body.second.radius = Utilities::MPI::max(body.second.radius, A.comm);
          if (body.second.radius == 0) // a single node doesn't rotate
            body.second.radius = 1;
        }
      return bodies;
    }



    /** w·A v and w·diag(A) v of all pairs of modes, summed over the rows. */
    void
    add_energies(const SparseSystem       &A,
                 const std::vector<Label> &label,
                 std::map<Label, Body>    &bodies)
    {
      for (unsigned int i = 0; i + 1 < A.row_start.size(); ++i)
        {
          if (!is_displacement(A, i))
            continue;
          Body      &body = bodies.at(label[A.global_equation[i]]);
          const Mode row  = modes_at(A, i, body);
          Mode       image{}; // this row's part of A times the modes
          double     diagonal = 0;
          for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
            {
              const unsigned int j = A.column[k];
              if (!is_displacement(A, j))
                continue;
              const Mode column = modes_at(A, j, body);
              // a symmetric matrix has one of each pair, and half of the
              // diagonal counts twice below
              const double a = A.values[k] * (A.symmetric && j == i ? 0.5 : 1);
              for (unsigned int m = 0; m < 6; ++m)
                image[m] += a * column[m];
              if (i == j)
                diagonal += A.values[k];
            }
          for (unsigned int m = 0; m < 6; ++m)
            for (unsigned int n = 0; n < 6; ++n)
              {
                body.energy[6 * m + n] +=
                  row[m] * image[n] + (A.symmetric ? image[m] * row[n] : 0.);
                body.diagonal[6 * m + n] += diagonal * row[m] * row[n];
              }
        }
      for (auto &body : bodies)
        {
          sum_over_ranks(body.second.energy, A.comm);
          sum_over_ranks(body.second.diagonal, A.comm);
        }
    }



    /** Eigenvalues, ascending, and eigenvectors (columns) of a symmetric
     * matrix. */
    void
    eigen_decomposition(const FullMatrix<double> &matrix,
                        Vector<double>           &values,
                        FullMatrix<double>       &vectors)
    {
      const unsigned int       n = matrix.m();
      LAPACKFullMatrix<double> copy(n, n);
      copy               = matrix;
      const double bound = 2 * matrix.frobenius_norm() + 1;
      copy.compute_eigenvalues_symmetric(-bound, bound, 0., values, vectors);
    }



    /** Combinations of the modes v that nothing answers: w·A v = 0 for all
     * modes w. Where a pressure follows the surface A isn't symmetric, and v·A
     * v alone wouldn't tell. */
    std::vector<Mode>
    null_space(const Body &body, const unsigned int n_modes)
    {
      FullMatrix<double> diagonal(n_modes, n_modes), energy(n_modes, n_modes);
      for (unsigned int m = 0; m < n_modes; ++m)
        for (unsigned int n = 0; n < n_modes; ++n)
          {
            diagonal(m, n) = body.diagonal[6 * m + n];
            energy(m, n)   = body.energy[6 * m + n];
          }
      Vector<double>     values;
      FullMatrix<double> vectors;
      eigen_decomposition(diagonal, values, vectors);

      // modes that no equation feels aren't free, but held altogether
      std::vector<Mode> basis;
      for (unsigned int k = 0; k < values.size(); ++k)
        if (values[k] > rounding::accumulated * values.linfty_norm())
          {
            basis.emplace_back();
            basis.back().fill(0.);
            for (unsigned int m = 0; m < n_modes; ++m)
              basis.back()[m] = vectors(m, k) / std::sqrt(values[k]);
          }
      if (basis.empty())
        return {};
      FullMatrix<double> reduced(basis.size(), basis.size());
      for (unsigned int k = 0; k < basis.size(); ++k)
        for (unsigned int l = 0; l < basis.size(); ++l)
          for (unsigned int m = 0; m < n_modes; ++m)
            for (unsigned int n = 0; n < n_modes; ++n)
              reduced(k, l) += basis[k][m] * energy(m, n) * basis[l][n];
      LAPACKFullMatrix<double> decomposed(basis.size(), basis.size());
      decomposed = reduced;
      decomposed.compute_svd();

      std::vector<Mode> modes;
      for (unsigned int k = 0; k < basis.size(); ++k)
        if (decomposed.singular_value(k) < rounding::accumulated)
          {
            Mode mode{};
            for (unsigned int l = 0; l < basis.size(); ++l)
              for (unsigned int m = 0; m < n_modes; ++m)
                mode[m] += decomposed.get_svd_vt()(k, l) * basis[l][m];
            modes.push_back(mode);
          }
      return modes;
    }



    std::string
    as_text(const double *x, const unsigned int n)
    {
      std::ostringstream text;
      text.precision(4);
      text << '(';
      for (unsigned int d = 0; d < n; ++d)
        text << (d > 0 ? ", " : "") << (std::abs(x[d]) < 1e-9 ? 0. : x[d]);
      text << ')';
      return text.str();
    }



    /** Separate the span of @p modes into those whose entries first ... last-1
     * vanish and the rest. */
    void
    separate(const std::vector<Mode> &modes,
             const unsigned int       first,
             const unsigned int       last,
             std::vector<Mode>       &without,
             std::vector<Mode>       &with)
    {
      const unsigned int n = modes.size();
      if (n == 0)
        return;
      FullMatrix<double> products(n, n);
      double             size = 0;
      for (unsigned int k = 0; k < n; ++k)
        for (unsigned int l = 0; l < n; ++l)
          {
            for (unsigned int m = first; m < last; ++m)
              products(k, l) += modes[k][m] * modes[l][m];
            for (unsigned int m = 0; m < 6 && k == l; ++m)
              size = std::max(size, modes[k][m] * modes[k][m]);
          }
      Vector<double>     values;
      FullMatrix<double> vectors;
      eigen_decomposition(products, values, vectors);
      for (unsigned int k = 0; k < n; ++k)
        {
          Mode mode{};
          for (unsigned int l = 0; l < n; ++l)
            for (unsigned int m = 0; m < 6; ++m)
              mode[m] += vectors(l, k) * modes[l][m];
          (values[k] < rounding::accumulated * size ? without : with)
            .push_back(mode);
        }
    }



    /** "translation in x", "translation along (0.6, 0.8)" and the like. */
    std::vector<std::string>
    describe_directions(const std::vector<Mode> &modes,
                        const unsigned int       first,
                        const unsigned int       dim,
                        const std::string       &along_axis,
                        const std::string       &along)
    {
      // an axis is in the span if its projection is as long as itself
      std::vector<std::string> names;
      FullMatrix<double>       products(dim, dim);
      for (const Mode &mode : modes)
        for (unsigned int a = 0; a < dim; ++a)
          for (unsigned int b = 0; b < dim; ++b)
            products(a, b) += mode[first + a] * mode[first + b];
      Vector<double>     values;
      FullMatrix<double> vectors;
      eigen_decomposition(products, values, vectors);
      std::vector<unsigned int> in_span;
      for (unsigned int k = 0; k < dim; ++k)
        if (values[k] > 1e-8 * values.linfty_norm())
          in_span.push_back(k);
      for (unsigned int a = 0; a < dim; ++a)
        {
          double square = 0;
          for (const unsigned int k : in_span)
            square += vectors(a, k) * vectors(a, k);
          if (square > 1 - 1e-6)
            names.push_back(along_axis + "xyz"[a]);
        }
      if (names.size() < in_span.size())
        {
          names.clear();
          for (const unsigned int k : in_span)
            {
              std::array<double, 3> direction{};
              for (unsigned int a = 0; a < dim; ++a)
                direction[a] = vectors(a, k);
              names.push_back(along + as_text(direction.data(), dim));
            }
        }
      return names;
    }



    std::vector<std::string>
    describe(const std::vector<Mode> &modes,
             const Body              &body,
             const unsigned int       dim)
    {
      std::vector<Mode> translations, rotations;
      separate(modes, dim, dim == 2 ? 3 : 6, translations, rotations);
      std::vector<std::string> names;
      if (!translations.empty())
        names = describe_directions(
          translations, 0, dim, "translation in ", "translation along ");
      if (dim == 2)
        for (const Mode &mode : rotations)
          {
            // v = t + ω e_z × (x - c) vanishes at x
            const double omega = mode[2] / body.radius;
            const double x[2]  = {body.centre[0] - mode[1] / omega,
                                  body.centre[1] + mode[0] / omega};
            names.push_back(translations.empty() ?
                              "rotation about " + as_text(x, 2) :
                              "rotation");
          }
      else if (!rotations.empty())
        for (const std::string &name :
             describe_directions(rotations,
                                 3,
                                 3,
                                 "rotation about an axis in ",
                                 "rotation about an axis along "))
          names.push_back(name);
      return names;
    }
  } // namespace



  std::vector<FreeBody>
  find_free_bodies(const SparseSystem &A)
  {
    if (A.n_equations == 0)
      return {};
    const std::vector<Label> label  = label_bodies(A);
    std::map<Label, Body>    bodies = collect_bodies(A, label);
    add_energies(A, label, bodies);
    std::vector<FreeBody> free_bodies;
    for (const auto &entry : bodies)
      {
        const Body             &body  = entry.second;
        const std::vector<Mode> modes = null_space(body, A.dim == 2 ? 3 : 6);
        if (modes.empty())
          continue;
        FreeBody result;
        result.n_equations = body.n;
        result.centre.assign(body.centre.begin(), body.centre.begin() + A.dim);
        result.motions = describe(modes, body, A.dim);
        free_bodies.push_back(result);
      }
    return free_bodies;
  }



  bool
  has_free_pressure(const SparseSystem &A)
  {
    // A v for v = 1 at the pressures, and |A| v: by displacement equation, and
    // summed over the pressure equations at last
    const types::global_dof_index n = A.n_equations;
    std::vector<double>           sum(n + 1, 0.), size(n + 1, 0.);
    bool                          any = false;
    for (unsigned int i = 0; i + 1 < A.row_start.size(); ++i)
      for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
        {
          const unsigned int j      = A.column[k];
          const bool         row    = !is_displacement(A, i);
          const bool         column = !is_displacement(A, j);
          const auto         add    = [&](const types::global_dof_index at) {
            sum[at] += A.values[k];
            size[at] += std::abs(A.values[k]);
          };
          any = any || row;
          if (column)
            add(row ? n : A.global_equation[i]);
          if (row && A.symmetric && i != j)
            add(column ? n : A.global_equation[j]);
        }
    Utilities::MPI::sum(sum, A.comm, sum);
    Utilities::MPI::sum(size, A.comm, size);
    const auto largest = [](const std::vector<double> &values) {
      double result = 0;
      for (unsigned int i = 0; i + 1 < values.size(); ++i)
        result = std::max(result, std::abs(values[i]));
      return result;
    };
    return Utilities::MPI::max(any ? 1 : 0, A.comm) != 0 &&
           largest(sum) <= rounding::accumulated * largest(size) &&
           std::abs(sum[n]) <= rounding::accumulated * size[n];
  }
} // namespace isochor
