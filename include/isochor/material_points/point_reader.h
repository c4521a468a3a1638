/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_reader_h
#define isochor_point_reader_h

#include <isochor/material_points/point_arrays.h>
#include <isochor/material_points/point_layout.h>

#include <memory>
#include <vector>

namespace isochor
{
  /** Brings points, blocks of particle properties, into PointArrays. */
  template <int dim>
  struct PointReader
  {
    const PointLayout                       &layout;
    const std::shared_ptr<const PointSlots> &slots; ///< of the present order
    /** By number of the material, in u-p: whether it dissipates; empty if none
     * does. */
    const std::vector<unsigned char> &dissipates;

    /** Make room for @p n points, without stencils. */
    void
    resize(PointArrays<dim> &arrays, const unsigned int n) const;
    /** Let the fields of @p arrays that aren't copied read the points. */
    void
    attach(PointArrays<dim> &arrays) const;
    /** Bring point @p q at @p location, with these @p properties, into @p
     * arrays. */
    void
    read(const unsigned int             q,
         const Point<dim>              &location,
         const ArrayView<const double> &properties,
         PointArrays<dim>              &arrays) const;
    /** What a step changes of it. */
    void
    read_state(const unsigned int             q,
               const Point<dim>              &location,
               const ArrayView<const double> &properties,
               PointArrays<dim>              &arrays) const;
    /** Whether read_state() does anything. */
    bool
    copies_state() const
    {
      return fields_are_copied || layout.axisymmetric || layout.n_history > 0 ||
             layout.dynamic || layout.with_domains;
    }

  private:
    void
    read_domain(const unsigned int             q,
                const Point<dim>              &location,
                const ArrayView<const double> &properties,
                PointArrays<dim>              &arrays) const;

    /** Whether PointArrays copies what each iteration reads. In 3D it would be
     * a tenth of a point's memory, and assembly is less of the time. */
    static constexpr bool fields_are_copied = (dim == 2);
  };
} // namespace isochor

#endif
