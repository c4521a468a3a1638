/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_law_h
#define isochor_interaction_law_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <isochor/base/plugin_registry.h>
#include <isochor/boundary_condition/surface_forces.h>

#include <memory>
#include <string>

namespace isochor
{
  /** What became of a place of the surface. */
  enum class SurfaceState : unsigned char
  {
    open,
    sticks,
    slides
  };

  /**
   * Interface of the laws between a surface and its partner: which traction f
   * the partner can exert on the surface, per area at t = 0. With the body's
   * own traction t = P N, the gap g and γ of the subdomain, f = Proj_C(w),  w =
   * t - γ g, the projection to the admissible tractions C, so that f = t where
   * g = 0 and t is admissible (Nitsche's method; Chouly, Hild & Renard, Math.
   * Comp. 84, 2015). To add a law, write `source/interaction/<name>.cc` with
   * the class and its registration; its parameters live in the subsection
   * "Interaction: ...", where `Law` names it, and may be shared with others of
   * the same name and meaning.
   */
  template <int dim>
  class InteractionLaw
  {
  public:
    virtual ~InteractionLaw() = default;

    /** Declare `Law`, which is @p usual if it isn't given, and the parameters
     * of all laws. */
    static void
    declare_laws(ParameterHandler &prm, const std::string &usual);
    /** The law that the parameters name, its own being read. @p section: which
     * they are in, for messages. */
    static std::unique_ptr<InteractionLaw<dim>>
    create(ParameterHandler &prm, const std::string &section);

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** What acts if it is given whatever the surface does: there is no partner,
     * and project() is not called. */
    virtual SurfaceLoad<dim> *
    load()
    {
      return nullptr;
    }

    /** The result of project(). */
    struct Projection
    {
      Tensor<1, dim> f;      ///< Pa
      Tensor<2, dim> f_by_w; ///< ∂f/∂w at fixed n
      Tensor<2, dim> f_by_n; ///< ∂f/∂n at fixed w (Pa)
      SurfaceState   state = SurfaceState::open;
    };

    /**
     * Project @p w (Pa). @p n is the unit normal of the partner, towards the
     * body: w·n > 0 is pressure. @p area_ratio is the current area over that at
     * t = 0, by which stresses of the law are multiplied.
     */
    virtual Projection
    project(const Tensor<1, dim> &w,
            const Tensor<1, dim> &n,
            const double          area_ratio) const = 0;

    /** Whether there is any interaction; else project() is not called. */
    virtual bool
    acts() const
    {
      return true;
    }

    /** Whether the surface may leave the partner and come to it: w contains the
     * gap along n of the nearest place. If not, that of the place that it was
     * at when the interaction began. */
    virtual bool
    is_unilateral() const
    {
      return true;
    }

    /** Whether all components are constrained, or only that along n: M = 1 or
     * n ⊗ n in the consistency terms (InteractionTerm). */
    virtual bool
    constrains_tangent() const
    {
      return false;
    }

  protected:
    /** The subsection of its parameters, for messages. */
    std::string section;
  };

  namespace internal
  {
    /** The projection with f = f_n(w_n) n + f_t, w_n = w·n, for laws whose
     * traction along n is max(0, w_n) or w_n: set f and its derivatives for the
     * former part. */
    template <int dim>
    void
    project_normal(const Tensor<1, dim>                     &w,
                   const Tensor<1, dim>                     &n,
                   typename InteractionLaw<dim>::Projection &result);
  } // namespace internal
} // namespace isochor

#endif
