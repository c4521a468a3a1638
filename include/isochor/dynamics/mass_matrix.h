/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_mass_matrix_h
#define isochor_mass_matrix_h

#include <isochor/dynamics/domain_inertia.h>

#include <vector>

namespace isochor
{
  /**
   * The consistent mass matrix M_IJ = Σ_p m_p N_I(x_p) N_J(x_p) and the
   * projection of fields of the points to the nodes that goes with it,
   *   M f_I = Σ_p m_p N_I f_p,
   * the least-squares fit of Σ_I N_I f_I to the f_p. A field that nodes can
   * represent comes back as it is, mass times field and its moment (linear and
   * angular momentum of velocities) are kept by any. Where points hardly touch
   * a node, M is nearly singular and f_I of such a node means little; but
   * Σ_I N_I f_I at the points, all that is ever used, is bounded by the f_p in
   * the norm Σ m_p f_p².
   *
   * Fields are vectors of dim components, m_p masses; with other weights in
   * their place, such as volumes, and one component it projects pressures.
   */
  template <int dim>
  class MassMatrix
  {
  public:
    /** Take the points of @p step, and their nodes; if they have domains,
     * @p with_domains also the inertia of these about their centres.
     * Collective. */
    void
    reinit(const StepContext<dim> &step, const bool with_domains = false);

    /** The same with the @p weights (by point) in the place of masses, for
     * fields of @p n_components, 1 or dim. Collective. */
    void
    reinit(const StepContext<dim>    &step,
           const std::vector<double> &weights,
           const unsigned int         n_components);

    /** Elements of this rank: cells that hold points or, if points have
     * stencils of their own, points. */
    unsigned int
    n_elements(const StepContext<dim> &step) const
    {
      return step.points.has_stencils() ? step.points.n_points() :
                                          step.points.cell.size();
    }

    /** The nodes of an element. @p nodes is cleared first. */
    void
    element_nodes(const StepContext<dim>    &step,
                  const unsigned int         element,
                  std::vector<unsigned int> &nodes) const;

    /** M_IJ of an element, by rows. */
    void
    element_matrix(const StepContext<dim> &step,
                   const unsigned int      element,
                   std::vector<double>    &matrix) const;

    /** @p result = Σ_p m_p N_I f_p with f_p = @p field[p], dim components per
     * node. Collective. */
    void
    collect(const StepContext<dim>            &step,
            const std::vector<Tensor<1, dim>> &field,
            NodalField                        &result) const;
    /** The same of scalars, one component per node. */
    void
    collect(const StepContext<dim>    &step,
            const std::vector<double> &field,
            NodalField                &result) const;

    /** @p result = M @p field, both of dim components per node; @p field has
     * its ghosts updated. Collective. */
    void
    vmult(const StepContext<dim> &step,
          const NodalField       &field,
          NodalField             &result) const;

    /**
     * Solve M x = @p load for the entries of @p solution (n_components per
     * node) that are not @p held (one char per local entry); those that are
     * stay as they are. The @p followers are what they follow plus what is @p
     * given (by follower; empty: 0), their own values don't count, and the load
     * on them acts there. @p solution is where the iteration starts; its ghosts
     * are updated at the end. Nodes without mass get zero. Collective.
     *
     * @p with_domains solves M + B instead, B of DomainInertia. M has rank one
     * for each point and component, and is singular where fewer points than
     * nodes are; M + B, the mass of fields that are linear on the domains but
     * for their spin, isn't. For loads that are not of the form Σ m_p N_I f_p,
     * and can be anything in the directions that M can't see.
     * @return the residual relative to the load, in the norm of the diagonal;
     * infinity, and @p solution as it was, if the iteration breaks down.
     */
    double
    solve(const StepContext<dim>           &step,
          const NodalField                 &load,
          const std::vector<unsigned char> &held,
          const Followers                  &followers,
          const std::vector<double>        &given,
          NodalField                       &solution,
          const bool                        with_domains = false) const;

    /** Set the entries of @p solution that are not @p held to @p load over the
     * lumped mass, where that is one of functions between 0 and 1. Others, of
     * functions that are continued beyond their cells, may be as small as
     * rounding errors, and stay as they are. */
    void
    set_lumped_solution(const NodalField                 &load,
                        const std::vector<unsigned char> &held,
                        NodalField                       &solution) const;

    /** Σ_p m_p N_I, by node. */
    NodalField lumped;

  private:
    struct ScaledMatrix;

    /** @p scale becomes what makes the diagonal 1, with what followers hand on;
     * 0 where nodes are @p held or massless: the @p solution of those is 0.
     * Collective. */
    void
    scale_diagonal(const StepContext<dim>           &step,
                   const std::vector<unsigned char> &held,
                   const Followers                  &followers,
                   const bool                        with_domains,
                   NodalField                       &scale,
                   NodalField                       &solution) const;

    /** @p result += M @p field on this rank. */
    void
    add_product(const StepContext<dim> &step,
                const NodalField       &field,
                NodalField             &result) const;
    template <int n>
    void
    add_product_of_components(const StepContext<dim> &step,
                              const NodalField       &field,
                              NodalField             &result) const;
    /** collect() with the component a of the field at a point q. */
    template <typename Field>
    void
    collect_components(const StepContext<dim> &step,
                       const Field            &field,
                       NodalField             &result) const;
    static constexpr unsigned int n_entries = (dim + 1) * (dim + 2) / 2;

    /** By point, m_p. */
    std::vector<double> weight;
    /** Of the fields, at a node. */
    unsigned int n_components = dim;
    /** M_IJ, J <= I, of the cells; empty if points have stencils. */
    std::vector<std::array<double, n_entries>> cell_mass;
    NodalField                                 diagonal; ///< M_II, by node
    DomainInertia<dim>                         domains;
  };
} // namespace isochor

#endif
