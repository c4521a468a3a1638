/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_layout_h
#define isochor_point_layout_h

#include <deal.II/base/tensor.h>

#include <cmath>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Where each field of a material point stands in its block of particle
   * properties. The one layout that seeding, output, checkpoint and the
   * exchange between ranks share. A scene carries only the fields it needs.
   */
  struct PointLayout
  {
    unsigned int volume       = 0; ///< reference volume V_0 (m^dim)
    unsigned int mass         = 0; ///< kg
    unsigned int material     = 0; ///< index of the material
    unsigned int displacement = 0; ///< total displacement (m), dim components
    unsigned int F            = 0; ///< deformation gradient, dim x dim by rows
    unsigned int pressure = 0; ///< p, conjugate to θ (Pa), tension positive
    /** V_0 over what it was at t = 0, or what is left of that by splitting,
     * less 1; and behind it what the point remembers of its shear
     * (UnseenVolume); only in u-p, else 0. */
    unsigned int volume_gain  = 0;
    unsigned int stress       = 0; ///< Cauchy: xx, yy, zz, xy(, xz, yz) (Pa)
    unsigned int velocity     = 0; ///< m/s, only in dynamics
    unsigned int acceleration = 0; ///< m/s^2, only in dynamics
    /** What the acceleration exceeds that of the forces in the last step by
     * (m/s^2), see InertiaTerm; only if with_excess. */
    unsigned int excess      = 0;
    bool         with_excess = false;
    unsigned int history     = 0; ///< of the material, n_history components
    unsigned int n_history   = 0;
    bool         dynamic     = false;
    /** Corners 1 ... dim of the point's simplex domain at t = 0, relative to
     * the point (m), the first being minus their sum; only if with_domains. */
    unsigned int domain       = 0;
    bool         with_domains = false;
    /** The size of cells that the point asks for (m), 0: as it is; only on
     * adaptive grids. */
    unsigned int cell_size      = 0;
    bool         with_cell_size = false;
    /** Of a part of a seeded point: how its domain came from the whole one (see
     * Ancestry), or without domains the V_0 of the whole; 0 of a whole point.
     * Only on adaptive grids. */
    unsigned int ancestry      = 0;
    bool         with_ancestry = false;
    /** Which faces of the point's domain lie on the surface of the body, a sum
     * of 1 << c for the face opposite to corner c; only if with_surface. */
    unsigned int outer_faces  = 0;
    bool         with_surface = false;
    unsigned int n_properties = 0;
    /** Whether the plane is a section of a body of revolution, see
     * AxisymmetricMaterial. */
    bool axisymmetric = false;

    /** Whether the form is u-p. */
    bool
    mixed() const
    {
      return volume_gain > 0;
    }

    /** Where the vectors begin whose sums weighted with masses are conserved.
     */
    std::vector<unsigned int>
    vectors_by_mass() const
    {
      std::vector<unsigned int> fields;
      if (dynamic)
        fields = {velocity, acceleration};
      if (with_excess)
        fields.push_back(excess);
      return fields;
    }

    PointLayout() = default;
    PointLayout(const unsigned int dim,
                const unsigned int n_history,
                const bool         dynamic,
                const bool         with_domains   = false,
                const bool         with_cell_size = false,
                const bool         with_ancestry  = false,
                const bool         with_excess    = false,
                const bool         with_surface   = false,
                const bool         mixed          = false);
  };

  /** F of a point from its @p properties. */
  template <int dim>
  Tensor<2, dim>
  deformation_gradient(const double *properties, const PointLayout &layout)
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = properties[layout.F + i * dim + j];
    return F;
  }

  /** By how much the domain of a point with @p properties would have to be
   * larger at t = 0, in each direction, to have its V_0 (UnseenVolume): F maps
   * that to the present one. */
  template <int dim>
  double
  domain_stretch(const double *properties, const PointLayout &layout)
  {
    const double gain = layout.mixed() ? properties[layout.volume_gain] : 0.;
    return gain == 0 ? 1. : std::pow(1 + gain, 1. / dim);
  }
} // namespace isochor

#endif
