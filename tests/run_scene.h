/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_run_scene_h
#define isochor_tests_run_scene_h

// Scenes run through the library, for tests that look at their statistics and
// warnings. No header of deal.II is read here, which would take most of the
// time of a compilation: what needs one is in support/. For tests that look
// into the problem itself there is scene.h.

#include <isochor/base/statistics.h>
#include <isochor/base/warnings.h>
#include <isochor/base/work_tally.h>
#include <isochor/nonlinear_solver/newton_report.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace isochor
{
  template <int dim>
  class MaterialPointMethod;

  namespace test
  {
    constexpr double pi = 3.14159265358979323846;

    /** MPI, from the beginning of main() to its end; with one thread. */
    class MPISession
    {
    public:
      MPISession(int argc, char **argv);
      ~MPISession();

    private:
      struct Implementation;
      std::unique_ptr<Implementation> implementation;
    };

    /** Of MPI_COMM_WORLD. */
    unsigned int
    this_rank();
    unsigned int
    n_ranks();
    /** All ranks have come here. */
    void
    wait_for_all_ranks();
    double
    max_over_ranks(const double value);

    /** Warnings go to the standard error, which ctest compares, too. Tests that
     * are about them read all_warnings(). */
    inline const bool silent = (std::cerr.rdbuf(nullptr), true);

    /** What was seen of the scene run last, step by step. */
    struct Recorded
    {
      std::vector<NewtonReport> newton;
      std::vector<double>       times;
      /** Those of record_columns(). Steps that don't have one are left out. */
      std::map<std::string, std::vector<double>> columns;
    };

    Recorded &
    recorded();

    /** Keep these columns of the statistics in recorded(), of all scenes that
     * are run from now on. */
    void
    record_columns(const std::vector<std::string> &names);

    /** Problems are deleted where their class is known. */
    template <int dim>
    struct DeleteProblem
    {
      void
      operator()(MaterialPointMethod<dim> *problem) const;
    };
    template <int dim>
    using ProblemPointer =
      std::unique_ptr<MaterialPointMethod<dim>, DeleteProblem<dim>>;

    /** Run the scene described by @p settings, one "Section/Name = value" a
     * line. With the plain quadrature, if they don't say otherwise: most tests
     * are about what doesn't depend on it. */
    template <int dim>
    ProblemPointer<dim>
    run_scene(const std::string &settings);

    /** For run_scene(): the grid moves with the body and is never put back. */
    inline const std::string keep_grid =
      "Grid reset/Steps between resets = 0\n"
      "Grid reset/Smallest element quality = 0\n";

    /** Of the last step's statistics. */
    template <int dim>
    double
    get(const MaterialPointMethod<dim> &problem, const std::string &column);

    template <int dim>
    const Statistics &
    last_statistics(const MaterialPointMethod<dim> &problem);

    template <int dim>
    const Warnings &
    all_warnings(const MaterialPointMethod<dim> &problem);

    /** The first warning of @p subject, empty if there is none. */
    template <int dim>
    std::string
    warning_of(const MaterialPointMethod<dim> &problem,
               const std::string              &subject)
    {
      for (const auto &warning : all_warnings(problem).all())
        if (warning.subject == subject)
          return warning.text;
      return "";
    }

    /** What was done and what was skipped. */
    template <int dim>
    const WorkTally &
    work(const MaterialPointMethod<dim> &problem);

    /** What the scene never needs. */
    template <int dim>
    std::vector<std::string>
    not_needed(const MaterialPointMethod<dim> &problem);

    /** |value / expected - 1| */
    inline double
    relative(const double value, const double expected)
    {
      return std::abs(value / expected - 1);
    }

    /** @p number as short as it is, "1.5". */
    std::string
    in_short(const double number);

    /** Print "what: OK", or what went wrong, from rank 0 or where it did. */
    void
    check(const std::string &what, const bool ok, const std::string &details);

    /** As above, for an error that must not exceed a tolerance. */
    void
    check_error(const std::string &what,
                const double       error,
                const double       tolerance);

    /** @p text in one line: deal.II breaks the lines of messages anywhere. */
    std::string
    one_line(const std::string &text);

    /** The largest value of @p column in statistics.txt, which rank 0 has. */
    double
    largest_in_statistics(const std::string &column);

    /** The larger of two errors; not-a-number is infinitely wrong. */
    inline void
    add_error(double &worst, const double error)
    {
      if (!(error <= worst))
        worst = (error == error ? error : 1e300);
    }
  } // namespace test
} // namespace isochor

#endif
