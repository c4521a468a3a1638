/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/boundary_condition/body_surface_conditions.h>

namespace isochor
{
  template <int dim>
  void
  BodySurfaceConditions<dim>::initialize(const BackgroundGrid<dim> &grid)
  {
    if (conditions.surfaces.empty())
      return;
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



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 BodySurfaceConditions,
                                 "Surfaces of body")
} // namespace isochor
