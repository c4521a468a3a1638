/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_side_h
#define isochor_rigid_side_h

#include <isochor/base/finite_rotation.h>
#include <isochor/boundary_condition/boundary_condition.h>

#include <array>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * One side of RigidSides. Vectors are three-dimensional inside, so that 2D
   * and 3D are the same; in 2D rotations are about z.
   *
   * Unknowns of the step: the translation Δu of the reference point (the first
   * control node) and the rotation vector Δθ times the radius of the side (the
   * second one; in 2D its first component).
   */
  template <int dim>
  class RigidSide
  {
  public:
    /** @p items of @p parameter: "x = formula, moment = formula, centre = (0,
     * 1)". */
    RigidSide(const std::string &boundary,
              const std::string &items,
              const std::string &parameter);

    /** Once: find vertices, reference point and radius. */
    void
    initialize(const BackgroundGrid<dim> &grid);
    void
    find_vertices(const BackgroundGrid<dim> &grid);

    const std::string &
    name() const
    {
      return boundary;
    }
    const std::vector<unsigned int> &
    vertices() const
    {
      return side_vertices;
    }

    std::array<ControlNode<dim>, 2>
    control_nodes() const;
    void
    set_first_control_node(const unsigned int first)
    {
      first_control = first;
    }
    unsigned int
    control_number() const
    {
      return first_control;
    }
    /** The local number of the second control node, or invalid. */
    unsigned int
    rotation_node(const StepContext<dim> &step) const;
    /** Whether no moment makes the matrix unsymmetric. */
    bool
    is_symmetric() const;

    /** Whether it neither turns nor moves in x freely. */
    bool
    keeps_to_axis() const
    {
      return translation[0] && rotation[0];
    }

    /** A side that may turn does so about its reference point: warn if that is
     * by default the centroid of a side of which the body has another part.
     * Collective. */
    void
    warn_of_centre_beside_body(const StepContext<dim> &step) const;

    /** Labels of its equations in the last constrain() begin here. */
    unsigned int
    first_label() const
    {
      return label_of_first;
    }
    /** @p label is that of the first equation, and of the next side's. */
    void
    constrain(const StepContext<dim> &step,
              const void             *owner,
              unsigned int           &label,
              NodalConstraints       &constraints) const;
    void
    relinearise(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const unsigned int      equation,
                NodalConstraints       &constraints) const;
    double
    convective_acceleration(const StepContext<dim>           &step,
                            const NodalField                 &velocity,
                            const NodalConstraints           &constraints,
                            const NodalConstraints::Equation &equation) const;

    /** Add λ ∂²u/∂θ∂θ of an equation to @p matrix, dim x dim. */
    void
    add_curvature(const StepContext<dim>        &step,
                  const NodalField              &unknowns,
                  const NodalConstraints        &constraints,
                  const unsigned int             equation,
                  const double                   multiplier,
                  std::array<double, dim * dim> &matrix) const;
    /** Add @p matrix to the element of the rotation. */
    void
    add_matrix(const StepContext<dim>              &step,
               const std::array<double, dim * dim> &matrix,
               const unsigned int                   element,
               MixedSystem<dim>                    &system) const;

    /** The dead loads on the control nodes: forces and, in 2D, the moment. */
    void
    add_force(const StepContext<dim> &step, NodalField &force) const;
    /** In 3D, the moment, whose force on the rotation vector depends on it. */
    void
    add_moment_force(const StepContext<dim> &step,
                     const NodalField       &unknowns,
                     NodalField             &force) const;
    bool
    assembles_moment(const double time) const
    {
      return dim == 3 && moment_at(time).norm() > 0;
    }
    void
    add_moment(const StepContext<dim> &step,
               const NodalField       &unknowns,
               const NodalField       &pending,
               const unsigned int      element,
               const bool              with_matrix,
               MixedSystem<dim>       &system) const;

    /** Add the force and, about the reference point at the end of the step, the
     * moment of an equation's @p multiplier. */
    void
    add_to_resultant(const StepContext<dim> &step,
                     const NodalField       &unknowns,
                     const NodalConstraints &constraints,
                     const unsigned int      equation,
                     const double            multiplier,
                     std::array<double, 6>  &sum) const;
    /** Whether it would turn freely, but @p constraints at its nodes that come
     * later, as periodic sides, leave it no rotation. */
    bool
    rotation_is_pinned(const StepContext<dim> &step,
                       const NodalConstraints &constraints) const;
    /** What holds a pinned rotation acts at nodes of the side and counts in its
     * @p resultant, too: put the moment that acts on the side in place of
     * their sum. */
    void
    take_given_moment(const StepContext<dim> &step,
                      std::array<double, 6>  &resultant) const;
    void
    set_statistics(const StepContext<dim>      &step,
                   const NodalField            &unknowns,
                   const std::array<double, 6> &resultant,
                   Statistics                  &statistics) const;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns);
    /** How far its vertices have moved since t = 0: the largest distance, and
     * the largest along @p direction (m). */
    std::pair<double, double>
    moved_by(const BackgroundGrid<dim> &grid,
             const Tensor<1, dim>      &direction) const;

    void
    save(std::ostream &state) const;
    void
    load(std::istream &state);

  private:
    using Vector3 = Tensor<1, 3>;
    using Formula = std::unique_ptr<Expression<dim>>;

    /** Components of the rotation vector that there are: z in 2D. */
    static constexpr unsigned int n_rotations = (dim == 2 ? 1 : 3);
    static constexpr unsigned int
    axis(const unsigned int r)
    {
      return dim == 2 ? 2 : r;
    }

    void
    parse_item(const std::string &item);
    void
    set_centre(const std::string &text);
    double
    at(const Formula &formula, const double time) const;
    /** What a formula adds in the step. */
    double
    increment(const Formula &formula, const StepContext<dim> &step) const;
    bool
    rotation_is_prescribed() const;
    /** Prescribed components of Δθ of the step, others 0. */
    Vector3
    prescribed_rotation(const StepContext<dim> &step) const;
    /** Δθ by the control node; zero if this rank has none. */
    Vector3
    rotation_of(const StepContext<dim> &step, const NodalField &unknowns) const;
    Vector3
    translation_of(const StepContext<dim> &step,
                   const NodalField       &unknowns) const;
    /** X_I - c at the start of the step, X_I the place on the side of the
     * vertex of a label. */
    Vector3
    arm(const StepContext<dim> &step, const unsigned int label) const;
    /** x_I - X_I at the start of the step, of the vertex of a label. */
    Vector3
    offset(const StepContext<dim> &step, const unsigned int label) const;
    unsigned int
    component(const unsigned int label) const
    {
      return (label - label_of_first) % dim;
    }
    /** The step has converged, with the translation @p u and the rotation
     * vector @p theta. Collective. */
    void
    add_to_offsets(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const Vector3          &u,
                   const Vector3          &theta);
    Vector3
    moment_at(const double time) const;
    /** The rotation vector after @p step, continuous from the last one. */
    Vector3
    total_after(const Vector3 &step, const Tensor<2, 3> &R) const;

    std::string                      boundary, parameter;
    std::array<Formula, dim>         translation, force;
    std::array<Formula, n_rotations> rotation, moment;
    bool                             has_centre = false;
    std::vector<unsigned int>        side_vertices;
    double                           radius         = 1;
    unsigned int                     first_control  = 0;
    mutable unsigned int             label_of_first = 0;

    /** At the start of the step: reference point, what it has moved, the
     * rotation since t = 0 and its vector; and at the last reset. */
    Vector3      centre, moved, total, reset_centre;
    Tensor<2, 3> R, reset_R;
    /** By vertex, on a grid that is kept: how far other conditions, as walls,
     * have led the node away from its place on the side. */
    std::vector<Vector3> offsets;
  };
} // namespace isochor

#endif
