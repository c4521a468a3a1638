/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/parameter_list.h>
#include <isochor/base/safe_file.h>
#include <isochor/step/checkpoint.h>
#include <isochor/step/checkpoint_file.h>
#include <isochor/step/plugin_states.h>

#include <boost/archive/binary_iarchive.hpp>
#include <boost/archive/binary_oarchive.hpp>
#include <boost/serialization/map.hpp>
#include <boost/serialization/string.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace isochor
{
  /** What one rank saves. */
  template <int dim>
  struct Checkpoint<dim>::Contents
  {
    unsigned int                       n_ranks          = 0;
    std::uint64_t                      grid_fingerprint = 0;
    std::map<std::string, std::string> problem, settings;

    LoadStepping time;
    LastMotion   last_motion;
    std::string  grid_reset;
    /** What boundary conditions and post-processors remember, by name. */
    std::map<std::string, std::string> boundary_conditions, postprocessors;
    std::string                        diagnoses;

    /** The points in the order of the handler: per point the cell, the id, the
     * coordinates (dim in space, dim in the reference cell) and properties. */
    unsigned int               n_properties = 0;
    std::vector<unsigned int>  cells;
    std::vector<std::uint64_t> ids;
    std::vector<double>        coordinates, properties;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &n_ranks &grid_fingerprint &problem &settings &time &last_motion
        &grid_reset &boundary_conditions &postprocessors &diagnoses
          &n_properties &cells &ids &coordinates &properties;
    }
  };



  namespace
  {
    constexpr unsigned int n_slots = 2;

    /** Of vertices, cells and who owns them. */
    template <int dim>
    std::uint64_t
    fingerprint(const SimplexGeometry<dim> &geometry)
    {
      const auto   &vertices = geometry.vertices();
      std::uint64_t hash =
        fnv1a(vertices.data(), vertices.size() * sizeof(vertices[0]));
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          const auto        &corners = geometry.vertex_indices(cell);
          const unsigned int owner   = geometry.owner(cell);
          hash = fnv1a(corners.data(), sizeof(corners), hash);
          hash = fnv1a(&owner, sizeof(owner), hash);
        }
      return hash;
    }



    /** Which parameters differ, for messages. */
    std::string
    differences(const std::map<std::string, std::string> &then,
                const std::map<std::string, std::string> &now)
    {
      std::string text;
      const auto  add = [&](const std::string &path,
                           const std::string &old_value,
                           const std::string &new_value) {
        text +=
          "\n  <" + path + ">: " + old_value + " then, " + new_value + " now";
      };
      for (const auto &entry : then)
        {
          const auto other = now.find(entry.first);
          if (other == now.end())
            add(entry.first, "'" + entry.second + "'", "unknown");
          else if (other->second != entry.second)
            add(entry.first,
                "'" + entry.second + "'",
                "'" + other->second + "'");
        }
      for (const auto &entry : now)
        if (then.find(entry.first) == then.end())
          add(entry.first, "unknown", "'" + entry.second + "'");
      return text;
    }
  } // namespace



  template <int dim>
  void
  Checkpoint<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Checkpoint");
    prm.declare_entry(
      "Interval",
      "0",
      Patterns::Integer(0),
      "Steps between two checkpoints, from which an interrupted "
      "run can be resumed. Another is written at the end. 0: "
      "none after a number of steps, and none at all, not even at "
      "the end, if <Wall time interval> is 0, too.");
    prm.declare_entry("Wall time interval",
                      "0",
                      Patterns::Double(0),
                      "A checkpoint is written after the first step that ends "
                      "so long (s, of real time) after the last one. 0: none "
                      "by wall time.");
    prm.declare_entry("Resume",
                      "false",
                      Patterns::Bool(),
                      "Whether to continue from the last checkpoint in the "
                      "output directory, on as many processes as wrote it. "
                      "Parameters that describe the problem must be those of "
                      "the first run; those of <Time>, <Newton>, <Linear "
                      "solver>, <Postprocess>, <Output> and <Checkpoint>, and "
                      "<Grid reset/Tolerated imbalance>, may "
                      "change. The step size is that of the checkpoint unless "
                      "'Time/Step size' is changed.");
    prm.leave_subsection();
  }



  template <int dim>
  void
  Checkpoint<dim>::parse_parameters(ParameterHandler               &prm,
                                    const std::vector<std::string> &changeable)
  {
    prm.enter_subsection("Checkpoint");
    step_interval = prm.get_integer("Interval");
    wall_interval = prm.get_double("Wall time interval");
    resume        = prm.get_bool("Resume");
    prm.leave_subsection();
    problem.clear();
    settings.clear();
    for (const auto &entry : ParameterList(prm).entries)
      {
        const std::string path = join_path(entry.first);
        const bool        may_change =
          std::any_of(changeable.begin(),
                      changeable.end(),
                      [&path](const std::string &start) {
                        return path.compare(0, start.size(), start) == 0;
                      });
        (may_change ? settings : problem)[path] = entry.second.value;
      }
    // of this run only
    settings.erase("Checkpoint/Resume");
    settings.erase("Output/Directory");
  }



  template <int dim>
  std::vector<std::string>
  Checkpoint<dim>::changeable_parameters()
  {
    return {"Checkpoint/", "Grid reset/Tolerated imbalance"};
  }



  template <int dim>
  std::string
  Checkpoint<dim>::file_name(const unsigned int slot) const
  {
    Assert(grid != nullptr, ExcMessage("start() comes first."));
    AssertIndexRange(slot, n_slots);
    const unsigned int rank =
      Utilities::MPI::this_mpi_process(grid->communicator());
    return directory + "/checkpoint-" + std::to_string(slot) + "." +
           Utilities::int_to_string(rank, 4) + ".bin";
  }



  template <int dim>
  std::string
  Checkpoint<dim>::start(const BackgroundGrid<dim> &grid_,
                         const std::string         &directory_,
                         const State               &state)
  {
    grid             = &grid_;
    directory        = directory_;
    grid_fingerprint = fingerprint(grid->geometry());
    last_time        = std::chrono::steady_clock::now();
    if (resume)
      return resume_from_newest(state);
    return put_aside_old();
  }



  template <int dim>
  void
  Checkpoint<dim>::resume_if_asked(const BackgroundGrid<dim> &grid_,
                                   const std::string         &directory_,
                                   const State               &state)
  {
    if (resume)
      start(grid_, directory_, state);
  }



  template <int dim>
  std::string
  Checkpoint<dim>::put_aside_old() const
  {
    Assert(grid != nullptr, ExcMessage("start() comes first."));
    std::string notice;
    if (Utilities::MPI::this_mpi_process(grid->communicator()) != 0)
      return notice;
    for (unsigned int slot = 0; slot < n_slots; ++slot)
      {
        const Slot        old  = read_slot(slot);
        const std::string file = file_name(slot);
        if (std::rename(file.c_str(), (file + ".old").c_str()) == 0)
          notice += (notice.empty() ? "" : " and ") +
                    (old.contents ?
                       "after step " + std::to_string(old.contents->time.step) +
                         ", t = " + std::to_string(old.contents->time.time) :
                       std::string("an unreadable one"));
      }
    return notice.empty() ? "" :
                            "This run starts at t = 0. The checkpoints of an "
                            "earlier one in <" +
                              directory + "> (" + notice +
                              ") are kept with the ending '.old' until the "
                              "next run; to go on from them take '.old' away "
                              "and use --restart.";
  }



  template <int dim>
  bool
  Checkpoint<dim>::write_if_due(const State &state)
  {
    Assert(step_interval == 0 || grid != nullptr,
           ExcMessage("start() comes first."));
    if (step_interval == 0 && wall_interval == 0)
      return false;
    const MPI_Comm      comm = grid->communicator();
    const LoadStepping &time = state.time;

    // one clock decides for all ranks
    const std::chrono::duration<double> elapsed =
      std::chrono::steady_clock::now() - last_time;
    const bool by_wall_time =
      wall_interval > 0 &&
      Utilities::MPI::broadcast(comm, elapsed.count(), 0) >= wall_interval;
    const bool by_steps =
      step_interval > 0 && time.step >= last_step + step_interval;
    if (!by_wall_time && !by_steps && !time.finished())
      return false;

    const Contents contents = collect(state);
    run_on_all_ranks(comm, [&]() {
      std::ostringstream stream(std::ios::binary);
      {
        boost::archive::binary_oarchive archive(stream);
        archive << contents;
      }
      write_checkpoint_file(file_name(next_slot), dim, stream.str());
    });
    next_slot = (next_slot + 1) % n_slots;
    last_step = time.step;
    last_time = std::chrono::steady_clock::now();
    return true;
  }



  template <int dim>
  typename Checkpoint<dim>::Contents
  Checkpoint<dim>::collect(const State &state) const
  {
    Assert(grid != nullptr, ExcMessage("start() comes first."));
    Contents c;
    c.n_ranks          = Utilities::MPI::n_mpi_processes(grid->communicator());
    c.grid_fingerprint = grid_fingerprint;
    c.problem          = problem;
    c.settings         = settings;
    c.time             = state.time;
    c.last_motion      = state.last_motion;
    c.grid_reset       = state.setup.save_state();
    for (const auto &condition : state.boundary_conditions)
      c.boundary_conditions[condition->name] = condition->save_state();
    for (const auto &postprocessor : state.postprocessors)
      c.postprocessors[postprocessor->name] = postprocessor->save_state();
    c.diagnoses = state.diagnoses.save_state();

    const auto &handler = state.points.handler();
    c.n_properties      = handler.n_properties_per_particle();
    for (auto particle = handler.begin(); particle != handler.end(); ++particle)
      {
        c.cells.push_back(
          particle->get_surrounding_cell()->active_cell_index());
        c.ids.push_back(particle->get_id());
        for (unsigned int d = 0; d < dim; ++d)
          c.coordinates.push_back(particle->get_location()[d]);
        for (unsigned int d = 0; d < dim; ++d)
          c.coordinates.push_back(particle->get_reference_location()[d]);
        const auto values = particle->get_properties();
        c.properties.insert(c.properties.end(), values.begin(), values.end());
      }
    return c;
  }



  template <int dim>
  typename Checkpoint<dim>::Slot
  Checkpoint<dim>::read_slot(const unsigned int slot) const
  {
    Slot        result;
    std::string data;
    result.error = read_checkpoint_file(file_name(slot), dim, data);
    if (!result.error.empty())
      return result;
    try
      {
        std::istringstream              stream(data, std::ios::binary);
        boost::archive::binary_iarchive archive(stream);
        auto                            contents = std::make_unique<Contents>();
        archive >> *contents;
        result.contents = std::move(contents);
      }
    catch (const std::exception &) // of any kind: lengths may be nonsense
      {
        result.error = "The file <" + file_name(slot) +
                       "> can't be read: another version of the program has "
                       "written it.";
      }
    return result;
  }



  template <int dim>
  void
  Checkpoint<dim>::check_problem(const Contents &contents) const
  {
    const unsigned int n_ranks =
      Utilities::MPI::n_mpi_processes(grid->communicator());
    AssertThrow(contents.n_ranks == n_ranks,
                ExcMessage("The checkpoint in <" + directory +
                           "> was written by " +
                           std::to_string(contents.n_ranks) +
                           " processes. Resume it with as many, not with " +
                           std::to_string(n_ranks) + "."));
    AssertThrow(contents.problem == problem,
                ExcMessage("The checkpoint in <" + directory +
                           "> belongs to another problem:" +
                           differences(contents.problem, problem)));
    AssertThrow(contents.grid_fingerprint == grid_fingerprint,
                ExcMessage("The checkpoint in <" + directory +
                           "> belongs to another grid, or to another "
                           "partition of it: the parameters are the same, but "
                           "not vertices, cells or their owners. Has the mesh "
                           "file changed?"));
  }



  template <int dim>
  std::string
  Checkpoint<dim>::resume_from_newest(const State &state)
  {
    const MPI_Comm                comm = grid->communicator();
    std::array<Slot, n_slots>     slots;
    std::array<unsigned, n_slots> step{};
    std::string                   problems;
    unsigned int                  newest = n_slots;
    for (unsigned int slot = 0; slot < n_slots; ++slot)
      {
        run_on_all_ranks(comm, [&]() { slots[slot] = read_slot(slot); });
        Slot &s = slots[slot];
        // a set counts if all ranks have their part of the same step
        step[slot]         = s.contents ? s.contents->time.step : 0;
        const auto minimum = Utilities::MPI::min(step[slot], comm);
        const auto maximum = Utilities::MPI::max(step[slot], comm);
        if (s.error.empty() && minimum < maximum)
          s.error = "The set of the file <" + file_name(slot) +
                    "> is not of one step on all processes.";
        const auto errors = Utilities::MPI::all_gather(comm, s.error);
        // a rank whose file says how many ranks there were knows best
        run_on_all_ranks(comm, [&]() {
          if (s.contents && s.contents->n_ranks != errors.size())
            check_problem(*s.contents);
        });
        const auto error =
          std::find_if(errors.begin(), errors.end(), [](const auto &e) {
            return !e.empty();
          });
        if (error != errors.end())
          problems += (problems.empty() ? "" : " ") + *error;
        else if (newest == n_slots || step[slot] > step[newest])
          newest = slot;
      }
    AssertThrow(newest < n_slots,
                ExcMessage("There is no checkpoint to resume from in <" +
                           directory + ">. " + problems +
                           " A run writes them if it sets "
                           "<Checkpoint/Interval> or <Checkpoint/Wall time "
                           "interval>."));

    run_on_all_ranks(comm, [&]() { check_problem(*slots[newest].contents); });
    restore(*slots[newest].contents, state);
    next_slot = (newest + 1) % n_slots;
    last_step = state.time.step;
    return "Resumed after step " + std::to_string(state.time.step) +
           ", t = " + std::to_string(state.time.time) +
           (problems.empty() ? "" : " (" + problems + ")") +
           ". What was written after it is replaced." +
           (slots[newest].contents->settings == settings ?
              "" :
              " Changed:" +
                differences(slots[newest].contents->settings, settings));
  }



  template <int dim>
  void
  Checkpoint<dim>::restore(const Contents &c, const State &state) const
  {
    run_on_all_ranks(grid->communicator(), [&]() {
      check_names(c.boundary_conditions, state.boundary_conditions);
      check_names(c.postprocessors, state.postprocessors);
      AssertThrow(c.n_properties ==
                    state.points.handler().n_properties_per_particle(),
                  ExcMessage("The checkpoint was written by a program whose "
                             "material points carry other fields."));
    });
    state.time.resume(c.time);
    state.last_motion = c.last_motion;
    state.setup.load_state(c.grid_reset);
    load_states(c.boundary_conditions, state.boundary_conditions);
    load_states(c.postprocessors, state.postprocessors);
    state.diagnoses.load_state(c.diagnoses);

    // in the order saved, which is then that of the handler: sums over points
    // must not change by rounding
    auto &handler = state.points.handler();
    handler.clear_particles();
    for (std::size_t i = 0; i < c.cells.size(); ++i)
      {
        Point<dim> location, reference;
        for (unsigned int d = 0; d < dim; ++d)
          {
            location[d]  = c.coordinates[2 * dim * i + d];
            reference[d] = c.coordinates[2 * dim * i + dim + d];
          }
        handler.insert_particle(location,
                                reference,
                                c.ids[i],
                                grid->geometry().cell_iterator(c.cells[i]),
                                ArrayView<const double>(c.properties.data() +
                                                          c.n_properties * i,
                                                        c.n_properties));
      }
    handler.update_cached_numbers();
  }



  template class Checkpoint<2>;
  template class Checkpoint<3>;
} // namespace isochor
