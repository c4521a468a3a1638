/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/expression.h>
#include <isochor/material_points.h>
#include <isochor/mesh_reader.h>
#include <isochor/relocation.h>
#include <isochor/seeding.h>

#include <algorithm>
#include <limits>
#include <map>
#include <sstream>

namespace isochor
{
  PointLayout::PointLayout(const unsigned int dim,
                           const unsigned int n_history,
                           const bool         dynamic,
                           const bool         with_domains,
                           const bool         with_cell_size)
    : n_history(n_history)
    , dynamic(dynamic)
    , with_domains(with_domains)
    , with_cell_size(with_cell_size)
  {
    const auto place = [this](unsigned int &field, const unsigned int size) {
      field = n_properties;
      n_properties += size;
    };
    place(volume, 1);
    place(mass, 1);
    place(material, 1);
    place(displacement, dim);
    place(F, dim * dim);
    place(pressure, 1);
    place(stress, dim == 2 ? 4 : 6);
    if (dynamic)
      {
        place(velocity, dim);
        place(acceleration, dim);
      }
    place(history, n_history);
    if (with_domains)
      place(domain, dim * dim);
    if (with_cell_size)
      place(cell_size, 1);
  }



  template <int dim>
  MaterialPoints<dim>::MaterialPoints(const BackgroundGrid<dim> &grid)
    : grid(grid)
  {}



  template <int dim>
  void
  MaterialPoints<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry("Points per cell",
                      dim == 2 ? "3" : "4",
                      Patterns::Integer(1),
                      "Material points seeded per cell: 1, 3, 4, 6, 7, 9, 12, "
                      "15, 16, ... in 2D, 1, 4, 8, 14, 27, 35, ... in 3D.");
    prm.declare_entry("Points per cell in zones",
                      "",
                      Patterns::Anything(),
                      "Other counts where a condition in x, y(, z) holds at "
                      "the cell's centre: 'count: condition; count: "
                      "condition'. The last that holds counts.");
    prm.declare_entry("Region",
                      "1",
                      Patterns::Anything(),
                      "The body: a condition in x, y(, z). Points are seeded "
                      "where it holds.");
    prm.declare_entry("Physical groups",
                      "",
                      Patterns::List(Patterns::Anything()),
                      "The names of the physical groups of cells that the body "
                      "fills: of 'Body mesh' if there is one, else of the "
                      "gmsh grid. Empty: all.");
    prm.declare_entry("Body mesh",
                      "",
                      Patterns::Anything(),
                      "A second gmsh .msh file, of the body: points are seeded "
                      "in its cells instead of the grid's.");
    prm.declare_entry("Lattice spacing",
                      "0",
                      Patterns::Double(0),
                      "If positive, points are seeded on a square lattice of "
                      "this spacing (m) instead of per cell: one per box, or "
                      "one per simplex of each box (2 in 2D, 6 in 3D) if "
                      "'Quadrature/Type' gives the points simplex domains.");
    prm.declare_entry("Materials in zones",
                      "",
                      Patterns::Anything(),
                      "Bodies of several materials: 'number: condition; ...'. "
                      "Material 1 is the subsection 'Material', k > 1 the "
                      "subsection 'Material k'. The last condition that holds "
                      "counts; 1 elsewhere.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  MaterialPoints<dim>::parse_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    parameters.points_per_cell = prm.get_integer("Points per cell");
    parameters.zones           = prm.get("Points per cell in zones");
    parameters.region          = prm.get("Region");
    parameters.groups =
      Utilities::split_string_list(prm.get("Physical groups"));
    parameters.body_mesh       = prm.get("Body mesh");
    parameters.lattice_spacing = prm.get_double("Lattice spacing");
    parameters.material_zones  = prm.get("Materials in zones");
    prm.leave_subsection();
    check_combinations();
    // fail now and not after an hour of meshing
    material_point_rule<dim>(parameters.points_per_cell);
    Expression<dim>(parameters.region,
                    "Material points/Region",
                    FormulaVariables::space);
  }



  template <int dim>
  void
  MaterialPoints<dim>::check_combinations() const
  {
    const bool lattice = parameters.lattice_spacing > 0;
    AssertThrow(!lattice || parameters.body_mesh.empty(),
                ExcMessage("The parameters <Material points/Lattice spacing> "
                           "and <Material points/Body mesh> are two ways to "
                           "place the points. Leave one out."));
    AssertThrow(!lattice || parameters.zones.empty(),
                ExcMessage("The parameter <Material points/Points per cell in "
                           "zones> can't be used with <Material points/Lattice "
                           "spacing>, which places the points without regard "
                           "to cells. Leave one out."));
  }



  template <int dim>
  void
  MaterialPoints<dim>::seed(
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials,
    const bool                                              dynamic,
    const std::string                                      &initial_velocity,
    const bool                                              with_domains)
  {
    unsigned int n_history = 0;
    for (const auto &material : materials)
      n_history =
        std::max<unsigned int>(n_history, material->history_names().size());
    point_layout =
      PointLayout(dim, n_history, dynamic, with_domains, grid.is_adaptive());
    groups.clear();
    particles.initialize(grid.triangulation(),
                         grid.mapping(),
                         point_layout.n_properties);

    std::vector<Seed> seeds =
      !parameters.body_mesh.empty() ?
        seeds_in_body_mesh() :
      parameters.lattice_spacing > 0 ?
        seeds_on_lattice() :
        seeds_in_cells(grid.geometry(), grid.group_ids());
    const Expression<dim> in_body(parameters.region, "Material points/Region");
    seeds.erase(std::remove_if(seeds.begin(),
                               seeds.end(),
                               [&](const Seed &seed) {
                                 return !(in_body(seed.location, 0.) > 0);
                               }),
                seeds.end());
    AssertThrow(!seeds.empty(),
                ExcMessage("No material point lies in the grid. Check the "
                           "parameters of <Material points>, which describe "
                           "the body, against those of <Grid>."));
    insert(seeds, materials);
    if (!initial_velocity.empty())
      set_velocity(initial_velocity);
  }



  template <int dim>
  std::vector<typename MaterialPoints<dim>::Seed>
  MaterialPoints<dim>::seeds_in_cells(
    const SimplexGeometry<dim>                      &geometry,
    const std::map<std::string, types::material_id> &group_ids) const
  {
    struct Zone
    {
      Quadrature<dim>                 rule;
      std::vector<CornerVectors<dim>> domains;
      Expression<dim>                 condition;
    };
    std::vector<Zone> zones;
    const auto        add_zone = [&zones](const unsigned int     n_points,
                                   const Expression<dim> &condition) {
      zones.push_back({material_point_rule<dim>(n_points),
                       material_point_domains<dim>(n_points),
                       condition});
    };
    add_zone(parameters.points_per_cell, Expression<dim>("1", ""));
    for (const auto &zone :
         split_named_list(parameters.zones,
                          "Material points/Points per cell in zones"))
      add_zone(Utilities::string_to_int(zone.first),
               Expression<dim>(zone.second,
                               "Material points/Points per cell in zones",
                               FormulaVariables::space));

    std::vector<Seed> seeds;
    for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
      {
        if (!in_groups(geometry.cell_iterator(cell)->material_id(),
                       parameters.groups,
                       group_ids))
          continue;
        std::array<Point<dim>, dim + 1> corners;
        Point<dim>                      centre;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            corners[v] = geometry.vertices()[geometry.vertex_indices(cell)[v]];
            centre += corners[v] / (dim + 1.);
          }
        unsigned int zone = zones.size() - 1;
        while (zone > 0 && !(zones[zone].condition(centre, 0.) > 0))
          --zone;
        const Quadrature<dim> &rule = zones[zone].rule;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Seed seed{corners[0],
                      cell,
                      rule.weight(q) * geometry.measure(cell),
                      {}};
            for (unsigned int d = 0; d < dim; ++d)
              {
                const Tensor<1, dim> edge = corners[d + 1] - corners[0];
                seed.location += rule.point(q)[d] * edge;
                for (unsigned int c = 0; c <= dim; ++c)
                  seed.domain[c] += zones[zone].domains[q][c][d] * edge;
              }
            seeds.push_back(seed);
          }
      }
    return seeds;
  }



  template <int dim>
  std::vector<typename MaterialPoints<dim>::Seed>
  MaterialPoints<dim>::seeds_in_body_mesh() const
  {
    Triangulation<dim> body;
    const MeshGroups   names =
      read_mesh<dim>(parameters.body_mesh, "Material points/Body mesh", body);
    const SimplexGeometry<dim> geometry(body);
    std::vector<Seed>          seeds = seeds_in_cells(geometry, names.cells);
    locate(seeds);
    return seeds;
  }



  template <int dim>
  std::vector<typename MaterialPoints<dim>::Seed>
  MaterialPoints<dim>::seeds_on_lattice() const
  {
    const double h = parameters.lattice_spacing;
    Point<dim>   lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::numeric_limits<double>::max();
        upper[d] = std::numeric_limits<double>::lowest();
      }
    for (const Point<dim> &vertex : grid.geometry().vertices())
      for (unsigned int d = 0; d < dim; ++d)
        {
          lower[d] = std::min(lower[d], vertex[d]);
          upper[d] = std::max(upper[d], vertex[d]);
        }
    std::array<unsigned int, dim> n;
    double                        n_boxes = 1;
    for (unsigned int d = 0; d < dim; ++d)
      n_boxes *= std::ceil((upper[d] - lower[d]) / h - 1e-10);
    std::ostringstream number;
    number << n_boxes;
    AssertThrow(n_boxes < std::numeric_limits<int>::max(),
                ExcMessage("The lattice of the parameter <Material "
                           "points/Lattice spacing> has " +
                           number.str() +
                           " boxes in the extent of the grid: are <Grid> and "
                           "the spacing in the same unit?"));
    for (unsigned int d = 0; d < dim; ++d)
      n[d] = std::ceil((upper[d] - lower[d]) / h - 1e-10);
    const unsigned int n_points = n_boxes;
    // one point in the middle of each box; where points carry simplex domains,
    // one in each simplex of the box, so that the domains tile the body
    std::vector<CornerVectors<dim>> domains(1);
    std::vector<Point<dim>>         places(1);
    for (unsigned int d = 0; d < dim; ++d)
      places[0][d] = 0.5;
    if (point_layout.with_domains)
      {
        domains.clear();
        places.clear();
        for (const auto &corners : box_simplices<dim>())
          {
            Point<dim> centroid;
            for (const Point<dim> &corner : corners)
              centroid += corner / (dim + 1.);
            places.push_back(centroid);
            domains.emplace_back();
            for (unsigned int c = 0; c <= dim; ++c)
              domains.back()[c] = h * (corners[c] - centroid);
          }
      }
    const Expression<dim> in_body(parameters.region, "Material points/Region");
    std::vector<Seed>     seeds;
    for (unsigned int i = 0; i < n_points; ++i)
      for (unsigned int s = 0; s < places.size(); ++s)
        {
          Seed seed{lower, 0, std::pow(h, dim) / places.size(), domains[s]};
          unsigned int rest = i;
          for (unsigned int d = 0; d < dim; ++d, rest /= n[d - 1])
            seed.location[d] += (rest % n[d] + places[s][d]) * h;
          if (in_body(seed.location, 0.) > 0)
            seeds.push_back(seed);
        }
    locate(seeds);
    seeds.erase(std::remove_if(seeds.begin(),
                               seeds.end(),
                               [&](const Seed &seed) {
                                 return !in_groups(grid.geometry()
                                                     .cell_iterator(seed.cell)
                                                     ->material_id(),
                                                   parameters.groups,
                                                   grid.group_ids());
                               }),
                seeds.end());
    return seeds;
  }



  template <int dim>
  void
  MaterialPoints<dim>::locate(std::vector<Seed> &seeds) const
  {
    const PointLocator<dim> locator(grid.geometry());
    std::vector<Seed>       located;
    unsigned int            hint = 0;
    for (Seed seed : seeds)
      {
        const auto place = locator.locate(seed.location, hint);
        if (!place.found)
          continue;
        hint = seed.cell = place.cell;
        located.push_back(seed);
      }
    AssertThrow(located.size() == seeds.size() || parameters.body_mesh.empty(),
                ExcMessage(std::to_string(seeds.size() - located.size()) +
                           " points of the body <" + parameters.body_mesh +
                           "> lie outside of the grid. The grid must cover "
                           "the body."));
    seeds.swap(located);
  }



  template <int dim>
  void
  MaterialPoints<dim>::insert(
    const std::vector<Seed>                                &seeds,
    const std::vector<std::unique_ptr<MaterialModel<dim>>> &materials)
  {
    std::vector<std::pair<unsigned int, Expression<dim>>> zones;
    for (const auto &zone :
         split_named_list(parameters.material_zones,
                          "Material points/Materials in zones"))
      {
        const unsigned int number = Utilities::string_to_int(zone.first);
        AssertThrow(number >= 1 && number <= materials.size(),
                    ExcMessage("The parameter <Material points/Materials in "
                               "zones> names material " +
                               zone.first + ", but there are " +
                               std::to_string(materials.size()) + "."));
        zones.emplace_back(number - 1,
                           Expression<dim>(zone.second,
                                           "Material points/Materials in "
                                           "zones",
                                           FormulaVariables::space));
      }

    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid.communicator());
    const SimplexGeometry<dim> &geometry = grid.geometry();
    std::vector<double>         properties(point_layout.n_properties);
    for (unsigned int i = 0; i < seeds.size(); ++i)
      {
        const Seed &seed = seeds[i];
        if (geometry.owner(seed.cell) != rank)
          continue;
        unsigned int material = 0;
        for (const auto &zone : zones)
          if (zone.second(seed.location, 0.) > 0)
            material = zone.first;

        std::fill(properties.begin(), properties.end(), 0.);
        properties[point_layout.volume] = seed.volume;
        properties[point_layout.mass] =
          seed.volume * materials[material]->density();
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

        const Point<dim> reference = SimplexGeometry<dim>::reference_location(
          geometry.barycentric(seed.cell, seed.location));
        particles.insert_particle(seed.location,
                                  reference,
                                  i,
                                  geometry.cell_iterator(seed.cell),
                                  make_array_view(properties));
      }
    particles.update_cached_numbers();
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
    for (auto &particle : particles)
      for (unsigned int d = 0; d < dim; ++d)
        particle.get_properties()[point_layout.velocity + d] =
          velocity[d](particle.get_location(), 0.);
  }



  template <int dim>
  void
  MaterialPoints<dim>::group_by_cell()
  {
    // the handler keeps the points of a cell together, cells in any order
    groups.clear();
    for (auto particle = particles.begin(); particle != particles.end();
         ++particle)
      {
        const unsigned int cell =
          particle->get_surrounding_cell()->active_cell_index();
        if (groups.empty() || groups.back().cell != cell)
          groups.push_back({cell, particle, 0});
        ++groups.back().n_points;
      }
    std::sort(groups.begin(), groups.end(), [](const auto &a, const auto &b) {
      return a.cell < b.cell;
    });
  }



  template <int dim>
  template <typename Function>
  void
  MaterialPoints<dim>::for_each_in_arrays(const Function &copy) const
  {
    unsigned int q = 0;
    for (const Group &group : groups)
      {
        auto particle = group.first;
        for (unsigned int i = 0; i < group.n_points; ++i, ++particle, ++q)
          copy(q,
               group.cell,
               particle->get_location(),
               particle->get_properties().data());
      }
  }



  template <int dim>
  void
  MaterialPoints<dim>::gather(PointArrays<dim> &arrays)
  {
    group_by_cell();
    const unsigned int n = particles.n_locally_owned_particles();
    arrays.n_history     = point_layout.n_history;
    arrays.cell.clear();
    arrays.cell_start.assign(1, 0);
    for (const Group &group : groups)
      {
        arrays.cell.push_back(group.cell);
        arrays.cell_start.push_back(arrays.cell_start.back() + group.n_points);
      }
    arrays.n_occupied_cells = arrays.cell.size();
    arrays.deformed_cell.clear();
    arrays.stencil_start.clear();
    arrays.corner_cells.clear();
    arrays.shape.resize(n);
    arrays.volume.resize(n);
    arrays.mass.resize(n);
    arrays.weight.resize(n);
    arrays.pressure.resize(n);
    arrays.F.resize(n);
    arrays.material.resize(n);
    arrays.history.resize(n * std::size_t(point_layout.n_history));
    arrays.velocity.resize(point_layout.dynamic ? n : 0);
    arrays.acceleration.resize(point_layout.dynamic ? n : 0);
    arrays.domain.resize(point_layout.with_domains ? n : 0);

    const PointLayout &l = point_layout;
    for_each_in_arrays([&](const unsigned int q,
                           const unsigned int cell,
                           const Point<dim>  &location,
                           const double      *properties) {
      arrays.shape[q]    = grid.geometry().barycentric(cell, location);
      arrays.volume[q]   = properties[l.volume];
      arrays.mass[q]     = properties[l.mass];
      arrays.weight[q]   = properties[l.volume];
      arrays.material[q] = static_cast<unsigned char>(properties[l.material]);
      if (!l.with_domains)
        return;
      arrays.domain[q][0] = Tensor<1, dim>();
      for (unsigned int c = 0; c < dim; ++c)
        {
          for (unsigned int d = 0; d < dim; ++d)
            arrays.domain[q][c + 1][d] = properties[l.domain + c * dim + d];
          arrays.domain[q][0] -= arrays.domain[q][c + 1];
        }
    });
    update(arrays);
  }



  template <int dim>
  void
  MaterialPoints<dim>::update(PointArrays<dim> &arrays)
  {
    if (groups.empty()) // a resumed run
      group_by_cell();
    const PointLayout &l = point_layout;
    for_each_in_arrays([&](const unsigned int q,
                           const unsigned int /*cell*/,
                           const Point<dim> & /*location*/,
                           const double *properties) {
      arrays.pressure[q] = properties[l.pressure];
      arrays.F[q]        = deformation_gradient<dim>(properties, l);
      std::copy_n(properties + l.history,
                  l.n_history,
                  arrays.history.data() + q * std::size_t(l.n_history));
      if (l.dynamic)
        for (unsigned int d = 0; d < dim; ++d)
          {
            arrays.velocity[q][d]     = properties[l.velocity + d];
            arrays.acceleration[q][d] = properties[l.acceleration + d];
          }
    });
  }



  template <int dim>
  void
  MaterialPoints<dim>::relocate(const PointLocator<dim> &locator)
  {
    groups.clear();
    const RelocationReport<dim> report = isochor::relocate(particles, locator);
    if (report.n_lost == 0)
      return;

    constexpr std::size_t               most = 3; // places to list
    std::string                         places;
    std::map<std::string, unsigned int> n_through;
    for (std::size_t i = 0; i < report.lost.size(); ++i)
      {
        const Point<dim> &x = report.lost.locations[i];
        ++n_through[grid.boundary_crossed(report.lost.cells[i], x)];
        std::ostringstream place;
        place << " Point " << report.lost.ids[i] << " is at (" << x << ").";
        if (i < most)
          places += place.str();
        // kept, so that the state can be looked at
        particles.insert_particle(
          x,
          SimplexGeometry<dim>::reference_location(
            grid.geometry().barycentric(report.lost.cells[i], x)),
          report.lost.ids[i],
          grid.geometry().cell_iterator(report.lost.cells[i]),
          report.lost.payload(i));
      }
    particles.update_cached_numbers();

    std::map<std::string, unsigned int> n_through_all;
    std::string                         all_places, boundaries;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), n_through))
      for (const auto &entry : of_rank)
        n_through_all[entry.first] += entry.second;
    for (const auto &of_rank :
         Utilities::MPI::all_gather(grid.communicator(), places))
      all_places += of_rank;
    for (const auto &entry : n_through_all)
      boundaries += (boundaries.empty() ? "" : ", ") +
                    std::to_string(entry.second) + " through <" + entry.first +
                    ">";
    AssertThrow(false,
                ExcPointsLeftGrid(std::to_string(report.n_lost) +
                                  " material points left the background "
                                  "grid, " +
                                  boundaries + "." + all_places +
                                  " Enlarge the grid, or hold the body by "
                                  "boundary conditions."));
  }



  template <int dim>
  void
  MaterialPoints<dim>::change_grid(
    const PointLocator<dim>                                    &locator,
    const std::function<std::unique_ptr<Triangulation<dim>>()> &change)
  {
    groups.clear();
    const unsigned int n_properties = particles.n_properties_per_particle();
    PointRecords<dim>  records(n_properties);
    for (const auto &particle : particles)
      records.push_back(particle.get_surrounding_cell()->active_cell_index(),
                        particle.get_id(),
                        particle.get_location(),
                        particle.get_properties());
    particles.clear_particles();
    const std::unique_ptr<Triangulation<dim>> old = change();
    // lets go of the old one
    particles.initialize(grid.triangulation(), grid.mapping(), n_properties);
    for (std::size_t i = 0; i < records.size(); ++i)
      {
        const auto place =
          locator.locate(records.locations[i],
                         grid.cells_after_change()[records.cells[i]]);
        AssertThrow(place.found, ExcInternalError());
        records.cells[i] = place.cell;
      }
    std::size_t n_shipped;
    insert_particles(particles,
                     locator,
                     exchange_points(records, grid.geometry(), n_shipped));
  }



  template <int dim>
  double
  MaterialPoints<dim>::total_reference_volume() const
  {
    double volume = 0;
    for (const auto &particle : particles)
      volume += particle.get_properties()[point_layout.volume];
    return Utilities::MPI::sum(volume, grid.communicator());
  }



  template <int dim>
  Particles::ParticleHandler<dim> &
  MaterialPoints<dim>::handler()
  {
    return particles;
  }



  template <int dim>
  const Particles::ParticleHandler<dim> &
  MaterialPoints<dim>::handler() const
  {
    return particles;
  }



  template <int dim>
  const PointLayout &
  MaterialPoints<dim>::layout() const
  {
    return point_layout;
  }



  template class MaterialPoints<2>;
  template class MaterialPoints<3>;
} // namespace isochor
