/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/postprocess/postprocessor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace isochor
{
  /**
   * Named tracers: massless points of the body, given where they are at t = 0,
   * which move with the displacement field. Their displacement and, in the u-p
   * form, pressure go into the statistics.
   */
  template <int dim>
  class PointProbes : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Point probes",
                        "",
                        Patterns::Anything(),
                        "Points of the body whose displacement (m) and "
                        "pressure (Pa) go into the statistics, by their place "
                        "at t = 0: 'name: x, y(, z); name: ...'.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = "Postprocess/Point probes";
      for (const auto &entry : split_named_list(prm.get("Point probes"), name))
        {
          const auto x =
            Utilities::string_to_double(split_formulas(entry.second, name));
          AssertThrow(x.size() == dim,
                      ExcMessage("The probe <" + entry.first +
                                 "> of the parameter <" + name + "> needs " +
                                 std::to_string(dim) + " coordinates."));
          Probe probe;
          probe.name = entry.first;
          for (unsigned int d = 0; d < dim; ++d)
            probe.location[d] = x[d];
          probe.origin = probe.location;
          for (const Probe &other : probes)
            AssertThrow(other.name != probe.name,
                        ExcMessage("The parameter <" + name +
                                   "> names the probe <" + probe.name +
                                   "> twice."));
          probes.push_back(probe);
        }
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics            &statistics) override
    {
      for (Probe &probe : probes)
        {
          if (probe.is_new)
            place_in_moved_body(result, probe);
          const std::array<double, dim + 2> values = interpolate(result, probe);
          AssertThrow(values[dim + 1] > 0,
                      ExcMessage("The point probe <" + probe.name +
                                 "> lies in no cell that holds material. Check "
                                 "<Postprocess/Point probes>."));
          for (unsigned int a = 0; a < dim; ++a)
            {
              const double increment = values[a] / values[dim + 1];
              probe.displacement[a] += increment;
              probe.location[a] += increment;
              statistics.set(std::string("Displacement ") + "xyz"[a] + " of " +
                               probe.name + " (m)",
                             probe.displacement[a]);
            }
          if (result.step.mixed())
            statistics.set("Pressure at " + probe.name + " (Pa)",
                           values[dim] / values[dim + 1]);
        }
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      for (const Probe &probe : probes)
        if (!probe.is_new)
          state << probe.origin << ' ' << probe.location << ' '
                << probe.displacement << ' ' << probe.name << '\n';
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      // the parameters may name other probes than before
      for (Probe &probe : probes)
        probe.is_new = true;
      std::istringstream state(text);
      for (std::string line; std::getline(state, line);)
        {
          std::istringstream values(line);
          Probe              saved;
          for (unsigned int d = 0; d < dim; ++d)
            values >> saved.origin[d];
          for (unsigned int d = 0; d < dim; ++d)
            values >> saved.location[d];
          for (unsigned int d = 0; d < dim; ++d)
            values >> saved.displacement[d];
          std::getline(values >> std::ws, saved.name);
          for (Probe &probe : probes)
            if (probe.name == saved.name && probe.origin == saved.origin)
              probe = saved;
        }
    }

  private:
    struct Probe
    {
      std::string    name;
      Point<dim>     origin, location; ///< at t = 0, at the start of the step
      Tensor<1, dim> displacement;
      /** Added at a restart: still where it was at t = 0. */
      bool is_new = false;
    };

    /**
     * Where a probe of the undeformed body is now: as its nearest material
     * point X_p (by places at t = 0), x = x_p + F_p (X - X_p).
     */
    static void
    place_in_moved_body(const StepResult<dim> &result, Probe &probe)
    {
      const MPI_Comm          comm = result.step.grid.communicator();
      const PointLayout      &l    = result.points.layout();
      double                  best = std::numeric_limits<double>::max();
      std::array<double, dim> place{};
      for (const auto &particle : result.points.handler())
        {
          const double *properties = particle.get_properties().data();
          Point<dim>    X          = particle.get_location();
          for (unsigned int d = 0; d < dim; ++d)
            X[d] -= properties[l.displacement + d];
          const Tensor<1, dim> distance = probe.origin - X;
          if (distance.norm() >= best)
            continue;
          best = distance.norm();
          const Point<dim> x =
            particle.get_location() +
            deformation_gradient<dim>(properties, l) * distance;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = x[d];
        }
      const double       nearest = Utilities::MPI::min(best, comm);
      const unsigned int rank    = Utilities::MPI::this_mpi_process(comm);
      const unsigned int owner   = Utilities::MPI::min(
        best == nearest ? rank : numbers::invalid_unsigned_int, comm);
      if (rank != owner)
        place.fill(0.);
      sum_over_ranks(place, comm);
      for (unsigned int d = 0; d < dim; ++d)
        probe.location[d] = place[d];
      probe.displacement = probe.location - probe.origin;
      probe.is_new       = false;
    }

    /** Whether the probe lies within what a material point stands for, at
     * t = 0: 1.5 of its size reach to the corners of sharp triangles. */
    static bool
    lies_in_body(const StepResult<dim> &result, const Probe &probe)
    {
      const PointLayout &l    = result.points.layout();
      bool               near = false;
      for (const auto &particle : result.points.handler())
        {
          const double *properties = particle.get_properties().data();
          near = near || particle.get_location().distance(probe.location) <
                           1.5 * std::pow(properties[l.volume], 1. / dim);
        }
      return Utilities::MPI::max(near ? 1 : 0,
                                 result.step.grid.communicator()) == 1;
    }

    /** How many points act on each node. One without points may be a node of a
     * cell that holds a point all the same: a point with a domain acts through
     * its corners. Its unknowns mean nothing. */
    static NodalField
    touched_nodes(const StepContext<dim> &step)
    {
      NodalField touched;
      step.nodes.initialize(touched, 1);
      for (unsigned int k = 0; k < step.points.n_occupied_cells; ++k)
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          {
            const auto stencil =
              step.points.stencil(step.grid.geometry(), k, q);
            for (unsigned int I = 0; I < stencil.n_nodes; ++I)
              touched.local_element(step.nodes.node(stencil.vertex[I])) += 1;
          }
      touched.compress(VectorOperation::add);
      touched.update_ghost_values();
      return touched;
    }

    /**
     * Displacement increment, pressure and the number of ranks that found the
     * probe in an occupied cell, summed over them. Among the cells around the
     * probe the occupied one that fits best is taken, with its shape functions
     * extrapolated if it must be: a probe may lie on the surface of the body, a
     * corner even beyond the cells that hold material points.
     */
    std::array<double, dim + 2>
    interpolate(const StepResult<dim> &result, const Probe &probe) const
    {
      const StepContext<dim>     &step     = result.step;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      unsigned int                best     = numbers::invalid_unsigned_int;
      // a point of the surface may lie beyond the last cell that holds a
      // material point, as boundary points do; one outside of the body is an
      // error at the start
      double best_fit =
        result.time.step == 0 && !lies_in_body(result, probe) ? -1e-2 : -1;
      const NodalField touched = touched_nodes(step);
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        {
          const auto &vertices = geometry.vertex_indices(step.points.cell[k]);
          if (std::any_of(vertices.begin(),
                          vertices.end(),
                          [&](const unsigned int v) {
                            const unsigned int node = step.nodes.node(v);
                            return node == numbers::invalid_unsigned_int ||
                                   touched.local_element(node) == 0.;
                          }))
            continue;
          const auto lambda =
            step.points.barycentric(geometry, k, probe.location);
          const double fit = *std::min_element(lambda.begin(), lambda.end());
          if (fit > best_fit)
            {
              best     = k;
              best_fit = fit;
            }
        }
      // several ranks may hold a cell at a face: the one that fits best, or
      // the first of them
      const MPI_Comm     comm = step.grid.communicator();
      const double       fit  = Utilities::MPI::max(best_fit, comm);
      const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
      const unsigned int winner =
        Utilities::MPI::min(best != numbers::invalid_unsigned_int &&
                                best_fit == fit ?
                              rank :
                              numbers::invalid_unsigned_int,
                            comm);

      std::array<double, dim + 2> values{};
      if (rank == winner)
        {
          const auto lambda =
            step.points.barycentric(geometry, best, probe.location);
          for (unsigned int I = 0; I <= dim; ++I)
            {
              const unsigned int node = step.nodes.node(
                geometry.vertex_indices(step.points.cell[best])[I]);
              for (unsigned int a = 0; a < step.n_components; ++a)
                values[a] += lambda[I] * result.unknowns.local_element(
                                           node * step.n_components + a);
            }
          values[dim + 1] = 1;
        }
      sum_over_ranks(values, comm);
      return values;
    }

    std::vector<Probe> probes;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, PointProbes, "Point probes")
} // namespace isochor
