/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/command_line.h>
#include <isochor/edit_distance.h>
#include <isochor/parameter_file.h>
#include <isochor/shared_libraries.h>

#include <algorithm>
#include <chrono>
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
    const char *const usage =
      "Usage: isochor [options] scene.prm\n"
      "       mpirun -n 4 isochor [options] scene.prm\n"
      "\n"
      "Options:\n"
      "  --help                    Print this text.\n"
      "  --version                 Print the versions of Isochor and of the\n"
      "                            libraries below it.\n"
      "  --print-parameters        Print all parameters, documented, as a\n"
      "                            parameter file: the defaults, or with a\n"
      "                            scene or overrides what these make of "
      "them.\n"
      "  --validate                Read the scene and set everything up to the\n"
      "                            equations of the first step, but don't run\n"
      "                            it or write any file.\n"
      "  --set Section/Entry=value Override a parameter of the scene.\n"
      "                            Can be repeated; the last one wins.\n"
      "  --output-directory DIR    The same as --set Output/Directory=DIR.\n"
      "  --restart                 The same as --set Checkpoint/Resume=true.\n"
      "  --quiet                   Print errors and warnings only.\n"
      "\n"
      "Examples:\n"
      "  isochor --print-parameters --set Dimension=3 > all.prm\n"
      "  isochor --set \"Material/Poisson ratio=0.499\" scene.prm\n"
      "\n"
      "Exit status: 0 success, 1 error in the scene or the run, 2 error in the\n"
      "command line.\n";



    struct Options
    {
      bool                            help             = false;
      bool                            version          = false;
      bool                            print_parameters = false;
      bool                            validate         = false;
      bool                            quiet            = false;
      std::string                     scene; ///< empty if none is given
      std::vector<ParameterStatement> overrides;
    };



    /** Reads argv into Options; each option is one line of a table. */
    class OptionParser
    {
    public:
      /** Throws ParameterError for what is not a legal command line. */
      Options
      parse(const std::vector<std::string> &arguments);

    private:
      struct Option
      {
        std::string                              name;
        bool                                     takes_value;
        std::function<void(const std::string &)> apply;
      };

      const Option &
      find(const std::string &name) const;

      void
      override_with(const std::string &text, const std::string &origin);

      void
      set_scene(const std::string &name);

      Options options;

      const std::vector<Option> table = {
        {"--help", false, [this](const auto &) { options.help = true; }},
        {"--version", false, [this](const auto &) { options.version = true; }},
        {"--print-parameters",
         false,
         [this](const auto &) { options.print_parameters = true; }},
        {"--validate",
         false,
         [this](const auto &) { options.validate = true; }},
        {"--set",
         true,
         [this](const auto &text) { override_with(text, "--set"); }},
        {"--output-directory",
         true,
         [this](const auto &directory) {
           override_with("Output/Directory=" + directory, "--output-directory");
         }},
        {"--restart",
         false,
         [this](const auto &) {
           override_with("Checkpoint/Resume=true", "--restart");
         }},
        {"--quiet", false, [this](const auto &) { options.quiet = true; }}};
    };



    Options
    OptionParser::parse(const std::vector<std::string> &arguments)
    {
      for (auto argument = arguments.begin(); argument != arguments.end();
           ++argument)
        {
          if (argument->empty() || argument->front() != '-')
            {
              set_scene(*argument);
              continue;
            }
          const auto    equals    = argument->find('=');
          const Option &option    = find(argument->substr(0, equals));
          const bool    has_value = equals != std::string::npos;
          if (has_value && !option.takes_value)
            throw ParameterError("the option " + option.name +
                                 " takes no value, got <" + *argument + ">");
          std::string value = has_value ? argument->substr(equals + 1) : "";
          if (option.takes_value && !has_value)
            {
              if (++argument == arguments.end())
                throw ParameterError("the option " + option.name +
                                     " needs a value");
              value = *argument;
            }
          option.apply(value);
        }
      const bool needs_scene =
        !options.help && !options.version && !options.print_parameters;
      if (needs_scene && options.scene.empty())
        throw ParameterError("no parameter file given");
      return options;
    }



    const OptionParser::Option &
    OptionParser::find(const std::string &name) const
    {
      const auto nearest = std::min_element(
        table.begin(), table.end(), [&](const Option &a, const Option &b) {
          return edit_distance(name, a.name) < edit_distance(name, b.name);
        });
      if (nearest->name != name)
        throw ParameterError("unknown option <" + name + ">; did you mean " +
                             nearest->name + "?");
      return *nearest;
    }



    void
    OptionParser::override_with(const std::string &text,
                                const std::string &origin)
    {
      options.overrides.push_back(parse_override(text, "option " + origin));
    }



    void
    OptionParser::set_scene(const std::string &name)
    {
      if (name.empty())
        throw ParameterError("the name of the parameter file is empty");
      if (!options.scene.empty())
        throw ParameterError("more than one parameter file given: <" +
                             options.scene + "> and <" + name + ">");
      options.scene = name;
    }



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
                        "The space dimension: 2 (plane strain) or 3.");
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



    void
    execute(const Options  &options,
            const Program  &program,
            const MPI_Comm &comm)
    {
      const bool is_root = Utilities::MPI::this_mpi_process(comm) == 0;

      std::vector<ParameterStatement> statements;
      if (!options.scene.empty())
        statements = read_parameter_file(options.scene, comm);
      statements.insert(statements.end(),
                        options.overrides.begin(),
                        options.overrides.end());

      load_shared_libraries(statements);
      const unsigned int dim = find_dimension(statements);
      ParameterHandler   prm;
      declare_dimension(prm);
      declare_shared_libraries(prm);
      program.declare(prm, dim, n_numbered_subsections(statements, "Material"));
      apply_parameters(statements, prm);

      if (options.print_parameters)
        {
          if (is_root)
            prm.print_parameters(std::cout,
                                 ParameterHandler::PRM |
                                   ParameterHandler::KeepDeclarationOrder);
          return;
        }
      prm.assert_that_entries_have_been_set();

      std::optional<SilencedOutput> silence;
      if (options.quiet)
        silence.emplace();
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



    /** ExcMessage is written for the user. Other exceptions of deal.II are
     * likely defects, of which the place in the sources matters too. */
    std::string
    describe(const std::exception &exception)
    {
      const auto *message =
        dynamic_cast<const StandardExceptions::ExcMessage *>(&exception);
      if (message == nullptr)
        return exception.what();
      std::ostringstream text;
      message->print_info(text);
      return Utilities::trim(text.str());
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

    Options options;
    try
      {
        options = OptionParser().parse({argv + std::min(argc, 1), argv + argc});
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
          std::cout << usage;
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
        report_failure(describe(exception), *failures);
      }
    catch (...)
      {
        report_failure("an exception of unknown type", *failures);
      }
    return 1;
  }
} // namespace isochor
