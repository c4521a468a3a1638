/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_nodal_unknowns_h
#define isochor_nodal_unknowns_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <isochor/equations/active_nodes.h>

namespace isochor
{
  /** ΔF = 1 + Σ_I Δu_I ⊗ ∇_n N_I over @p n_nodes nodes with the gradients
   * @p gradient; @p increment(I) is Δu_I. */
  template <int dim, typename Increment>
  Tensor<2, dim>
  deformation_increment(const unsigned int          n_nodes,
                        const Increment            &increment,
                        const Tensor<1, dim> *const gradient)
  {
    Tensor<2, dim> F = unit_symmetric_tensor<dim>();
    for (unsigned int I = 0; I < n_nodes; ++I)
      F += outer_product(increment(I), gradient[I]);
    return F;
  }

  /**
   * The nodal unknowns of a step, to be read: displacement increments and, in
   * the u-p form, pressures. Everything that interpolates them does it through
   * this class, which knows where they stand in a NodalField.
   *
   * A stencil is a list of nodes with N_I and ∇_n N_I at a point: that of
   * PointArrays or of BoundaryPoints. All of its nodes must be active.
   */
  template <int dim>
  class NodalUnknowns
  {
  public:
    /** @p step is a StepContext; both must outlive this object. @p unknowns has
     * its ghosts updated. */
    template <typename Step>
    NodalUnknowns(const Step &step, const NodalField &unknowns)
      : nodes(step.nodes)
      , n_components(step.n_components)
      , values(unknowns.begin())
    {}

    /** Whether the node at @p vertex takes part in the step. */
    bool
    is_active(const unsigned int vertex) const
    {
      return nodes.node(vertex) != numbers::invalid_unsigned_int;
    }

    /** Δu (m) at the node at @p vertex. */
    Tensor<1, dim>
    increment(const unsigned int vertex) const
    {
      const double *const nodal = at(vertex);
      Tensor<1, dim>      u;
      for (unsigned int a = 0; a < dim; ++a)
        u[a] = nodal[a];
      return u;
    }

    /** p (Pa) there; only in the u-p form. */
    double
    pressure(const unsigned int vertex) const
    {
      return at(vertex)[dim];
    }

    /** Fill the nodal values of a kernel's @p element with those at
     * @p vertices. */
    template <typename Element>
    void
    gather(const unsigned int        n_nodes,
           const unsigned int *const vertices,
           Element                  &element) const
    {
      for (unsigned int I = 0; I < n_nodes; ++I)
        {
          const double *const nodal = at(vertices[I]);
          for (unsigned int a = 0; a < dim; ++a)
            element.increment[I][a] = nodal[a];
          if (Element::mixed)
            element.pressure[I] = nodal[dim];
        }
    }

    /** Δu at the point of @p stencil, Σ N_I Δu_I. */
    template <typename Stencil>
    Tensor<1, dim>
    increment_at(const Stencil &stencil) const
    {
      Tensor<1, dim> u;
      for (unsigned int I = 0; I < stencil.n_nodes; ++I)
        u += stencil.shape[I] * increment(stencil.vertex[I]);
      return u;
    }

    /** p at the point of @p stencil, Σ N_I p_I; 0 in the u form. */
    template <typename Stencil>
    double
    pressure_at(const Stencil &stencil) const
    {
      double p = 0;
      if (n_components == dim + 1)
        for (unsigned int I = 0; I < stencil.n_nodes; ++I)
          p += stencil.shape[I] * pressure(stencil.vertex[I]);
      return p;
    }

    /** ∇_n Δu at the point of @p stencil. */
    template <typename Stencil>
    Tensor<2, dim>
    gradient_at(const Stencil &stencil) const
    {
      Tensor<2, dim> gradient;
      for (unsigned int I = 0; I < stencil.n_nodes; ++I)
        gradient +=
          outer_product(increment(stencil.vertex[I]), stencil.gradient[I]);
      return gradient;
    }

    /** ΔF at the point of @p stencil. */
    template <typename Stencil>
    Tensor<2, dim>
    deformation_at(const Stencil &stencil) const
    {
      return deformation_increment<dim>(
        stencil.n_nodes,
        [&](const unsigned int I) { return increment(stencil.vertex[I]); },
        stencil.gradient);
    }

    /** r_{n+1} / r_n = 1 + Σ N_I Δu_r,I / r_n at point @p q of @p points, whose
     * stencil is @p stencil; 1 if the body is not one of revolution. */
    template <typename Points, typename Stencil>
    double
    hoop_at(const Stencil     &stencil,
            const Points      &points,
            const unsigned int q) const
    {
      return points.radius.empty() ?
               1. :
               1 + increment_at(stencil)[0] / points.radius[q];
    }

  private:
    const double *
    at(const unsigned int vertex) const
    {
      Assert(is_active(vertex), ExcInternalError());
      return values + nodes.node(vertex) * n_components;
    }

    const ActiveNodes<dim> &nodes;
    const unsigned int      n_components;
    const double *const     values;
  };
} // namespace isochor

#endif
