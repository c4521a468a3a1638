/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_rigid_motion_h
#define isochor_rigid_motion_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/expression.h>
#include <isochor/grid/prescribed_motion.h>
#include <isochor/rigid_body/rigid_move.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** What is given of the motion of a rigid body: which of its components are
   * prescribed, fixed or free, and the loads on the last ones. */
  template <int dim>
  class RigidMotion
  {
  public:
    using Components = RigidComponents<dim>;
    using Values     = typename Components::Values;

    static void
    declare_parameters(ParameterHandler &prm);
    /** In the subsection @p section. @throws ExcMessage for what contradicts
     * itself. */
    void
    parse_parameters(ParameterHandler &prm, const std::string &section);

    /** "x", "y", "rotation", or "x", "y", "z", "rx", "ry", "rz". */
    static const std::vector<std::string> &
    names();
    bool
    is_free(const unsigned int component) const
    {
      return free[component];
    }
    bool
    has_free_components() const;
    bool
    has_free_rotations() const;
    /** Whether there is a formula for a component of the rotation. */
    bool
    has_prescribed_rotations() const;

    /** Displacement and rotation vector since t = 0; 0 if fixed or free. */
    Values
    prescribed(const double time) const;
    /** The same at the end of a step to @p time, also of a trial. */
    Values
    at_end(const double time) const;
    /** A trial step of dynamics begins or, if it has no size, is over. */
    void
    set_trial(const TrialMotion &next)
    {
      trial = next;
    }
    /** Force and moment, 0 where there is none. */
    Values
    loads(const double time) const;

  private:
    using Formulas = std::vector<std::unique_ptr<Expression<dim>>>;

    void
    parse_free(const std::string &list, const std::string &section);
    void
    parse_loads(ParameterHandler &prm, const std::string &section);
    static Values
    values(const Formulas &formulas, const double time);

    Formulas                        motions, forces;
    std::array<bool, Components::n> free{};
    TrialMotion                     trial;
  };
} // namespace isochor

#endif
