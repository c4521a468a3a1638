/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_deal_ii_view_h
#define isochor_deal_ii_view_h

#include <deal.II/dofs/dof_handler.h>
#include <deal.II/hp/fe_collection.h>
#include <deal.II/hp/mapping_collection.h>
#include <deal.II/numerics/data_component_interpretation.h>

#include <isochor/equations/equation_term.h>

#include <string>
#include <vector>

namespace isochor
{
  /**
   * The nodal unknowns of a step as deal.II knows fields: a DoFHandler, the
   * vector that belongs to it, and what DataOut wants to know of its
   * components. For post-processors that use deal.II's own tools, such as
   * DataOut, VectorTools or KellyErrorEstimator; doc/plugins/deal_ii_tools.cc
   * is an example. Nothing of it exists unless somebody makes an object: the
   * program itself has no DoFHandler.
   *
   * The finite element is an FESystem of continuous linear elements,
   * displacement increments (m) and in the u-p form the pressure (Pa), on the
   * cells that hold material, active_fe_index() == 0, and an FE_Nothing with as
   * many components on all others, active_fe_index() == 1. So tools need their
   * hp versions: mapping collection, and quadrature collections of two. On an
   * FE_Nothing fields and gradients are zero: KellyErrorEstimator takes the
   * edge of the cells with material for one with zero normal derivatives.
   *
   * The object belongs to the step it is made in, that is to
   * Postprocessor::evaluate_nodes(). The cells are those of the undeformed
   * grid, whether it is kept or not (see GridReset).
   */
  template <int dim>
  class DealIIView
  {
  public:
    /** Distributes degrees of freedom. Collective. */
    DealIIView(const StepContext<dim> &step, const NodalField &unknowns);

    const DoFHandler<dim> &
    dof_handler() const
    {
      return dofs;
    }

    /** With all other degrees of freedom as ghosts: every rank knows the whole
     * grid, and tools such as KellyErrorEstimator go over all of it if they
     * aren't told a subdomain. */
    const LinearAlgebra::distributed::Vector<double> &
    solution() const
    {
      return values;
    }

    const hp::MappingCollection<dim> &
    mappings() const
    {
      return mapping_collection;
    }

    /** "displacement_increment" dim times, and "pressure". */
    std::vector<std::string>
    component_names() const;
    std::vector<DataComponentInterpretation::DataComponentInterpretation>
    component_interpretation() const;

  private:
    void
    mark_cells(const StepContext<dim> &step);
    void
    copy_values(const StepContext<dim> &step, const NodalField &unknowns);

    const unsigned int                         n_components;
    const hp::MappingCollection<dim>           mapping_collection;
    hp::FECollection<dim>                      elements;
    DoFHandler<dim>                            dofs;
    LinearAlgebra::distributed::Vector<double> values;
  };
} // namespace isochor

#endif
