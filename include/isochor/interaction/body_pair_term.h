/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_pair_term_h
#define isochor_body_pair_term_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/interaction/body_pair_kernel.h>
#include <isochor/interaction/interaction_term.h>

#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * What bodies do to each other at their surfaces. Gauss points on both
   * surfaces take part, each with the part γ'/(γ + γ') of the integral, γ its
   * own and γ' the other body's, so that most is integrated where the softer
   * body ends; the mean traction is t = κ t₁ - κ' t₂ with the same weights
   * κ = γ'/(γ + γ'), and γ_h = 2 γ γ'/(γ + γ').
   *
   * Bodies with faces that coincide at t = 0 are tied there, others may come
   * into contact without friction, unless an interaction says something else.
   * An element is a Gauss point with the faces of other bodies that it may meet
   * in the step, of which the nearest acts.
   */
  template <int dim>
  class BodyPairTerm : public BoundaryCondition<dim>, public ActsByAssembly<dim>
  {
  public:
    /** @p interactions of two bodies each; @p bodies: by layer of the grid. */
    BodyPairTerm(std::vector<std::unique_ptr<Interaction<dim>>> &&interactions);

    /** The names of the bodies, by layer of the grid, once they are known. */
    void
    set_bodies(const std::vector<std::string> &names);

    /** What else acts on the surfaces of the bodies, prepared before this. */
    void
    set_others(InteractionTerm<dim> &others)
    {
      this->others = &others;
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      this->grid = &grid;
      laws.find_places(grid);
    }
    void
    set_body(const BodyShape<dim> & /*shape*/,
             const PointArrays<dim> &points) override
    {
      this->points = &points;
    }
    void
    touch_vertices(std::vector<unsigned int> &vertices) override;
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;
    void
    prepare(const StepContext<dim> &step) override;
    void
    note_start(const StepContext<dim> &start,
               const NodalField       &unknowns,
               const NodalField       &forces) override;
    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;
    void
    add_unit_residual(const StepContext<dim> &step,
                      NodalField             &scale) const override;
    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override;
    bool
    has_symmetric_matrix() const override
    {
      return grid->n_layers() == 1;
    }
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override;
    /** Whether bodies may meet at faces that no element has. */
    bool
    needs_reset() const override
    {
      return way_since_reset + 2 * largest_increment > reach;
    }
    std::string
    save_state() const override;
    void
    load_state(const std::string &state) override
    {
      std::istringstream(state) >> largest_increment >> reach >>
        way_since_reset;
      memory.load(state.substr(state.find('\n') + 1));
    }

  private:
    using Element = PairElement<dim>;

    /** Within what distance (m) of @p face elements are looked for. */
    double
    margin_of(const FaceCopy<dim> &face) const;
    void
    find_elements();
    /** In a run that is resumed on a kept grid: find the elements, with the
     * nodes that are active. Collective. */
    void
    resume(const StepContext<dim> &step);
    bool
    find_tie(const Point<dim> &X, Element &element) const;
    /** What evaluates the elements, at the iterate. */
    BodyPairKernel<dim>
    kernel_at(const StepContext<dim> &step, const NodalField &unknowns) const
    {
      return {
        step, unknowns, copies, laws, *default_tie, memory, given(), reach};
    }
    const FaceLoads<dim> *
    given() const
    {
      return others == nullptr ? nullptr : &others->given();
    }
    /** Find what Gauss points touch at the start of the @p step, and where
     * nothing is near or something else is nearer. */
    void
    find_contact(const StepContext<dim> &step);

    InteractionTerm<dim>                *others = nullptr;
    PairLaws<dim>                        laws;
    std::unique_ptr<InteractionLaw<dim>> default_tie;
    /** Pairs of bodies, the lower number first, that are tied somewhere: they
     * don't come into contact elsewhere, as at the edges of what is tied. */
    std::set<std::pair<unsigned int, unsigned int>> tied_pairs;
    bool                                            knows_tied_pairs = false;
    std::vector<std::string>                        body_names;
    const BackgroundGrid<dim>                      *grid   = nullptr;
    const PointArrays<dim>                         *points = nullptr;
    BodySurface<dim>                                surface;
    std::vector<FaceCopy<dim>>                      copies; ///< of all ranks
    unsigned int         first_own = 0;                     ///< of the copies
    std::vector<Element> elements;
    double               largest_increment = 0; ///< of the last step (m)
    /** Half of the distance within which the elements have all faces, at the
     * last reset; and how much two bodies can have come closer since (m). Up to
     * there the nearest face is an element's: a place that is farther beyond
     * its nearest face than this and what it slides in the step is next to one
     * that it doesn't have, and isn't met. */
    double                     reach = 0, way_since_reset = 0;
    mutable SurfaceMemory<dim> memory;
  };
} // namespace isochor

#endif
