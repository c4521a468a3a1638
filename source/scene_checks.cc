/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/free_motions.h>
#include <isochor/mpi_sums.h>
#include <isochor/scene.h>
#include <isochor/scene_checks.h>

#include <algorithm>
#include <array>
#include <sstream>

namespace isochor
{
  namespace
  {
    /** The extent of places, for messages. */
    template <int dim>
    struct Extent
    {
      std::vector<double> lower = std::vector<double>(dim, 1e300),
                          upper = std::vector<double>(dim, -1e300);

      void
      include(const Point<dim> &x)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            lower[d] = std::min(lower[d], x[d]);
            upper[d] = std::max(upper[d], x[d]);
          }
      }

      void
      merge(const MPI_Comm comm)
      {
        Utilities::MPI::min(lower, comm, lower);
        Utilities::MPI::max(upper, comm, upper);
      }

      /** "[0, 1] x [2, 3]" */
      std::string
      text() const
      {
        std::ostringstream out;
        out.precision(4);
        for (unsigned int d = 0; d < dim; ++d)
          out << (d > 0 ? " x [" : "[") << lower[d] << ", " << upper[d] << "]";
        return out.str();
      }
    };
  } // namespace



  template <int dim>
  void
  warn_if_untouched(const StepContext<dim>  &step,
                    const std::string       &parameter,
                    const std::string       &name,
                    const types::boundary_id id,
                    const bool               everywhere)
  {
    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    Extent<dim>                 boundary, body;
    bool                        touched = false;
    for (const BoundaryFace &face : step.grid.boundary_faces())
      {
        if (!everywhere && face.id != id)
          continue;
        for (unsigned int v = 0; v <= dim; ++v)
          if (v != face.opposite_vertex)
            {
              const unsigned int vertex = geometry.vertex_indices(face.cell)[v];
              boundary.include(geometry.vertices()[vertex]);
              touched = touched || step.nodes.node(vertex) !=
                                     numbers::invalid_unsigned_int;
            }
      }
    const MPI_Comm comm = step.grid.communicator();
    if (Utilities::MPI::max(static_cast<int>(touched), comm) != 0)
      return;

    for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
      for (const unsigned int vertex :
           geometry.vertex_indices(step.points.cell[k]))
        body.include(geometry.vertices()[vertex]);
    body.merge(comm);
    step.warnings.add(
      "no material at <" + name + "> of <" + parameter + ">",
      "The entry for <" + name + "> of the parameter <" + parameter +
        "> has no effect at the start, as the material doesn't touch that "
        "boundary: the cells of the body lie in " +
        body.text() + ", the boundary in " + boundary.text() +
        ". That is right for a wall which the body reaches later. Otherwise "
        "check the name of the boundary, <Grid> and the place of the body in "
        "<Material points>.");
  }



  template <int dim>
  void
  check_body(const StepContext<dim> &step)
  {
    const MPI_Comm comm = step.grid.communicator();
    // a body that fills less than this part of the cells it is in isn't
    // resolved by them, whatever its shape
    constexpr double                smallest_share = 0.01;
    std::array<double, 3>           sums{}; // body, its cells, number of them
    const std::size_t               n_materials = step.kernel.materials.size();
    std::vector<unsigned long long> n_points(n_materials, 0);
    const PointArrays<dim>         &points = step.points;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        sums[1] += step.grid.geometry().measure(points.cell[k]);
        sums[2] += 1;
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            sums[0] += points.volume[q];
            ++n_points[points.material[q]];
          }
      }
    sum_over_ranks(sums, comm);
    Utilities::MPI::sum(n_points, comm, n_points);
    const std::string unit = dim == 2 ? " m^2" : " m^3";
    if (sums[0] < smallest_share * sums[1])
      {
        std::ostringstream numbers;
        numbers.precision(3);
        numbers << "fills " << 100 * sums[0] / sums[1] << " % of the "
                << sums[2] << " cell(s) it is in (" << sums[0] << " of "
                << sums[1] << unit << ")";
        step.warnings.add("a body smaller than a cell",
                          "The body " + numbers.str() +
                            ": no cell resolves it. Are the lengths in <Grid> "
                            "and <Material points> in the same unit? Otherwise "
                            "raise <Grid/Subdivisions>, or use a finer mesh.");
      }
    for (unsigned int m = 1; m < n_materials; ++m)
      if (n_points[m] == 0)
        step.warnings.add("no point of material " + std::to_string(m + 1),
                          "No material point is made of <Material " +
                            std::to_string(m + 1) +
                            ">: <Material points/Materials in zones> has no "
                            "zone with that number that holds a point.");
  }



  void
  check_supports(const SparseSystem &matrix, Warnings &warnings)
  {
    constexpr unsigned int      most   = 3;
    const std::vector<FreeBody> bodies = find_free_bodies(matrix);
    if (bodies.empty())
      return;
    std::ostringstream text;
    text.precision(4);
    text << "Nothing holds "
         << (bodies.size() == 1 ? "a body" :
                                  std::to_string(bodies.size()) + " bodies")
         << " against: ";
    for (unsigned int b = 0; b < std::min<std::size_t>(bodies.size(), most);
         ++b)
      {
        text << (b > 0 ? "; " : "");
        for (unsigned int m = 0; m < bodies[b].motions.size(); ++m)
          text << (m > 0 ? ", " : "") << bodies[b].motions[m];
        text << " (the one around (";
        for (unsigned int d = 0; d < bodies[b].centre.size(); ++d)
          text << (d > 0 ? ", " : "") << bodies[b].centre[d];
        text << "), " << bodies[b].n_equations << " displacement equations)";
      }
    if (bodies.size() > most)
      text << "; ...";
    text << ". In statics the displacement is then not unique, and there is no "
            "equilibrium if a load acts along such a motion. Hold the body by "
            "<Boundary conditions/Displacement> or <Boundary "
            "conditions/Displacement of body>, or give it inertia: <Dynamics/"
            "Inertia = true>.";
    warnings.add("a body that nothing holds", text.str());
  }



  template <int dim>
  void
  check_first_step(const Scene<dim>       &scene,
                   const StepContext<dim> &step,
                   const SparseSystem     &matrix)
  {
    check_body(step);
    for (const auto &condition : scene.boundary_conditions)
      condition->check_scene(step);
    for (const auto &postprocessor : scene.postprocessors)
      postprocessor->check_scene(step);
    if (!scene.dynamic)
      check_supports(matrix, step.warnings);
  }



  template <int dim>
  void
  warn_if_nothing_moves(Scene<dim>         &scene,
                        const NewtonReport &newton,
                        const NodalField   &unknowns)
  {
    // in dynamics the trial steps may have left nothing to iterate on
    if (scene.time.step == 0 && newton.n_iterations() == 0 &&
        unknowns.linfty_norm() == 0)
      scene.warnings.add(
        "nothing loads the scene",
        "The first step, to t = " + std::to_string(scene.time.next_time()) +
          ", needed no iteration: no load and no displacement acts on the body "
          "up to then. Set loads in <Boundary conditions>, <Dynamics/Initial "
          "velocity>, or a larger <Time/Step size> if they begin later.");
  }



  template void
  warn_if_untouched<2>(const StepContext<2> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool);
  template void
  warn_if_untouched<3>(const StepContext<3> &,
                       const std::string &,
                       const std::string &,
                       const types::boundary_id,
                       const bool);
  template void
  check_body<2>(const StepContext<2> &);
  template void
  check_body<3>(const StepContext<3> &);
  template void
  check_first_step<2>(const Scene<2> &,
                      const StepContext<2> &,
                      const SparseSystem &);
  template void
  check_first_step<3>(const Scene<3> &,
                      const StepContext<3> &,
                      const SparseSystem &);
  template void
  warn_if_nothing_moves<2>(Scene<2> &,
                           const NewtonReport &,
                           const NodalField &);
  template void
  warn_if_nothing_moves<3>(Scene<3> &,
                           const NewtonReport &,
                           const NodalField &);
} // namespace isochor
