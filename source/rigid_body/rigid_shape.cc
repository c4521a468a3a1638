/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/base/rounding.h>
#include <isochor/grid/lattice_source.h>
#include <isochor/rigid_body/rigid_shape.h>

#include <limits>

namespace isochor
{
  template <int dim>
  void
  RigidShape<dim>::declare_shapes(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Shape",
      "half plane",
      Patterns::Selection(PluginRegistry<RigidShape<dim>>::names()),
      "The shape of the rigid body at t = 0. half plane: all that is behind a "
      "plane. circle: a circle or, in 3D, a sphere. box: along the axes. "
      "wedge, polygon: in 2D. cone, cylinder: around an axis; in 2D their "
      "section in the plane of the axis, for an axisymmetric geometry with "
      "the axis x = 0. mesh: a surface from a file. formula: where a formula "
      "is negative.");
    PluginRegistry<RigidShape<dim>>::declare_parameters(prm);
  }



  template <int dim>
  std::unique_ptr<RigidShape<dim>>
  RigidShape<dim>::create(ParameterHandler &prm, const std::string &section)
  {
    const std::string name  = prm.get("Shape");
    auto              shape = PluginRegistry<RigidShape<dim>>::create(name);
    shape->section          = section;
    shape->declared         = PluginRegistry<RigidShape<dim>>::parameters(name);
    shape->parse_parameters(prm);
    return shape;
  }



  template <int dim>
  void
  RigidShape<dim>::check(const bool         ok,
                         const std::string &entry,
                         const std::string &requirement) const
  {
    AssertThrow(ok,
                ExcMessage("The parameter <" + parameter(entry) + "> " +
                           requirement));
  }



  template <int dim>
  void
  RigidShape<dim>::declare_place(ParameterHandler  &prm,
                                 const std::string &entry,
                                 const std::string &documentation)
  {
    prm.declare_entry(entry,
                      dim == 2 ? "0, 0" : "0, 0, 0",
                      Patterns::List(Patterns::Double(), dim, dim),
                      documentation);
  }



  template <int dim>
  void
  RigidShape<dim>::declare_direction(ParameterHandler  &prm,
                                     const std::string &entry,
                                     const std::string &documentation)
  {
    prm.declare_entry(entry,
                      dim == 2 ? "0, 1" : "0, 1, 0",
                      Patterns::List(Patterns::Double(), dim, dim),
                      documentation);
  }



  template <int dim>
  void
  RigidShape<dim>::declare_length(ParameterHandler  &prm,
                                  const std::string &entry,
                                  const std::string &documentation)
  {
    prm.declare_entry(entry, "0", Patterns::Double(0), documentation);
  }



  template <int dim>
  void
  RigidShape<dim>::declare_corners(ParameterHandler &prm)
  {
    declare_place(prm,
                  "Lower corner",
                  "The corner with the least coordinates (m) of a box, or of "
                  "the region that holds the surface of a formula.");
    declare_place(prm,
                  "Upper corner",
                  "The corner with the largest coordinates (m).");
  }



  template <int dim>
  void
  RigidShape<dim>::declare_edge_radius(ParameterHandler &prm)
  {
    declare_length(prm,
                   "Edge radius",
                   "The radius (m) with which the convex edges of a box, "
                   "cylinder or polygon are rounded; flat faces stay where "
                   "they are. 0: sharp edges.");
  }



  template <int dim>
  void
  RigidShape<dim>::declare_radius(ParameterHandler &prm)
  {
    declare_length(prm, "Radius", "The radius (m) of a circle or cylinder.");
  }



  template <int dim>
  void
  RigidShape<dim>::declare_axis(ParameterHandler &prm)
  {
    declare_place(prm,
                  "Apex",
                  "Where the flanks of a wedge or cone meet (m). A rounded tip "
                  "lies behind it.");
    prm.declare_entry("Apex angle",
                      "60",
                      Patterns::Double(0, 180),
                      "The angle between the flanks of a wedge or cone "
                      "(degrees).");
    declare_direction(prm,
                      "Direction",
                      "The direction of the axis of a wedge or cone, from the "
                      "apex into the rigid body. Of any length.");
    declare_length(prm,
                   "Tip radius",
                   "The radius (m) with which the tip of a wedge or cone is "
                   "rounded. 0: a sharp tip.");
    declare_length(prm,
                   "Length",
                   "The length (m) of a wedge or cone along its axis from the "
                   "apex; of a cone with its shaft.");
  }



  template <int dim>
  Point<dim>
  RigidShape<dim>::get_place(const ParameterHandler &prm,
                             const std::string      &entry) const
  {
    return parse_point<dim>(prm.get(entry), parameter(entry));
  }



  template <int dim>
  Tensor<1, dim>
  RigidShape<dim>::get_direction(const ParameterHandler &prm,
                                 const std::string      &entry) const
  {
    const Tensor<1, dim> direction = get_place(prm, entry);
    check(direction.norm() > 0, entry, "must not be zero.");
    return direction / direction.norm();
  }



  template <int dim>
  double
  RigidShape<dim>::get_positive(const ParameterHandler &prm,
                                const std::string      &entry) const
  {
    const double value = prm.get_double(entry);
    check(value > 0, entry, "must be positive.");
    return value;
  }



  template <int dim>
  BoundingBox<dim>
  RigidShape<dim>::unbounded()
  {
    Point<dim> upper;
    for (unsigned int d = 0; d < dim; ++d)
      upper[d] = std::numeric_limits<double>::infinity();
    return BoundingBox<dim>({-upper, upper});
  }



  template <int dim>
  SymmetricTensor<2, dim>
  rounded_curvature(const double          distance,
                    const Tensor<1, dim> &normal,
                    const Tensor<1, dim> &edge)
  {
    Assert(distance != 0, ExcDivideByZero());
    SymmetricTensor<2, dim> curvature;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        curvature[i][j] =
          ((i == j ? 1. : 0.) - normal[i] * normal[j] - edge[i] * edge[j]) /
          distance;
    return curvature;
  }



  template <int dim>
  void
  round_corner(const Point<dim>     &x,
               const Tensor<1, dim> &edge,
               ClosestPoint<dim>    &place)
  {
    // a direction that isn't that of rounding
    const Tensor<1, dim> arm = x - place.point;
    if (arm.norm() <= rounding::arithmetic * (x.norm() + place.point.norm()))
      return;
    place.normal    = arm / place.distance;
    place.curvature = rounded_curvature(place.distance, place.normal, edge);
  }



  template class RigidShape<2>;
  template class RigidShape<3>;
  template SymmetricTensor<2, 2>
  rounded_curvature<2>(const double,
                       const Tensor<1, 2> &,
                       const Tensor<1, 2> &);
  template SymmetricTensor<2, 3>
  rounded_curvature<3>(const double,
                       const Tensor<1, 3> &,
                       const Tensor<1, 3> &);
  template void
  round_corner(const Point<2> &, const Tensor<1, 2> &, ClosestPoint<2> &);
  template void
  round_corner(const Point<3> &, const Tensor<1, 3> &, ClosestPoint<3> &);
} // namespace isochor
