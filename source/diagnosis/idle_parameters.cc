/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/parameter_list.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/interaction/interaction_law.h>
#include <isochor/interaction/rigid_body_term.h>
#include <isochor/linear_solver/linear_solver_choice.h>

#include <algorithm>
#include <set>
#include <string>

namespace isochor
{
  namespace
  {
    using Path = ParameterList::Path;

    /** Looks into a list of parameters and warns. */
    class Inspector
    {
    public:
      Inspector(const ParameterList &list, Warnings &warnings)
        : list(list)
        , warnings(warnings)
      {}

      /** The value of a parameter, empty if there is none. */
      std::string
      value(const Path &path) const
      {
        const auto entry = list.entries.find(path);
        return entry == list.entries.end() ? "" : entry->second.value;
      }

      double
      number(const Path &path) const
      {
        const std::string text = value(path);
        return text.empty() ? 0. : std::stod(text);
      }

      /** Warn if the parameter is changed; @p why completes "has no effect". */
      void
      idle(const Path &path, const std::string &why) const
      {
        const auto entry = list.entries.find(path);
        if (entry == list.entries.end() || !entry->second.is_changed())
          return;
        const std::string name = join_path(path);
        warnings.add("no effect of <" + name + ">",
                     "<" + name + " = " + entry->second.value +
                       "> has no effect " + why + ".");
      }

      /** The same for all parameters whose path starts with @p start, but for
       * the one called @p except there. */
      void
      idle_section(const Path        &start,
                   const std::string &why,
                   const std::string &except = "") const
      {
        for (const auto &entry : list.entries)
          if (entry.first.size() > start.size() &&
              std::equal(start.begin(), start.end(), entry.first.begin()) &&
              entry.first.back() != except)
            idle(entry.first, why);
      }

      /** In @p section, the subsections are those of the plugins among which
       * @p selector chooses: warn of those of the others. */
      void
      idle_plugins(const std::string &section,
                   const std::string &selector) const
      {
        const std::string chosen = value({section, selector});
        for (const Path &path : list.subsections)
          if (path.size() == 2 && path[0] == section && path[1] != chosen)
            idle_section(path,
                         "with <" + section + "/" + selector + " = " + chosen +
                           ">");
      }

    private:
      const ParameterList &list;
      Warnings            &warnings;
    };



    /** @p all: the parameters of all ways to make a grid. */
    template <int dim>
    void
    inspect_grid(const Inspector             &inspect,
                 const GridSource<dim>       &source,
                 const std::set<std::string> &all,
                 const GridReset<dim>        &reset)
    {
      const std::string type = inspect.value({"Grid", "Type"});
      std::string       with = "with <Grid/Type = " + type + ">";
      if (!source.is_adaptive())
        inspect.idle_section({"Adaptive grid"}, with);
      else
        with += " and <Grid/Coarse cells = " +
                inspect.value({"Grid", "Coarse cells"}) + ">";
      const std::set<std::string> in_use = source.parameters_in_use();
      for (const std::string &name : all)
        if (in_use.count(name) == 0)
          inspect.idle({"Grid", name},
                       with + " in " + std::to_string(dim) + "D");
      if (reset.always())
        inspect.idle({"Grid reset", "Smallest element quality"},
                     reset.why_always() +
                       ": the grid is reset after each step");
    }



    /** What the solution asks for, where the grid never changes or nothing can
     * yield. */
    void
    inspect_adaptation(const ParameterList &list, const Inspector &inspect)
    {
      const std::string section = "Adaptive grid";
      if (inspect.number({section, "Resets between changes"}) == 0 &&
          inspect.number({section, "Repetitions of first step"}) == 0)
        for (const char *name : {"Cell size in plastic zones",
                                 "Plastic increment",
                                 "Target of relative error",
                                 "Target number of leaves"})
          inspect.idle({section, name},
                       "with <Adaptive grid/Resets between changes = 0> and "
                       "<Adaptive grid/Repetitions of first step = 0>: the "
                       "grid stays as it is at t = 0");
      const bool can_yield =
        std::any_of(list.entries.begin(),
                    list.entries.end(),
                    [](const auto &entry) {
                      return entry.first.back() == "Model" &&
                             entry.second.value != "Neo-Hookean";
                    });
      if (!can_yield)
        for (const char *name :
             {"Cell size in plastic zones", "Plastic increment"})
          inspect.idle({section, name},
                       "with <Material/Model = Neo-Hookean>, which never "
                       "yields");
    }



    void
    inspect_equations(const Inspector &inspect, const bool has_inertia)
    {
      if (inspect.value({"Formulation", "Type"}) == "u")
        for (const char *name : {"Stabilisation", "PPP coefficient"})
          inspect.idle({"Formulation", name}, "with <Formulation/Type = u>");
      else if (inspect.value({"Formulation", "Stabilisation"}) == "none")
        inspect.idle({"Formulation", "PPP coefficient"},
                     "with <Formulation/Stabilisation = none>");
      if (!has_inertia)
        inspect.idle({"Time", "Tolerated error"},
                     "without inertia: it is about steps in dynamics");
      if (!has_inertia)
        inspect.idle_section(
          {"Dynamics"},
          inspect.value({"Dynamics", "Scheme"}) == "statics" ?
            "with <Dynamics/Scheme = statics>" :
            "with <Dynamics/Inertia = false>",
          inspect.value({"Dynamics", "Scheme"}) == "statics" ? "Scheme" :
                                                               "Inertia");
    }



    void
    inspect_cut_cells(const Inspector &inspect, const bool is_asked_for)
    {
      const std::string use = inspect.value({"Cut cells", "Extension"});
      if (use == "never" || (use == "auto" && !is_asked_for))
        inspect.idle({"Cut cells", "Smallest support"},
                     use == "never" ?
                       "with <Cut cells/Extension = never>" :
                       "with <Cut cells/Extension = auto> and <Quadrature/Type "
                       "= " +
                         inspect.value({"Quadrature", "Type"}) + ">");
    }



    /** The names in "name: ...; name: ...". */
    std::set<std::string>
    names_in(const std::string &named_list)
    {
      std::set<std::string> names;
      for (const auto &entry : split_named_list(named_list, ""))
        names.insert(entry.first);
      return names;
    }



    void
    inspect_surfaces(const ParameterList &list,
                     const Inspector     &inspect,
                     Warnings            &warnings)
    {
      const std::string main        = "Boundary conditions",
                        interaction = "Interaction: ";
      for (const Path &path : list.subsections)
        {
          const std::string section = path.front();
          if (path.size() > 1 || section.rfind(main, 0) != 0)
            continue;
          if (inspect.value({section, "Surfaces of body"}).empty())
            {
              const std::string without =
                "without <" + section + "/Surfaces of body>";
              inspect.idle({section, "Mesh of body surfaces"}, without);
              if (inspect.value({section, "Traction"}).empty())
                inspect.idle({section, "Boundary points per face"},
                             without + " or <" + section + "/Traction>");
            }
          std::set<std::string> used =
            names_in(inspect.value({section, "Traction on body"}));
          used.merge(names_in(inspect.value({section, "Pressure on body"})));
          for (const Path &other : list.subsections)
            if (section == main && other[0].rfind(interaction, 0) == 0)
              used.insert(
                other[0].substr(interaction.size(),
                                other[0].find(" - ") - interaction.size()));
          for (const std::string &name :
               names_in(inspect.value({section, "Surfaces of body"})))
            if (used.count(name) == 0)
              warnings.add(
                "no effect of <" + section + "/Surfaces of body: " + name + ">",
                "no condition names this surface: name it in <Traction on "
                "body> or <Pressure on body> of that section, in a section "
                "<Interaction: " +
                  name + " - place>, or leave it out.");
        }
    }



    void
    inspect_points(const Inspector &inspect, const bool has_domains)
    {
      if (!has_domains)
        inspect.idle({"Material points", "Split at share of cell"},
                     "with <Quadrature/Type = " +
                       inspect.value({"Quadrature", "Type"}) +
                       ">: points without subdomains aren't split");
      if (inspect.number({"Material points", "Lattice spacing"}) > 0)
        inspect.idle({"Material points", "Points per cell"},
                     "with <Material points/Lattice spacing>, which sets the "
                     "density of points");
    }



    void
    inspect_materials(const ParameterList &list, Inspector &inspect)
    {
      for (const Path &path : list.subsections)
        if (path.size() == 1 && path[0].rfind("Material", 0) == 0 &&
            list.entries.count({path[0], "Model"}) > 0)
          {
            inspect.idle_plugins(path[0], "Model");
            if (inspect.number({path[0], "J2", "Saturation exponent"}) == 0 &&
                inspect.value({path[0], "Model"}) == "J2")
              inspect.idle({path[0], "J2", "Saturation stress"},
                           "with <" + path[0] + "/J2/Saturation exponent = 0>");
          }
    }



    /** The sections "Rigid body: NAME" and "Interaction: BODY - PARTNER". */
    template <int dim>
    void
    inspect_partners(
      const ParameterList                                       &list,
      const std::vector<std::shared_ptr<RigidBodyInScene<dim>>> &rigid_bodies,
      const Inspector                                           &inspect)
    {
      for (const auto &one : rigid_bodies)
        {
          const std::string section = "Rigid body: " + one->body.name();
          const std::set<std::string> in_use = one->body.parameters_in_use();
          for (const auto &entry : list.entries)
            if (entry.first.size() == 2 && entry.first[0] == section &&
                in_use.count(entry.first[1]) == 0)
              inspect.idle(entry.first,
                           "with <" + section + "/Shape = " +
                             inspect.value({section, "Shape"}) + "> " +
                             (one->body.has_free_components() ? "and" :
                                                                "without") +
                             " <Free>");
        }
      for (const Path &path : list.subsections)
        if (path.size() == 1 && path[0].rfind("Interaction: ", 0) == 0)
          {
            using Laws                 = PluginRegistry<InteractionLaw<dim>>;
            const std::string     law  = inspect.value({path[0], "Law"});
            const auto            used = Laws::parameters(law);
            std::set<std::string> of_laws;
            for (const std::string &name :
                 Utilities::split_string_list(Laws::names(), '|'))
              of_laws.merge(Laws::parameters(name));
            for (const std::string &name : of_laws)
              if (used.count(name) == 0)
                inspect.idle({path[0], name},
                             "with <" + path[0] + "/Law = " + law + ">");
            const std::string partner = path[0].substr(path[0].rfind(" - "));
            if (partner != " - place")
              inspect.idle({path[0], "Displacement"},
                           "on an interaction with another partner than "
                           "'place'");
          }
    }



    void
    inspect_linear_solver(const ParameterList &list, const Inspector &inspect)
    {
      const std::string solver = inspect.value({"Linear solver", "Solver"});
      const std::string with   = "with <Linear solver/Solver = " + solver + ">";
      if (solver != "auto")
        inspect.idle({"Linear solver", "Largest direct system"}, with);
      const auto in_use = LinearSolverChoice::candidates(solver);
      if (in_use.size() == 1) // a direct solver
        inspect.idle({"Newton", "Inexact"}, with);
      for (const Path &path : list.subsections)
        if (path.size() == 2 && path[0] == "Linear solver" &&
            std::find(in_use.begin(), in_use.end(), path[1]) == in_use.end())
          inspect.idle_section(path, with);
    }
  } // namespace



  /**
   * Parameters that differ from their defaults but have no effect with what the
   * others say, one warning each. Combinations that can't be meant at all are
   * errors of the classes that own the parameters.
   */
  template <int dim>
  class IdleParameters : public Diagnosis<dim>
  {
  public:
    void
    scene_read(const ParameterHandler &prm,
               const Scene<dim>       &scene,
               const GridReset<dim>   &reset) override
    {
      const ParameterList   list(prm);
      Warnings             &warnings = *this->warnings;
      Inspector             inspect(list, warnings);
      std::set<std::string> of_grids;
      for (const std::string &name : Utilities::split_string_list(
             PluginRegistry<GridSource<dim>>::names(), '|'))
        of_grids.merge(PluginRegistry<GridSource<dim>>::parameters(name));
      inspect_grid(inspect, scene.grid.source(), of_grids, reset);
      inspect_points(inspect, scene.points_have_domains());
      if (scene.grid.source().is_adaptive())
        inspect_adaptation(list, inspect);
      inspect_equations(inspect, scene.has_inertia());
      inspect_cut_cells(inspect, scene.ties_cut_cells());
      inspect_surfaces(list, inspect, warnings);
      inspect_materials(list, inspect);
      inspect_partners<dim>(list, scene.rigid_bodies, inspect);
      inspect_linear_solver(list, inspect);
    }

    /** Materials that no point is made of. */
    void
    step_set_up(const Scene<dim> & /*scene*/,
                const StepContext<dim> &step,
                const SparseSystem & /*matrix*/) override
    {
      std::vector<unsigned long long> n_points(step.kernel.materials.size(), 0);
      const PointArrays<dim>         &points = step.points;
      for (unsigned int q = 0; q < points.n_points(); ++q)
        ++n_points[points.material[q]];
      Utilities::MPI::sum(n_points, step.grid.communicator(), n_points);
      for (unsigned int m = 1; m < n_points.size(); ++m)
        if (n_points[m] == 0)
          this->warn("no material point is made of it: no zone of <Material "
                     "points/Materials in zones> with that number holds one, "
                     "or a later zone does, which counts.",
                     "Material " + std::to_string(m + 1));
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    IdleParameters,
    "no effect of <parameter>",
    ISOCHOR_ESSENTIAL,
    "the parameter differs from its default, but has no effect with the "
    "others, such as `PPP coefficient` in `u`, `Friction coefficient` of an "
    "interaction without `Law = Coulomb`, `Radius` of a rigid body that is a "
    "box, a section of a solver that isn't chosen, a surface of the body that "
    "no condition names, or a section `Material k` of which no point is made "
    "(no zone names it, or later zones hold in all of its own)",
    "leave it out, or choose what it belongs to")
} // namespace isochor
