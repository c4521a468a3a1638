/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/edit_distance.h>
#include <isochor/program/command_line_options.h>

#include <algorithm>
#include <functional>

namespace isochor
{
  const char *const command_line_usage =
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
    "  --explain [NAME]          Print what a warning means, when it is issued\n"
    "                            and what to do, or the names of all.\n"
    "  --set Section/Entry=value Override a parameter of the scene.\n"
    "                            Can be repeated; the last one wins.\n"
    "  --output-directory DIR    The same as --set Output/Directory=DIR.\n"
    "  --restart                 The same as --set Checkpoint/Resume=true.\n"
    "  --quiet                   Print errors and warnings only.\n"
    "  --grid-offsets N          Run the scene N times with the grid lines\n"
    "                            moved below the body, into directories\n"
    "                            offset-0, offset-1, ... of the output, and\n"
    "                            print mean and spread of each statistic at\n"
    "                            the end: the error bar that the place of\n"
    "                            the grid gives a result.\n"
    "\n"
    "Examples:\n"
    "  isochor --print-parameters --set Dimension=3 > all.prm\n"
    "  isochor --set \"Material/Poisson ratio=0.499\" scene.prm\n"
    "\n"
    "Exit status: 0 success, 1 error in the scene or the run, 2 error in the\n"
    "command line.\n";



  namespace
  {
    /** Reads argv into CommandLineOptions; each option is one line of a table.
     */
    class OptionParser
    {
    public:
      /** Throws ParameterError for what is not a legal command line. */
      CommandLineOptions
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

      CommandLineOptions options;

      const std::vector<Option> table = {
        {"--help", false, [this](const auto &) { options.help = true; }},
        {"--version", false, [this](const auto &) { options.version = true; }},
        {"--print-parameters",
         false,
         [this](const auto &) { options.print_parameters = true; }},
        {"--validate",
         false,
         [this](const auto &) { options.validate = true; }},
        {"--explain",
         true,
         [this](const auto &name) {
           options.explains = true;
           options.explain  = name;
         }},
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
        {"--quiet", false, [this](const auto &) { options.quiet = true; }},
        {"--grid-offsets", true, [this](const auto &text) {
           if (text.empty() || text.size() > 6 ||
               text.find_first_not_of("0123456789") != std::string::npos ||
               std::stoi(text) < 2)
             throw ParameterError("the option --grid-offsets needs a number of "
                                  "runs, at least 2, got <" +
                                  text + ">");
           options.n_grid_offsets = std::stoi(text);
         }}};
    };



    CommandLineOptions
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
              // without a name all are listed
              if (option.name == "--explain" && argument + 1 == arguments.end())
                {
                  option.apply("");
                  break;
                }
              if (++argument == arguments.end())
                throw ParameterError("the option " + option.name +
                                     " needs a value");
              value = *argument;
            }
          option.apply(value);
        }
      const bool needs_scene = !options.help && !options.version &&
                               !options.print_parameters && !options.explains;
      if (options.n_grid_offsets > 0 &&
          (options.validate || options.print_parameters))
        throw ParameterError("the option --grid-offsets runs the scene; it has "
                             "no effect with --validate or --print-parameters");
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
  } // namespace



  CommandLineOptions
  parse_command_line(const std::vector<std::string> &arguments)
  {
    return OptionParser().parse(arguments);
  }
} // namespace isochor
