/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <isochor/base/edit_distance.h>
#include <isochor/base/file_names.h>
#include <isochor/base/parameter_file.h>
#include <isochor/base/parameter_list.h>
#include <isochor/base/replaced_parameters.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <set>
#include <sstream>
#include <utility>

namespace isochor
{
  namespace
  {
    using Path = ParameterList::Path;



    /** Turns files into statements. */
    class Reader
    {
    public:
      std::vector<ParameterStatement> statements;

      /** @p origin is the include line, empty for the first file. */
      void
      read(const std::filesystem::path &file, const std::string &origin);

    private:
      struct OpenSubsection
      {
        std::string name;
        std::string origin;
      };

      void
      read_line(const std::string           &line,
                const std::filesystem::path &file,
                const std::string           &origin,
                const std::size_t            file_depth);

      void
      read_set(const std::string &argument, const std::string &origin);

      void
      leave_subsection(const std::string &argument,
                       const std::string &origin,
                       const std::size_t  file_depth);

      Path
      path_of(const std::string &name) const;

      std::vector<OpenSubsection>        open_subsections;
      std::vector<std::filesystem::path> open_files;
      /** Where files set parameters, by file: which of two lines in one file is
       * meant can't be told (of two files the one that includes the other is).
       */
      std::map<std::pair<std::string, Path>, std::string> set_at;
    };



    std::ifstream
    open_parameter_file(const std::filesystem::path &file,
                        const std::string           &origin)
    {
      const std::string prefix  = origin.empty() ? "" : origin + ": ";
      const std::string subject = "the parameter file <" + file.string() + ">";
      // the overloads with an error code don't throw: a path that can't be
      // looked at is reported as missing
      std::error_code code;
      if (!std::filesystem::exists(file, code))
        throw ParameterError(prefix + subject + " does not exist");
      if (std::filesystem::is_directory(file, code))
        throw ParameterError(prefix + subject + " is a directory");
      std::ifstream stream(file);
      if (!stream)
        throw ParameterError(prefix + subject + " cannot be opened");
      return stream;
    }



    void
    Reader::read(const std::filesystem::path &file, const std::string &origin)
    {
      std::ifstream stream    = open_parameter_file(file, origin);
      const auto    canonical = std::filesystem::canonical(file);
      if (std::find(open_files.begin(), open_files.end(), canonical) !=
          open_files.end())
        throw ParameterError(origin + ": cyclic include, the file <" +
                             file.string() + "> is being read already");
      open_files.push_back(canonical);
      const std::size_t file_depth = open_subsections.size();

      // A backslash at the end of a line joins it with the next, as in
      // ParameterHandler; errors name the first of the joined lines.
      std::string line, joined;
      std::string line_origin;
      bool        continues = false;
      for (unsigned int number = 1; std::getline(stream, line); ++number)
        {
          if (!continues)
            line_origin = file.string() + ":" + std::to_string(number);
          // the mark of UTF-8 that some editors put first
          if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0)
            line.erase(0, 3);
          joined    = (continues ? joined : "") + Utilities::trim(line);
          continues = !joined.empty() && joined.back() == '\\';
          if (continues)
            joined.pop_back();
          else
            read_line(joined, file, line_origin, file_depth);
        }
      if (stream.bad())
        throw ParameterError("cannot read <" + file.string() + ">");
      if (continues)
        throw ParameterError(line_origin +
                             ": the file ends in a line to be continued");
      if (open_subsections.size() > file_depth)
        throw ParameterError(
          open_subsections.back().origin + ": the subsection <" +
          open_subsections.back().name + "> has no 'end' in this file");
      open_files.pop_back();
    }



    void
    Reader::read_line(const std::string           &line,
                      const std::filesystem::path &file,
                      const std::string           &origin,
                      const std::size_t            file_depth)
    {
      const std::string statement =
        Utilities::trim(line.substr(0, line.find('#')));
      if (statement.empty())
        return;
      const auto        blank    = statement.find_first_of(" \t");
      const std::string keyword  = statement.substr(0, blank);
      const std::string argument = blank == std::string::npos ?
                                     "" :
                                     Utilities::trim(statement.substr(blank));

      if (keyword == "set" || keyword == "SET")
        read_set(argument, origin);
      else if (keyword == "end" || keyword == "END")
        leave_subsection(argument, origin, file_depth);
      else if ((keyword == "subsection" || keyword == "SUBSECTION") &&
               !argument.empty())
        {
          open_subsections.push_back({argument, origin});
          statements.push_back({path_of(""), true, "", origin});
        }
      else if ((keyword == "include" || keyword == "INCLUDE") &&
               !argument.empty())
        read((file.parent_path() / argument).lexically_normal(), origin);
      else
        throw ParameterError(
          origin + ": cannot understand <" + statement +
          ">; legal lines are 'set Entry = value', 'subsection Name', 'end', "
          "'include file.prm' and comments after '#'");
    }



    void
    Reader::read_set(const std::string &argument, const std::string &origin)
    {
      const auto        equals = argument.find('=');
      const std::string name   = Utilities::trim(argument.substr(0, equals));
      if (equals == std::string::npos || name.empty())
        throw ParameterError(origin + ": expected 'set Entry = value', got <" +
                             "set " + argument + ">");
      const Path        path  = path_of(name);
      const std::string value = Utilities::trim(argument.substr(equals + 1)),
                        file  = origin.substr(0, origin.rfind(':'));
      const auto before =
        set_at.emplace(std::make_pair(file, path), origin).first->second;
      if (before != origin)
        throw ParameterError(
          origin + ": the parameter <" + join_path(path) +
          "> is set for the second time in this file, after " + before +
          "; leave one of the two out");
      statements.push_back({path, false, value, origin});
    }



    void
    Reader::leave_subsection(const std::string &argument,
                             const std::string &origin,
                             const std::size_t  file_depth)
    {
      if (!argument.empty())
        throw ParameterError(origin + ": <" + argument +
                             "> after 'end', which takes nothing");
      if (open_subsections.size() == file_depth)
        throw ParameterError(origin +
                             ": 'end' without a subsection in this file");
      open_subsections.pop_back();
    }



    Path
    Reader::path_of(const std::string &name) const
    {
      Path path;
      for (const OpenSubsection &subsection : open_subsections)
        path.push_back(subsection.name);
      if (!name.empty())
        path.push_back(name);
      return path;
    }



    /**
     * How unlikely it is that @p candidate is meant by @p path: the edit
     * distance of the names, plus that of the enclosing subsections. The latter
     * counts little at most, since a right name in a wrong section is common,
     * and least in a section with a name, which is meant as it stands there. */
    std::pair<unsigned int, unsigned int>
    mismatch(const Path &path, const Path &candidate)
    {
      constexpr unsigned int wrong_section = 2;

      const auto section = [](const Path &p) {
        return join_path(Path(p.begin(), p.end() - 1));
      };
      const unsigned int names = edit_distance(path.back(), candidate.back());
      unsigned int sections = edit_distance(section(path), section(candidate));
      if (path.front() == candidate.front() &&
          path.front().find(": ") != std::string::npos)
        sections = std::min(sections, 1u);
      return {names + std::min(sections, wrong_section), sections};
    }



    /** "; did you mean <...>?" for the best of the paths in a range. */
    template <typename Range, typename GetPath>
    std::string
    suggestion(const Path &path, const Range &range, const GetPath &get_path)
    {
      if (range.begin() == range.end())
        return "";
      const auto best = std::min_element(range.begin(),
                                         range.end(),
                                         [&](const auto &a, const auto &b) {
                                           return mismatch(path, get_path(a)) <
                                                  mismatch(path, get_path(b));
                                         });
      return "; did you mean <" + join_path(get_path(*best)) + ">?";
    }



    /** For a path in a section with a name, such as "Postprocess: left": what
     * there is in it, which depends on its type. */
    std::string
    known_in_named_section(const Path &path, const ParameterList &declarations)
    {
      if (path.size() < 2 || path.front().find(": ") == std::string::npos)
        return "";
      std::string known;
      for (const auto &entry : declarations.entries)
        if (entry.first.front() == path.front())
          known += (known.empty() ? " <" : ", <") +
                   join_path(Path(entry.first.begin() + 1, entry.first.end())) +
                   ">";
      return known.empty() ?
               "" :
               " There are in <" + path.front() + ">:" + known + ".";
    }



    void
    check_declared(const ParameterStatement &statement,
                   const ParameterList      &declarations)
    {
      const Path       &path         = statement.path;
      const std::string prefix       = statement.origin + ": ";
      const std::string name         = "<" + join_path(path) + ">";
      const bool        is_parameter = declarations.entries.count(path) > 0;
      const bool is_subsection       = declarations.subsections.count(path) > 0;

      if (statement.is_subsection && is_parameter)
        throw ParameterError(prefix + name +
                             " is a parameter, not a subsection");
      if (!statement.is_subsection && is_subsection)
        throw ParameterError(prefix + name +
                             " is a subsection, not a parameter");
      if (statement.is_subsection && !is_subsection)
        throw ParameterError(prefix + "unknown subsection " + name +
                             suggestion(path,
                                        declarations.subsections,
                                        [](const Path &p) { return p; }));
      if (!statement.is_subsection && !is_parameter)
        throw ParameterError(
          prefix + "unknown parameter " + name +
          suggestion(path,
                     declarations.entries,
                     [](const auto &entry) { return entry.first; }) +
          known_in_named_section(path, declarations));
    }



    /** Why @p value is no number, if it isn't and is to match @p pattern. */
    std::string
    why_no_number(const std::string &value, const std::string &pattern)
    {
      if (pattern.rfind("[Double", 0) != 0 && pattern.rfind("[Integer", 0) != 0)
        return "";
      std::size_t end = 0;
      try
        {
          std::stod(value, &end);
        }
      catch (const std::exception &)
        {
          return ". It must be a number";
        }
      const std::string rest = Utilities::trim(value.substr(end));
      if (rest.empty())
        return "";
      if (rest.front() == ',')
        return ". It must be one number; decimals are written with a point";
      return ". It must be a number without a unit or anything else behind: "
             "units are m, s, kg, N, Pa, J";
    }



    void
    set_parameter(const ParameterStatement &statement,
                  const std::string        &pattern,
                  ParameterHandler         &prm)
    {
      const Path sections(statement.path.begin(), statement.path.end() - 1);
      for (const std::string &section : sections)
        prm.enter_subsection(section);
      try
        {
          prm.set(statement.path.back(),
                  with_paths_of_files(statement, pattern));
        }
      catch (const ParameterHandler::ExcValueDoesNotMatchPattern &)
        {
          throw ParameterError(statement.origin + ": the value <" +
                               statement.value + "> of the parameter <" +
                               join_path(statement.path) +
                               "> is not allowed; allowed is " + pattern +
                               why_no_number(statement.value, pattern));
        }
      for (unsigned int i = 0; i < sections.size(); ++i)
        prm.leave_subsection();
    }



    void
    create_directory(const std::string &directory)
    {
      if (directory.empty())
        throw ParameterError("the output directory has an empty name");
      std::error_code code;
      std::filesystem::create_directories(directory, code);
      // libstdc++ says nothing of a file that is in the way
      if (!code && !std::filesystem::is_directory(directory))
        code = std::make_error_code(std::errc::not_a_directory);
      if (code)
        throw ParameterError("cannot create the output directory <" +
                             directory + ">: " + code.message());
    }
  } // namespace



  std::vector<ParameterStatement>
  read_parameter_file(const std::string &file_name, const MPI_Comm &comm)
  {
    Reader reader;
    run_on_root(comm, [&]() { reader.read(file_name, ""); });
    return Utilities::MPI::broadcast(comm, reader.statements, 0);
  }



  ParameterStatement
  parse_override(const std::string &text, const std::string &origin)
  {
    const auto equals = text.find('=');
    if (equals == std::string::npos)
      throw ParameterError(origin + ": expected 'Section/Entry=value', got <" +
                           text + ">");
    ParameterStatement statement;
    statement.origin = origin;
    statement.value  = Utilities::trim(text.substr(equals + 1));
    std::istringstream names(text.substr(0, equals) + '/');
    for (std::string name; std::getline(names, name, '/');)
      statement.path.push_back(Utilities::trim(name));
    if (std::find(statement.path.begin(), statement.path.end(), "") !=
        statement.path.end())
      throw ParameterError(origin + ": empty name in the path <" +
                           text.substr(0, equals) + ">");
    return statement;
  }



  void
  apply_parameters(const std::vector<ParameterStatement> &statements,
                   ParameterHandler                      &prm)
  {
    const ParameterList declarations(prm);
    // A value that a later one replaces need not be allowed: a scene in 3D may
    // include one in 2D and give its own corners.
    std::map<ParameterList::Path, const ParameterStatement *> last;
    for (const ParameterStatement &statement : statements)
      last[statement.path] = &statement;
    for (const ParameterStatement &statement : statements)
      {
        check_replaced(statement);
        check_declared(statement, declarations);
        if (!statement.is_subsection && last.at(statement.path) == &statement)
          set_parameter(statement,
                        declarations.entries.at(statement.path).pattern,
                        prm);
      }
  }



  void
  create_output_directory(const std::string &directory, const MPI_Comm &comm)
  {
    run_on_root(comm, [&]() { create_directory(directory); });
  }



  void
  write_effective_parameters(const ParameterHandler &prm,
                             const std::string      &directory,
                             const MPI_Comm         &comm)
  {
    run_on_root(comm, [&]() {
      create_directory(directory);
      const auto file = std::filesystem::path(directory) / "parameters.prm";
      std::ostringstream text;
      prm.print_parameters(text,
                           ParameterHandler::PRM |
                             ParameterHandler::KeepDeclarationOrder);
      std::ofstream stream(file);
      stream << "# Isochor " << ISOCHOR_VERSION
             << ": the parameters in effect.\n"
             << text.str();
      stream.close();
      if (!stream)
        throw ParameterError("cannot write <" + file.string() +
                             ">; is the output directory writable?");
    });
  }
} // namespace isochor
