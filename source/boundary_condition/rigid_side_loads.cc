/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Loads on a rigid side, what it tells in the statistics, and its state.

#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/rigid_side.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>

namespace isochor
{
  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::moment_at(const double time) const
  {
    Vector3 M;
    for (unsigned int r = 0; r < n_rotations; ++r)
      M[axis(r)] = at(moment[r], time);
    return M;
  }



  template <int dim>
  void
  RigidSide<dim>::add_force(const StepContext<dim> &step,
                            NodalField             &load) const
  {
    const unsigned int turned = rotation_node(step);
    if (turned >= step.nodes.n_owned())
      return;
    const unsigned int shifted =
      step.nodes.node(step.nodes.control_vertex(first_control));
    for (unsigned int a = 0; a < dim; ++a)
      load.local_element(shifted * step.n_components + a) +=
        at(force[a], step.time);
    if (dim == 2)
      load.local_element(turned * step.n_components) +=
        at(moment[0], step.time) / radius;
  }



  template <int dim>
  void
  RigidSide<dim>::add_moment_force(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   NodalField             &load) const
  {
    const unsigned int turned = rotation_node(step);
    if (dim == 2 || turned >= step.nodes.n_owned())
      return;
    const Vector3 Q = FiniteRotation(rotation_of(step, unknowns))
                        .pull_back(moment_at(step.time));
    for (unsigned int r = 0; r < n_rotations; ++r)
      load.local_element(turned * step.n_components + r) += Q[r] / radius;
  }



  template <int dim>
  void
  RigidSide<dim>::add_moment(const StepContext<dim> &step,
                             const NodalField       &unknowns,
                             const NodalField       &pending,
                             const unsigned int      element,
                             const bool              with_matrix,
                             MixedSystem<dim>       &system) const
  {
    if (dim == 2 || rotation_node(step) >= step.nodes.n_owned())
      return;
    const Vector3 M = moment_at(step.time);
    if (M.norm() == 0)
      return;
    const unsigned int                        nc = step.n_components;
    const FiniteRotation                      now(rotation_of(step, unknowns));
    std::array<double, dim + 1>               residual{};
    std::array<double, (dim + 1) * (dim + 1)> matrix{};
    const Vector3                             Q = now.pull_back(M);
    for (unsigned int i = 0; i < n_rotations; ++i)
      {
        residual[i] = -Q[i] / radius;
        for (unsigned int j = 0; j < n_rotations; ++j)
          matrix[i * nc + j] =
            -now.pull_back_derivative(j, M)[i] / (radius * radius);
      }
    system.add_element(element,
                       residual.data(),
                       with_matrix ? matrix.data() : nullptr,
                       pending);
  }



  template <int dim>
  void
  RigidSide<dim>::add_to_resultant(const StepContext<dim> &step,
                                   const NodalField       &unknowns,
                                   const NodalConstraints &constraints,
                                   const unsigned int      k,
                                   const double            multiplier,
                                   std::array<double, 6>  &sum) const
  {
    const unsigned int label = constraints.equations[k].label;
    Vector3            F;
    F[component(label)] = multiplier;
    const Vector3 M     = cross_product_3d(
      FiniteRotation(rotation_of(step, unknowns)).rotate(arm(step, label)), F);
    for (unsigned int d = 0; d < 3; ++d)
      {
        sum[d] += F[d];
        sum[3 + d] += M[d];
      }
  }



  template <int dim>
  bool
  RigidSide<dim>::rotation_is_pinned(const StepContext<dim> &step,
                                     const NodalConstraints &constraints) const
  {
    const unsigned int turned = rotation_node(step);
    if (turned == numbers::invalid_unsigned_int)
      return false;
    bool pinned = false;
    for (unsigned int r = 0; r < n_rotations; ++r)
      {
        if (rotation[r])
          return false;
        pinned =
          pinned || constraints.constrained[turned * step.n_components + r] ==
                      NodalConstraints::follows;
      }
    return pinned;
  }



  template <int dim>
  void
  RigidSide<dim>::take_given_moment(const StepContext<dim> &step,
                                    std::array<double, 6>  &resultant) const
  {
    const Vector3 M = moment_at(step.time);
    for (unsigned int d = 0; d < 3; ++d)
      resultant[3 + d] = M[d];
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::total_after(const Vector3      &step,
                              const Tensor<2, 3> &R_after) const
  {
    const Vector3 guess = total + step;
    if (dim == 2)
      return guess;
    // the vector of a rotation is known but for full turns about its axis
    const Vector3 principal = FiniteRotation::vector_of(R_after);
    const double  angle     = principal.norm();
    if (guess.norm() == 0)
      return principal;
    const Vector3 about =
      angle > 1e-8 ? principal / angle : guess / guess.norm();
    const double turns =
      std::round((guess * about - angle) / (2 * numbers::PI));
    return (angle + 2 * numbers::PI * turns) * about;
  }



  template <int dim>
  void
  RigidSide<dim>::set_statistics(const StepContext<dim>      &step,
                                 const NodalField            &unknowns,
                                 const std::array<double, 6> &resultant,
                                 Statistics                  &statistics) const
  {
    // known where the side's control nodes are
    std::array<double, 6> motion{};
    if (rotation_node(step) < step.nodes.n_owned())
      {
        const Vector3 theta = rotation_of(step, unknowns),
                      u     = moved + translation_of(step, unknowns),
                      turn =
                        total_after(theta, FiniteRotation(theta).matrix() * R);
        for (unsigned int d = 0; d < 3; ++d)
          {
            motion[d]     = u[d];
            motion[3 + d] = turn[d];
          }
      }
    sum_over_ranks(motion, step.grid.communicator());
    const auto set = [&](const std::string &quantity,
                         const unsigned int d,
                         const std::string &unit,
                         const double       value) {
      const std::string axis_name =
        d == 2 && dim == 2 ? "" : std::string(" ") + "xyz"[d];
      statistics.set(quantity + axis_name + " of rigid side " + boundary +
                       " (" + unit + ")",
                     value);
    };
    for (unsigned int a = 0; a < dim; ++a)
      set("Force", a, "N", resultant[a]);
    for (unsigned int r = 0; r < n_rotations; ++r)
      set("Moment", axis(r), "N m", resultant[3 + axis(r)]);
    for (unsigned int a = 0; a < dim; ++a)
      set("Translation", a, "m", motion[a]);
    for (unsigned int r = 0; r < n_rotations; ++r)
      set("Rotation", axis(r), "rad", motion[3 + axis(r)]);
  }



  template <int dim>
  void
  RigidSide<dim>::save(std::ostream &state) const
  {
    for (const Vector3 &v : {centre, moved, total, reset_centre})
      state << v << ' ';
    for (const Tensor<2, 3> &rotation : {R, reset_R})
      state << rotation << ' ';
    for (const Vector3 &v : offsets)
      state << v << ' ';
  }



  template <int dim>
  void
  RigidSide<dim>::load(std::istream &state)
  {
    for (Vector3 *v : {&centre, &moved, &total, &reset_centre})
      for (unsigned int d = 0; d < 3; ++d)
        state >> (*v)[d];
    for (Tensor<2, 3> *rotation : {&R, &reset_R})
      for (unsigned int d = 0; d < 9; ++d)
        state >> (*rotation)[d / 3][d % 3];
    for (Vector3 &v : offsets)
      for (unsigned int d = 0; d < 3; ++d)
        state >> v[d];
  }



  template Tensor<1, 3>
  RigidSide<2>::moment_at(const double) const;
  template void
  RigidSide<2>::add_force(const StepContext<2> &, NodalField &) const;
  template void
  RigidSide<2>::add_moment_force(const StepContext<2> &,
                                 const NodalField &,
                                 NodalField &) const;
  template void
  RigidSide<2>::add_moment(const StepContext<2> &,
                           const NodalField &,
                           const NodalField &,
                           const unsigned int,
                           const bool,
                           MixedSystem<2> &) const;
  template void
  RigidSide<2>::add_to_resultant(const StepContext<2> &,
                                 const NodalField &,
                                 const NodalConstraints &,
                                 const unsigned int,
                                 const double,
                                 std::array<double, 6> &) const;
  template bool
  RigidSide<2>::rotation_is_pinned(const StepContext<2> &,
                                   const NodalConstraints &) const;
  template void
  RigidSide<2>::take_given_moment(const StepContext<2> &,
                                  std::array<double, 6> &) const;
  template Tensor<1, 3>
  RigidSide<2>::total_after(const Tensor<1, 3> &, const Tensor<2, 3> &) const;
  template void
  RigidSide<2>::set_statistics(const StepContext<2> &,
                               const NodalField &,
                               const std::array<double, 6> &,
                               Statistics &) const;
  template void
  RigidSide<2>::save(std::ostream &) const;
  template void
  RigidSide<2>::load(std::istream &);

  template Tensor<1, 3>
  RigidSide<3>::moment_at(const double) const;
  template void
  RigidSide<3>::add_force(const StepContext<3> &, NodalField &) const;
  template void
  RigidSide<3>::add_moment_force(const StepContext<3> &,
                                 const NodalField &,
                                 NodalField &) const;
  template void
  RigidSide<3>::add_moment(const StepContext<3> &,
                           const NodalField &,
                           const NodalField &,
                           const unsigned int,
                           const bool,
                           MixedSystem<3> &) const;
  template void
  RigidSide<3>::add_to_resultant(const StepContext<3> &,
                                 const NodalField &,
                                 const NodalConstraints &,
                                 const unsigned int,
                                 const double,
                                 std::array<double, 6> &) const;
  template bool
  RigidSide<3>::rotation_is_pinned(const StepContext<3> &,
                                   const NodalConstraints &) const;
  template void
  RigidSide<3>::take_given_moment(const StepContext<3> &,
                                  std::array<double, 6> &) const;
  template Tensor<1, 3>
  RigidSide<3>::total_after(const Tensor<1, 3> &, const Tensor<2, 3> &) const;
  template void
  RigidSide<3>::set_statistics(const StepContext<3> &,
                               const NodalField &,
                               const std::array<double, 6> &,
                               Statistics &) const;
  template void
  RigidSide<3>::save(std::ostream &) const;
  template void
  RigidSide<3>::load(std::istream &);
} // namespace isochor
