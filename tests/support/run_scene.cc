/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include "../run_scene.h"

#include "../scene.h"

namespace isochor
{
  namespace test
  {
    struct MPISession::Implementation
    {
      int                              argc;
      char                           **argv;
      Utilities::MPI::MPI_InitFinalize mpi{argc, argv, 1};
    };

    MPISession::MPISession(int argc, char **argv)
      : implementation(new Implementation{argc, argv})
    {}

    MPISession::~MPISession() = default;

    unsigned int
    this_rank()
    {
      return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
    }

    unsigned int
    n_ranks()
    {
      return Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
    }

    void
    wait_for_all_ranks()
    {
      MPI_Barrier(MPI_COMM_WORLD);
    }

    double
    max_over_ranks(const double value)
    {
      return Utilities::MPI::max(value, MPI_COMM_WORLD);
    }

    Recorded &
    recorded()
    {
      static Recorded r;
      return r;
    }

    namespace
    {
      std::vector<std::string> &
      columns_to_record()
      {
        static std::vector<std::string> names;
        return names;
      }

      /** Fills recorded(). */
      template <int dim>
      class Recorder : public Postprocessor<dim>
      {
      public:
        void
        evaluate_nodes(const StepResult<dim> &result, Statistics &) override
        {
          recorded().newton.push_back(result.newton);
          recorded().times.push_back(result.step.time);
        }

        void
        evaluate_points(const StepResult<dim> &,
                        Statistics &statistics) override
        {
          for (const std::string &name : columns_to_record())
            try
              {
                recorded().columns[name].push_back(statistics.get(name));
              }
            catch (const std::exception &)
              {} // a scene without it
        }
      };
      // they are called in the order of their names
      ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Recorder, "Z: recorder")
    } // namespace

    void
    record_columns(const std::vector<std::string> &names)
    {
      columns_to_record() = names;
    }

    void
    set_parameters(ParameterHandler &prm, const std::string &settings)
    {
      std::istringstream lines(settings);
      for (std::string line; std::getline(lines, line);)
        {
          const auto equals = line.find('=');
          if (equals == std::string::npos)
            continue;
          auto path = Utilities::split_string_list(line.substr(0, equals), '/');
          for (unsigned int i = 0; i + 1 < path.size(); ++i)
            prm.enter_subsection(path[i]);
          prm.set(path.back(), Utilities::trim(line.substr(equals + 1)));
          for (unsigned int i = 0; i + 1 < path.size(); ++i)
            prm.leave_subsection();
        }
    }

    template <int dim>
    void
    DeleteProblem<dim>::operator()(MaterialPointMethod<dim> *problem) const
    {
      delete problem;
    }

    SceneSections
    sections_of(const std::string &settings, unsigned int n_materials)
    {
      while (settings.find("Material " + std::to_string(n_materials + 1) +
                           "/") != std::string::npos)
        ++n_materials;
      SceneSections      sections(n_materials);
      std::istringstream lines(settings);
      for (std::string line; std::getline(lines, line);)
        {
          const std::string name = line.substr(0, line.find('/'));
          for (const auto &[kind, list] :
               {std::make_pair("Interaction: ", &sections.interactions),
                std::make_pair("Rigid body: ", &sections.rigid_bodies)})
            if (line.rfind(kind, 0) == 0 &&
                std::none_of(list->begin(), list->end(), [&](const auto &one) {
                  return one.section == name;
                }))
              list->push_back({name, ""});
        }
      return sections;
    }

    template <int dim>
    ProblemPointer<dim>
    run_scene(const std::string &settings)
    {
      ParameterHandler prm;
      MaterialPointMethod<dim>::declare_parameters(prm, sections_of(settings));
      set_parameters(prm,
                     (settings.find("Grid/Type = adaptive") ==
                          std::string::npos ?
                        std::string("Quadrature/Type = points\n") :
                        std::string()) +
                       "Output/Directory = .\nOutput/Terminal = quiet\n"
                       "Postprocess/Write grid = false\n"
                       "Postprocess/Write material points = false\n" +
                       settings);
      recorded() = {};
      ProblemPointer<dim> problem(new MaterialPointMethod<dim>(MPI_COMM_WORLD));
      problem->parse_parameters(prm);
      problem->run();
      return problem;
    }

    template <int dim>
    double
    get(const MaterialPointMethod<dim> &problem, const std::string &column)
    {
      return problem.last_statistics().get(column);
    }

    template <int dim>
    const Statistics &
    last_statistics(const MaterialPointMethod<dim> &problem)
    {
      return problem.last_statistics();
    }

    template <int dim>
    const Warnings &
    all_warnings(const MaterialPointMethod<dim> &problem)
    {
      return problem.all_warnings();
    }

    template <int dim>
    const WorkTally &
    work(const MaterialPointMethod<dim> &problem)
    {
      return problem.work();
    }

    template <int dim>
    std::vector<std::string>
    not_needed(const MaterialPointMethod<dim> &problem)
    {
      return problem.not_needed();
    }

    std::string
    in_short(const double number)
    {
      std::ostringstream text;
      text << number;
      return text.str();
    }

    void
    check(const std::string &what, const bool ok, const std::string &details)
    {
      const bool all_ok = Utilities::MPI::min(ok ? 1 : 0, MPI_COMM_WORLD) == 1;
      if (!ok)
        std::cout << what << ": FAILED, " << details << std::endl;
      else if (all_ok && this_rank() == 0)
        std::cout << what << ": OK" << std::endl;
    }

    void
    check_error(const std::string &what,
                const double       error,
                const double       tolerance)
    {
      std::ostringstream details;
      details << "error " << error << " > " << tolerance;
      check(what, error <= tolerance, details.str());
    }

    std::string
    one_line(const std::string &text)
    {
      std::istringstream words(text);
      std::string        line;
      for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
      return line;
    }

    double
    largest_in_statistics(const std::string &column)
    {
      std::ifstream file("statistics.txt");
      unsigned int  index   = 0;
      double        largest = 0;
      for (std::string line; std::getline(file, line);)
        if (line[0] == '#')
          {
            if (line.find(": " + column) != std::string::npos)
              index = std::stoi(line.substr(1));
          }
        else
          {
            std::istringstream entries(line);
            std::string        entry;
            for (unsigned int i = 0; i < index; ++i)
              entries >> entry;
            largest = std::max(largest, std::stod(entry));
          }
      return index == 0 ? 1e300 : largest;
    }

#define INSTANTIATE(dim)                                                    \
  template struct DeleteProblem<dim>;                                       \
  template ProblemPointer<dim> run_scene(const std::string &settings);      \
  template double              get(const MaterialPointMethod<dim> &problem, \
                                   const std::string              &column);              \
  template const Statistics   &last_statistics(                             \
      const MaterialPointMethod<dim> &problem);                             \
  template const Warnings &all_warnings(                                    \
    const MaterialPointMethod<dim> &problem);                               \
  template const WorkTally &work(const MaterialPointMethod<dim> &problem);  \
  template std::vector<std::string> not_needed(                             \
    const MaterialPointMethod<dim> &problem);

    INSTANTIATE(2)
    INSTANTIATE(3)
#undef INSTANTIATE
  } // namespace test
} // namespace isochor
