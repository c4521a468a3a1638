/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_shape_h
#define isochor_rigid_shape_h

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** What a place x sees of the surface of a rigid body. */
  template <int dim>
  struct ClosestPoint
  {
    /** Signed distance of x (m), positive outside of the rigid body. */
    double distance = 0;
    /** The nearest place of the surface (m). */
    Point<dim> point;
    /** The gradient of the distance at x: the unit normal that points out of
     * the rigid body. */
    Tensor<1, dim> normal;
    /** The Hessian of the distance at x, ∂normal/∂x (1/m): zero if the nearest
     * place is on a flat face. */
    SymmetricTensor<2, dim> curvature;
  };

  /**
   * Interface of the shapes of rigid bodies, each in the pose of t = 0. To add
   * one, write `source/rigid_body/<name>.cc` with the class and its
   * registration; its parameters live in the subsection "Rigid body: NAME",
   * where `Shape` names it, and may be shared with others of the same name and
   * meaning.
   */
  template <int dim>
  class RigidShape
  {
  public:
    /** A segment (2D) or triangle (3D) of a surface, the rigid body on the left
     * of the segment or behind the triangle, whose corners run counterclockwise
     * if seen from outside. */
    using Facet = std::array<Point<dim>, dim>;

    virtual ~RigidShape() = default;

    /** Declare `Shape` and the parameters of all shapes in a subsection "Rigid
     * body: NAME". */
    static void
    declare_shapes(ParameterHandler &prm);
    /** The shape that `Shape` names, its parameters read from @p prm, which is
     * in the subsection @p section. @throws ExcMessage for parameters that
     * describe no shape. */
    static std::unique_ptr<RigidShape<dim>>
    create(ParameterHandler &prm, const std::string &section);

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** The parameters of the subsection that matter for this shape. */
    const std::set<std::string> &
    parameters_in_use() const
    {
      return declared;
    }

    /** What @p x sees of the surface. The distance is that to the nearest place
     * of the surface; where there are several, any of them. */
    virtual ClosestPoint<dim>
    closest(const Point<dim> &x) const = 0;

    /** The surface for pictures. Round parts are divided into facets of a few
     * degrees; what has no end is cut off at about @p reach (m) from
     * centre(). */
    virtual std::vector<Facet>
    surface(const double reach) const = 0;

    /** A box that holds the rigid body; from -∞ to ∞ in all directions if it
     * has no end. */
    virtual BoundingBox<dim>
    box() const = 0;

    /** The point that the rigid body rotates about if no other is given. By
     * default the centre of its box. */
    virtual Point<dim>
    centre() const
    {
      return box().center();
    }

  protected:
    /** The path of one of its parameters, for messages. */
    std::string
    parameter(const std::string &entry) const
    {
      return section + "/" + entry;
    }
    /** @throws ExcMessage "The parameter <path> ..." unless @p ok. */
    void
    check(const bool         ok,
          const std::string &entry,
          const std::string &requirement) const;

    /** Declare a place or a direction, by default (0, 0(, 0)) or the y axis. */
    static void
    declare_place(ParameterHandler  &prm,
                  const std::string &entry,
                  const std::string &documentation);
    static void
    declare_direction(ParameterHandler  &prm,
                      const std::string &entry,
                      const std::string &documentation);
    /** Declare a length in m. */
    static void
    declare_length(ParameterHandler  &prm,
                   const std::string &entry,
                   const std::string &documentation);
    /** What several shapes have. */
    static void
    declare_corners(ParameterHandler &prm);
    static void
    declare_edge_radius(ParameterHandler &prm);
    static void
    declare_radius(ParameterHandler &prm);
    static void
    declare_axis(ParameterHandler &prm);

    Point<dim>
    get_place(const ParameterHandler &prm, const std::string &entry) const;
    /** Of length 1. */
    Tensor<1, dim>
    get_direction(const ParameterHandler &prm, const std::string &entry) const;
    /** Larger than zero. */
    double
    get_positive(const ParameterHandler &prm, const std::string &entry) const;

    /** The box of what has no end. */
    static BoundingBox<dim>
    unbounded();

  private:
    std::string           section;
    std::set<std::string> declared;
  };

  /** The Hessian of the distance from an edge or a corner, whose normals are
   * those of the places around it: the projection on what is across @p normal
   * and @p edge (a unit vector, or 0 at a corner), divided by the
   * @p distance. */
  template <int dim>
  SymmetricTensor<2, dim>
  rounded_curvature(const double          distance,
                    const Tensor<1, dim> &normal,
                    const Tensor<1, dim> &edge = Tensor<1, dim>());

  /** The @p place nearest to @p x is a corner or on an @p edge: set normal and
   * curvature, unless x is there, too. */
  template <int dim>
  void
  round_corner(const Point<dim>     &x,
               const Tensor<1, dim> &edge,
               ClosestPoint<dim>    &place);
} // namespace isochor

#endif
