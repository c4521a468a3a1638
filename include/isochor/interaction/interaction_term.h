/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_term_h
#define isochor_interaction_term_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/equations/body_surface.h>
#include <isochor/interaction/face_loads.h>
#include <isochor/interaction/interaction.h>
#include <isochor/interaction/interaction_kernel.h>
#include <isochor/interaction/surface_memory.h>

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * All that acts on the surface of the bodies by interactions. An element is a
   * face of BodySurface with all its partners, or a pressure (FaceLoads): its
   * nodes are those of the face's subdomain, so that neither contact nor its
   * loss changes the pattern of the matrix.
   */
  template <int dim>
  class InteractionTerm : public BoundaryCondition<dim>,
                          public ActsByAssembly<dim>,
                          public FindsLoadsOnSupports<dim>
  {
  public:
    /** @param loads The interactions that are loads.
     * @param walls Boundaries that each body has frictionless contact with,
     * unless there is an interaction between the two. */
    InteractionTerm(
      std::vector<std::unique_ptr<Interaction<dim>>> &&interactions,
      std::vector<std::unique_ptr<Interaction<dim>>> &&loads,
      const std::vector<OneSidedWall>                 &walls);

    /** The names of the bodies, by layer of the grid, once they are known. */
    void
    set_bodies(const std::vector<std::string> &names)
    {
      add_walls(walls, names, interactions);
      for (const auto &interaction : interactions)
        interaction->find_bodies(names);
      for (const auto &load : loads.interactions())
        load->find_bodies(names);
    }

    const std::vector<LoadOnSupport> &
    loads_on_supports() const override
    {
      return loads.loads_on_supports();
    }

    const FaceLoads<dim> &
    given() const
    {
      return loads;
    }
    /** After prepare(): how far (m) the nearest of the partners that face @p f
     * of the surface may come into contact with will be from where Gauss point
     * @p g is at the start of the step. */
    double
    gap(const unsigned int f, const unsigned int g) const;
    /** Another body is nearer there, see InteractionKernel::Measure. */
    void
    set_nearer_body(const unsigned int f, const unsigned int g);

    /** Whether surfaces may leave what they touch. */
    bool
    may_let_go() const
    {
      for (const auto &interaction : interactions)
        if (interaction->law->is_unilateral())
          return true;
      return false;
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override
    {
      this->grid = &grid;
      for (const auto &interaction : interactions)
        {
          interaction->partner->initialize(grid);
          interaction->find_place(grid);
        }
      for (const auto &load : loads.interactions())
        load->find_place(grid);
    }
    void
    set_body(const BodyShape<dim> & /*shape*/,
             const PointArrays<dim> &points) override
    {
      this->points = &points;
    }
    std::string
    describe() const override
    {
      return description;
    }
    void
    touch_vertices(std::vector<unsigned int> & /*vertices*/) override
    {
      find_faces();
    }
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;
    /** Find γ and the adjoint of the step. */
    void
    prepare(const StepContext<dim> &step) override;
    void
    set_trial(const StepContext<dim> &step,
              const double            trial_size,
              const SmoothStart      &start) override
    {
      for (const auto &interaction : interactions)
        interaction->partner->set_trial(
          {step.old_time, step.time, trial_size, start});
    }
    void
    append_motions(std::vector<Expression<dim>> &motions) const override
    {
      for (const auto &interaction : interactions)
        interaction->partner->append_motions(motions);
    }
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
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      loads.add_dead_loads(step, force);
    }
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
      return interactions.empty() && walls.empty() && !loads.have_pressures();
    }
    bool
    assembles_load(const StepContext<dim> & /*step*/) const override
    {
      return loads.have_pressures();
    }
    bool
    moves_body(const StepContext<dim> &step) const override
    {
      return !faces.empty() && std::any_of(interactions.begin(),
                                           interactions.end(),
                                           [&](const auto &one) {
                                             return one->law->is_unilateral() ||
                                                    one->partner->moves(step);
                                           });
    }
    /** Contact that was missed: what is behind the surface is in a partner. */
    std::string
    objection(const StepContext<dim> &step,
              const NodalField       &unknowns) const override;
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override;
    std::string
    save_state() const override;
    void
    load_state(const std::string &state) override;

  private:
    /** A face that takes part, with what is constant in a step. */
    struct FaceElement
    {
      unsigned int              face;     ///< in the surface
      std::vector<unsigned int> partners; ///< numbers of its interactions
      std::vector<unsigned int> loads;    ///< FaceLoads::on_face()
      bool                      is_tied = false; ///< by one of them
      /** By Gauss point and partner: facing() with the normals of the body at
       * the start of the step and of the partner where it will be. */
      std::array<std::vector<double>, BodySurface<dim>::n_gauss> facing;
      /** By Gauss point: see InteractionTerm::gap(), and whether a body is
       * nearer. */
      std::array<double, BodySurface<dim>::n_gauss> gap;
      std::array<bool, BodySurface<dim>::n_gauss>   body_is_nearer;
      Tensor<1, dim>              normal; ///< outward, at the start of the step
      double                      gamma      = 0;
      double                      area_ratio = 1;
      std::vector<Tensor<1, dim>> adjoint; ///< B, if θ is not 0
      /** By Gauss point and partner, if it is known. */
      std::vector<StartOfStep<dim>> start;
    };

    /** What acts at a Gauss point of a face by one of its interactions. */
    struct Action
    {
      unsigned int partner, gauss_point; ///< partner: of the element
      /** Where it acts on the partner, at the iterate. */
      Point<dim> y;
      /** On the body (N): of contact the mean over the step, of a tie that at
       * its end. */
      Tensor<1, dim>   force;
      Tensor<1, dim>   remembered; ///< for the next step (m)
      double           kept;       ///< SurfaceStress::Flow::kept
      SurfaceState     state;
      StartOfStep<dim> end; ///< InteractionKernel::at_end()
    };

    void
    update_partners(const StepContext<dim> &step,
                    const NodalField       &unknowns) const
    {
      for (const auto &interaction : interactions)
        interaction->partner->update(step, unknowns);
    }
    /** The faces that take part, as they are at the start of the step.
     * Collective. */
    void
    find_faces();
    /** @throws ExcMessage for an interaction without a face, and for faces that
     * two of them tie. Collective. */
    void
    check_surfaces();
    typename SurfaceStress<dim>::Domain
    domain(const StepContext<dim> &step, const unsigned int face) const;
    /** Of the material, whose stress was evaluated last, for ties; none in
     * dynamics, where what acts has to be the gradient of an energy. */
    typename SurfaceStress<dim>::Flow
    flow_at(const StepContext<dim>                    &step,
            const FaceElement                         &element,
            const typename SurfaceStress<dim>::Domain &domain) const
    {
      return step.has_inertia || !element.is_tied ?
               typename SurfaceStress<dim>::Flow() :
               stress.flow(*domain.material, domain.history);
    }
    /** Residual and matrix of a face. @p actions, if not null, gets what acts.
     */
    EvaluationStatus
    evaluate_face(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const FaceElement      &element,
                  const bool              with_matrix,
                  InteractionKernel<dim> &kernel,
                  std::vector<Action>    *actions) const;
    /** Set what Gauss point @p g faces, and its gap, with partners in their
     * present poses. */
    void
    look_at_partners(const StepContext<dim> &step,
                     const unsigned int      g,
                     FaceElement            &element) const;
    /** That of face @p f of the surface, or the end. */
    typename std::vector<FaceElement>::const_iterator
    element_of(const unsigned int f) const;
    /** A partner that may act at a Gauss point, by its number in the element.
     */
    struct ActingPartner
    {
      unsigned int      partner;
      PartnerPlace<dim> place;
      /** It acts where it is open, too: the nearest, and no other is closed. */
      bool is_alone;
    };
    using ActingPartners = std::vector<ActingPartner>;
    /** Those of Gauss point @p g, at @p place with the pressure @p p and the
     * loads @p given: the tie or, in contact, all that it faces. The stress is
     * evaluated. */
    ActingPartners
    acting(const FaceElement                         &element,
           const unsigned int                         g,
           const typename Partner<dim>::SurfacePlace &place,
           const double                               p,
           const GivenTraction<dim>                  &given) const;
    /** Of Gauss point @p g, at @p start at the start of the step, and one of
     * the element's partners. */
    typename InteractionKernel<dim>::Measure
    measure_of(const StepContext<dim>                 &step,
               const FaceElement                      &element,
               const unsigned int                      g,
               const unsigned int                      partner,
               const typename BodySurface<dim>::Place &start,
               const bool                              is_alone) const;
    /** The force (N) and the moment (N m; in 2D the third component) on the
     * body by each interaction, of all ranks. Notes what is remembered, too. */
    std::vector<std::array<double, dim + 3>>
    resultants(const StepContext<dim> &step, const NodalField &unknowns) const;
    void
    set_nodes(const StepContext<dim>    &step,
              const FaceElement         &element,
              std::vector<unsigned int> &nodes) const;
    std::vector<std::unique_ptr<Interaction<dim>>> interactions;
    FaceLoads<dim>                                 loads;
    const std::vector<OneSidedWall>                walls;
    const BackgroundGrid<dim>                     *grid   = nullptr;
    const PointArrays<dim>                        *points = nullptr;
    bool                     is_checked = false; ///< see check_surfaces()
    std::string              description;
    BodySurface<dim>         surface;
    std::vector<FaceElement> faces;
    /** Of each Gauss point InteractionKernel::remembered(), of the face the
     * part of its elastic strain that its point kept in the last step. */
    mutable SurfaceMemory<dim> memory;
    /** The forces at the end of the last step (N): with the pressures that
     * nodes of another grid get from the points they would be others. */
    mutable SurfaceMemory<dim> forces;
    mutable SurfaceStress<dim> stress;
  };
} // namespace isochor

#endif
