/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/surface_checks.h>
#include <isochor/boundary_condition/surface_forces.h>

#include <algorithm>
#include <string>

namespace isochor
{
  /**
   * Loads on the surface of the body, wherever it is in the grid: dead loads
   * and follower pressures on boundary points, see SurfaceForces. Loads on a
   * boundary of the grid are loads on the surface
   * that the body has there at t = 0.
   */
  template <int dim>
  class BodySurfaceConditions : public BoundaryCondition<dim>,
                                public ActsByAssembly<dim>
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
    }

    void
    initialize(const BackgroundGrid<dim> &grid) override;
    void
    grid_changed(const BackgroundGrid<dim> &grid, const bool at_start) override;
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
             MixedSystem<dim>       &system) override;
    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override;

    bool
    has_symmetric_matrix() const override;
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
                       NodalField             &force) const override;
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const NodalConstraints &constraints,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override;

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
      points->load_state(regions(), state);
      seeded = true;
    }

  private:
    void
    seed(const BackgroundGrid<dim> &grid);
    std::vector<SurfaceRegion<dim>>
    regions() const;

    SurfaceConditions<dim>               conditions;
    const BodyShape<dim>                *shape = nullptr;
    const PointArrays<dim>              *body  = nullptr;
    std::unique_ptr<BoundaryPoints<dim>> points;
    bool                                 seeded = false;
    std::string                          description;
    /** By surface; empty but in the step in which they are seeded: the part of
     * the area of their faces that the body covers. */
    std::vector<double>                 covered_share;
    std::unique_ptr<SurfaceForces<dim>> forces;
  };



  template <int dim>
  void
  BodySurfaceConditions<dim>::initialize(const BackgroundGrid<dim> &grid)
  {
    conditions.find_boundaries(grid);
    if (!conditions.surfaces.empty())
      {
        points =
          std::make_unique<BoundaryPoints<dim>>(grid,
                                                conditions.points_per_face);
        forces = std::make_unique<SurfaceForces<dim>>(conditions, *points);
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::grid_changed(const BackgroundGrid<dim> & /*grid*/,
                                           const bool at_start)
  {
    if (!points || !seeded)
      return;
    if (at_start)
      {
        seeded = false; // as many as the new faces need
        covered_share.clear();
      }
    else
      points->change_grid();
  }



  template <int dim>
  std::vector<SurfaceRegion<dim>>
  BodySurfaceConditions<dim>::regions() const
  {
    std::vector<SurfaceRegion<dim>> places;
    for (const SurfaceCondition<dim> &surface : conditions.surfaces)
      places.push_back(surface.place);
    return places;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::seed(const BackgroundGrid<dim> &grid)
  {
    const std::vector<SurfaceRegion<dim>> places = regions();
    const auto                            found =
      points->are_on_domains(*body) ?
                                   points->find_on_domains(places, *body) :
                                   seed_surfaces(grid,
                      *shape,
                      union_over_ranks(body->cell, grid.communicator()),
                      places,
                      conditions.body_mesh);
    points->seed(places, found.faces, *body);
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
      seed(points->background_grid());
    points->locate(*body);
    points->touch_vertices(vertices);
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::collect_elements(const StepContext<dim> &step,
                                               ElementNodes           &elements)
  {
    if (!points)
      return;
    const std::string mesh = this->parameter("Mesh of body surfaces");
    warn_of_surfaces_off_the_body(step, conditions, covered_share, mesh);
    covered_share.clear();
    std::vector<unsigned int> nodes;
    for (unsigned int b = 0; b < points->size(); ++b)
      if (forces->has_element(b))
        {
          const auto stencil = points->stencil(b);
          nodes.clear();
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            nodes.push_back(step.nodes.node(stencil.vertex[I]));
          elements.add(nodes.begin(), nodes.end());
        }
  }



  template <int dim>
  EvaluationStatus
  BodySurfaceConditions<dim>::assemble(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       const NodalField       &pending,
                                       const unsigned int      first_element,
                                       const bool              with_matrix,
                                       MixedSystem<dim>       &system)
  {
    typename SurfaceForces<dim>::PointElement element;
    unsigned int                              e = first_element;
    for (unsigned int b = 0; points && b < points->size(); ++b)
      if (forces->has_element(b))
        {
          const EvaluationStatus status =
            forces->evaluate_point(step, unknowns, b, with_matrix, element);
          if (status != EvaluationStatus::success)
            return status;
          system.add_element(e++,
                             element.residual.data(),
                             with_matrix ? element.matrix.data() : nullptr,
                             pending);
        }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_external_force(const StepContext<dim> &step,
                                                 NodalField &force) const
  {
    if (points)
      forces->add_dead_loads(step, force);
  }



  template <int dim>
  bool
  BodySurfaceConditions<dim>::has_symmetric_matrix() const
  {
    return std::all_of(conditions.surfaces.begin(),
                       conditions.surfaces.end(),
                       [](const auto &s) { return s.pressure.empty(); });
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_boundary_force(const StepContext<dim> &step,
                                                 const NodalField &unknowns,
                                                 NodalField       &force) const
  {
    typename SurfaceForces<dim>::PointElement element;
    for (unsigned int b = 0; points && b < points->size(); ++b)
      if (forces->has_element(b))
        {
          // what can't be evaluated stops assemble(), too
          if (forces->evaluate_point(step, unknowns, b, false, element) !=
              EvaluationStatus::success)
            return;
          const auto nodes = points->stencil(b);
          for (unsigned int I = 0; I < nodes.n_nodes; ++I)
            for (unsigned int a = 0; a < step.n_components; ++a)
              force.local_element(
                step.nodes.node(nodes.vertex[I]) * step.n_components + a) -=
                element.residual[I * step.n_components + a];
        }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::evaluate(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       const MixedSystem<dim> & /*system*/,
                                       const NodalConstraints &constraints,
                                       Statistics             &statistics) const
  {
    if (points)
      warn_of_loads_on_supports(
        step, unknowns, conditions, *points, *forces, constraints);
    // <Traction> may load a boundary that <Surfaces of body> has, too
    for (const SurfaceCondition<dim> &surface : conditions.surfaces)
      {
        const std::string      &name = surface.place.name;
        std::array<double, dim> force{};
        for (unsigned int b = 0; b < points->size(); ++b)
          if (forces->condition_at(b).place.name == name)
            {
              const Tensor<1, dim> f = forces->load(step, unknowns, b);
              for (unsigned int a = 0; a < dim; ++a)
                force[a] += f[a];
            }
        sum_over_ranks(force, step.grid.communicator());
        for (unsigned int a = 0; a < dim; ++a)
          statistics.set(std::string("Load ") + "xyz"[a] + " on " + name +
                           " (N)",
                         force[a]);
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::advance(const StepContext<dim> &step,
                                      const NodalField       &unknowns)
  {
    if (points)
      points->advance(step, unknowns);
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 BodySurfaceConditions,
                                 "Surfaces of body")
} // namespace isochor
