/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_term_h
#define isochor_body_term_h

#include <isochor/equations/equation_term.h>

namespace isochor
{
  /**
   * The internal forces of the body and, in the u-p form, its pressure
   * equation: one element per occupied cell or, where points have stencils of
   * their own, per point (and then one per cell for the stabilisation).
   */
  template <int dim>
  class BodyTerm : public EquationTerm<dim>
  {
  public:
    BodyTerm(const BackgroundGrid<dim> &grid, const PointArrays<dim> &points);

    void
    touch_vertices(std::vector<unsigned int> &vertices) override;

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;

    /** Σ V G |∇N_I| and Σ V N_I at the nodes: the forces and volumes that
     * strains of order one would give. The scale below which a residual is
     * rounding. */
    void
    add_unit_residual(const StepContext<dim> &step,
                      NodalField             &scale) const override;

  private:
    template <int n_components, unsigned int max_nodes>
    EvaluationStatus
    assemble_domains(const StepContext<dim> &step,
                     const NodalField       &unknowns,
                     const NodalField       &pending,
                     const unsigned int      first_element,
                     const bool              with_matrix,
                     MixedSystem<dim>       &system) const;
    void
    assemble_overlapped_cells(const StepContext<dim> &step,
                              const NodalField       &unknowns,
                              const NodalField       &pending,
                              const unsigned int      first_element,
                              const bool              with_matrix,
                              MixedSystem<dim>       &system) const;

    template <int n_components>
    EvaluationStatus
    assemble_cells(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const NodalField       &pending,
                   const unsigned int      first_element,
                   const bool              with_matrix,
                   MixedSystem<dim>       &system) const;

    const BackgroundGrid<dim> &grid;
    const PointArrays<dim>    &points;
  };
} // namespace isochor

#endif
