/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/rigid_partner.h>

#include <cmath>

namespace isochor
{
  template <int dim>
  void
  RigidPartner<dim>::declare_parameters(ParameterHandler &prm)
  {
    RigidShape<dim>::declare_shapes(prm);
    prm.declare_entry("Motion", "", Patterns::Anything(), "Formulas in t.");
  }



  template <int dim>
  RigidPartner<dim>::RigidPartner(ParameterHandler  &prm,
                                  const std::string &section)
    : shape(RigidShape<dim>::create(prm, section))
    , centre(shape->centre())
  {
    const std::vector<std::string> names =
      dim == 2 ? std::vector<std::string>{"x", "y", "rotation"} :
                 std::vector<std::string>{"x", "y", "z", "rx", "ry", "rz"};
    for (const std::string &item :
         split_formulas(prm.get("Motion"), section + "/Motion"))
      {
        const std::size_t equals = item.find('=');
        const auto        found  = std::find(names.begin(),
                                     names.end(),
                                     Utilities::trim(item.substr(0, equals)));
        AssertThrow(equals != std::string::npos && found != names.end(),
                    ExcMessage("bad motion"));
        motion[found - names.begin()].emplace_back(item.substr(equals + 1),
                                                   section + "/Motion");
      }
  }



  template <int dim>
  typename RigidPartner<dim>::Pose
  RigidPartner<dim>::pose(const double time) const
  {
    Pose       result;
    const auto value = [&](const unsigned int i) {
      return motion[i].empty() ? 0. : motion[i].front()(Point<dim>(), time);
    };
    for (unsigned int d = 0; d < dim; ++d)
      result.displacement[d] = value(d);
    if constexpr (dim == 2)
      {
        const double a = value(2), c = std::cos(a), s = std::sin(a);
        result.rotation = Tensor<2, 2>({{c, -s}, {s, c}});
      }
    else
      {
        const Tensor<1, 3> v({value(3), value(4), value(5)});
        const double       a = v.norm();
        const Tensor<2, 3> W(
          {{0, -v[2], v[1]}, {v[2], 0, -v[0]}, {-v[1], v[0], 0}});
        result.rotation = unit_symmetric_tensor<3>();
        if (a > 0)
          result.rotation +=
            std::sin(a) / a * W + (1 - std::cos(a)) / (a * a) * (W * W);
      }
    return result;
  }



  template <int dim>
  PartnerPlace<dim>
  RigidPartner<dim>::nearest(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    const Tensor<2, dim> &R = end.rotation, R_t = transpose(R),
                         one = unit_symmetric_tensor<dim>();
    const Point<dim> x       = place.start->x + place.increment;
    const Point<dim> X =
      centre + R_t * (x - centre - end.displacement); // in the pose of t = 0
    const ClosestPoint<dim> closest = shape->closest(X);
    // the place of the partner has moved by this in the step
    const Tensor<1, dim> drift =
      at(end, closest.point) - at(start, closest.point);
    const Tensor<2, dim> drift_by_x =
      (R - start.rotation) *
      (one - outer_product(closest.normal, closest.normal) -
       closest.distance * Tensor<2, dim>(closest.curvature)) *
      R_t;
    return nearest_place<dim>(closest.distance,
                              R * closest.normal,
                              symmetrize(R * Tensor<2, dim>(closest.curvature) *
                                         R_t),
                              place.slip + place.increment - drift,
                              one - drift_by_x);
  }



  template <int dim>
  PartnerPlace<dim>
  RigidPartner<dim>::original(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    PartnerPlace<dim> result;
    const Point<dim> &X = place.start->X;
    result.gap_by_x     = unit_symmetric_tensor<dim>();
    result.gap = place.start->displacement + place.increment - (at(end, X) - X);
    return result;
  }



  template class RigidPartner<2>;
  template class RigidPartner<3>;
} // namespace isochor
