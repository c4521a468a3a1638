/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/base/thickness.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/outer_faces.h>
#include <isochor/material_points/point_domain.h>
#include <isochor/material_points/point_reader.h>
#include <isochor/material_points/relocation.h>

#include <algorithm>
#include <utility>

namespace isochor
{
  template <int dim>
  MaterialPoints<dim>::MaterialPoints(const BackgroundGrid<dim> &grid)
    : grid(grid)
    , particles(std::make_unique<Particles::ParticleHandler<dim>>())
  {}



  template <int dim>
  void
  MaterialPoints<dim>::declare_parameters(ParameterHandler &prm)
  {
    BodySeeding<dim>::declare_parameters(prm);
    Bodies<dim>::declare_parameters(prm);
  }



  template <int dim>
  void
  MaterialPoints<dim>::parse_parameters(ParameterHandler &prm)
  {
    seeding.parse_parameters(prm);
    all_bodies.parse_parameters(prm);
  }



  template <int dim>
  void
  MaterialPoints<dim>::seed(
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
    const bool                                              dynamic,
    const std::string                                      &initial_velocity,
    const bool                                              with_domains,
    const bool                                              axisymmetric,
    const bool                                              mixed,
    const bool                                              with_excess,
    const std::function<void(const unsigned int)>          &make_layers)
  {
    unsigned int n_history = 0;
    dissipates.clear();
    for (const auto &material : materials)
      {
        n_history =
          std::max<unsigned int>(n_history, material->history_names().size());
        dissipates.push_back(mixed && material->dissipates());
      }
    if (std::count(dissipates.begin(), dissipates.end(), 1) == 0)
      dissipates.clear(); // none has to know its shear stress
    auto                            seeds = seeding.seeds(grid,
                               with_domains,
                               materials.size(),
                               has_one_field ? std::vector<std::string>() :
                                                                          all_bodies.zones());
    const std::vector<unsigned int> body_of_seed =
      divide_into_bodies(make_layers, seeds);
    const bool with_surface =
      with_domains && (keeps_surface || !body_of_seed.empty());
    if (with_surface)
      find_outer_faces(seeds, body_of_seed);
    point_layout              = PointLayout(dim,
                               n_history,
                               dynamic,
                               with_domains,
                               grid.is_adaptive(),
                               grid.is_adaptive(),
                               with_excess,
                               with_surface,
                               mixed);
    point_layout.axisymmetric = axisymmetric;
    forget_order();
    particles->initialize(grid.triangulation(),
                          grid.mapping(),
                          point_layout.n_properties);
    insert(seeds, materials);
    if (!initial_velocity.empty())
      set_velocity(initial_velocity);
  }



  template <int dim>
  std::vector<unsigned int>
  MaterialPoints<dim>::divide_into_bodies(
    const std::function<void(const unsigned int)> &make_layers,
    std::vector<Seed<dim>>                        &seeds)
  {
    const std::vector<unsigned int> body_of_seed =
      has_one_field ? std::vector<unsigned int>() : all_bodies.divide(seeds);
    AssertThrow(all_bodies.size() == 1 || make_layers,
                ExcMessage("The body can't be seeded anew in a scene of "
                           "several <Material points/Bodies>. Set <Adaptive "
                           "grid/Repetitions of first step = 0>."));
    if (make_layers)
      make_layers(all_bodies.size());
    for (unsigned int i = 0; i < body_of_seed.size(); ++i)
      seeds[i].cell = grid.cell_in_layer(seeds[i].cell, body_of_seed[i]);
    return body_of_seed;
  }



  template <int dim>
  void
  MaterialPoints<dim>::insert(
    const std::vector<Seed<dim>>                           &seeds,
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials)
  {
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    const SimplexGeometry<dim> &geometry = grid.geometry();
    std::vector<double>         properties(point_layout.n_properties);
    // arrays that grow by themselves take up to twice the memory
    const std::size_t n_own =
      std::count_if(seeds.begin(), seeds.end(), [&](const Seed<dim> &seed) {
        return geometry.owner(seed.cell) == rank;
      });
    particles->reserve(with_room_to_come(n_own, grid.communicator()));
    for (unsigned int i = 0; i < seeds.size(); ++i)
      {
        const Seed<dim> &seed = seeds[i];
        if (geometry.owner(seed.cell) != rank)
          continue;
        const unsigned int material = seed.material;
        std::fill(properties.begin(), properties.end(), 0.);
        properties[point_layout.volume] = seed.volume;
        properties[point_layout.mass] =
          thickness(point_layout.axisymmetric, seed.location[0]) * seed.volume *
          materials[material]->density();
        properties[point_layout.material] = material;
        for (unsigned int d = 0; d < dim; ++d)
          properties[point_layout.F + d * dim + d] = 1.;
        if (point_layout.n_history > 0)
          materials[material]->initialize_history(properties.data() +
                                                  point_layout.history);
        if (point_layout.with_domains)
          for (unsigned int c = 0; c < dim; ++c)
            for (unsigned int d = 0; d < dim; ++d)
              properties[point_layout.domain + c * dim + d] =
                seed.domain[c + 1][d];
        if (point_layout.with_surface)
          properties[point_layout.outer_faces] = seed.outer_faces;

        const Point<dim> reference = SimplexGeometry<dim>::reference_location(
          geometry.barycentric(seed.cell, seed.location));
        particles->insert_particle(seed.location,
                                   reference,
                                   i,
                                   geometry.cell_iterator(seed.cell),
                                   make_array_view(properties));
      }
    particles->update_cached_numbers();
  }



  template <int dim>
  void
  MaterialPoints<dim>::set_velocity(const std::string &formulas)
  {
    const std::string            name = "Dynamics/Initial velocity";
    std::vector<Expression<dim>> velocity;
    for (const auto &item : split_formulas(formulas, name))
      velocity.emplace_back(item, name, FormulaVariables::space);
    AssertThrow(velocity.size() == dim,
                ExcMessage("The parameter <" + name + "> needs " +
                           std::to_string(dim) + " components."));
    for (auto &particle : *particles)
      for (unsigned int d = 0; d < dim; ++d)
        particle.get_properties()[point_layout.velocity + d] =
          velocity[d](particle.get_location(), 0.);
  }



  template <int dim>
  void
  MaterialPoints<dim>::forget_order()
  {
    slots.reset();
    cell_start.clear();
  }



  template <int dim>
  std::vector<unsigned int>
  MaterialPoints<dim>::order_by_cell()
  {
    // the handler keeps the points of a cell together, cells in any order
    struct Group
    {
      unsigned int cell, first, n_points;
    };
    std::vector<Group>        groups;
    std::vector<unsigned int> handles;
    handles.reserve(particles->n_locally_owned_particles());
    for (const auto &particle : *particles)
      {
        const unsigned int cell =
          particle.get_surrounding_cell()->active_cell_index();
        if (groups.empty() || groups.back().cell != cell)
          groups.push_back(
            {cell, static_cast<unsigned int>(handles.size()), 0});
        ++groups.back().n_points;
        handles.push_back(particle.get_local_index());
      }
    std::sort(groups.begin(), groups.end(), [](const auto &a, const auto &b) {
      return a.cell < b.cell;
    });

    const auto                found = std::make_shared<PointSlots>();
    std::vector<unsigned int> cells;
    found->slot.reserve(handles.size());
    cells.reserve(groups.size());
    cell_start.reserve(groups.size() + 1);
    cell_start.assign(1, 0);
    for (const Group &group : groups)
      {
        const auto first = handles.begin() + group.first;
        found->slot.insert(found->slot.end(), first, first + group.n_points);
        cells.push_back(group.cell);
        cell_start.push_back(found->slot.size());
      }
    auto &pool = particles->get_property_pool();
    if (!handles.empty())
      found->properties = pool.get_properties(0).data();
    found->n_properties = pool.n_properties_per_slot();
    slots               = found;
    return cells;
  }



  template <int dim>
  void
  MaterialPoints<dim>::gather(PointArrays<dim> &arrays)
  {
    arrays.cell       = order_by_cell();
    arrays.cell_start = cell_start;
    const PointReader<dim> reader{point_layout, slots, dissipates};
    reader.resize(arrays, particles->n_locally_owned_particles());
    reader.attach(arrays);
    for_each([&](const unsigned int k,
                 const unsigned int q,
                 const Point<dim>  &location,
                 ArrayView<double>  properties) {
      arrays.shape[q] = grid.geometry().barycentric(arrays.cell[k], location);
      reader.read(q, location, properties, arrays);
      if (point_layout.with_surface)
        arrays.domain_corners.id[q] =
          particles->get_property_pool().get_id(slots->slot[q]);
    });
  }



  template <int dim>
  void
  MaterialPoints<dim>::update(PointArrays<dim> &arrays)
  {
    if (!slots) // a resumed run
      order_by_cell();
    const PointReader<dim> reader{point_layout, slots, dissipates};
    reader.attach(arrays);
    if (reader.copies_state())
      for_each([&](const unsigned int /*k*/,
                   const unsigned int q,
                   const Point<dim>  &location,
                   ArrayView<double>  properties) {
        reader.read_state(q, location, properties, arrays);
      });
  }



  template <int dim>
  types::particle_index
  MaterialPoints<dim>::relocate(const PointLocator<dim>          &locator,
                                const std::vector<unsigned char> &is_concerned)
  {
    forget_order();
    const RelocationReport<dim> report = isochor::relocate(
      particles, grid.mapping(), locator, is_concerned, n_out_of_order);
    if (report.n_lost > 0)
      throw_lost_points(grid, report, *particles);
    return report.n_moved;
  }



  template <int dim>
  void
  MaterialPoints<dim>::change_grid(
    const PointLocator<dim>                                    &locator,
    const std::function<std::unique_ptr<Triangulation<dim>>()> &change,
    const bool                                                  keep_points)
  {
    forget_order();
    n_out_of_order                  = 0;
    const unsigned int n_properties = particles->n_properties_per_particle();
    PointRecords<dim>  records =
      keep_points ? all_points(*particles) : PointRecords<dim>(n_properties);
    particles->clear_particles();
    const std::unique_ptr<Triangulation<dim>> old = change();
    // lets go of the old one
    particles->initialize(grid.triangulation(), grid.mapping(), n_properties);
    if (!keep_points)
      return;
    for (std::size_t i = 0; i < records.size(); ++i)
      {
        const auto place =
          locator.locate(records.locations[i],
                         grid.cells_after_change()[records.cells[i]]);
        AssertThrow(place.found, ExcInternalError());
        records.cells[i] = place.cell;
      }
    std::size_t             n_shipped;
    const PointRecords<dim> own =
      exchange_points(std::move(records), grid.geometry(), n_shipped);
    particles->reserve(with_room_to_come(own.size(), grid.communicator()));
    insert_particles(*particles, locator, own);
  }



  template <int dim>
  void
  MaterialPoints<dim>::change_owners(const PointLocator<dim>     &locator,
                                     const std::function<void()> &change)
  {
    forget_order();
    isochor::change_owners(
      particles, grid.mapping(), locator, change, n_out_of_order);
  }



  template <int dim>
  double
  MaterialPoints<dim>::kinetic_energy() const
  {
    const PointLayout &l   = point_layout;
    double             sum = 0;
    for (const auto &particle : *particles)
      for (unsigned int d = 0; d < dim; ++d)
        sum += particle.get_properties()[l.mass] / 2 *
               std::pow(particle.get_properties()[l.velocity + d], 2);
    return sum;
  }



  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace isochor
