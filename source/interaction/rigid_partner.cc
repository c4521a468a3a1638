/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/rigid_partner.h>

#include <algorithm>
#include <array>
#include <limits>

namespace isochor
{
  template <int dim>
  void
  RigidPartner<dim>::update(const StepContext<dim> &step,
                            const NodalField       &unknowns)
  {
    move = std::make_unique<RigidMove<dim>>(
      rigid->body.move(step.time, rigid->increments(step, unknowns)));
  }



  template <int dim>
  Tensor<1, dim>
  RigidPartner<dim>::slip(const typename Partner<dim>::SurfacePlace &place,
                          const Point<dim>                          &y) const
  {
    const Tensor<1, dim> drift =
      y - move->old_pose().place(move->pose().original(y));
    return place.slip + place.increment - drift;
  }



  template <int dim>
  Tensor<2, dim>
  RigidPartner<dim>::turned() const
  {
    return Tensor<2, dim>(unit_symmetric_tensor<dim>()) -
           move->old_pose().rotation * transpose(move->pose().rotation);
  }



  template <int dim>
  Tensor<2, dim>
  RigidPartner<dim>::slip_by_x(const ClosestPoint<dim> &closest) const
  {
    const Tensor<2, dim> one = unit_symmetric_tensor<dim>();
    return one -
           turned() * (one - outer_product(closest.normal, closest.normal) -
                       closest.distance * Tensor<2, dim>(closest.curvature));
  }



  template <int dim>
  PartnerPlace<dim>
  RigidPartner<dim>::nearest(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    const Point<dim>        x       = place.start->x + place.increment;
    const ClosestPoint<dim> closest = rigid->body.closest(x, move->pose());
    return nearest_place<dim>(closest.distance,
                              closest.normal,
                              closest.curvature,
                              slip(place, closest.point),
                              slip_by_x(closest));
  }



  template <int dim>
  PartnerPlace<dim>
  RigidPartner<dim>::original(
    const typename Partner<dim>::SurfacePlace &place) const
  {
    PartnerPlace<dim> result;
    const Point<dim> &X = place.start->X;
    result.gap_by_x     = unit_symmetric_tensor<dim>();
    result.gap =
      place.start->displacement + place.increment - (move->pose().place(X) - X);
    return result;
  }



  template <int dim>
  double
  RigidPartner<dim>::depth(
    const std::array<typename Partner<dim>::Way, dim + 1> &corners) const
  {
    // as the rigid body sees them; last their mean, which may be outside of one
    // with a hollow that has all corners on its surface
    std::array<Point<dim>, dim + 2>     from;
    std::array<Tensor<1, dim>, dim + 2> way;
    double                              longest = 0;
    for (unsigned int c = 0; c <= dim; ++c)
      {
        from[c] = move->old_pose().original(corners[c][0]);
        way[c]  = move->pose().original(corners[c][1]) - from[c];
        longest = std::max(longest, way[c].norm());
        from[dim + 1] += from[c] / (dim + 1.);
        way[dim + 1] += way[c] / (dim + 1.);
      }
    // of the farthest of them after a part s of the step, or of one that the
    // rest of it can't bring there
    const auto distance = [&](const double s) {
      double largest = std::numeric_limits<double>::lowest();
      for (unsigned int c = dim + 2; c > 0 && largest < (1 - s) * longest; --c)
        largest = std::max(
          largest,
          rigid->body.shape().closest(from[c - 1] + s * way[c - 1]).distance);
      return largest;
    };
    constexpr double shortest = 0.01;
    double           s = 0, d = distance(s);
    if (d < 0) // it may be pushed out
      d = distance(s = 1);
    while (d >= 0 && d < (1 - s) * longest)
      {
        s = std::min(1., s + std::max(d / longest, shortest));
        d = distance(s);
      }
    return std::max(0., -d);
  }



  template <int dim>
  Tensor<1, 3>
  RigidPartner<dim>::moment(const Point<dim>     &y,
                            const Tensor<1, dim> &force,
                            const bool            mean) const
  {
    Tensor<1, dim> arm = y - move->pose().reference - move->pose().displacement;
    if (mean)
      arm -= turned() * arm / 2;
    Tensor<1, 3> lever, f;
    for (unsigned int a = 0; a < dim; ++a)
      {
        lever[a] = arm[a];
        f[a]     = force[a];
      }
    return cross_product_3d(lever, f);
  }



  template <int dim>
  std::vector<unsigned int>
  RigidPartner<dim>::control_vertices(const ActiveNodes<dim> &nodes) const
  {
    if (!rigid->body.has_free_components())
      return {};
    return {nodes.control_vertex(rigid->first_control_node),
            nodes.control_vertex(rigid->first_control_node + 1)};
  }



  template <int dim>
  void
  RigidPartner<dim>::motion(
    const typename Partner<dim>::SurfacePlace &place,
    const bool                                 is_unilateral,
    std::vector<std::vector<typename InteractionKernel<dim>::PartnerMotion>>
      &motions) const
  {
    motions.clear();
    if (!rigid->body.has_free_components())
      return;
    const Point<dim>        x       = place.start->x + place.increment;
    const ClosestPoint<dim> closest = rigid->body.closest(x, move->pose());
    const Point<dim>        y =
      is_unilateral ? closest.point : move->pose().place(place.start->X);
    const auto            moves = move->motion(y);
    const auto            turns = move->normal_change(x, closest);
    const Tensor<1, dim> &n     = closest.normal;
    const Tensor<1, dim>  s     = slip(place, closest.point);
    motions.resize(2);
    for (unsigned int i = 0; i < RigidBody<dim>::n_components; ++i)
      {
        typename InteractionKernel<dim>::PartnerMotion motion;
        if (!rigid->body.is_free(i))
          {
            motions[i < dim ? 0 : 1].push_back(motion); // is no unknown
            continue;
          }
        motion.place      = moves[i] / rigid->scale(i);
        motion.place_by_y = move->motion_by_x(i) / rigid->scale(i);
        for (unsigned int j = dim; i >= dim && j < RigidBody<dim>::n_components;
             ++j)
          if (rigid->body.is_free(j))
            motion.place_by_component[j - dim] =
              move->second_motion(y, i, j) /
              (rigid->scale(i) * rigid->scale(j));
        if (is_unilateral)
          {
            // the spin of n, apart from its change with the place
            motion.normal = turns[i] / rigid->scale(i) +
                            Tensor<2, dim>(closest.curvature) * motion.place;
            // what slip_by_x() leaves of the slip's change at a fixed x
            Tensor<1, dim> with_slip =
              closest.distance * (turned() * motion.normal);
            with_slip -= (with_slip * n) * n;
            motion.gap = (closest.distance - s * n) * motion.normal -
                         (s * motion.normal) * n + with_slip;
          }
        motions[i < dim ? 0 : 1].push_back(motion);
      }
  }



  template class RigidPartner<2>;
  template class RigidPartner<3>;
} // namespace isochor
