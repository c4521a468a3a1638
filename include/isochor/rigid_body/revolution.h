/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_revolution_h
#define isochor_revolution_h

#include <isochor/rigid_body/outline.h>

#include <vector>

namespace isochor
{
  /**
   * A solid around an axis: in 3D of revolution, in 2D its section through the
   * axis, which is also a body of an axisymmetric geometry. The outline is
   * closed and symmetric in the coordinates (r, z), r the distance from the
   * axis and z that along the axis from #origin.
   */
  template <int dim>
  struct Revolution
  {
    Point<dim>     origin;
    Tensor<1, dim> axis; ///< of length 1
    Outline        outline;

    ClosestPoint<dim>
    closest(const Point<dim> &x) const;
    /** For pictures. */
    std::vector<typename RigidShape<dim>::Facet>
    surface() const;
    /** A box around the cylinder that holds it. */
    BoundingBox<dim>
    box() const;

  private:
    /** Any unit vector across the axis; in 2D that with which the axis is a
     * right-handed system. */
    Tensor<1, dim>
    across() const;
  };

  /** A shape that is such a solid. */
  template <int dim>
  class ShapeOfRevolution : public RigidShape<dim>
  {
  public:
    ClosestPoint<dim>
    closest(const Point<dim> &x) const override
    {
      return solid.closest(x);
    }

    std::vector<typename RigidShape<dim>::Facet>
    surface(const double /*reach*/) const override
    {
      return solid.surface();
    }

    BoundingBox<dim>
    box() const override
    {
      return solid.box();
    }

  protected:
    Revolution<dim> solid;
  };
} // namespace isochor

#endif
