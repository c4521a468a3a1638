/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_tensor_tools_h
#define isochor_tensor_tools_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <isochor/material_model/material_model.h>

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

  /** t² = t t. */
  inline SymmetricTensor<2, 3>
  square(const SymmetricTensor<2, 3> &t)
  {
    SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = i; j < 3; ++j)
        result[i][j] =
          t[i][0] * t[0][j] + t[i][1] * t[1][j] + t[i][2] * t[2][j];
    return result;
  }

  /** f b f^T, where f_33 = 1 in plane strain. */
  template <int dim>
  inline SymmetricTensor<2, 3>
  push_forward(const Tensor<2, dim> &f, const SymmetricTensor<2, 3> &b)
  {
    Tensor<2, dim> f_b;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        for (unsigned int k = 0; k < dim; ++k)
          f_b[i][j] += f[i][k] * b[k][j];

    SymmetricTensor<2, 3> result;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        {
          double sum = 0;
          for (unsigned int k = 0; k < dim; ++k)
            sum += f_b[i][k] * f[j][k];
          result[i][j] = sum;
        }
    if (dim == 2)
      result[2][2] = b[2][2];
    return result;
  }
} // namespace isochor

#endif
