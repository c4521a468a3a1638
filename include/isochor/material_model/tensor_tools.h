/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_tensor_tools_h
#define isochor_tensor_tools_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <isochor/base/unrolled.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/point_pack.h>

#include <array>
#include <string>

namespace isochor
{
  /** Where component @p i (in deal.II's order) of a symmetric tensor of
   * dimension @p dim stands among the components xx, yy, zz, xy, xz, yz of the
   * 3D tensor. */
  template <int dim>
  constexpr unsigned int
  component_in_3d(const unsigned int i)
  {
    return (dim == 2 && i == 2) ? 3 : i;
  }

  /** Where component ij of a symmetric tensor of dimension @p dim stands in
   * deal.II's order. */
  template <int dim>
  constexpr unsigned int
  component_in_plane(const unsigned int i, const unsigned int j)
  {
    return i == j ? i : dim - 1 + i + j;
  }

  /** The part of the 3D tensor @p t that works on motions of dimension dim. */
  template <int dim>
  inline SymmetricTensor<2, dim>
  in_plane(const SymmetricTensor<2, 3> &t)
  {
    SymmetricTensor<2, dim> part;
    for (unsigned int i = 0; i < part.n_independent_components; ++i)
      part.access_raw_entry(i) = t.access_raw_entry(component_in_3d<dim>(i));
    return part;
  }

  /** A 3D tensor from its n_symmetric_components<dim> stored components. The
   * one order of histories, points, checkpoints and output: xx, yy, zz, xy(,
   * xz, yz), which is deal.II's. */
  template <int dim>
  inline SymmetricTensor<2, 3>
  load_symmetric(const double *components)
  {
    SymmetricTensor<2, 3> t;
    for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
      t.access_raw_entry(i) = components[i];
    return t;
  }

  /** The inverse of load_symmetric(). */
  template <int dim>
  inline void
  store_symmetric(const SymmetricTensor<2, 3> &t, double *components)
  {
    for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
      components[i] = t.access_raw_entry(i);
  }

  /** The name of component @p i of a symmetric 3D tensor: "xx", ..., "yz". */
  inline std::string
  symmetric_component_name(const unsigned int i)
  {
    const char *names[] = {"xx", "yy", "zz", "xy", "xz", "yz"};
    AssertIndexRange(i, 6);
    return names[i];
  }

  /**
   * A symmetric 3D tensor by its n_symmetric_components<dim>, in the order of
   * store_symmetric(). Laws compute with these what they do at each point in
   * each iteration: a SymmetricTensor<2, 3> also carries the shears across the
   * plane, and, written by numbers and read as vectors right afterwards, made
   * laws two to three times slower.
   */
  template <int dim, typename Number = double>
  struct SymmetricComponents
  {
    static constexpr unsigned int n = n_symmetric_components<dim>;

    /** Where component ij stands. */
    static constexpr unsigned int
    place(const unsigned int i, const unsigned int j)
    {
      return component_in_plane<3>(i, j);
    }

    std::array<Number, n> entry;

    /** The one that is component @p i of in_plane() of the tensor. */
    Number
    in_plane(const unsigned int i) const
    {
      return entry[component_in_3d<dim>(i)];
    }

    Number
    trace() const
    {
      return entry[0] + entry[1] + entry[2];
    }

    SymmetricComponents
    deviator() const
    {
      return *this + (-1. / 3.) * trace();
    }

    /** t : t. */
    Number
    norm_square() const
    {
      Number normal = 0., shear = 0.;
      unrolled<n>(
        [&](const auto i) { (i < 3 ? normal : shear) += entry[i] * entry[i]; });
      return normal + 2. * shear;
    }

    Number
    determinant() const
    {
      const Number *const t   = entry.data();
      const Number        det = (t[0] * t[1] - t[3] * t[3]) * t[2];
      return dim == 2 ? det :
                        det + 2. * t[3] * t[4] * t[5] - t[0] * t[5] * t[5] -
                          t[1] * t[4] * t[4];
    }

    /** t² = t t. */
    SymmetricComponents
    square() const
    {
      SymmetricComponents result;
      unrolled<dim>([&](const auto i) {
        unrolled<dim - i>([&](const auto above) {
          constexpr unsigned int j   = i + above;
          Number                 sum = 0.;
          unrolled<dim>([&](const auto k) {
            sum += entry[place(i, k)] * entry[place(k, j)];
          });
          result.entry[place(i, j)] = sum;
        });
      });
      if (dim == 2)
        result.entry[2] = entry[2] * entry[2];
      return result;
    }

    /** t + @p mean 1. */
    SymmetricComponents
    operator+(const Number &mean) const
    {
      SymmetricComponents result;
      unrolled<n>([&](const auto i) {
        result.entry[i] = i < 3 ? entry[i] + mean : entry[i];
      });
      return result;
    }

    SymmetricComponents
    operator+(const SymmetricComponents &other) const
    {
      SymmetricComponents result;
      unrolled<n>(
        [&](const auto i) { result.entry[i] = entry[i] + other.entry[i]; });
      return result;
    }

    friend SymmetricComponents
    operator*(const Number &factor, const SymmetricComponents &t)
    {
      SymmetricComponents result;
      unrolled<n>([&](const auto i) { result.entry[i] = factor * t.entry[i]; });
      return result;
    }

    void
    copy_to(SymmetricTensor<2, 3> &t) const
    {
      unrolled<n>([&](const auto i) { t.access_raw_entry(i) = entry[i]; });
      for (unsigned int i = n; i < 6; ++i)
        t.access_raw_entry(i) = 0.;
    }

    static SymmetricComponents
    load(const Number *components)
    {
      SymmetricComponents t;
      unrolled<n>([&](const auto i) { t.entry[i] = components[i]; });
      return t;
    }

    void
    store(Number *components) const
    {
      unrolled<n>([&](const auto i) { components[i] = entry[i]; });
    }
  };

  /** Component ij of the in-plane part of a modulus, i and j in deal.II's
   * order, at i n + j: the same for fourth-order tensors. */
  template <int dim, typename Number = double>
  using ModulusComponents =
    std::array<Number,
               SymmetricTensor<2, dim>::n_independent_components *
                 SymmetricTensor<2, dim>::n_independent_components>;

  template <int dim>
  inline void
  copy_modulus(const ModulusComponents<dim> &from, SymmetricTensor<4, dim> &to)
  {
    unrolled<std::tuple_size<ModulusComponents<dim>>::value>(
      [&](const auto i) { to.access_raw_entry(i) = from[i]; });
  }

  /** f b f^T, where f_33 = 1 in plane strain. @p b: the components of b.
   * @tparam Matrix Tensor<2, dim>, or TensorPack with @p Number PointPack. */
  template <int dim, typename Matrix, typename Number>
  inline DEAL_II_ALWAYS_INLINE SymmetricComponents<dim, Number>
  push_forward_by(const Matrix &f, const Number *const b)
  {
    Number f_b[dim][dim];
    unrolled<dim>([&](const auto i) {
      unrolled<dim>([&](const auto j) {
        f_b[i][j] = 0.;
        unrolled<dim>([&](const auto k) {
          f_b[i][j] += f[i()][k()] * b[component_in_plane<3>(k, j)];
        });
      });
    });

    SymmetricComponents<dim, Number> result;
    unrolled<dim>([&](const auto i) {
      unrolled<dim - i>([&](const auto above) {
        constexpr unsigned int j   = i + above;
        Number                 sum = 0.;
        unrolled<dim>([&](const auto k) { sum += f_b[i][k] * f[j][k()]; });
        result.entry[result.place(i, j)] = sum;
      });
    });
    if (dim == 2)
      result.entry[2] = b[2];
    return result;
  }

  /** The same of numbers. */
  template <int dim>
  inline SymmetricComponents<dim>
  push_forward(const Tensor<2, dim> &f, const double *const b)
  {
    return push_forward_by<dim>(f, b);
  }

  /** The same of a tensor. */
  template <int dim>
  inline SymmetricTensor<2, 3>
  push_forward(const Tensor<2, dim> &f, const SymmetricTensor<2, 3> &b)
  {
    std::array<double, n_symmetric_components<dim>> components;
    store_symmetric<dim>(b, components.data());
    SymmetricTensor<2, 3> result;
    push_forward(f, components.data()).copy_to(result);
    return result;
  }
} // namespace isochor

#endif
