/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/surface_checks.h>

namespace isochor
{
  template <int dim>
  void
  warn_of_uncovered_faces(const StepContext<dim>       &step,
                          const SurfaceConditions<dim> &conditions,
                          const std::vector<double>    &covered_area,
                          const std::vector<double>    &candidate_area,
                          const std::string            &mesh_parameter)
  {
    const std::string unit = dim == 2 ? " m" : " m^2";
    for (unsigned int s = 0; s < covered_area.size(); ++s)
      {
        const BodySurface<dim> &place = conditions.surfaces[s].place;
        const double            share = covered_area[s] / candidate_area[s];
        if (place.on_grid_boundary || share > 0.99)
          continue;
        step.warnings.add(
          "surface in part off the body",
          "The body covers only " + rounded(100 * share) +
            " % of the faces of cells that the surface <" + place.name +
            "> of <" + place.parameter + "> consists of, " +
            rounded(covered_area[s]) + " of " + rounded(candidate_area[s]) +
            unit +
            "; what it does acts on this part. If the body's "
            "surface does not lie on faces of the grid there, give the body's "
            "mesh in <" +
            mesh_parameter + ">.");
      }
  }



  template <int dim>
  void
  warn_of_loads_beside_domains(const StepContext<dim>       &step,
                               const SurfaceConditions<dim> &conditions,
                               const std::vector<double>    &share_on_domains,
                               const std::string            &mesh_parameter)
  {
    constexpr double enough = 0.95;
    for (unsigned int s = 0; s < share_on_domains.size(); ++s)
      {
        const SurfaceCondition<dim> &surface = conditions.surfaces[s];
        if ((surface.traction.empty() && surface.pressure.empty()) ||
            share_on_domains[s] > enough)
          continue;
        step.warnings.add(
          "a load beside the domains of the points",
          "Only " + rounded(100 * share_on_domains[s]) +
            " % of the area of the surface <" + surface.place.name + "> of <" +
            surface.place.parameter +
            "> consist of faces of the points' domains, which <Quadrature/Type> "
            "makes of the body at t = 0. Elsewhere its load is not in balance "
            "with the stress of the points below, by 5 to 20 per cent, once the "
            "surface lies inside of cells. Let the surface be that of the "
            "points' domains (the mesh of <Material points/Body mesh> in <" +
            mesh_parameter +
            ">, or a <Material points/Region> that ends where cells do), or "
            "choose <Quadrature/Type = cell-filled + boundary>.");
      }
  }



  template void
  warn_of_uncovered_faces(const StepContext<2> &,
                          const SurfaceConditions<2> &,
                          const std::vector<double> &,
                          const std::vector<double> &,
                          const std::string &);
  template void
  warn_of_loads_beside_domains(const StepContext<2> &,
                               const SurfaceConditions<2> &,
                               const std::vector<double> &,
                               const std::string &);
  template void
  warn_of_uncovered_faces(const StepContext<3> &,
                          const SurfaceConditions<3> &,
                          const std::vector<double> &,
                          const std::vector<double> &,
                          const std::string &);
  template void
  warn_of_loads_beside_domains(const StepContext<3> &,
                               const SurfaceConditions<3> &,
                               const std::vector<double> &,
                               const std::string &);
} // namespace isochor
