/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/equations/pressure_mapping.h>
#include <isochor/postprocess/carried_reactions.h>
#include <isochor/postprocess/energy_balance.h>
#include <isochor/postprocess/postprocessor.h>
#include <isochor/postprocess/stabilisation_energy.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

namespace isochor
{
  /**
   * Where the energy of the body is and where it came from, its linear and its
   * angular momentum about the origin (per metre of thickness in plane strain):
   *
   *  - strain energy Σ_p V_p (W_dev + p²/(2K)) and, with PPP, that of the
   *    stabilisation (StabilisationEnergy, doc/method.md);
   *  - plastic work: the work of the stresses at points whose law has a
   *    history, (τ_n : ∇_n Δu + τ_{n+1} : ∇_{n+1} Δu) V_p / 2 in a step, minus
   *    what is stored elastically;
   *  - external work of loads and of prescribed motions, by the mean of the
   *    forces at both ends of a step times Δu_I;
   *  - what the scheme lost: external work minus the change of
   *    kinetic and strain energy, minus plastic work: errors of load stepping,
   *    time integration and the transfer between points and nodes.
   */
  template <int dim>
  class Energies : public Postprocessor<dim>, public HasEnergyBalance<dim>
  {
  public:
    void
    grid_changed(const BackgroundGrid<dim> & /*grid*/) override
    {
      has_other_grid = true;
    }

    void
    owners_changed(const BackgroundGrid<dim> &grid) override
    {
      // the next step keeps those of its own held unknowns
      for (const auto &of_rank :
           Utilities::MPI::all_gather(grid.communicator(), reactions))
        reactions.insert(of_rank.begin(), of_rank.end());
    }

    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Write energies",
                        "in dynamics",
                        Patterns::Selection("never|in dynamics|always"),
                        "Whether strain energy, plastic and external work, "
                        "momenta and the energy lost by the scheme go into the "
                        "statistics. 'never': nor are losses warned of.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      in_statics  = prm.get("Write energies") == "always";
      in_dynamics = prm.get("Write energies") != "never";
      watches     = in_dynamics;
    }

    void
    evaluate_nodes(const StepResult<dim> &result,
                   Statistics & /*statistics*/) override
    {
      is_watched = is_watched_in_statics(result);
      if (!enabled(result))
        return;
      std::array<double, n_sums> sums = point_sums(result);
      sums[external] = external_work(result) + result.work_of_jump;
      sum_over_ranks(sums, result.step.grid.communicator());
      stabilisation.advance(result.step, result.unknowns, old_weight(result));
      if (result.time.step == 0)
        initial_energy = sums[old_strain] + sums[old_kinetic] +
                         kinetic_energy_of_conditions(result).value_or(0);
      const double stabilisation_energy =
        stabilisation.stored + result.subscale_energy;
      strain_energy = sums[strain] + stabilisation_energy;
      stiffness     = sums[shear_modulus];
      external_sum += sums[external];
      stress_work += sums[plastic];
      // p θ' of the points lacks what the stabilisation stores
      plastic_sum =
        stress_work - (any_dissipates(result.step) ? stabilisation_energy : 0.);
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      if (!enabled(result))
        return;
      const PointLayout    &l = result.points.layout();
      std::array<double, 7> sums{}; // momenta, kinetic energy
      for (const auto &point : result.points.handler())
        {
          const auto     values = point.get_properties();
          const double   m      = values[l.mass];
          Tensor<1, dim> v;
          for (unsigned int a = 0; l.dynamic && a < dim; ++a)
            v[a] = values[l.velocity + a];
          const auto x = point.get_location();
          for (unsigned int a = 0; a < dim; ++a)
            {
              sums[a] += m * v[a];
              const unsigned int b = (a + 1) % dim, c = (a + 2) % dim;
              if (dim == 3)
                sums[3 + a] += m * (x[b] * v[c] - x[c] * v[b]);
            }
          if (dim == 2)
            sums[5] += m * (x[0] * v[1] - x[1] * v[0]);
          sums[6] += m / 2 * v.norm_square();
        }
      sum_over_ranks(sums, result.step.grid.communicator());

      const auto of_conditions = kinetic_energy_of_conditions(result);
      balance                  = {sums[6] + of_conditions.value_or(0),
                                  strain_energy + plastic_sum,
                                  external_sum + initial_energy,
                                  stiffness};
      if (!l.dynamic && !in_statics)
        return;
      statistics.set("Strain energy (J)", strain_energy);
      statistics.set("Plastic work (J)", plastic_sum);
      statistics.set("External work (J)", external_sum);
      statistics.set("Energy lost by the scheme (J)",
                     balance.supplied - balance.internal - balance.kinetic);
      if (!l.dynamic)
        return;
      if (of_conditions)
        statistics.set("Kinetic energy of rigid bodies (J)", *of_conditions);
      for (unsigned int a = 0; a < dim; ++a)
        statistics.set(std::string("Momentum ") + "xyz"[a] + " (kg m/s)",
                       sums[a]);
      for (unsigned int a = (dim == 3 ? 0 : 2); a < 3; ++a)
        statistics.set(std::string("Angular momentum ") + "xyz"[a] +
                         " (kg m^2/s)",
                       sums[3 + a]);
    }

    const EnergyBalance *
    energy_balance(const StepResult<dim> &result) const override
    {
      return result.points.layout().dynamic ?
               (in_dynamics ? &balance : nullptr) :
               (is_watched ? &balance : nullptr);
    }

    std::string
    save_state() const override
    {
      std::ostringstream state;
      state.precision(std::numeric_limits<double>::max_digits10);
      state << initial_energy << ' ' << external_sum << ' ' << stress_work
            << ' ';
      stabilisation.save(state);
      state << reactions.size() << ' ';
      for (const auto &reaction : reactions)
        state << reaction.first << ' ' << reaction.second << ' ';
      state << places.size() << ' ';
      for (const auto &place : places)
        state << place.first << ' ' << place.second << ' ';
      return state.str();
    }

    void
    load_state(const std::string &text) override
    {
      std::istringstream state(text);
      std::size_t        n = 0;
      state >> initial_energy >> external_sum >> stress_work;
      stabilisation.load(state);
      state >> n;
      for (std::size_t i = 0; i < n; ++i)
        {
          unsigned int entry = 0;
          state >> entry;
          state >> reactions[entry];
        }
      has_other_grid = false; // that of the state is back
      state >> n;
      for (std::size_t i = 0; i < n; ++i)
        {
          unsigned int entry = 0;
          state >> entry;
          for (unsigned int d = 0; d < dim; ++d)
            state >> places[entry][d];
        }
    }

  private:
    enum Sum
    {
      strain,
      old_strain,
      old_kinetic,
      plastic,
      external,
      shear_modulus,
      n_sums
    };

    static bool
    any_dissipates(const StepContext<dim> &step)
    {
      for (const auto &material : step.kernel.materials)
        if (material->dissipates())
          return true;
      return false;
    }

    /** Whether points of elastic materials, too, do work that they don't store,
     * which is to be told from that of the others. */
    static bool
    is_stabilised(const StepContext<dim> &step)
    {
      return step.mixed() && step.kernel.stabilisation.coefficient > 0 &&
             any_dissipates(step);
    }

    bool
    enabled(const StepResult<dim> &result) const
    {
      return result.points.layout().dynamic ? in_dynamics :
                                              in_statics || is_watched;
    }

    /** Elastic bodies; first steps may be too large for the work's formula. */
    bool
    is_watched_in_statics(const StepResult<dim> &result) const
    {
      return watches && !result.points.layout().dynamic &&
             result.time.step >= 10 && !any_dissipates(result.step);
    }

    /** This rank's part of what is found at the points, which are where the
     * step has started. */
    std::array<double, n_sums>
    point_sums(const StepResult<dim> &result) const
    {
      const StepContext<dim>         &step   = result.step;
      const PointArrays<dim>         &points = step.points;
      const NodalUnknowns<dim>        nodal(step, result.unknowns);
      std::array<double, n_sums>      sums{};
      std::array<double, max_history> history;
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            const auto stencil = points.stencil(step.grid.geometry(), k, q);
            const Tensor<2, dim>      gradient = nodal.gradient_at(stencil);
            const MaterialModel<dim> &material =
              *step.kernel.materials[points.material[q]];
            const double *const old_history =
              points.history.data() + q * std::size_t(points.n_history);
            const double V      = points.volume[q] * points.thickness(q);
            const double hoop   = nodal.hoop_at(stencil, points, q);
            const double half_K = material.inverse_bulk_modulus() / 2;

            const auto state =
              step.kernel.final_state(points,
                                      q,
                                      gradient + unit_symmetric_tensor<dim>(),
                                      hoop,
                                      step.mixed(),
                                      nodal.pressure_at(stencil),
                                      history.data());
            const double stored =
              material.deviatoric_energy(state.F, history.data()) +
              half_K * state.pressure * state.pressure;
            sums[strain] += V * stored;
            sums[shear_modulus] += V * material.shear_modulus();
            if (result.time.step == 0 && result.points.layout().dynamic)
              sums[old_kinetic] +=
                points.mass[q] / 2 * points.velocity[q].norm_square();
            if (result.time.step > 0 && points.n_history == 0)
              continue;

            const double old_stored =
              material.deviatoric_energy(points.F[q], old_history) +
              half_K * points.pressure[q] * points.pressure[q];
            sums[old_strain] += V * old_stored;
            if (!material.dissipates() && !is_stabilised(step))
              continue;
            const auto old_state =
              step.kernel.final_state(points,
                                      q,
                                      unit_symmetric_tensor<dim>(),
                                      1.,
                                      step.mixed(),
                                      points.pressure[q],
                                      history.data());
            const Tensor<2, dim> new_gradient =
              gradient * invert(gradient + unit_symmetric_tensor<dim>());
            sums[plastic] += V * (old_state.power(gradient, hoop - 1) / 2 +
                                  state.power(new_gradient, 1 - 1 / hoop) / 2 -
                                  (stored - old_stored));
          }
      return sums;
    }

    static std::optional<double>
    kinetic_energy_of_conditions(const StepResult<dim> &result)
    {
      const auto with_mass = with_role<const HasMass<dim>>(result.conditions);
      Assert(with_mass.size() <= 1, ExcInternalError());
      return with_mass.empty() || !result.points.layout().dynamic ?
               std::nullopt :
               with_mass[0]->kinetic_energy();
    }

    /** What the stabilisation takes for the body's weight at the start of the
     * step. */
    static Tensor<1, dim>
    old_weight(const StepResult<dim> &result)
    {
      const MixedKernel<dim> &kernel = result.step.kernel;
      Tensor<1, dim>          weight;
      if (kernel.stabilisation.hydrostatic_acceleration.norm_square() == 0)
        return weight;
      for (const auto &condition : result.conditions)
        weight += condition->body_acceleration(result.step.old_time);
      if (kernel.axisymmetric)
        weight[0] = 0.;
      return weight;
    }

    /** The unknowns that the step started with. */
    static NodalField
    start_unknowns(const StepResult<dim> &result)
    {
      StepContext<dim> start = result.step;
      start.time             = start.old_time;
      NodalField rest;
      start.nodes.initialize(rest, start.n_components);
      if (result.start != nullptr)
        rest = *result.start;
      else if (start.mixed())
        map_pressure_to_nodes(start, rest);
      return rest;
    }

    /** The mean over the step and, as the component of pressures, the change of
     * the volume that interactions leave out. @p rest: start_unknowns().
     * Collective. */
    static NodalField
    external_forces(const StepResult<dim> &result, const NodalField &rest)
    {
      const StepContext<dim> &step  = result.step;
      StepContext<dim>        start = step;
      start.time                    = step.old_time;
      NodalField force;
      step.nodes.initialize(force, step.n_components);
      const auto add = [&](const StepContext<dim> &at,
                           const NodalField       &unknowns) {
        for (const auto &condition : result.conditions)
          condition->add_external_force(at, force);
        for (const auto *const condition :
             with_role<const ActsByAssembly<dim>>(result.conditions))
          condition->add_boundary_force(at, unknowns, force);
      };
      const auto scale = [&](const double forces, const double volumes) {
        for (unsigned int i = 0; i < step.nodes.n_local() * step.n_components;
             ++i)
          force.local_element(i) *=
            (i % step.n_components == dim ? volumes : forces);
      };
      add(start, rest);
      scale(1, -1);
      add(step, result.unknowns);
      scale(0.5, 1);
      force.compress(VectorOperation::add);
      return force;
    }

    /** Of the step, this rank's part. */
    double
    external_work(const StepResult<dim> &result)
    {
      const StepContext<dim> &step  = result.step;
      const NodalField        rest  = start_unknowns(result);
      const NodalField        force = external_forces(result, rest);
      double                  work  = 0;
      const bool with_volumes       = step.mixed() && step.unknowns_at_start;
      for (unsigned int node = 0; node < step.nodes.n_owned() && with_volumes;
           ++node)
        {
          const unsigned int i = node * step.n_components + dim;
          work -= force.local_element(i) / 2 *
                  (rest.local_element(i) + result.unknowns.local_element(i));
        }
      for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
        for (unsigned int a = 0; a < dim; ++a)
          {
            const unsigned int i = node * step.n_components + a;
            const double       u = result.unknowns.local_element(i);
            work += force.local_element(i) * u;
            if (result.system.equation(i) != numbers::invalid_unsigned_int)
              continue;
            // of what follows others: of the motion that is prescribed for it
            const bool follows = result.system.follows(i);
            add_held(step,
                     i,
                     follows ? result.system.follower_force(i) :
                               result.system.residual.local_element(i),
                     follows ? result.system.prescribed_value(i) : u);
          }
      if (std::exchange(has_other_grid, false))
        carry_reactions(step, held, places, reactions);
      // before the first step nothing reacts, in statics unless the body is
      // stressed, in dynamics to what starts suddenly, but for the impulse
      const bool starts_unloaded =
        result.time.step == 0 &&
        (result.points.layout().dynamic ?
           Utilities::MPI::max(std::abs(result.work_of_jump),
                               step.grid.communicator()) > 0 :
           initial_energy == 0.);
      std::map<unsigned int, double> new_reactions;
      for (const HeldUnknown &one : held)
        {
          const auto   old    = reactions.find(one.entry);
          const double before = old != reactions.end() ? old->second :
                                starts_unloaded        ? 0. :
                                                         one.reaction;
          work += (one.reaction + before) / 2 * one.moved;
          new_reactions[one.entry] = one.reaction;
        }
      reactions.swap(new_reactions);
      places.clear();
      for (const HeldUnknown &one : held)
        if (step.grid.is_adaptive())
          places[one.entry] = place_at_end(result, one.entry);
      held.clear();
      return work;
    }

    /** Where the vertex of @p entry is when the step is over: a grid that moves
     * starts the next one there. */
    static Point<dim>
    place_at_end(const StepResult<dim> &result, const unsigned int entry)
    {
      const StepContext<dim> &step  = result.step;
      Point<dim>              place = place_of_entry(step, entry);
      if (step.grid.is_moving())
        for (unsigned int a = 0; a < dim; ++a)
          place[a] += result.unknowns.local_element(
            step.nodes.node(entry / dim) * step.n_components + a);
      return place;
    }

    void
    add_held(const StepContext<dim> &step,
             const unsigned int      entry,
             const double            reaction,
             const double            moved)
    {
      AssertIndexRange(entry, step.nodes.n_owned() * step.n_components);
      Assert(entry % step.n_components < dim,
             ExcMessage("Pressures do no work."));
      const unsigned int nc = step.n_components;
      held.push_back(
        {step.nodes.vertex(entry / nc) * dim + entry % nc, reaction, moved});
    }

    bool   in_statics = false, in_dynamics = true, watches = true;
    bool   is_watched     = false; ///< in this step, in statics
    double initial_energy = 0, strain_energy = 0, external_sum = 0,
           plastic_sum = 0;
    /** Of the stresses at points that may yield, less what these store. */
    double                   stress_work = 0;
    StabilisationEnergy<dim> stabilisation;
    EnergyBalance            balance; ///< after this step
    /** Σ V_p G_p. */
    double stiffness = 0;
    /** Of held unknowns of this rank's vertices at the end of the last step, by
     * dim * vertex + component. */
    std::map<unsigned int, double> reactions;
    /** Where they are, on adaptive grids; whether these are other ones now. */
    std::map<unsigned int, Point<dim>> places;
    bool                               has_other_grid = false;
    std::vector<HeldUnknown>           held; ///< in this step
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Energies, "Energies")
} // namespace isochor
