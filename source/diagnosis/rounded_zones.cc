/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/thickness.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/seeded_cells.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** Volumes of a material (m^dim, of a body of revolution m^3). */
    struct Volumes
    {
      double points = 0, ///< what its points stand for
        zones       = 0; ///< what its zones have, where points are

      void
      add(const double to_points, const double to_zones)
      {
        points += to_points;
        zones += to_zones;
      }
    };
    /** The volumes of materials, by points and by zones. */
    template <int dim>
    class MaterialVolumes
    {
    public:
      MaterialVolumes(const BodySeeding<dim> &seeding,
                      const PointLayout      &layout)
        : zones(seeding.create_material_zones())
        , rules(seeding.create_zones(false))
        , in_body(seeding.parameters_read().region, "Material points/Region")
        , axisymmetric(layout.axisymmetric)
      {
        for (const auto &zone : zones)
          n_materials = std::max(n_materials, zone.first);
        clear();
      }

      void
      clear()
      {
        volumes.assign(n_materials + 1, Volumes());
      }

      /** Add this rank's share of those cells of @p body that belong to the
       * @p groups. */
      void
      add_cells(const SimplexGeometry<dim>                      &body,
                const std::map<std::string, types::material_id> &ids,
                const std::vector<std::string>                  &groups,
                const MPI_Comm                                   comm)
      {
        std::vector<int>          at_vertex(body.vertices().size(), -1);
        std::vector<unsigned int> mixed;
        for (unsigned int cell = Utilities::MPI::this_mpi_process(comm);
             cell < body.n_cells_of_first_layer();
             cell += Utilities::MPI::n_mpi_processes(comm))
          {
            const Point<dim> centroid = cell_centroid(body, cell);
            if (!in_groups(body.cell_iterator(cell)->material_id(),
                           groups,
                           ids))
              continue;
            const int own      = material(centroid);
            bool      is_mixed = false;
            for (const unsigned int v : body.vertex_indices(cell))
              {
                if (at_vertex[v] < 0)
                  at_vertex[v] = material(body.vertices()[v]);
                is_mixed = is_mixed || at_vertex[v] != own;
              }
            const double size = ring(centroid) * body.measure(cell);
            if (is_mixed)
              mixed.push_back(cell);
            else
              volumes[own].add(size, size);
          }
        // enough places for the sum, and for each cell
        constexpr std::size_t in_all = 100000, least = 64, most = 256;
        for (const unsigned int cell : mixed)
          add_mixed(body, cell, std::clamp(in_all / mixed.size(), least, most));
      }

      /** By material; what is outside of the region is one, too, the last. */
      std::vector<Volumes> volumes;

    private:
      const typename BodySeeding<dim>::MaterialZones     zones;
      const std::vector<typename BodySeeding<dim>::Zone> rules;
      const Expression<dim>                              in_body;
      const bool                                         axisymmetric;
      int                                                n_materials = 1;

      int
      material(const Point<dim> &x) const
      {
        return in_body(x, 0.) > 0 ?
                 int(BodySeeding<dim>::material_at(zones, x)) :
                 n_materials;
      }

      double
      ring(const Point<dim> &x) const
      {
        return thickness(axisymmetric, x[0]);
      }

      /** Add a cell of several materials, looked at in @p n_places. */
      void
      add_mixed(const SimplexGeometry<dim> &geometry,
                const unsigned int          cell,
                const unsigned int          n_places)
      {
        const auto   places  = places_in_cell<dim>(geometry, cell, rules);
        const double size    = geometry.measure(cell);
        const auto   corners = corners_of(geometry, cell);
        for (const Point<dim> &x : places)
          volumes[material(x)].add(ring(x) * size / places.size(), 0.);
        for (unsigned int i = 0; i < n_places; ++i)
          {
            const Point<dim> x =
              spread_place<dim>(corners, std::size_t(cell) * n_places + i);
            volumes[material(x)].add(0., ring(x) * size / n_places);
          }
      }
    };
  } // namespace



  /** What points make of the region and the zones of materials. */
  template <int dim>
  class RoundedZones : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      const BodySeeding<dim> &seeding    = scene.points.body_seeding();
      const auto             &parameters = seeding.parameters_read();
      const PointLayout      &layout     = scene.points.layout();
      // domains are cut by the borders of region and zones
      if ((parameters.material_zones.empty() &&
           names_in_formula(parameters.region).empty()) ||
          parameters.lattice_spacing > 0 || layout.with_domains)
        return;
      const MPI_Comm       comm = scene.grid.communicator();
      MaterialVolumes<dim> found(seeding, layout);
      try
        {
          look_at_cells_of_body(
            seeding,
            scene.grid,
            [&](const SimplexGeometry<dim>                      &body,
                const std::map<std::string, types::material_id> &ids) {
              found.add_cells(body, ids, parameters.groups, comm);
            });
        }
      catch (const StandardExceptions::ExcMessage &)
        {
          found.clear(); // a formula need have values at the points only
        }
      warn_of_rounding(found.volumes, layout.axisymmetric ? 3 : dim, comm);
    }

  private:
    /** Warn of the material, of all but the last of the @p volumes, that is
     * rounded most. Collective. */
    void
    warn_of_rounding(const std::vector<Volumes> &volumes,
                     const unsigned int          dim_of_volume,
                     const MPI_Comm              comm) const
    {
      constexpr double much  = 0.02;
      unsigned int     worst = 0;
      double           most = much, of_points = 0, sign = 0;
      for (unsigned int k = 0; k + 1 < volumes.size(); ++k)
        {
          const double points = Utilities::MPI::sum(volumes[k].points, comm),
                       zones  = Utilities::MPI::sum(volumes[k].zones, comm),
                       difference = points - zones;
          // of no points at all another warning tells
          if (points > 0 && std::abs(difference) > most * zones)
            {
              worst     = k;
              most      = std::abs(difference) / zones;
              of_points = points;
              sign      = difference;
            }
        }
      if (most > much)
        this->warn("the points of material " + std::to_string(worst + 1) +
                   " stand for " + rounded(of_points) + " m^" +
                   std::to_string(dim_of_volume) + ", " + rounded(100 * most) +
                   " % " + (sign > 0 ? "more" : "less") +
                   " than its region and zones. Use <Quadrature/Type = CPDI>, "
                   "smaller cells or more points, or let their sides lie on "
                   "lines of cells.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    RoundedZones,
    "rounded to the points",
    ISOCHOR_ESSENTIAL,
    "where points have no domains (`points`, `cell-filled`), the points that "
    "`Region` and, by material, `Materials in zones` hold stand for a volume "
    "that differs by more than 2 % from theirs: a point belongs to the body, "
    "and to a material, as a whole",
    "`Quadrature/Type = CPDI`, whose domains are cut by the borders; sides on "
    "lines of cells, smaller cells, more points, or `Body mesh`")
} // namespace isochor
