/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/expression.h>
#include <isochor/grid/extent.h>
#include <isochor/grid/mesh_reader.h>
#include <isochor/grid/nearest_cells.h>
#include <isochor/material_points/body_seeding.h>
#include <isochor/material_points/point_locator.h>
#include <isochor/material_points/region_seeds.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  BodySeeding<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Material points");
    prm.declare_entry(
      "Points per cell",
      "0",
      Patterns::Integer(0),
      "Material points seeded per cell: 1, 3, 4, 6, 7, 9, 12, "
      "15, 16, ... in 2D, 1, 4, 8, 14, 27, 35, ... in 3D. Where each point "
      "owns a part of the cell (with <Quadrature/Type> CPDI, the default), "
      "numbers into which a cell can be divided: "
      "1, 3, 4, 6, 9, 12, 16, 24, ...; 3D: 1, 4, 8, 24, 27, .... 0 stands "
      "for 4 (3D: 8) there and 3 (3D: 4) elsewhere.");
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
                      "where it holds; those with domains ('Points per cell') "
                      "have them cut by its border, of conditions joined by "
                      "'&&' one after the other. Parts and gaps that are "
                      "narrower than the distance of points are lost; a "
                      "warning tells, but not with <Lattice spacing>.");
    prm.declare_entry("Physical groups",
                      "",
                      Patterns::List(Patterns::Anything()),
                      "The names of the physical groups of cells that the body "
                      "fills: of 'Body mesh' if there is one, else of the "
                      "gmsh grid. Empty: all.");
    prm.declare_entry("Body mesh",
                      "",
                      Patterns::FileName(),
                      "A second gmsh .msh file, of the body: points are seeded "
                      "in its cells instead of the grid's.");
    prm.declare_entry("Lattice spacing",
                      "0",
                      Patterns::Double(0),
                      "If positive, points are seeded on a square lattice of "
                      "this spacing (m) instead of per cell: one per box, or "
                      "one per simplex of each box (2 in 2D, 6 in 3D) if "
                      "'Quadrature/Type' gives the points simplex domains.");
    prm.declare_entry(
      "Materials in zones",
      "",
      Patterns::Anything(),
      "Bodies of several materials: 'number: condition; ...'. "
      "Material 1 is the subsection 'Material', k > 1 the "
      "subsection 'Material k', whose defaults are those of the "
      "program, not the entries of 'Material'. The last "
      "condition that holds counts; 1 elsewhere. Domains of points are cut "
      "by the borders of the zones.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  BodySeeding<dim>::parse_parameters(ParameterHandler &prm)
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
    Expression<dim>(parameters.region,
                    "Material points/Region",
                    FormulaVariables::space);
  }



  template <int dim>
  void
  BodySeeding<dim>::check_numbers(const bool with_domains) const
  {
    if (!(parameters.lattice_spacing > 0))
      create_zones(with_domains);
  }



  template <int dim>
  void
  BodySeeding<dim>::check_combinations() const
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
  std::vector<Seed<dim>>
  BodySeeding<dim>::seeds(const BackgroundGrid<dim>      &grid,
                          const bool                      with_domains,
                          const unsigned int              n_materials,
                          const std::vector<std::string> &zones) const
  {
    std::vector<Seed<dim>> seeds =
      !parameters.body_mesh.empty() ?
        seeds_in_body_mesh(grid, with_domains) :
      parameters.lattice_spacing > 0 ?
        seeds_on_lattice(grid, with_domains) :
        seeds_in_cells(grid.geometry(), grid.group_ids(), with_domains);
    AssertThrow(!seeds.empty(),
                ExcMessage("No material point lies in the grid. Check the "
                           "parameters of <Material points>, which describe "
                           "the body, against those of <Grid>."));
    choose_materials(n_materials, with_domains, seeds);
    for (unsigned int z = 0; z < zones.size(); ++z)
      assign_zone(zones[z],
                  "Material points/Bodies",
                  with_domains,
                  &Seed<dim>::zone,
                  z + 1,
                  seeds);
    if (with_domains)
      relocate(grid.geometry(), seeds);
    return seeds;
  }



  template <int dim>
  typename BodySeeding<dim>::MaterialZones
  BodySeeding<dim>::create_material_zones() const
  {
    const char   *name = "Material points/Materials in zones";
    MaterialZones zones;
    for (const auto &zone : split_named_list(parameters.material_zones, name))
      zones.emplace_back(Utilities::string_to_int(zone.first),
                         Expression<dim>(zone.second,
                                         name,
                                         FormulaVariables::space));
    return zones;
  }



  template <int dim>
  unsigned int
  BodySeeding<dim>::material_at(const MaterialZones &zones, const Point<dim> &x)
  {
    const auto last =
      std::find_if(zones.rbegin(), zones.rend(), [&](const auto &zone) {
        return zone.second(x, 0.) > 0;
      });
    return last == zones.rend() ? 0 : last->first - 1;
  }



  template <int dim>
  void
  BodySeeding<dim>::choose_materials(const unsigned int      n_materials,
                                     const bool              with_domains,
                                     std::vector<Seed<dim>> &seeds) const
  {
    const char *name = "Material points/Materials in zones";
    for (const auto &[number, zone] :
         split_named_list(parameters.material_zones, name))
      {
        const int material = Utilities::string_to_int(number);
        AssertThrow(material >= 1 && material <= int(n_materials),
                    ExcMessage("The parameter <" + std::string(name) +
                               "> names material " + number +
                               ", but there are " +
                               std::to_string(n_materials) + "."));
        assign_zone(
          zone, name, with_domains, &Seed<dim>::material, material - 1, seeds);
      }
  }



  template <int dim>
  void
  BodySeeding<dim>::relocate(const SimplexGeometry<dim> &geometry,
                             std::vector<Seed<dim>>     &seeds)
  {
    std::unique_ptr<PointLocator<dim>> locator;
    for (Seed<dim> &seed : seeds)
      {
        const auto lambda = geometry.barycentric(seed.cell, seed.location);
        if (*std::min_element(lambda.begin(), lambda.end()) >= 0)
          continue;
        if (!locator)
          locator = std::make_unique<PointLocator<dim>>(geometry);
        const auto place = locator->locate(seed.location, seed.cell);
        if (place.found)
          seed.cell = place.cell;
      }
  }



  template <int dim>
  std::vector<typename BodySeeding<dim>::Zone>
  BodySeeding<dim>::create_zones(const bool with_domains) const
  {
    std::vector<Zone> zones;
    const auto        add_zone = [&](const unsigned int     n_points,
                              const Expression<dim> &condition) {
      if (with_domains)
        {
          const auto points = material_points_with_domains<dim>(n_points);
          zones.push_back({n_points, points.rule, points.domains, condition});
        }
      else
        zones.push_back(
          {n_points, material_point_rule<dim>(n_points), {}, condition});
    };
    // parts with edges half as long as those of the cell, which may be
    // stretched before they are longer than a cell
    const unsigned int by_default = with_domains ? (1 << dim) : dim + 1;
    add_zone(parameters.points_per_cell > 0 ? parameters.points_per_cell :
                                              by_default,
             Expression<dim>("1", ""));
    for (const auto &zone :
         split_named_list(parameters.zones,
                          "Material points/Points per cell in zones"))
      add_zone(Utilities::string_to_int(zone.first),
               Expression<dim>(zone.second,
                               "Material points/Points per cell in zones",
                               FormulaVariables::space));
    return zones;
  }



  template <int dim>
  unsigned int
  BodySeeding<dim>::find_zone(const std::vector<Zone> &zones,
                              const Point<dim>        &centroid)
  {
    Assert(!zones.empty(), ExcInternalError());
    unsigned int zone = zones.size() - 1;
    while (zone > 0 && !(zones[zone].condition(centroid, 0.) > 0))
      --zone;
    return zone;
  }



  template <int dim>
  std::vector<Seed<dim>>
  BodySeeding<dim>::seeds_in_cells(
    const SimplexGeometry<dim>                      &geometry,
    const std::map<std::string, types::material_id> &group_ids,
    const bool                                       with_domains) const
  {
    const std::vector<Zone> zones = create_zones(with_domains);
    SeedsInRegion<dim>      seeds(parameters.region, with_domains);
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
        order_for_subdivision<dim>(corners);
        const unsigned int     zone = find_zone(zones, centre);
        const Quadrature<dim> &rule = zones[zone].rule;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Seed<dim> seed{
              corners[0], cell, rule.weight(q) * geometry.measure(cell), {}, 0};
            for (unsigned int d = 0; d < dim; ++d)
              {
                const Tensor<1, dim> edge = corners[d + 1] - corners[0];
                seed.location += rule.point(q)[d] * edge;
                for (unsigned int c = 0; c <= dim && with_domains; ++c)
                  seed.domain[c] += zones[zone].domains[q][c][d] * edge;
              }
            seeds.add(seed);
          }
      }
    return seeds.all();
  }



  template <int dim>
  std::vector<Seed<dim>>
  BodySeeding<dim>::seeds_in_body_mesh(const BackgroundGrid<dim> &grid,
                                       const bool with_domains) const
  {
    Triangulation<dim> body;
    const MeshGroups   names =
      read_mesh<dim>(parameters.body_mesh, "Material points/Body mesh", body);
    const SimplexGeometry<dim> geometry(body);
    std::vector<Seed<dim>>     seeds =
      seeds_in_cells(geometry, names.cells, with_domains);
    locate(grid, seeds);
    return seeds;
  }



  namespace
  {
    /** How many boxes of the size @p h there are along each axis. */
    template <int dim>
    std::array<unsigned int, dim>
    count_boxes(const Extent<dim> &extent, const double h)
    {
      Assert(h > 0, ExcMessage("There is no lattice."));
      std::array<double, dim> length;
      double                  n_boxes = 1;
      for (unsigned int d = 0; d < dim; ++d)
        {
          length[d] =
            std::ceil((extent.upper[d] - extent.lower[d]) / h - 1e-10);
          n_boxes *= length[d];
        }
      std::ostringstream number;
      number << n_boxes;
      AssertThrow(n_boxes < std::numeric_limits<int>::max(),
                  ExcMessage("The lattice of the parameter <Material "
                             "points/Lattice spacing> has " +
                             number.str() +
                             " boxes in the extent of the grid: are <Grid> and "
                             "the spacing in the same unit?"));
      std::array<unsigned int, dim> n;
      std::copy(length.begin(), length.end(), n.begin());
      return n;
    }

    /** The points in a box of a lattice: where they are, in units of the box,
     * and their domains (m). */
    template <int dim>
    struct BoxParts
    {
      std::vector<Point<dim>>         places;
      std::vector<CornerVectors<dim>> domains;
    };

    /** One point in the middle; where points carry simplex domains, one in each
     * simplex of the box, so that the domains tile the body. */
    template <int dim>
    BoxParts<dim>
    divide_box(const double h, const bool with_domains)
    {
      BoxParts<dim> parts;
      if (!with_domains)
        {
          parts.domains.resize(1);
          parts.places.resize(1);
          for (unsigned int d = 0; d < dim; ++d)
            parts.places[0][d] = 0.5;
          return parts;
        }
      for (const auto &corners : box_simplices<dim>())
        {
          Point<dim> centroid;
          for (const Point<dim> &corner : corners)
            centroid += corner / (dim + 1.);
          parts.places.push_back(centroid);
          parts.domains.emplace_back();
          for (unsigned int c = 0; c <= dim; ++c)
            parts.domains.back()[c] = h * (corners[c] - centroid);
        }
      return parts;
    }
  } // namespace



  template <int dim>
  std::vector<Seed<dim>>
  BodySeeding<dim>::seeds_on_lattice(const BackgroundGrid<dim> &grid,
                                     const bool with_domains) const
  {
    Assert(parameters.lattice_spacing > 0, ExcMessage("There is no lattice."));
    const double h = parameters.lattice_spacing;
    Extent<dim>  extent;
    for (const Point<dim> &vertex : grid.geometry().vertices())
      extent.include(vertex);
    const auto         n = count_boxes(extent, h);
    const unsigned int n_points =
      std::accumulate(n.begin(), n.end(), 1u, std::multiplies<unsigned int>());
    const BoxParts<dim> parts = divide_box<dim>(h, with_domains);
    SeedsInRegion<dim>  in_region(parameters.region, with_domains);
    for (unsigned int i = 0; i < n_points; ++i)
      for (unsigned int s = 0; s < parts.places.size(); ++s)
        {
          Seed<dim> seed{
            {}, 0, std::pow(h, dim) / parts.places.size(), parts.domains[s], 0};
          unsigned int rest = i;
          for (unsigned int d = 0; d < dim; ++d, rest /= n[d - 1])
            seed.location[d] =
              extent.lower[d] + (rest % n[d] + parts.places[s][d]) * h;
          in_region.add(seed);
        }
    std::vector<Seed<dim>> seeds = in_region.all();
    locate(grid, seeds);
    seeds.erase(std::remove_if(seeds.begin(),
                               seeds.end(),
                               [&](const Seed<dim> &seed) {
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
  BodySeeding<dim>::locate(const BackgroundGrid<dim> &grid,
                           std::vector<Seed<dim>>    &seeds) const
  {
    const PointLocator<dim> locator(grid.geometry());
    std::vector<Seed<dim>>  located;
    unsigned int            hint = 0;
    for (Seed<dim> seed : seeds)
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



  template class BodySeeding<2>;
  template class BodySeeding<3>;
} // namespace isochor
