/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_orthogonal_subscales_h
#define isochor_orthogonal_subscales_h

#include <isochor/equations/equation_term.h>

#include <array>
#include <functional>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * The stabilisation of the pressure by orthogonal subscales (OSS; Codina,
   * Comput. Methods Appl. Mech. Eng. 191 (2002) 4295-4321). A pressure that
   * drives an acceleration or carries a weight changes within a cell, but is no
   * oscillation. So PPP, ½ p·S_e p in cell e, is applied to what is left of the
   * pressure without one that nodes can balance,
   *   Φ = Σ_I min over c_I of Σ_{e at I} d·S_e d / (2(d+1)),
   *   d_J = p_J - ρ_e c_I·x_J at the vertices x_J,
   * with a vector c_I of its own for each node I: symmetric, not negative, and
   * zero for a pressure that is linear around the node, or bends as ρ jumps.
   * Each node and the cells around it, a patch, are an element.
   */
  template <int dim>
  class OrthogonalSubscales : public EquationTerm<dim>
  {
  public:
    /** Vertices that are the same place as others, with these, which have no
     * root themselves: of the grid as it is when asked. */
    using Images =
      std::function<std::vector<std::pair<unsigned int, unsigned int>>()>;

    OrthogonalSubscales(const BackgroundGrid<dim> &grid,
                        const PointArrays<dim>    &points,
                        const MixedKernel<dim>    &kernel,
                        const Images              &periodic_images);

    /** Collective. */
    void
    touch_vertices(std::vector<unsigned int> &vertices) override;

    /** Find the patches of the grid as it is deformed now, and their S, which
     * are those of the coming step. Collective. */
    void
    start_step();

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

    /** Φ of the pressures among @p unknowns, of all ranks (J; in plane strain
     * per metre). Collective. */
    double
    energy(const StepContext<dim> &step, const NodalField &unknowns) const;

  private:
    void
    find_roots();
    /** The vertices of @p cell, or of what they are the images of. */
    std::array<unsigned int, dim + 1>
    roots(const unsigned int cell) const;
    /** The cells around the nodes of this rank, with the points of all ranks in
     * them. Collective. */
    std::map<unsigned int, OverlappedCell<dim>>
    cells_at_owned_nodes() const;
    /** Append a patch of @p cells. */
    void
    add_patch(const std::vector<const OverlappedCell<dim> *> &cells);
    /** -S p of patch @p k. */
    void
    evaluate(const unsigned int      k,
             const StepContext<dim> &step,
             const NodalField       &unknowns,
             std::vector<double>    &volume) const;

    const BackgroundGrid<dim> &grid;
    const PointArrays<dim>    &points;
    const MixedKernel<dim>    &kernel;
    const Images               periodic_images;
    /** By image. */
    std::unordered_map<unsigned int, unsigned int> root_of;

    /** The vertices of each patch, and its S by rows, one after the other. */
    ElementNodes        patches;
    std::vector<double> entries;
    /** Where the S of each patch begins. */
    std::vector<std::size_t> first_entry;
  };
} // namespace isochor

#endif
