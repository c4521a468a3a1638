/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_material_at_nodes_h
#define isochor_material_at_nodes_h

#include <isochor/base/expression.h>
#include <isochor/equations/equation_term.h>

#include <array>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace isochor
{
  /** One component of the displacement that is prescribed on a boundary of the
   * grid; the same on all ranks. */
  template <int dim>
  struct PrescribedComponent
  {
    std::string               boundary;
    unsigned int              component;
    Expression<dim>           displacement;
    std::vector<unsigned int> vertices;
    /** Whether the displacement depends on x, y or z. */
    bool depends_on_place = false;
  };

  /**
   * Which material is at the nodes of a boundary whose prescribed displacement
   * depends on the place. A formula u(X, t) means material that was at X at t =
   * 0. When a grid is put back at t_r, a node at x gets other material, that
   * with X + u(X, t_r) = x, and then keeps it until the next time. Components
   * that are not prescribed don't count: X is there where the node was
   * generated.
   */
  template <int dim>
  class MaterialAtNodes
  {
  public:
    /** Look at @p conditions, with the grid's vertices
     * at t = 0 at @p reference. */
    void
    set(const std::vector<PrescribedComponent<dim>> &conditions,
        const std::vector<Point<dim>>               &reference);

    /** X of the material at @p vertex at the start of @p step. If there is
     * none, or several, where the node was generated, with a warning. */
    Point<dim>
    place(const unsigned int             vertex,
          const std::vector<Point<dim>> &reference,
          const StepContext<dim>        &step) const;

    /** The @p step is done. */
    void
    advance(const StepContext<dim> &step)
    {
      if (!step.grid_is_kept)
        reset_time = step.old_time;
    }

    /** When the grid was put back (s), which is the state to save. */
    double reset_time = 0;

  private:
    /** The formulas of the components held. */
    using Formulas = std::array<std::optional<Expression<dim>>, dim>;

    /** X + u(X, t) - x in the components held, else 0. */
    static Tensor<1, dim>
    residual(const Formulas   &displacement,
             const Point<dim> &X,
             const Point<dim> &x,
             const double      t);

    std::unordered_map<unsigned int, Formulas> formulas;   ///< by vertex
    double                                     extent = 0; ///< of the grid (m)
  };
} // namespace isochor

#endif
