/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_kernel_h
#define isochor_interaction_kernel_h

#include <isochor/base/rounding.h>
#include <isochor/equations/equation_term.h>
#include <isochor/equations/surface_stress.h>
#include <isochor/interaction/interaction_law.h>

#include <array>
#include <vector>

namespace isochor
{
  /** What the partner is to a place of the surface: its gap and the derivatives
   * of this, x the place's position. */
  template <int dim>
  struct PartnerPlace
  {
    Tensor<1, dim> gap;    ///< g (m), the total one
    Tensor<1, dim> normal; ///< n, of the partner, towards the body
    double normal_gap = 0; ///< g·n: distance, negative in the partner (m)
    Tensor<2, dim> gap_by_x, normal_by_x;
    /** What of the traction the partner can exert; 1 but for components that
     * are left free. */
    Tensor<2, dim> mask = unit_symmetric_tensor<dim>();
  };

  /**
   * How much of a surface with the outward normal @p nu faces the normal @p n
   * of its partner: the cosine of the angle between them, 0 from a right angle
   * on, as nearly as numbers have it: a side must not miss its wall because it
   * faces a lid by rounding. Contact is integrated with this factor, which is 1
   * but for second order in the angle where there is contact, so that faces
   * which turn towards the partner or away from it begin and end to take part
   * smoothly.
   */
  template <int dim>
  double
  facing(const Tensor<1, dim> &nu, const Tensor<1, dim> &n)
  {
    const double cosine = -(nu * n);
    return cosine > rounding::accumulated ? cosine : 0.;
  }

  /** Measure::rounding of a subdomain: @p gamma times what is small against its
   * height, 1/@p area_per_volume. */
  inline double
  rounding_of_contact(const double gamma, const double area_per_volume)
  {
    return 1e-10 * gamma / area_per_volume;
  }

  /** The loads at a place, which act whatever the surface does: other
   * interactions carry the rest of the traction there. */
  template <int dim>
  struct GivenTraction
  {
    Tensor<1, dim> dead;         ///< per area of BodySurface::Face (Pa)
    double         pressure = 0; ///< against the present area (Pa)
  };

  /** What there is at a place at the start of a step. */
  template <int dim>
  struct StartOfStep
  {
    Tensor<1, dim> w, f;   ///< Pa, see InteractionLaw
    Tensor<1, dim> normal; ///< n
    /** Of each side its pressure (Pa) and ∂t/∂p, if the body's equations have
     * pressures. */
    std::array<double, 2>         pressure{};
    std::array<Tensor<1, dim>, 2> t_by_pressure{};
  };

  /** For EquationTerm::add_unit_residual(): of places at a distance @p r from
   * the origin a unit of the last digit remains in gaps, which are multiplied
   * by
   * @p area and @p gamma. */
  template <int dim>
  void
  add_rounding_of_gap(const StepContext<dim>   &step,
                      const unsigned int        n_nodes,
                      const unsigned int *const vertices,
                      const double *const       shape,
                      const double              area,
                      const double              gamma,
                      const double              r,
                      NodalField               &scale);

  /**
   * The contribution of one Gauss point of a surface to the equations, for all
   * partners and laws the only place where it stands. With t the body's own
   * traction less that of loads there, or the mean κ₁ t₁ - κ₂ t₂ of two
   * bodies, f of InteractionLaw, M
   * the projection to the constrained components and the trace v of a test
   * function (of two bodies v₁ - v₂):
   *   R(v) = - ∫ f·v + θ ∫ (f - M t)·B[v] / γ,
   *   R(q) = ∫ (f - M t)·q s F^{-T}N / γ,
   * over areas at t = 0. θ = 0: without the adjoint term, for statics. θ = 1
   * in dynamics, where it keeps the equations symmetric up to second order,
   * with B the elastic change of the traction frozen at the start of the step
   * (SurfaceStress::elastic_traction_by_displacement()).
   */
  template <int dim>
  class InteractionKernel
  {
  public:
    using Projection = typename InteractionLaw<dim>::Projection;

    /** The subdomain of a body at the place. */
    struct Side
    {
      const SurfaceStress<dim> *stress;
      unsigned int              n_nodes;
      const unsigned int       *node;  ///< which node of the element each is
      const double             *shape; ///< N_I at the place
      const double             *point_shape; ///< of pressures at the point
      double                    pressure;    ///< p at the place
      /** κ₁ or -κ₂, the factor of t. */
      double weight;
      /** 1, or -1 of the partner: the factor of v. */
      double sign;
      /** B_J,b by J * dim + b, if θ is not 0. */
      const Tensor<1, dim> *adjoint = nullptr;
      GivenTraction<dim>    given   = {};
    };

    /** How a place is integrated, and γ. */
    struct Measure
    {
      double weight;         ///< of the area at t = 0 (m^(dim-1))
      double gamma;          ///< Pa/m
      double theta      = 0; ///< θ
      double area_ratio = 1; ///< see InteractionLaw::project()
      /** A traction of some rounding errors (Pa): with a pull of less there is
       * contact, so that a body which touches its partner is held by it. */
      double rounding = 0;
      /** What there was at the start of the step, see add(); null if that
       * doesn't matter. */
      const StartOfStep<dim> *start      = nullptr;
      double                  end_weight = 0.5; ///< m
      /** It isn't near at the start of the step, or something else that the
       * surface may come into contact with is nearer or closed: where this is
       * open nothing is added then. Else the surface is weakly free of
       * tractions, so that contact begins and ends smoothly. */
      bool is_farther = false;
    };

    /** Begin with an element of @p n_nodes nodes with @p n_components unknowns.
     */
    void
    start_element(const unsigned int n_nodes,
                  const unsigned int n_components,
                  const bool         with_matrix);

    /** Begin with a place. */
    void
    start_place();
    void
    add_side(const Side &side);
    /** What an unknown moves of the partner: its place, its normal and the gap
     * that turns with it. */
    struct PartnerMotion
    {
      Tensor<1, dim> place, normal, gap;
      /** How `place` changes: from place to place of the partner, and with
       * each component of the same node at one place. Zero if it doesn't. */
      Tensor<2, dim>                  place_by_y{};
      std::array<Tensor<1, dim>, dim> place_by_component{};
    };
    /** The unknown @p component of node @p node moves the partner. */
    void
    add_partner(const unsigned int   node,
                const unsigned int   component,
                const PartnerMotion &motion)
    {
      const unsigned int i = node * n_components + component;
      trace[i] -= motion.place;
      turn_of_normal[i] += motion.normal;
      turn_of_gap[i] += motion.gap;
      if (with_matrix && motion.place_by_y.norm_square() > 0)
        turns.push_back({i, node * n_components, motion});
    }

    using FaceCoordinates = Tensor<1, dim - 1>;
    /** The place slides on the side that was added last: its coordinates ξ on
     * the face there change with the unknowns, by @p by_unknown. @p
     * shape_by_xi: ∂N_I/∂ξ. @p pressure_by_xi: ∂p/∂ξ. */
    void
    add_sliding(const std::vector<FaceCoordinates> &by_unknown,
                const std::vector<FaceCoordinates> &shape_by_xi,
                const FaceCoordinates              &pressure_by_xi);
    /** δv of an unknown relative to the partner, after all sides are added. */
    const Tensor<1, dim> &
    trace_of(const unsigned int i) const
    {
      return trace[i];
    }
    /**
     * Add what acts at the place by @p law. In dynamics a step takes a mean of
     * the forces at its ends, with the weights 1 - m and m, and that has to be
     * a gradient of
     *   Φ(t, g) = (max(0, w·n)² - (t·n)²)/(2γ),  w = t - γ g,
     * or contact that begins or ends would gain energy from nothing. With the
     * mean p̄ of the step's pressures at both of its ends, and f_0 and f_1 of
     *   w_0 = w(t_0, p̄, g_0),  w_1 = w(t_1, p̄, g_1),
     * it is
     *   f̄ = ρ ((1 - m) f_0 + m f_1),  ρ = |w_c|/|w_1 - w_0|
     * where contact begins or ends, w_c·n > 0 that of the two which has it, and
     * ρ = 1 elsewhere. With m = 1/2 its normal part does the work
     *   Φ(p̄, w_0) - Φ(p̄, w_1)
     * (the discrete gradient of Gonzalez, J. Nonlinear Sci. 6 (1996) 449-467),
     * else less; friction keeps its ratio to it. The pressure equation, which
     * holds at the end of the step, has v = ∂Φ/∂p = (f_1 - M t_1)/γ with p̄,
     * too: as Φ is concave in p, the energy of the body and γ v²/2 on its
     * surface together never grow, however fast pressures change.
     */
    Projection
    add(const InteractionLaw<dim> &law,
        const PartnerPlace<dim>   &place,
        const Measure             &measure);

    /** Add @p force (N), which acts at the place whatever the law. */
    void
    add_force(const Tensor<1, dim> &force)
    {
      for (unsigned int i = 0; i < n_dofs; ++i)
        residual[i] -= force * trace[i];
    }

    /** After add(): what the place remembers of the step (m). Laws leave the
     * gap e = (t - f)/γ. Friction remembers it, along the surface. Of a tie it
     * relaxes as the elastic strain of the material does, of which the part m =
     * @p flow.kept is left: the tie is from then on that of another place of
     * the body, at v from this one, v = @p shift at the end of the step; and
     * goes back to this one with the plastic strain,
     *   v ← (v - (1 - m) e)/(1 + Δε_p),
     * so that the total gap has the modulus γ |e^e| in the end. */
    Tensor<1, dim>
    remembered(const InteractionLaw<dim>               &law,
               const Tensor<1, dim>                    &shift,
               const typename SurfaceStress<dim>::Flow &flow) const
    {
      return law.is_unilateral() ?
               gap_left :
               (shift - (1 - flow.kept) * gap_left) / (1 + flow.strain);
    }
    /** After add() without a start: what the next step starts with. With one f
     * is what takes the place of that at the end, of a tie the same. */
    const StartOfStep<dim> &
    at_end() const
    {
      return end;
    }
    /** After add(): f̄, or f if there is no start. */
    const Tensor<1, dim> &
    mean_traction() const
    {
      return mean;
    }

    /** Of the element, as MixedSystem::add_element() wants them. */
    std::vector<double> residual, matrix;

  private:
    /** What acts: f, and its derivatives with respect to w_1, n_1 and w_0. */
    struct Acting
    {
      Tensor<1, dim> f;
      Tensor<2, dim> by_w, by_n, by_start;
    };
    /** Of the law, within the partner's mask. */
    static Projection
    project(const InteractionLaw<dim> &law,
            const Tensor<1, dim>      &w,
            const Tensor<1, dim>      &n,
            const PartnerPlace<dim>   &place,
            const Measure             &measure);
    /** What takes the place of f_1 in the equation of motion: f̄, less what has
     * acted at the start of the step. @p w_0: with the mean pressure. */
    static Acting
    in_step(const Projection     &f_1,
            const Tensor<1, dim> &w_1,
            const Tensor<1, dim> &n_1,
            const Projection     &f_0,
            const Tensor<1, dim> &w_0,
            const Measure        &measure,
            const bool            is_unilateral);
    /** Set t_end and w_0 to those with the mean pressures of the step. */
    void
    set_mean_pressures(const Measure &measure);
    /** @p in_pressure_equation: v, see add(). */
    void
    add_to_residual(const Acting         &acting,
                    const Measure        &measure,
                    const Tensor<1, dim> &in_pressure_equation,
                    const Tensor<1, dim> &adjoint_to);
    /** What comes from sliding: N_I there are those of another place. */
    void
    add_sliding_to_matrix(const Acting         &acting,
                          const Measure        &measure,
                          const Tensor<1, dim> &in_pressure_equation);
    void
    add_to_matrix(const InteractionLaw<dim> &law,
                  const PartnerPlace<dim>   &place,
                  const Acting              &acting,
                  const Projection          &f_1,
                  const Measure             &measure,
                  const Tensor<1, dim>      &in_pressure_equation);

    /** What comes from partners that turn: the lever of f is another one, at
     * the place nearest to the body's, or as the partner's place moves on. */
    void
    add_turns_to_matrix(const InteractionLaw<dim> &law,
                        const PartnerPlace<dim>   &place,
                        const Acting              &acting,
                        const Measure             &measure);
    /** M t. */
    static Tensor<1, dim>
    constrained(const InteractionLaw<dim> &law,
                const PartnerPlace<dim>   &place,
                const Tensor<1, dim>      &t)
    {
      return law.constrains_tangent() ?
               Tensor<1, dim>(place.mask * t) :
               Tensor<1, dim>((t * place.normal) * place.normal);
    }

    /** An unknown that turns the partner, and the first one of its node. */
    struct Turn
    {
      unsigned int  unknown, first;
      PartnerMotion motion;
    };

    unsigned int n_components = 0, n_dofs = 0;
    bool         with_matrix = false;
    /** By unknown of the element: the trace of its function, relative to the
     * partner; ∂t; ∂t_end and ∂w_0; what n and g turn by with the partner; the
     * adjoint B. */
    std::vector<Tensor<1, dim>> trace, t_by, t_end_by, w_0_by, turn_of_normal,
      turn_of_gap, adjoint;
    /** ∂p of each side, by unknown. */
    std::array<std::vector<double>, 2> pressure_by;
    /** t_1, and with the mean pressures of the step t_1 and w_0. */
    Tensor<1, dim>               t, t_end, w_0;
    Tensor<1, dim>               mean, gap_left;
    StartOfStep<dim>             end;
    std::vector<Side>            sides;
    std::vector<Turn>            turns;
    std::vector<FaceCoordinates> xi_by, shape_by_xi; ///< empty: no sliding
  };
} // namespace isochor

#endif
