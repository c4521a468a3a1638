/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_material_points_h
#define isochor_material_points_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>
#include <deal.II/particles/particle_handler.h>

#include <isochor/grid/background_grid.h>
#include <isochor/material_model/material_model.h>
#include <isochor/material_model/tensor_tools.h>
#include <isochor/material_points/bodies.h>
#include <isochor/material_points/body_seeding.h>
#include <isochor/material_points/point_arrays.h>
#include <isochor/material_points/point_layout.h>
#include <isochor/material_points/point_locator.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Thrown on all ranks if points left the grid. */
  class ExcPointsLeftGrid : public StandardExceptions::ExcMessage
  {
  public:
    /** @p boundaries are the names of those that points have crossed. */
    ExcPointsLeftGrid(const std::string              &message,
                      const std::vector<std::string> &boundaries)
      : StandardExceptions::ExcMessage(message)
      , boundaries(boundaries)
    {}

    const std::vector<std::string> boundaries;
  };

  /** How many materials there may be: their index is an unsigned char. */
  constexpr unsigned int max_materials = 256;

  /** The body: owner of the ParticleHandler that stores the points. */
  template <int dim>
  class MaterialPoints
  {
  public:
    MaterialPoints(const BackgroundGrid<dim> &grid);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** See BodySeeding::check_numbers(). */
    void
    check_numbers(const bool with_domains) const
    {
      seeding.check_numbers(with_domains);
    }

    /** Fill the body with points. Throws if none lies in the grid. @p mixed:
     * the form is u-p. */
    void
    seed(const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
         const bool                                              dynamic,
         const std::string                             &initial_velocity,
         const bool                                     with_domains = false,
         const bool                                     axisymmetric = false,
         const bool                                     mixed        = false,
         const bool                                     with_excess  = false,
         const std::function<void(const unsigned int)> &make_layers  = {});

    /** The bodies that the points belong to, by layer of the grid. */
    const Bodies<dim> &
    bodies() const
    {
      return all_bodies;
    }

    /** The number of the body that a point belongs to, which is the layer of
     * its cell. */
    unsigned int
    body_of(const Particles::ParticleAccessor<dim> &particle) const
    {
      return grid.layer_of_cell(
        particle.get_surrounding_cell()->active_cell_index());
    }

    /** Points that are seeded from now on, with domains, know which faces of
     * these are on the surface of the body (PointArrays::outer_faces); those of
     * several bodies do anyway. */
    void
    keep_surface()
    {
      keeps_surface = true;
    }

    /** See Bodies::set_periods(). */
    void
    set_periods(const std::vector<Tensor<1, dim>> &periods)
    {
      all_bodies.set_periods(periods);
    }

    /** Bodies that have no interactions share the nodes of one grid. */
    void
    share_fields()
    {
      has_one_field = true;
    }

    /** How they were placed. */
    const BodySeeding<dim> &
    body_seeding() const
    {
      return seeding;
    }

    /**
     * Let @p change replace the mesh of the grid (it returns what
     * BackgroundGrid::change() does), and put the points into the new cells.
     * They must lie in the cells that they are in. Not @p keep_points: there
     * are none afterwards, to be seeded anew. Collective.
     */
    void
    change_grid(
      const PointLocator<dim>                                    &locator,
      const std::function<std::unique_ptr<Triangulation<dim>>()> &change,
      const bool keep_points = true);

    /**
     * Let @p change give the cells other owners (BackgroundGrid::set_owners()),
     * and bring the points to them. They must lie in the cells that they are
     * in. Collective.
     */
    void
    change_owners(const PointLocator<dim>     &locator,
                  const std::function<void()> &change);

    /** Bring the points into @p arrays, ordered by cell. Some of their fields
     * are not copied, see PointField. */
    void
    gather(PointArrays<dim> &arrays);

    /** Bring what a step changes (F, pressure, history, velocity, acceleration)
     * into @p arrays, which gather() has filled since the points were last
     * located. */
    void
    update(PointArrays<dim> &arrays);

    /**
     * Call @p update(k, q, location, properties) for each point q of each
     * occupied cell k in the order of the last gather(). It may change the
     * location and the properties.
     */
    template <typename Function>
    void
    for_each(const Function &update)
    {
      auto &pool = particles->get_property_pool();
      for (unsigned int k = 0; k + 1 < cell_start.size(); ++k)
        for (unsigned int q = cell_start[k]; q < cell_start[k + 1]; ++q)
          {
            slots->prefetch(q, 0, slots->n_properties);
            const auto handle   = slots->slot[q];
            Point<dim> location = pool.get_location(handle);
            update(k, q, location, pool.get_properties(handle));
            pool.set_location(handle, location);
          }
    }

    /** Call @p look(q, properties) for each of them, in the same order. */
    template <typename Function>
    void
    look_at_each(const Function &look) const
    {
      auto &pool = particles->get_property_pool();
      for (unsigned int q = 0; !cell_start.empty() && q < cell_start.back();
           ++q)
        look(q, ArrayView<const double>(pool.get_properties(slots->slot[q])));
    }

    /** Bring every point to the cell and rank where it now lies.
     * @throws ExcPointsLeftGrid if points left the grid, saying where; they are
     * then kept in the cells they were in. Points of cells for which
     * @p is_concerned is 0 have not moved since this was called last; empty:
     * all may have. Collective. */
    types::particle_index
    relocate(const PointLocator<dim>          &locator,
             const std::vector<unsigned char> &is_concerned = {});

    Particles::ParticleHandler<dim> &
    handler()
    {
      return *particles;
    }
    const Particles::ParticleHandler<dim> &
    handler() const
    {
      return *particles;
    }
    /** Of the points of this rank, with the velocities that they have (J); in
     * dynamics. */
    double
    kinetic_energy() const;
    const PointLayout &
    layout() const
    {
      return point_layout;
    }

  private:
    /** Order the points by cell: find slots and cell_start. Returns the
     * occupied cells, ascending. */
    std::vector<unsigned int>
    order_by_cell();
    /** Forget the order: points have been located anew. */
    void
    forget_order();

    /** Put each of @p seeds into the layer of its body, once @p make_layers
     * has made them. Returns the body of each, empty if there is one. */
    std::vector<unsigned int>
    divide_into_bodies(
      const std::function<void(const unsigned int)> &make_layers,
      std::vector<Seed<dim>>                        &seeds);
    void
    insert(const std::vector<Seed<dim>>                           &seeds,
           const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials);
    void
    set_velocity(const std::string &formulas);

    const BackgroundGrid<dim> &grid;
    BodySeeding<dim>           seeding;
    Bodies<dim>                all_bodies;
    bool                       keeps_surface = false;
    bool                       has_one_field = false;
    /** By number of the material, in u-p: whether it dissipates; empty if none
     * does. */
    std::vector<unsigned char> dissipates;
    PointLayout                point_layout;
    /** Another one after relocate(). */
    std::unique_ptr<Particles::ParticleHandler<dim>> particles;
    /** As PointArrays has them; null and empty if points have been located
     * since. */
    std::shared_ptr<const PointSlots> slots;
    std::vector<unsigned int>         cell_start;
    /** See isochor::relocate(). */
    std::size_t n_out_of_order = 0;
  };
} // namespace isochor

#endif
