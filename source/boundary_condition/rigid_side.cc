/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition/rigid_side.h>
#include <isochor/grid/prescribed_motion.h>

#include <algorithm>
#include <cmath>
#include <istream>
#include <ostream>
#include <set>

namespace isochor
{
  namespace
  {
    constexpr unsigned int invalid = numbers::invalid_unsigned_int;

    template <int dim>
    Tensor<1, 3>
    in_space(const Point<dim> &x)
    {
      Tensor<1, 3> v;
      for (unsigned int d = 0; d < dim; ++d)
        v[d] = x[d];
      return v;
    }
  } // namespace



  template <int dim>
  void
  RigidSide<dim>::initialize(const BackgroundGrid<dim> &grid)
  {
    find_vertices(grid);
    const SimplexGeometry<dim> &geometry = grid.geometry();
    const types::boundary_id    id = grid.boundary_id(boundary, parameter);
    Vector3                     moment_of_area;
    double                      area = 0;
    for (const BoundaryFace &face : grid.boundary_faces())
      if (face.id == id)
        {
          const double a =
            geometry.measure(face.cell) *
            geometry.gradients(face.cell)[face.opposite_vertex].norm();
          area += a;
          for (unsigned int v = 0; v <= dim; ++v)
            if (v != face.opposite_vertex)
              moment_of_area +=
                a / dim *
                in_space(
                  geometry.vertices()[geometry.vertex_indices(face.cell)[v]]);
        }
    if (!has_centre)
      centre = moment_of_area / area;
    radius = 0;
    for (const unsigned int v : side_vertices)
      radius =
        std::max(radius, (in_space(geometry.vertices()[v]) - centre).norm());
    reset_centre = centre;
  }



  template <int dim>
  void
  RigidSide<dim>::find_vertices(const BackgroundGrid<dim> &grid)
  {
    const types::boundary_id id = grid.boundary_id(boundary, parameter);
    std::set<unsigned int>   found;
    for (const BoundaryFace &face : grid.boundary_faces())
      for (unsigned int v = 0; v <= dim && face.id == id; ++v)
        if (v != face.opposite_vertex)
          found.insert(grid.geometry().vertex_indices(face.cell)[v]);
    side_vertices.assign(found.begin(), found.end());
    offsets.assign(side_vertices.size(), Vector3());
  }



  template <int dim>
  std::array<ControlNode<dim>, 2>
  RigidSide<dim>::control_nodes() const
  {
    std::array<ControlNode<dim>, 2> nodes;
    for (auto &node : nodes)
      for (unsigned int d = 0; d < dim; ++d)
        node.position[d] = centre[d];
    nodes[1].rotation_arm = radius;
    return nodes;
  }



  template <int dim>
  unsigned int
  RigidSide<dim>::rotation_node(const StepContext<dim> &step) const
  {
    return step.nodes.node(step.nodes.control_vertex(first_control + 1));
  }



  template <int dim>
  bool
  RigidSide<dim>::is_symmetric() const
  {
    unsigned int n_free = 0, n_moments = 0;
    for (unsigned int r = 0; r < n_rotations; ++r)
      {
        n_free += !rotation[r];
        n_moments += bool(moment[r]);
      }
    return n_moments == 0 || n_free < 2;
  }



  template <int dim>
  double
  RigidSide<dim>::at(const Formula &formula, const double time) const
  {
    return formula ? (*formula)(Point<dim>(), time) : 0.;
  }



  template <int dim>
  double
  RigidSide<dim>::increment(const Formula          &formula,
                            const StepContext<dim> &step) const
  {
    return formula ? prescribed_increment(*formula,
                                          Point<dim>(),
                                          step.old_time,
                                          step.time) :
                     0.;
  }



  template <int dim>
  bool
  RigidSide<dim>::rotation_is_prescribed() const
  {
    return std::all_of(rotation.begin(), rotation.end(), [](const auto &f) {
      return f != nullptr;
    });
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::prescribed_rotation(const StepContext<dim> &step) const
  {
    Vector3 theta;
    if (dim == 3 && rotation_is_prescribed())
      {
        // the turn from the old to the new rotation
        const auto R_at = [&](const double time) {
          Vector3 vector;
          for (unsigned int r = 0; r < n_rotations; ++r)
            vector[r] = at(rotation[r], time);
          return FiniteRotation(vector).matrix();
        };
        if (step.old_time > 0)
          return FiniteRotation::vector_of(R_at(step.time) *
                                           transpose(R_at(step.old_time)));
        return FiniteRotation::vector_of(R_at(step.time));
      }
    for (unsigned int r = 0; r < n_rotations; ++r)
      theta[axis(r)] = increment(rotation[r], step);
    return theta;
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::rotation_of(const StepContext<dim> &step,
                              const NodalField       &unknowns) const
  {
    Vector3            theta;
    const unsigned int node = rotation_node(step);
    const unsigned int n    = unknowns.size() / step.nodes.n_global();
    for (unsigned int r = 0; node != invalid && r < n_rotations; ++r)
      theta[axis(r)] = unknowns.local_element(node * n + r) / radius;
    return theta;
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::translation_of(const StepContext<dim> &step,
                                 const NodalField       &unknowns) const
  {
    Vector3            u;
    const unsigned int node =
      step.nodes.node(step.nodes.control_vertex(first_control));
    for (unsigned int a = 0; node != invalid && a < dim; ++a)
      u[a] = unknowns.local_element(node * step.n_components + a);
    return u;
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::arm(const StepContext<dim> &step,
                      const unsigned int      label) const
  {
    const unsigned int vertex = side_vertices[(label - label_of_first) / dim];
    const Vector3      x = in_space(step.grid.geometry().vertices()[vertex]);
    return step.grid_is_kept ? R * (transpose(reset_R) * (x - reset_centre)) :
                               x - centre;
  }



  template <int dim>
  typename RigidSide<dim>::Vector3
  RigidSide<dim>::offset(const StepContext<dim> &step,
                         const unsigned int      label) const
  {
    return step.grid_is_kept ? offsets[(label - label_of_first) / dim] :
                               Vector3();
  }



  template <int dim>
  void
  RigidSide<dim>::constrain(const StepContext<dim> &step,
                            const void             *owner,
                            unsigned int           &label,
                            NodalConstraints       &constraints) const
  {
    const unsigned int nc = step.n_components;
    label_of_first        = label;
    label += side_vertices.size() * dim;
    const unsigned int turned  = rotation_node(step),
                       shifted = turned == invalid ?
                                   invalid :
                                   step.nodes.node(
                                     step.nodes.control_vertex(first_control));
    if (turned == invalid)
      return;

    const Vector3 theta = prescribed_rotation(step);
    for (unsigned int a = 0; a < dim; ++a)
      {
        if (translation[a])
          constraints.constrain(shifted * nc + a,
                                increment(translation[a], step));
        if (a >= n_rotations)
          constraints.constrain(turned * nc + a, 0.);
        else if (rotation[a % n_rotations])
          constraints.constrain(turned * nc + a, radius * theta[axis(a)]);
      }
    if (step.mixed())
      for (const unsigned int node : {shifted, turned})
        constraints.constrain(node * nc + dim, 0.);

    const FiniteRotation                         goal(theta);
    std::vector<std::pair<unsigned int, double>> terms;
    for (unsigned int i = 0; i < side_vertices.size(); ++i)
      {
        const unsigned int node = step.nodes.node(side_vertices[i]);
        if (node == invalid)
          continue;
        const Vector3 r = arm(step, label_of_first + i * dim);
        const Vector3 u =
          goal.rotate(r) - r - offset(step, label_of_first + i * dim);
        for (unsigned int a = 0; a < dim; ++a)
          {
            terms        = {{node * nc + a, 1.}, {shifted * nc + a, -1.}};
            double value = u[a];
            for (unsigned int k = 0; k < n_rotations; ++k)
              {
                Vector3 e;
                e[axis(k)]     = 1;
                const double d = cross_product_3d(e, r)[a];
                terms.emplace_back(turned * nc + k, -d / radius);
                value -= d * theta[axis(k)];
              }
            auto &equation =
              constraints.add(Precedence::rigid_side, terms, value);
            equation.changes   = true;
            equation.owner     = owner;
            equation.label     = label_of_first + i * dim + a;
            equation.n_vector  = dim;
            equation.component = a;
          }
      }
  }



  template <int dim>
  void
  RigidSide<dim>::relinearise(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const unsigned int      k,
                              NodalConstraints       &constraints) const
  {
    auto              &equation = constraints.equations[k];
    const unsigned int a        = component(equation.label);
    const Vector3      r        = arm(step, equation.label);
    const Vector3      theta    = rotation_of(step, unknowns);
    Vector3            goal     = theta; // where what is prescribed has come in
    const Vector3      given    = prescribed_rotation(step);
    for (unsigned int i = 0; i < n_rotations; ++i)
      if (rotation[i])
        goal[axis(i)] = given[axis(i)];
    const FiniteRotation now(theta);
    equation.value =
      (FiniteRotation(goal).rotate(r) - r - offset(step, equation.label))[a];
    for (unsigned int i = 0; i < n_rotations; ++i)
      {
        const double d = now.derivative(axis(i), r)[a];
        constraints.coefficient[equation.first + 2 + i] = -d / radius;
        equation.value -= d * goal[axis(i)];
      }
  }



  template <int dim>
  double
  RigidSide<dim>::convective_acceleration(
    const StepContext<dim> &step,
    const NodalField       &velocity,
    const NodalConstraints & /*constraints*/,
    const NodalConstraints::Equation &equation) const
  {
    const Vector3 r     = arm(step, equation.label);
    const Vector3 omega = rotation_of(step, velocity);
    Vector3       given; // is in the motion that is prescribed
    for (unsigned int i = 0; i < n_rotations; ++i)
      if (rotation[i])
        given[axis(i)] = omega[axis(i)];
    const auto towards_axis = [&r](const Vector3 &w) {
      return cross_product_3d(w, cross_product_3d(w, r));
    };
    return (towards_axis(omega) -
            towards_axis(given))[component(equation.label)];
  }



  template <int dim>
  void
  RigidSide<dim>::add_curvature(const StepContext<dim>        &step,
                                const NodalField              &unknowns,
                                const NodalConstraints        &constraints,
                                const unsigned int             k,
                                const double                   multiplier,
                                std::array<double, dim * dim> &matrix) const
  {
    if (multiplier == 0.)
      return;
    const unsigned int   label = constraints.equations[k].label;
    const Vector3        r     = arm(step, label);
    const FiniteRotation now(rotation_of(step, unknowns));
    for (unsigned int i = 0; i < n_rotations; ++i)
      for (unsigned int j = 0; j < n_rotations; ++j)
        matrix[i * dim + j] +=
          multiplier / (radius * radius) *
          now.second_derivative(axis(i), axis(j), r)[component(label)];
  }



  template <int dim>
  void
  RigidSide<dim>::add_matrix(const StepContext<dim>              &step,
                             const std::array<double, dim * dim> &matrix,
                             const unsigned int                   element,
                             MixedSystem<dim>                    &system) const
  {
    if (rotation_node(step) == invalid)
      return;
    const unsigned int                        nc = step.n_components;
    std::array<double, (dim + 1) * (dim + 1)> padded{};
    for (unsigned int i = 0; i < n_rotations; ++i)
      for (unsigned int j = 0; j < n_rotations; ++j)
        padded[i * nc + j] = matrix[i * dim + j];
    system.add_matrix(element, padded.data());
  }



  template <int dim>
  void
  RigidSide<dim>::advance(const StepContext<dim> &step,
                          const NodalField       &unknowns)
  {
    if (!step.grid_is_kept)
      {
        reset_centre = centre;
        reset_R      = R;
      }
    // the same on all ranks
    const Vector3 u     = translation_of(step, unknowns);
    const Vector3 theta = rotation_of(step, unknowns);
    if (rotation_node(step) != invalid)
      add_to_offsets(step, unknowns, u, theta);
    centre += u;
    moved += u;
    R     = FiniteRotation(theta).matrix() * R;
    total = total_after(theta, R);
  }



  template <int dim>
  void
  RigidSide<dim>::add_to_offsets(const StepContext<dim> &step,
                                 const NodalField       &unknowns,
                                 const Vector3          &u,
                                 const Vector3          &theta)
  {
    if (!step.grid_is_kept)
      offsets.assign(side_vertices.size(), Vector3());
    const FiniteRotation turn(theta);
    std::vector<double>  change(side_vertices.size() * dim, 0.);
    for (unsigned int i = 0; i < side_vertices.size(); ++i)
      {
        const unsigned int node = step.nodes.node(side_vertices[i]);
        if (node >= step.nodes.n_owned())
          continue;
        const Vector3 r = arm(step, label_of_first + i * dim);
        const Vector3 w = u + turn.rotate(r) - r;
        for (unsigned int a = 0; a < dim; ++a)
          change[i * dim + a] =
            unknowns.local_element(node * step.n_components + a) - w[a];
      }
    Utilities::MPI::sum(change, step.grid.communicator(), change);
    for (unsigned int i = 0; i < side_vertices.size(); ++i)
      for (unsigned int a = 0; a < dim; ++a)
        offsets[i][a] += change[i * dim + a];
  }



  template <int dim>
  std::pair<double, double>
  RigidSide<dim>::moved_by(const BackgroundGrid<dim> &grid,
                           const Tensor<1, dim>      &direction) const
  {
    // at t = 0 the reference point was at centre - moved
    double largest = 0, along = 0;
    for (const unsigned int v : side_vertices)
      {
        const Vector3 r =
          in_space(grid.geometry().vertices()[v]) - (centre - moved);
        const Vector3 u = moved + R * r - r;
        largest         = std::max(largest, u.norm());
        double product  = 0;
        for (unsigned int d = 0; d < dim; ++d)
          product += u[d] * direction[d];
        along = std::max(along, product);
      }
    return {largest, along};
  }



  template class RigidSide<2>;
  template class RigidSide<3>;
} // namespace isochor
