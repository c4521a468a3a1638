/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>
#include <deal.II/base/symmetric_tensor.h>

#include <isochor/boundary_condition/surface_correction.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <limits>
#include <ostream>

namespace isochor
{
  template <int dim>
  void
  SurfaceCorrection<dim>::find_modes(const BoundaryPoints<dim> &points,
                                     const unsigned int         n_surfaces,
                                     const MPI_Comm             comm)
  {
    std::vector<double> sums((1 + dim) * n_surfaces); // Σ A, Σ A X
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const double      A   = points.reference_area(b).norm();
        const Point<dim>  X   = points.reference_location(b);
        const std::size_t row = (1 + dim) * std::size_t(points.surface(b));
        sums[row] += A;
        for (unsigned int i = 0; i < dim; ++i)
          sums[row + 1 + i] += A * X[i];
      }
    Utilities::MPI::sum(sums, comm, sums);
    modes.assign(n_surfaces, {});
    for (unsigned int s = 0; s < n_surfaces; ++s)
      {
        modes[s].area = sums[(1 + dim) * s];
        for (unsigned int i = 0; i < dim; ++i)
          modes[s].centre[i] = sums[(1 + dim) * s + 1 + i] / modes[s].area;
      }
    find_axes(points, comm);
    make_orthogonal(points, comm);
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::find_axes(const BoundaryPoints<dim> &points,
                                    const MPI_Comm             comm)
  {
    // by surface: Σ A (X - X̄) ⊗ (X - X̄)
    constexpr unsigned int n_second = dim * dim;
    std::vector<double>    moments(n_second * modes.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const unsigned int   s = points.surface(b);
        const Tensor<1, dim> r = points.reference_location(b) - modes[s].centre;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = 0; j < dim; ++j)
            moments[n_second * s + dim * i + j] +=
              points.reference_area(b).norm() * r[i] * r[j];
      }
    Utilities::MPI::sum(moments, comm, moments);
    for (unsigned int s = 0; s < modes.size(); ++s)
      {
        SymmetricTensor<2, dim> radii; // of gyration, squared
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            radii[i][j] = moments[n_second * s + dim * i + j] / modes[s].area;
        const auto axes = eigenvectors(radii);
        // across a plane, and at a single point, there is no extent
        const double extent = std::pow(modes[s].area, 1. / (dim - 1));
        for (unsigned int k = 0; k < dim; ++k)
          if (axes[k].first > 1e-6 * extent * extent)
            modes[s].direction[k] = axes[k].second / std::sqrt(axes[k].first);
      }
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::make_orthogonal(const BoundaryPoints<dim> &points,
                                          const MPI_Comm             comm)
  {
    // by surface: the mean products of the monomials, and the mean size of
    // cells
    constexpr unsigned int stride = n_modes * n_modes + 1;
    std::vector<double>    means(stride * modes.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const Modes &at   = modes[points.surface(b)];
        double      *mean = &means[stride * std::size_t(points.surface(b))];
        const double part = points.reference_area(b).norm() / at.area;
        const auto   psi  = monomials(at, points.reference_location(b));
        for (unsigned int i = 0; i < n_modes; ++i)
          for (unsigned int j = 0; j < n_modes; ++j)
            mean[n_modes * i + j] += part * psi[i] * psi[j];
        mean[stride - 1] += part * points.size_of_cells(b);
      }
    Utilities::MPI::sum(means, comm, means);
    for (unsigned int s = 0; s < modes.size(); ++s)
      modes[s].make_orthogonal(&means[stride * std::size_t(s)],
                               means[stride * std::size_t(s) + stride - 1]);
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::Modes::make_orthogonal(const double *mean_products,
                                                 const double  size_of_cells)
  {
    const auto product = [&](const Monomials &a, const Monomials &b) {
      double sum = 0;
      for (unsigned int i = 0; i < n_modes; ++i)
        for (unsigned int j = 0; j < n_modes; ++j)
          sum += a[i] * mean_products[n_modes * i + j] * b[j];
      return sum;
    };
    // a straight side is as long as √12 times its radius of gyration
    constexpr double least_cells = 5.7; // as no regular grid has
    const auto       is_long     = [&](const unsigned int k) {
      return direction[k].norm() * least_cells * size_of_cells < std::sqrt(12.);
    };
    unsigned int m = 0;
    for (; m < n_affine; ++m)
      combination[m][m] = 1;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j, ++m)
        {
          if (!is_long(i) || !is_long(j))
            continue;
          Monomials phi{};
          phi[m]           = 1;
          const double all = product(phi, phi);
          for (unsigned int k = 0; k < m; ++k)
            {
              const double part = product(phi, combination[k]);
              for (unsigned int l = 0; l < n_modes; ++l)
                phi[l] -= part * combination[k][l];
            }
          // else it is nearly one of the others, as along an arc
          constexpr double considerable = 0.01;
          if (const double rest = product(phi, phi); rest > considerable * all)
            for (unsigned int l = 0; l < n_modes; ++l)
              combination[m][l] = phi[l] / std::sqrt(rest);
        }
  }



  template <int dim>
  auto
  SurfaceCorrection<dim>::monomials(const Modes &at, const Point<dim> &X)
    -> Monomials
  {
    Monomials psi;
    psi[0] = 1;
    for (unsigned int k = 0; k < dim; ++k)
      psi[1 + k] = at.direction[k] * (X - at.centre);
    unsigned int m = n_affine;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j, ++m)
        psi[m] = psi[1 + i] * psi[1 + j];
    return psi;
  }



  template <int dim>
  auto
  SurfaceCorrection<dim>::shape(const unsigned int surface,
                                const Point<dim>  &X) const -> Monomials
  {
    const Modes &at  = modes[surface];
    const auto   psi = monomials(at, X);
    Monomials    phi{};
    for (unsigned int k = 0; k < n_modes; ++k)
      for (unsigned int l = 0; l <= k; ++l)
        phi[k] += at.combination[k][l] * psi[l];
    return phi;
  }



  template <int dim>
  double
  SurfaceCorrection<dim>::value(const unsigned int surface,
                                const unsigned int a,
                                const Point<dim>  &X,
                                const double       time) const
  {
    if (modes.empty())
      return 0.;
    const Vector<double> &c   = time > accepted_time ? coefficients : accepted;
    const auto            phi = shape(surface, X);
    double                sum = 0;
    for (unsigned int k = 0; k < n_modes; ++k)
      sum += phi[k] * c((dim * surface + a) * n_modes + k);
    return sum;
  }



  template <int dim>
  Vector<double>
  SurfaceCorrection<dim>::gap_of_modes(const BoundaryPoints<dim>    &points,
                                       const SurfaceConditions<dim> &conditions,
                                       const Gap                    &gap,
                                       const MPI_Comm                comm) const
  {
    std::vector<double> sums(coefficients.size());
    for (unsigned int b = 0; b < points.size(); ++b)
      {
        const unsigned int s   = points.surface(b);
        const double       A   = points.reference_area(b).norm();
        const auto         phi = shape(s, points.reference_location(b));
        for (unsigned int a = 0; a < dim; ++a)
          if (!conditions.surfaces[s].displacement[a].empty())
            {
              const double g = gap(b, a);
              for (unsigned int k = 0; k < n_modes; ++k)
                sums[(dim * s + a) * n_modes + k] += A * phi[k] * g;
            }
      }
    Utilities::MPI::sum(sums, comm, sums);
    // the modes are orthogonal, and as large as 1 in the mean
    Vector<double> result(sums.size());
    for (unsigned int i = 0; i < sums.size(); ++i)
      if (i % n_modes < n_affine || !only_affine)
        result(i) = sums[i] / modes[i / (dim * n_modes)].area;
    return result;
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::start_step(const double size)
  {
    step_size  = size;
    n_updates  = 0;
    first_norm = 0;
    // what failed that often would only cost time
    constexpr unsigned int often = 3;
    given_up                     = n_steps_in_vain >= often;
    if (modes.empty())
      return;
    coefficients = accepted;
    if (accepted_size > 0)
      {
        coefficients.add(step_size / accepted_size, accepted);
        coefficients.add(-step_size / accepted_size, before);
      }
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::learn(const Vector<double> &new_gap)
  {
    // Broyden's good method: B += (Δc - B y)(Δc·B) / (Δc·B y), y = Δgap
    const unsigned int m = new_gap.size();
    Vector<double>     y = new_gap, B_y(m), c_B(m);
    y -= last_gap;
    inverse.vmult(B_y, y);
    inverse.Tvmult(c_B, change);
    const double denominator = change * B_y;
    if (!(std::abs(denominator) > 1e-3 * (change * change)))
      return;
    Vector<double> error = change;
    error -= B_y;
    for (unsigned int i = 0; i < m; ++i)
      for (unsigned int j = 0; j < m; ++j)
        inverse(i, j) += error(i) * c_B(j) / denominator;
  }



  template <int dim>
  bool
  SurfaceCorrection<dim>::is_small(const Vector<double>          &gap_of_modes,
                                   const std::array<double, dim> &moved) const
  {
    // of what the body is deformed by, and of this in other directions; and
    // what rounding leaves of places
    constexpr double small = 1e-4, very_small = 1e-7, rounding = 1e-15;
    const double     largest = *std::max_element(moved.begin(), moved.end());
    double           place   = largest;
    for (const Modes &at : modes)
      place = std::max(place,
                       at.centre.distance(Point<dim>()) +
                         std::pow(at.area, 1. / (dim - 1)));
    const double least = very_small * largest + rounding * place;
    for (unsigned int i = 0; i < gap_of_modes.size(); ++i)
      if (std::abs(gap_of_modes(i)) >
          std::max(small * moved[i / n_modes % dim], least))
        return false;
    return true;
  }



  template <int dim>
  bool
  SurfaceCorrection<dim>::update(const BoundaryPoints<dim>     &points,
                                 const SurfaceConditions<dim>  &conditions,
                                 const Gap                     &gap,
                                 const std::array<double, dim> &moved,
                                 const MPI_Comm                 comm)
  {
    if (given_up)
      return false;
    const unsigned int n_surfaces = conditions.surfaces.size();
    if (modes.empty())
      {
        find_modes(points, n_surfaces, comm);
        for (Vector<double> *c : {&coefficients, &accepted, &before})
          c->reinit(n_surfaces * dim * n_modes);
        inverse = FullMatrix<double>(IdentityMatrix(coefficients.size()));
      }
    const Vector<double> here = gap_of_modes(points, conditions, gap, comm);
    const bool           met  = is_small(here, moved);
    const double         norm = here.l2_norm();
    if (n_updates > 0)
      learn(here);
    else
      first_norm = norm;
    constexpr unsigned int patience = 3, most_updates = 10;
    if (n_updates >= patience && !(norm < first_norm / 2))
      {
        coefficients = accepted;
        return give_up();
      }
    if (met || n_updates == most_updates)
      return false;
    last_gap = here;
    change.reinit(here.size());
    inverse.vmult(change, here);
    change *= -1;
    coefficients += change;
    ++n_updates;
    return true;
  }



  template <int dim>
  bool
  SurfaceCorrection<dim>::give_up()
  {
    if (only_affine)
      {
        given_up = true;
        ++n_steps_in_vain;
      }
    only_affine = true;
    inverse     = FullMatrix<double>(IdentityMatrix(coefficients.size()));
    n_updates   = 0;
    return true;
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::accept(const double time)
  {
    accepted_time = time;
    accepted_size = step_size;
    before        = accepted;
    accepted      = coefficients;
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::save(std::ostream &text) const
  {
    text << modes.size() << ' ' << n_steps_in_vain << ' ' << only_affine << ' '
         << accepted_size << ' ' << accepted_time;
    for (const Modes &at : modes)
      {
        text << ' ' << at.area << ' ' << at.centre;
        for (const Tensor<1, dim> &n : at.direction)
          text << ' ' << n;
        for (const Monomials &of_mode : at.combination)
          for (const double part : of_mode)
            text << ' ' << part;
      }
    for (unsigned int i = 0; i < accepted.size(); ++i)
      text << ' ' << accepted(i) << ' ' << before(i);
    for (unsigned int i = 0; i < inverse.m(); ++i)
      for (unsigned int j = 0; j < inverse.n(); ++j)
        text << ' ' << inverse(i, j);
  }



  template <int dim>
  void
  SurfaceCorrection<dim>::load(std::istream &text)
  {
    std::size_t n_surfaces;
    text >> n_surfaces >> n_steps_in_vain >> only_affine >> accepted_size >>
      accepted_time;
    modes.assign(n_surfaces, {});
    for (Modes &at : modes)
      {
        text >> at.area >> at.centre;
        for (Tensor<1, dim> &n : at.direction)
          for (unsigned int i = 0; i < dim; ++i)
            text >> n[i];
        for (Monomials &of_mode : at.combination)
          for (double &part : of_mode)
            text >> part;
      }
    const unsigned int n_entries = n_surfaces * dim * n_modes;
    for (Vector<double> *c : {&coefficients, &accepted, &before})
      c->reinit(n_entries);
    for (unsigned int i = 0; i < n_entries; ++i)
      text >> accepted(i) >> before(i);
    coefficients = accepted;
    inverse.reinit(n_entries, n_entries);
    for (unsigned int i = 0; i < n_entries; ++i)
      for (unsigned int j = 0; j < n_entries; ++j)
        text >> inverse(i, j);
  }



  template class SurfaceCorrection<2>;
  template class SurfaceCorrection<3>;
} // namespace isochor
