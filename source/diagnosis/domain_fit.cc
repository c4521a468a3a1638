/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/seeded_cells.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The corners of domains on the face x_dim = 0 of the reference simplex,
     * in small units. The tilings divide all faces in the same way. */
    template <int dim>
    std::set<std::array<long, dim - 1>>
    corners_on_face(const Quadrature<dim>                 &rule,
                    const std::vector<CornerVectors<dim>> &domains)
    {
      constexpr double                    units = 1e8;
      std::set<std::array<long, dim - 1>> corners;
      for (unsigned int q = 0; q < domains.size(); ++q)
        for (const Tensor<1, dim> &corner : domains[q])
          if (const Point<dim> x = rule.point(q) + corner;
              std::abs(x[dim - 1]) * units < 1)
            {
              std::array<long, dim - 1> place;
              for (unsigned int d = 0; d + 1 < dim; ++d)
                place[d] = std::lround(x[d] * units / 16);
              corners.insert(place);
            }
      return corners;
    }
  } // namespace



  /** Domains of neighbours that divide the face between them differently. */
  template <int dim>
  class DomainFit : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      const BodySeeding<dim> &seeding = scene.points.body_seeding();
      if (scene.quadrature->is_linear_on_domains() &&
          scene.points.layout().with_domains &&
          !seeding.parameters_read().zones.empty())
        look_at_cells_of_body(seeding,
                              scene.grid,
                              [&](const auto &geometry, const auto &group_ids) {
                                look(seeding, geometry, group_ids);
                              });
    }

  private:
    void
    look(const BodySeeding<dim>                          &seeding,
         const SimplexGeometry<dim>                      &geometry,
         const std::map<std::string, types::material_id> &group_ids) const
    {
      const auto &parameters = seeding.parameters_read();
      const auto  zones      = seeding.create_zones(true);
      std::vector<std::set<std::array<long, dim - 1>>> corners;
      for (const auto &zone : zones)
        corners.push_back(corners_on_face<dim>(zone.rule, zone.domains));

      // by cell; those without points are in none
      const unsigned int        none = zones.size();
      const Expression<dim>     in_body(parameters.region,
                                    "Material points/Region");
      std::vector<unsigned int> zone_of(geometry.n_cells(), none);
      for (unsigned int cell = 0; cell < geometry.n_cells_of_first_layer();
           ++cell)
        {
          const Point<dim> centroid = cell_centroid(geometry, cell);
          if (in_body(centroid, 0.) > 0 &&
              in_groups(geometry.cell_iterator(cell)->material_id(),
                        parameters.groups,
                        group_ids))
            zone_of[cell] = seeding.find_zone(zones, centroid);
        }

      std::map<std::pair<unsigned int, unsigned int>, unsigned int> n_faces;
      for (unsigned int cell = 0; cell < geometry.n_cells_of_first_layer();
           ++cell)
        for (const unsigned int other : geometry.neighbours(cell))
          if (other != SimplexGeometry<dim>::no_cell && other > cell &&
              zone_of[cell] != none && zone_of[other] != none &&
              corners[zone_of[cell]] != corners[zone_of[other]])
            ++n_faces[std::minmax(zones[zone_of[cell]].n_points,
                                  zones[zone_of[other]].n_points)];
      if (n_faces.empty())
        return;
      std::ostringstream text;
      text
        << "in <Material points/Points per cell in zones> corners of domains "
           "hang on faces of others: ";
      for (auto pair = n_faces.begin(); pair != n_faces.end(); ++pair)
        text << (pair == n_faces.begin() ? "" : ", ") << pair->first.first
             << " points beside " << pair->first.second << " at "
             << pair->second << " faces";
      text << ". Numbers that divide faces alike: "
           << (dim == 2 ? "1 and 3; 4, 6 and 12; 9 and 27; 16, 24 and 48" :
                          "1 and 4; 8 and 32; 27 and 108")
           << '.';
      this->warn(text.str());
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    DomainFit,
    "domains that don't fit together",
    ISOCHOR_ESSENTIAL,
    "`Points per cell in zones` with domains (CPDI), at the start: cells meet "
    "whose numbers of points divide the face between them differently. "
    "Corners of domains hang on faces of others, and even a homogeneous "
    "stress has forces there",
    "numbers that divide faces alike (1 and 3; 4, 6 and 12; 9 and 27; 16, "
    "24 and 48; 3D: 1 and 4; 8 and 32; 27 and 108), one number everywhere, "
    "or a quadrature that doesn't integrate over domains (`points`, `cell-"
    "filled`)")
} // namespace isochor
