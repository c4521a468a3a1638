/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/boundary_points.h>
#include <isochor/boundary_condition/surface_checks.h>

#include <algorithm>
#include <string>
#include <utility>

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
    check_scene(const StepContext<dim> &step) const override;

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
    bool
    supports_body(const Tensor<1, dim> & /*gravity*/) const override
    {
      return !conditions.surfaces.empty();
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
      typename SurfaceForces<dim>::Surfaces surfaces;
      for (const SurfaceCondition<dim> &surface : conditions.surfaces)
        surfaces.push_back(&surface.load);
      SurfaceForces<dim>::evaluate(
        surfaces, step, unknowns, constraints, statistics);
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

  private:
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
    /** By surface; empty but in the step in which they are seeded: the part of
     * the area of their faces that the body covers. */
    std::vector<double> covered_share;
  };



  template <int dim>
  void
  BodySurfaceConditions<dim>::initialize(const BackgroundGrid<dim> &grid)
  {
    if (conditions.surfaces.empty())
      return;
    AssertThrow(!grid.is_adaptive(),
                ExcMessage("The load of the parameter <" +
                           conditions.surfaces[0].load.parameter +
                           "> on a grid that adapts needs <Quadrature/Type = "
                           "CPDI>: other quadratures have no faces that "
                           "follow the cells' sizes."));
    this->grid = &grid;
    conditions.find_boundaries(grid);
    points =
      std::make_unique<BoundaryPoints<dim>>(grid, conditions.points_per_face);
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::seed()
  {
    std::vector<SurfaceRegion<dim>> places;
    for (const SurfaceCondition<dim> &surface : conditions.surfaces)
      places.push_back(surface.place);
    const auto found =
      seed_surfaces(*grid,
                    *shape,
                    union_over_ranks(body->cell, grid->communicator()),
                    places,
                    conditions.body_mesh);
    points->seed(found.faces);
    covered_share = found.covered;
    for (unsigned int s = 0; s < places.size(); ++s)
      covered_share[s] /= found.candidate[s];
    description = describe_surfaces(found, places);
    seeded      = true;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::check_scene(const StepContext<dim> &step) const
  {
    warn_of_places_without_comparison(step, conditions);
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::touch_vertices(
    std::vector<unsigned int> &vertices)
  {
    if (!points)
      return;
    if (!seeded)
      seed();
    points->locate(*body);
    points->touch_vertices(vertices);
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::collect_elements(const StepContext<dim> &step,
                                               ElementNodes           &elements)
  {
    warn_of_surfaces_off_the_body(step,
                                  conditions,
                                  covered_share,
                                  this->parameter("Mesh of body surfaces"));
    covered_share.clear();
    SurfaceForces<dim>::collect_elements(step, elements);
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 BodySurfaceConditions,
                                 "Surfaces of body")
} // namespace isochor
