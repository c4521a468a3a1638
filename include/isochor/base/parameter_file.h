/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#ifndef isochor_parameter_file_h
#define isochor_parameter_file_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** A mistake of the user in a parameter file or override. Its message says
   * where the mistake is and what would be legal. */
  class ParameterError : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;
  };

  /**
   * One statement of a parameter file, or one override: `set` of the parameter
   * at #path, or (#is_subsection) the entering of the subsection at #path.
   */
  struct ParameterStatement
  {
    std::vector<std::string> path; ///< enclosing subsections, then the name
    bool                     is_subsection = false;
    std::string              value;
    std::string              origin; ///< "scene.prm:12", or the option

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &path &is_subsection &value &origin;
    }
  };

  /**
   * Call @p action on rank 0 of @p comm only. If it throws there, every rank
   * throws a ParameterError with the same message. Collective.
   */
  template <typename Action>
  void
  run_on_root(const MPI_Comm &comm, const Action &action);

  /**
   * Read a parameter file in the syntax of ParameterHandler, and the files that
   * it includes. Unlike ParameterHandler, a line `include other.prm` takes the
   * file relative to the including one, not to the working directory. Nothing
   * is compared with declarations yet. Collective: rank 0 reads.
   *
   * Throws ParameterError, with file and line, for files that can't be read,
   * cyclic includes, unbalanced subsections and lines that are no statement.
   */
  std::vector<ParameterStatement>
  read_parameter_file(const std::string &file_name, const MPI_Comm &comm);

  /**
   * The override `Section/Subsection/Entry=value` as a statement. The path ends
   * at the first `=`. Throws ParameterError if @p text is not of that form;
   * @p origin is how messages name the override.
   */
  ParameterStatement
  parse_override(const std::string &text, const std::string &origin);

  /**
   * How many subsections "name", "name 2", "name 3", ... at the top level the
   * statements mention: at least 1, as the first always exists. Throws
   * ParameterError if a number is left out, since the missing subsection would
   * silently take its defaults.
   */
  unsigned int
  n_numbered_subsections(const std::vector<ParameterStatement> &statements,
                         const std::string                     &name);

  /** A subsection "kind: name" at the top level, whose `Type` names a plugin.
   */
  struct NamedSection
  {
    std::string section, type;
  };

  /**
   * The subsections "@p kind: name" that the statements mention, in their
   * order. Throws ParameterError if one has no name or no `Type`, and if a file
   * has two of the same name. A file that includes another may open a section
   * of that again, to set its parameters anew.
   */
  std::vector<NamedSection>
  named_subsections(const std::vector<ParameterStatement> &statements,
                    const std::string                     &kind,
                    const bool                             with_types = true);

  /**
   * Set in @p prm, which has to be at its top level, what the statements say,
   * in their order, so that the last one wins. Throws ParameterError for
   * parameters and subsections that are not declared, with the nearest
   * declared one, and for values that violate the declared pattern.
   */
  void
  apply_parameters(const std::vector<ParameterStatement> &statements,
                   ParameterHandler                      &prm);

  /** Create the directory and its parents unless it exists. Throws
   * ParameterError if that can't be. Collective: rank 0 does it. */
  void
  create_output_directory(const std::string &directory, const MPI_Comm &comm);

  /**
   * Write all parameters, as they are in effect, with their documentation to
   * `<directory>/parameters.prm`, which can be run again. The directory is
   * created if necessary. Throws ParameterError if it can't be written.
   * Collective: rank 0 writes.
   */
  void
  write_effective_parameters(const ParameterHandler &prm,
                             const std::string      &directory,
                             const MPI_Comm         &comm = MPI_COMM_WORLD);



  template <typename Action>
  void
  run_on_root(const MPI_Comm &comm, const Action &action)
  {
    std::string error;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      try
        {
          action();
        }
      catch (const std::exception &exception)
        {
          error = exception.what();
          if (error.empty())
            error = "unknown error";
        }
    error = Utilities::MPI::broadcast(comm, error, 0);
    if (!error.empty())
      throw ParameterError(error);
  }
} // namespace isochor

#endif
