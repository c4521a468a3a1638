/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/expression.h>
#include <isochor/base/mpi_sums.h>
#include <isochor/equations/nodal_unknowns.h>
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
      prm.declare_entry(
        "Point probes",
        "",
        Patterns::Anything(),
        "Points of the body whose displacement (m) and "
        "pressure (Pa) go into the statistics, by their place "
        "at t = 0: 'name: x, y(, z); name: ...'. The pressure, the "
        "mean Cauchy stress (Kirchhoff's with Mohr-Coulomb), is "
        "that of the nodes around, which is the least accurate "
        "at surfaces: there it converges with the cell size "
        "only, that of the material points faster.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      const std::string name = this->parameter("Point probes");
      for (const auto &entry :
           split_list_of_unique_names(prm.get("Point probes"), name))
        {
          std::vector<double> x;
          for (const std::string &one : split_formulas(entry.second, name))
            x.push_back(number_in(one, name));
          AssertThrow(x.size() == dim,
                      ExcMessage("The probe <" + entry.first +
                                 "> of the parameter <" + name + "> needs " +
                                 std::to_string(dim) + " coordinates."));
          Probe probe;
          probe.name = entry.first;
          for (unsigned int d = 0; d < dim; ++d)
            probe.location[d] = x[d];
          probe.origin = probe.location;
          probes.push_back(probe);
        }
    }

    void
    check_scene(const StepContext<dim> &step) const override
    {
      if (probes.empty())
        return;
      const NodalField touched = touched_nodes(step);
      for (const Probe &probe : probes)
        {
          const bool in_body = lies_in_body(step, probe);
          const int  found =
            in_body || find_cell(step, probe, touched, in_body).found();
          assert_in_body(probe,
                         Utilities::MPI::max(found, step.grid.communicator()) ==
                           1);
        }
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics            &statistics) override
    {
      if (probes.empty())
        return;
      const NodalField touched = touched_nodes(result.step);
      for (Probe &probe : probes)
        {
          if (result.points.bodies().size() > 1)
            probe.body = result.points.bodies().at(probe.origin);
          if (probe.is_new)
            place_in_moved_body(result, probe);
          Values     values;
          const bool in_body =
            result.time.step > 0 || lies_in_body(result.step, probe);
          if (!interpolate(result, probe, touched, in_body, values))
            {
              assert_in_body(probe, in_body);
              extrapolate(result, probe, values);
            }
          for (unsigned int a = 0; a < dim; ++a)
            {
              probe.displacement[a] += values[a];
              probe.location[a] += values[a];
              statistics.set(std::string("Displacement ") + "xyz"[a] + " of " +
                               probe.name + " (m)",
                             probe.displacement[a]);
            }
          if (result.step.mixed())
            statistics.set("Pressure at " + probe.name + " (Pa)", values[dim]);
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
      /** Its body; unknown before the first step, and if there is one. */
      unsigned int body = numbers::invalid_unsigned_int;

      /** Whether a @p cell of the grid may hold its body. */
      bool
      may_be_in(const BackgroundGrid<dim> &grid, const unsigned int cell) const
      {
        return body == numbers::invalid_unsigned_int ||
               body == grid.layer_of_cell(cell);
      }
    };

    void
    assert_in_body(const Probe &probe, const bool in_body) const
    {
      AssertThrow(in_body,
                  ExcMessage("The point probe <" + probe.name +
                             "> lies in no cell that holds material. Check <" +
                             this->parameter("Point probes") + ">."));
    }

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
          if (probe.body != numbers::invalid_unsigned_int &&
              probe.body != result.points.body_of(particle))
            continue;
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

    /** Where point q in cell k of the list is at the start of the step. */
    static Point<dim>
    place_of(const StepContext<dim> &step,
             const unsigned int      k,
             const unsigned int      q)
    {
      Point<dim> x;
      for (unsigned int v = 0; v <= dim; ++v)
        x += step.points.shape[q][v] *
             step.points.corner(step.grid.geometry(), k, v);
      return x;
    }

    /** Whether the probe lies within what a material point stands for, at
     * t = 0: 1.5 of its size reach to the corners of sharp triangles.
     * Collective. */
    static bool
    lies_in_body(const StepContext<dim> &step, const Probe &probe)
    {
      bool near = false;
      for (unsigned int k = 0; k < step.points.cell.size() && !near; ++k)
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          near = near || (probe.may_be_in(step.grid, step.points.cell[k]) &&
                          place_of(step, k, q).distance(probe.location) <
                            1.5 * std::pow(step.points.volume[q], 1. / dim));
      return Utilities::MPI::max(near ? 1 : 0, step.grid.communicator()) == 1;
    }

    /** Displacement increment (m) and pressure (Pa) at a probe. */
    using Values = std::array<double, dim + 1>;

    /** How many points act on each node. One without points may be a node of a
     * cell that holds a point all the same: a point with a domain acts through
     * its corners. Its unknowns mean nothing. Empty if there is none of these.
     * Collective. */
    static NodalField
    touched_nodes(const StepContext<dim> &step)
    {
      NodalField touched;
      if (Utilities::MPI::max(step.points.has_stencils() ? 1 : 0,
                              step.grid.communicator()) == 0)
        return touched;
      step.nodes.initialize(touched, 1);
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
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

    /** Among several ranks that hold something at a probe, the values of that
     * one whose @p misfit is smallest, the first of them if several are alike.
     * False if none holds anything. Collective. */
    static bool
    take_best(const MPI_Comm comm,
              const double   misfit,
              const bool     holds,
              Values        &values)
    {
      const double       least  = Utilities::MPI::min(misfit, comm);
      const unsigned int rank   = Utilities::MPI::this_mpi_process(comm);
      const unsigned int winner = Utilities::MPI::min(
        holds && misfit == least ? rank : numbers::invalid_unsigned_int, comm);
      if (rank != winner)
        values.fill(0.);
      sum_over_ranks(values, comm);
      return winner != numbers::invalid_unsigned_int;
    }

    /** A cell of the list in PointArrays and how far inside of it a place is:
     * its smallest barycentric coordinate. */
    struct Fit
    {
      unsigned int cell   = numbers::invalid_unsigned_int;
      double       inside = 0;

      bool
      found() const
      {
        return cell != numbers::invalid_unsigned_int;
      }
    };

    /** That cell of this rank around the probe whose nodes all move with the
     * body and that fits best: a probe @p in_body may lie on the surface, which
     * may be beyond the last cell that holds a material point. */
    static Fit
    find_cell(const StepContext<dim> &step,
              const Probe            &probe,
              const NodalField       &touched,
              const bool              in_body)
    {
      const auto moves_with_body = [&](const unsigned int vertex) {
        const unsigned int node = step.nodes.node(vertex);
        return node != numbers::invalid_unsigned_int &&
               (touched.size() == 0 || touched.local_element(node) > 0.);
      };
      Fit best;
      best.inside = in_body ? -1 : -1e-2;
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        {
          if (!probe.may_be_in(step.grid, step.points.cell[k]))
            continue;
          const auto vertices =
            step.grid.shape_functions().nodes(step.points.cell[k]);
          if (!std::all_of(vertices.begin(), vertices.end(), moves_with_body))
            continue;
          const auto lambda =
            step.points.barycentric(step.grid.geometry(), k, probe.location);
          const double inside = *std::min_element(lambda.begin(), lambda.end());
          if (inside > best.inside)
            best = {k, inside};
        }
      return best;
    }

    /** Interpolate in the cell that find_cell() finds, its shape functions
     * extrapolated if it must be. False if there is none. Collective. */
    static bool
    interpolate(const StepResult<dim> &result,
                const Probe           &probe,
                const NodalField      &touched,
                const bool             in_body,
                Values                &values)
    {
      const StepContext<dim> &step = result.step;
      const Fit               best = find_cell(step, probe, touched, in_body);
      values.fill(0.);
      if (best.found())
        {
          typename ShapeFunctions<dim>::Values at;
          step.grid.shape_functions().evaluate(
            step.points.cell[best.cell],
            step.points.barycentric(step.grid.geometry(),
                                    best.cell,
                                    probe.location),
            at);
          const NodalUnknowns<dim> nodal(step, result.unknowns);
          for (unsigned int I = 0; I < at.n_nodes; ++I)
            {
              const Tensor<1, dim> increment = nodal.increment(at.vertex[I]);
              for (unsigned int a = 0; a < dim; ++a)
                values[a] += at.shape[I] * increment[a];
              if (step.mixed())
                values[dim] += at.shape[I] * nodal.pressure(at.vertex[I]);
            }
        }
      return take_best(step.grid.communicator(),
                       -best.inside,
                       best.found(),
                       values);
    }

    /** Where no cell around the probe moves with the body, as where a surface
     * is much distorted, it moves as the nearest material point and what is
     * around it: Δu_p + ∇Δu_p (x - x_p). Collective. */
    static void
    extrapolate(const StepResult<dim> &result,
                const Probe           &probe,
                Values                &values)
    {
      const StepContext<dim>     &step     = result.step;
      const SimplexGeometry<dim> &geometry = step.grid.geometry();
      double                      nearest  = std::numeric_limits<double>::max();
      unsigned int                cell = 0, point = 0;
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        for (unsigned int q = step.points.cell_start[k];
             q < step.points.cell_start[k + 1];
             ++q)
          {
            const double distance =
              probe.location.distance(place_of(step, k, q));
            if (distance < nearest &&
                probe.may_be_in(step.grid, step.points.cell[k]))
              {
                nearest = distance;
                cell    = k;
                point   = q;
              }
          }
      values.fill(0.);
      const bool found = nearest < std::numeric_limits<double>::max();
      if (found)
        {
          const NodalUnknowns<dim> nodal(step, result.unknowns);
          const auto stencil = step.points.stencil(geometry, cell, point);
          const Tensor<1, dim> increment =
            nodal.increment_at(stencil) +
            nodal.gradient_at(stencil) *
              (probe.location - place_of(step, cell, point));
          for (unsigned int a = 0; a < dim; ++a)
            values[a] = increment[a];
          values[dim] = nodal.pressure_at(stencil);
        }
      take_best(step.grid.communicator(), nearest, found, values);
    }

    std::vector<Probe> probes;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, PointProbes, "Point probes")
} // namespace isochor
