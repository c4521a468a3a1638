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
#include <isochor/material_points/point_locator.h>

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Where each field of a material point stands in its block of particle
   * properties. The one layout that seeding, output, checkpoint and the
   * exchange between ranks share. A scene carries only the fields it needs.
   */
  struct PointLayout
  {
    unsigned int volume       = 0; ///< reference volume V_0 (m^dim)
    unsigned int mass         = 0; ///< kg
    unsigned int material     = 0; ///< index of the material
    unsigned int displacement = 0; ///< total displacement (m), dim components
    unsigned int F            = 0; ///< deformation gradient, dim x dim by rows
    unsigned int pressure = 0; ///< p, conjugate to θ (Pa), tension positive
    /** V_0 over what it was at t = 0, or what is left of that by splitting,
     * less 1; and behind it what the point remembers of its shear
     * (UnseenVolume); only in u-p, else 0. */
    unsigned int volume_gain  = 0;
    unsigned int stress       = 0; ///< Cauchy: xx, yy, zz, xy(, xz, yz) (Pa)
    unsigned int velocity     = 0; ///< m/s, only in dynamics
    unsigned int acceleration = 0; ///< m/s^2, only in dynamics
    /** What the acceleration exceeds that of the forces in the last step by
     * (m/s^2), see InertiaTerm; only if with_excess. */
    unsigned int excess      = 0;
    bool         with_excess = false;
    unsigned int history     = 0; ///< of the material, n_history components
    unsigned int n_history   = 0;
    bool         dynamic     = false;
    /** Corners 1 ... dim of the point's simplex domain at t = 0, relative to
     * the point (m), the first being minus their sum; only if with_domains. */
    unsigned int domain       = 0;
    bool         with_domains = false;
    /** The size of cells that the point asks for (m), 0: as it is; only on
     * adaptive grids. */
    unsigned int cell_size      = 0;
    bool         with_cell_size = false;
    /** Of a part of a seeded point: how its domain came from the whole one (see
     * Ancestry), or without domains the V_0 of the whole; 0 of a whole point.
     * Only on adaptive grids. */
    unsigned int ancestry      = 0;
    bool         with_ancestry = false;
    /** Which faces of the point's domain lie on the surface of the body, a sum
     * of 1 << c for the face opposite to corner c; only if with_surface. */
    unsigned int outer_faces  = 0;
    bool         with_surface = false;
    unsigned int n_properties = 0;
    /** Whether the plane is a section of a body of revolution, see
     * AxisymmetricMaterial. */
    bool axisymmetric = false;

    /** Whether the form is u-p. */
    bool
    mixed() const
    {
      return volume_gain > 0;
    }

    /** Where the vectors begin whose sums weighted with masses are conserved.
     */
    std::vector<unsigned int>
    vectors_by_mass() const
    {
      std::vector<unsigned int> fields;
      if (dynamic)
        fields = {velocity, acceleration};
      if (with_excess)
        fields.push_back(excess);
      return fields;
    }

    PointLayout() = default;
    PointLayout(const unsigned int dim,
                const unsigned int n_history,
                const bool         dynamic,
                const bool         with_domains   = false,
                const bool         with_cell_size = false,
                const bool         with_ancestry  = false,
                const bool         with_excess    = false,
                const bool         with_surface   = false,
                const bool         mixed          = false);
  };

  /** F of a point from its @p properties. */
  template <int dim>
  Tensor<2, dim>
  deformation_gradient(const double *properties, const PointLayout &layout)
  {
    Tensor<2, dim> F;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        F[i][j] = properties[layout.F + i * dim + j];
    return F;
  }

  /** By how much the domain of a point with @p properties would have to be
   * larger at t = 0, in each direction, to have its V_0 (UnseenVolume): F maps
   * that to the present one. */
  template <int dim>
  double
  domain_stretch(const double *properties, const PointLayout &layout)
  {
    const double gain = layout.mixed() ? properties[layout.volume_gain] : 0.;
    return gain == 0 ? 1. : std::pow(1 + gain, 1. / dim);
  }

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
    handler();
    const Particles::ParticleHandler<dim> &
    handler() const;
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

    /** Whether PointArrays copies what each iteration reads. In 3D it would be
     * a tenth of a point's memory, and assembly is less of the time. */
    static constexpr bool fields_are_copied = (dim == 2);
    /** Let the fields of @p arrays that aren't copied read the points. */
    void
    attach(PointArrays<dim> &arrays) const;
    /** Bring what a step changes at point @p q into @p arrays. */
    void
    read_state(const unsigned int             q,
               const Point<dim>              &location,
               const ArrayView<const double> &properties,
               PointArrays<dim>              &arrays) const;

    /** The domain of point @p q. */
    void
    gather_domain(const unsigned int             q,
                  const Point<dim>              &location,
                  const ArrayView<const double> &properties,
                  PointArrays<dim>              &arrays) const;

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
