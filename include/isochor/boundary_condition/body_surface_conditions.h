/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_surface_conditions_h
#define isochor_body_surface_conditions_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/boundary_condition/surface_conditions.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochor
{
  /**
   * Parts of the surface of the body that have a name, and loads on them,
   * wherever it is in the grid. Loads on a boundary of the grid are loads on
   * the surface that the body has there at t = 0. With CPDI the loads are
   * interactions (take_loads()), with other quadratures they act on
   * BoundaryPoints.
   */
  template <int dim>
  class BodySurfaceConditions : public BoundaryCondition<dim>,
                                public ActsByAssembly<dim>,
                                public HasSurfaceLoads<dim>,
                                public FindsLoadsOnSupports<dim>,
                                private SurfaceForces<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      SurfaceConditions<dim>::declare_parameters(prm);
    }
    void
    parse_parameters(ParameterHandler &prm) override
    {
      conditions.section = this->section;
      conditions.parse_parameters(prm);
      for (SurfaceCondition<dim> &surface : conditions.surfaces)
        surface.load.owner = this->instance;
    }
    std::vector<SurfaceCondition<dim>>
    take_loads() override
    {
      return std::exchange(conditions.surfaces, {});
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override;
    void
    set_body(const BodyShape<dim> &shape, const PointArrays<dim> &body) override
    {
      this->shape = &shape;
      this->body  = &body;
    }

    std::string
    describe() const override
    {
      return description;
    }

    void
    touch_vertices(std::vector<unsigned int> &vertices) override;
    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override
    {
      SurfaceForces<dim>::collect_elements(step, elements);
    }

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override
    {
      return SurfaceForces<dim>::assemble(
        step, unknowns, pending, first_element, with_matrix, system);
    }
    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override
    {
      this->add_dead_loads(step, force);
    }

    bool
    has_symmetric_matrix() const override
    {
      return std::all_of(conditions.surfaces.begin(),
                         conditions.surfaces.end(),
                         [](const auto &s) { return s.load.pressure.empty(); });
    }
    bool
    assembles_load(const StepContext<dim> & /*step*/) const override
    {
      return !has_symmetric_matrix();
    }
    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override
    {
      this->add_pressures(step, unknowns, force);
    }
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> & /*system*/,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override
    {
      SurfaceForces<dim>::evaluate(
        loads(), step, unknowns, constraints, statistics);
    }
    const std::vector<LoadOnSupport> &
    loads_on_supports() const override
    {
      return SurfaceForces<dim>::loads_on_supports();
    }
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override
    {
      if (points)
        points->advance(step, unknowns);
    }

    std::string
    save_state() const override
    {
      return seeded ? points->save_state() : std::string();
    }
    void
    load_state(const std::string &state) override
    {
      if (state.empty() || !points)
        return;
      points->load_state(state);
      seeded = true;
    }

    /** What the parameters say, but for loads that were taken. */
    const SurfaceConditions<dim> &
    parameters() const
    {
      return conditions;
    }
    /** By surface with a load, where they have been seeded and not read: the
     * part of the area of their faces that the body covers. */
    const std::vector<double> &
    covered_shares() const
    {
      return covered_share;
    }

  private:
    typename SurfaceForces<dim>::Surfaces
    loads() const
    {
      typename SurfaceForces<dim>::Surfaces all;
      for (const SurfaceCondition<dim> &surface : conditions.surfaces)
        all.push_back(&surface.load);
      return all;
    }
    unsigned int
    n_places() const override
    {
      return points ? points->size() : 0;
    }
    const SurfaceLoad<dim> &
    load_at(const unsigned int b) const override
    {
      return conditions.surfaces[points->surface(b)].load;
    }
    typename SurfaceForces<dim>::Place
    place(const unsigned int b) const override
    {
      return points->place(b);
    }
    void
    seed();

    SurfaceConditions<dim>               conditions;
    const BackgroundGrid<dim>           *grid  = nullptr;
    const BodyShape<dim>                *shape = nullptr;
    const PointArrays<dim>              *body  = nullptr;
    std::unique_ptr<BoundaryPoints<dim>> points;
    bool                                 seeded = false;
    std::string                          description;
    std::vector<double>                  covered_share;
  };
} // namespace isochor

#endif
