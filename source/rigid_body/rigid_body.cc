/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/grid/lattice_source.h>
#include <isochor/rigid_body/rigid_body.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The rotation by a vector, in 2D about the third axis. */
    template <int dim>
    Tensor<2, dim>
    rotation_by(const Tensor<1, 3> &vector)
    {
      const Tensor<2, 3> R = FiniteRotation(vector).matrix();
      Tensor<2, dim>     result;
      for (unsigned int i = 0; i < dim; ++i)
        for (unsigned int j = 0; j < dim; ++j)
          result[i][j] = R[i][j];
      return result;
    }
  } // namespace



  template <int dim>
  RigidBody<dim>::RigidBody(const std::string &section)
    : section(section)
    , own_name(section.substr(
        section.find(": ") == std::string::npos ? 0 : section.find(": ") + 2))
  {}



  template <int dim>
  void
  RigidBody<dim>::declare_parameters(ParameterHandler &prm)
  {
    RigidShape<dim>::declare_shapes(prm);
    prm.declare_entry("Reference point",
                      "",
                      Patterns::List(Patterns::Double(), 0, dim),
                      "The point (m) that moves by x and y (and z), that "
                      "rotations and moments are about, and that is the centre "
                      "of mass. Empty: the centre of the shape.");
    RigidMotion<dim>::declare_parameters(prm);
    RigidInertia<dim>::declare_parameters(prm);
  }



  template <int dim>
  void
  RigidBody<dim>::parse_parameters(ParameterHandler &prm)
  {
    own_shape        = RigidShape<dim>::create(prm, section);
    pose_n.reference = prm.get("Reference point").empty() ?
                         own_shape->centre() :
                         parse_point<dim>(prm.get("Reference point"),
                                          section + "/Reference point");
    motion.parse_parameters(prm, section);
    inertia.parse_parameters(prm, section, motion);
    const Components start = motion.prescribed(0);
    pose_n.displacement    = RigidComponents<dim>::translation(start);
    total                  = RigidComponents<dim>::rotation(start);
    pose_n.rotation        = rotation_by<dim>(total);
    inertia.start(motion.loads(0), rotation_in_space(), motion);
  }



  template <int dim>
  std::set<std::string>
  RigidBody<dim>::parameters_in_use() const
  {
    std::set<std::string> names = own_shape->parameters_in_use();
    names.insert({"Shape", "Reference point", "Motion", "Free"});
    if (motion.has_free_components())
      names.insert(
        {"Force", "Moment", "Mass", "Moment of inertia", "Initial velocity"});
    return names;
  }



  template <int dim>
  Tensor<2, 3>
  RigidBody<dim>::rotation_in_space() const
  {
    Tensor<2, 3> R = unit_symmetric_tensor<3>();
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        R[i][j] = pose_n.rotation[i][j];
    return R;
  }



  template <int dim>
  typename RigidBody<dim>::Components
  RigidBody<dim>::complete(const double      time,
                           const Components &increments) const
  {
    const Components now = motion.at_end(time),
                     old = motion.prescribed(old_time);
    Components result;
    for (unsigned int c = 0; c < n_components; ++c)
      if (motion.is_free(c))
        result[c] = increments[c];
      else if (c < dim)
        result[c] = now[c] - pose_n.displacement[c];
      else
        result[c] = now[c] - old[c];
    if (dim == 3 && !motion.has_free_rotations())
      {
        // the turn from the old to the new rotation
        const Tensor<1, 3> turn = FiniteRotation::vector_of(
          FiniteRotation(RigidComponents<dim>::rotation(now)).matrix() *
          transpose(rotation_in_space()));
        for (unsigned int r = 0; r < n_rotations; ++r)
          result[dim + r] = turn[r];
      }
    return result;
  }



  template <int dim>
  ClosestPoint<dim>
  RigidBody<dim>::closest(const Point<dim> &x, const RigidPose<dim> &pose) const
  {
    ClosestPoint<dim>     result = own_shape->closest(pose.original(x));
    const Tensor<2, dim> &R      = pose.rotation;
    result.point                 = pose.place(result.point);
    result.normal                = R * result.normal;
    result.curvature =
      symmetrize(R * Tensor<2, dim>(result.curvature) * transpose(R));
    return result;
  }



  template <int dim>
  void
  RigidBody<dim>::equations(const double       time,
                            const RigidScheme &scheme,
                            const Components  &increments,
                            Components        &residual,
                            Matrix            &matrix) const
  {
    inertia.equations(scheme,
                      complete(time, increments),
                      motion.loads(time),
                      rotation_in_space(),
                      motion,
                      residual,
                      matrix);
  }



  template <int dim>
  Tensor<1, 3>
  RigidBody<dim>::total_after(const double      time,
                              const Components &increments) const
  {
    const Tensor<1, 3> theta = RigidComponents<dim>::rotation(increments);
    if (!motion.has_free_rotations())
      return RigidComponents<dim>::rotation(motion.prescribed(time));
    if (dim == 2)
      return total + theta;
    // of the rotation vectors of the same rotation that nearest to the last
    const Tensor<1, 3> v = FiniteRotation::vector_of(
      FiniteRotation(theta).matrix() * rotation_in_space());
    const double angle = v.norm();
    if (angle == 0)
      return v;
    const Tensor<1, 3> n = v / angle;
    const double turns   = std::round((total * n - angle) / (2 * numbers::PI));
    return (angle + 2 * numbers::PI * turns) * n;
  }



  template <int dim>
  void
  RigidBody<dim>::advance(const double       time,
                          const RigidScheme &scheme,
                          const Components  &increments)
  {
    const Components all = complete(time, increments);
    inertia.advance(scheme, all, rotation_in_space());
    total = total_after(time, all);
    pose_n.displacement += RigidComponents<dim>::translation(all);
    pose_n.rotation = rotation_by<dim>(total);
    old_time        = time;
  }



  template <int dim>
  void
  RigidBody<dim>::set_statistics(const double      time,
                                 const Components &increments,
                                 Statistics       &statistics) const
  {
    const Components     all = complete(time, increments);
    const Tensor<1, dim> u =
      pose_n.displacement + RigidComponents<dim>::translation(all);
    const Tensor<1, 3> turn = total_after(time, all);
    for (unsigned int d = 0; d < dim; ++d)
      statistics.set(std::string("Translation ") + "xyz"[d] +
                       " of rigid body " + own_name + " (m)",
                     u[d]);
    for (unsigned int r = 0; r < n_rotations; ++r)
      statistics.set("Rotation" +
                       (dim == 2 ? "" : std::string(" ") + "xyz"[r]) +
                       " of rigid body " + own_name + " (rad)",
                     turn[RigidComponents<dim>::axis(r)]);
  }



  template <int dim>
  std::string
  RigidBody<dim>::save_state() const
  {
    std::ostringstream state;
    state.precision(std::numeric_limits<double>::max_digits10);
    state << old_time << ' ' << pose_n.displacement << ' ' << pose_n.rotation
          << ' ' << total << ' ';
    inertia.save(state);
    return state.str();
  }



  template <int dim>
  void
  RigidBody<dim>::load_state(const std::string &text)
  {
    std::istringstream state(text);
    state >> old_time;
    for (unsigned int d = 0; d < dim; ++d)
      state >> pose_n.displacement[d];
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        state >> pose_n.rotation[i][j];
    for (unsigned int i = 0; i < 3; ++i)
      state >> total[i];
    inertia.load(state);
    AssertThrow(state,
                ExcMessage("The state of <" + section +
                           "> in the checkpoint is incomplete."));
  }



  template <int dim>
  std::vector<typename RigidShape<dim>::Facet>
  RigidBody<dim>::surface(const RigidPose<dim> &pose, const double reach) const
  {
    auto facets = own_shape->surface(reach);
    for (auto &facet : facets)
      for (Point<dim> &corner : facet)
        corner = pose.place(corner);
    return facets;
  }



  template class RigidBody<2>;
  template class RigidBody<3>;
} // namespace isochor
