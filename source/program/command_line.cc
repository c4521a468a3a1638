/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/explanation.h>
#include <isochor/base/parameter_file.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/base/shared_libraries.h>
#include <isochor/grid/grid_source.h>
#include <isochor/program/command_line.h>
#include <isochor/program/command_line_options.h>
#include <isochor/program/documented_parameters.h>
#include <isochor/program/grid_offsets.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iostream>
#include <optional>
#include <set>
#include <sstream>
#include <streambuf>
#include <string>
#include <thread>
#include <vector>

namespace isochor
{
  namespace
  {
    void
    print_versions()
    {
      char mpi_version[MPI_MAX_LIBRARY_VERSION_STRING];
      int  length = 0;
      MPI_Get_library_version(mpi_version, &length);
      const std::string mpi(mpi_version, length);

      std::cout << "Isochor " << ISOCHOR_VERSION << '\n'
                << "deal.II " << DEAL_II_PACKAGE_VERSION << '\n'
                << "Trilinos " << DEAL_II_TRILINOS_VERSION_MAJOR << '.'
                << DEAL_II_TRILINOS_VERSION_MINOR << '.'
                << DEAL_II_TRILINOS_VERSION_SUBMINOR << '\n'
                << "MPI " << MPI_VERSION << '.' << MPI_SUBVERSION
                << " ("
                // the rest is about how the library was packaged
                << mpi.substr(0, mpi.find_first_of(",\n")) << ")\n";
    }



    void
    declare_dimension(ParameterHandler &prm)
    {
      prm.declare_entry("Dimension",
                        "2",
                        Patterns::Selection("2|3"),
                        "The space dimension: 2 (plane strain, or "
                        "axisymmetric, see <Formulation/Geometry>) or 3.");
    }



    /** The dimension decides what else can be declared, hence it is found in
     * the statements before any of the others can be checked. */
    unsigned int
    find_dimension(const std::vector<ParameterStatement> &statements)
    {
      std::vector<ParameterStatement> selected;
      for (const ParameterStatement &statement : statements)
        if (!statement.is_subsection &&
            statement.path == std::vector<std::string>{"Dimension"})
          selected.push_back(statement);
      ParameterHandler prm;
      declare_dimension(prm);
      apply_parameters(selected, prm);
      return prm.get_integer("Dimension");
    }



    /** Swallows what is written to std::cout during its life. */
    class SilencedOutput
    {
    public:
      SilencedOutput()
        : original(std::cout.rdbuf(&nothing))
      {}

      ~SilencedOutput()
      {
        std::cout.rdbuf(original);
      }

    private:
      class Nothing : public std::streambuf
      {
        int_type
        overflow(int_type c) override
        {
          return traits_type::not_eof(c);
        }
      };

      Nothing         nothing;
      std::streambuf *original;
    };



    /** Declare all parameters in @p prm, which is empty, if asked for those of
     * example_sections, too, and read the scene. */
    unsigned int
    read_parameters(const std::vector<ParameterStatement> &statements,
                    const Program                         &program,
                    ParameterHandler                      &prm,
                    const bool with_examples = false)
    {
      const unsigned int dim = find_dimension(statements);
      declare_dimension(prm);
      declare_shared_libraries(prm);
      auto declared = statements;
      for (const std::string &section : example_sections)
        if (with_examples)
          declared.push_back({{section}, true, "", ""});
      program.declare(prm, dim, declared);
      apply_parameters(statements, prm);
      return dim;
    }



    /** Run the scene of @p statements with several places of the grid. */
    void
    run_grid_offsets(const std::vector<ParameterStatement> &statements,
                     const unsigned int                     n_runs,
                     const Program                         &program,
                     const MPI_Comm                        &comm)
    {
      const bool       is_root = Utilities::MPI::this_mpi_process(comm) == 0;
      OffsetStatistics results;
      std::string      directory;
      for (unsigned int k = 0; k < n_runs; ++k)
        {
          ParameterHandler   prm;
          const unsigned int dim = read_parameters(statements, program, prm);
          prm.enter_subsection("Output");
          directory              = prm.get("Directory");
          const std::string part = directory + "/offset-" + std::to_string(k);
          prm.set("Directory", part);
          prm.leave_subsection();
          prm.enter_subsection("Grid");
          // plugins are the same in 2D and 3D
          AssertThrow(PluginRegistry<GridSource<2>>::parameters(prm.get("Type"))
                          .count("Offset") > 0,
                      ExcMessage("The option --grid-offsets moves the lines of "
                                 "a lattice, such as a box or a trapezoid, but "
                                 "<Grid/Type> is <" +
                                 prm.get("Type") + ">."));
          prm.set("Offset", grid_offset(k, dim));
          prm.leave_subsection();
          if (is_root)
            std::cout << "\n--- Grid offset " << k << " of " << n_runs << ": "
                      << grid_offset(k, dim) << " of a cell" << std::endl;
          try
            {
              program.execute(prm, dim, false);
              if (is_root)
                results.add(part);
            }
          catch (const std::exception &exception)
            {
              // several ranks might not agree on that, so let them end
              if (Utilities::MPI::n_mpi_processes(comm) > 1)
                throw;
              results.add_failure(k, error_message(exception));
            }
        }
      if (!is_root)
        return;
      std::ofstream file(directory + "/grid_offsets.txt");
      results.print(file);
      std::cout << "\nAt the end of " << n_runs << " runs with the grid moved "
                << "below the body (also in " << directory
                << "/grid_offsets.txt):\n\n";
      results.print(std::cout);
      AssertThrow(results.n_failures() == 0,
                  ExcMessage(std::to_string(results.n_failures()) + " of " +
                             std::to_string(n_runs) +
                             " runs failed, see below the table, which is that "
                             "of the others. For the spread of a limit load "
                             "let each run end below it, or compare the times "
                             "at which the runs failed."));
    }



    void
    execute(const CommandLineOptions &options,
            const Program            &program,
            const MPI_Comm           &comm)
    {
      const bool is_root = Utilities::MPI::this_mpi_process(comm) == 0;

      std::vector<ParameterStatement> statements;
      if (!options.scene.empty())
        statements = read_parameter_file(options.scene, comm);
      statements.insert(statements.end(),
                        options.overrides.begin(),
                        options.overrides.end());

      load_shared_libraries(statements);
      if (options.explains)
        {
          if (is_root)
            std::cout << explanation_text(options.explain);
          return;
        }
      ParameterHandler   prm;
      const unsigned int dim =
        read_parameters(statements,
                        program,
                        prm,
                        options.print_parameters && options.scene.empty());

      if (options.print_parameters)
        {
          if (is_root)
            print_documented_parameters(prm, std::cout);
          return;
        }
      prm.assert_that_entries_have_been_set();

      std::optional<SilencedOutput> silence;
      if (options.quiet)
        silence.emplace();
      if (options.n_grid_offsets > 0)
        {
          run_grid_offsets(statements, options.n_grid_offsets, program, comm);
          return;
        }
      program.execute(prm, dim, options.validate);
      if (options.validate && is_root)
        std::cout << options.scene << ": valid" << std::endl;
    }



    /** Whether all ranks come here within a few seconds. */
    bool
    all_ranks_arrive(const MPI_Comm &comm)
    {
      using Clock = std::chrono::steady_clock;
      constexpr std::chrono::seconds      patience(5);
      constexpr std::chrono::milliseconds interval(5);

      MPI_Request request;
      MPI_Ibarrier(comm, &request);
      int arrived = 0;
      for (const auto start = Clock::now();
           !arrived && Clock::now() - start < patience;)
        {
          MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
          if (!arrived)
            std::this_thread::sleep_for(interval);
        }
      return arrived;
    }



    /** Write the errors of the ranks of @p comm, equal ones once. */
    void
    report_failure(const std::string &message, const MPI_Comm &comm)
    {
      if (!all_ranks_arrive(comm))
        {
          std::cerr << "isochor: error on rank "
                    << Utilities::MPI::this_mpi_process(comm) << ": " << message
                    << std::endl;
          MPI_Abort(comm, 1);
        }
      const auto messages = Utilities::MPI::gather(comm, message, 0);
      for (const std::string &m :
           std::set<std::string>(messages.begin(), messages.end()))
        std::cerr << "isochor: error: " << m << std::endl;
    }
  } // namespace



  int
  run_command_line(const int          argc,
                   const char *const *argv,
                   const Program     &program,
                   const MPI_Comm    &comm)
  {
    // Failures need a communicator on which no other message is under way.
    const Utilities::MPI::DuplicatedCommunicator failures(comm);
    const bool is_root = Utilities::MPI::this_mpi_process(comm) == 0;

    CommandLineOptions options;
    try
      {
        options = parse_command_line({argv + std::min(argc, 1), argv + argc});
      }
    catch (const ParameterError &error)
      {
        report_failure(std::string(error.what()) +
                         "\nTry 'isochor --help' for the options.",
                       *failures);
        return 2;
      }

    if (options.help || options.version)
      {
        if (is_root && options.help)
          std::cout << command_line_usage;
        else if (is_root)
          print_versions();
        return 0;
      }

    try
      {
        execute(options, program, comm);
        return 0;
      }
    catch (const std::exception &exception)
      {
        report_failure(error_message(exception), *failures);
      }
    catch (...)
      {
        report_failure("an exception of unknown type", *failures);
      }
    return 1;
  }
} // namespace isochor
