/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_scene_h
#define isochor_tests_scene_h

// Scenes run through the library, for tests that look into the results.

#include <deal.II/base/mpi.h>

#include <isochor/step/material_point_method.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

namespace isochor
{
  namespace test
  {
    /** Set the parameters listed in @p settings, one "Section/Name = value" a
     * line. */
    inline void
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

    /** What the post-processor below saw, of the scene run last. */
    struct Recorded
    {
      std::vector<NewtonReport> newton;
      std::vector<double>       times;
    };

    inline Recorded &
    recorded()
    {
      static Recorded r;
      return r;
    }

    /** Keeps the reports of Newton's method. */
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
    };
    ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Recorder, "Recorder")

    /** Warnings go to the standard error, which ctest compares, too. Tests that
     * are about them read MaterialPointMethod::all_warnings(). */
    inline const bool silent = (std::cerr.rdbuf(nullptr), true);

    /** Run the scene described by @p settings, see set_parameters(). With the
     * plain quadrature, if they don't say otherwise: most tests are about what
     * doesn't depend on it. */
    template <int dim>
    std::unique_ptr<MaterialPointMethod<dim>>
    run_scene(const std::string &settings)
    {
      ParameterHandler prm;
      unsigned int     n_materials = 1;
      while (settings.find("Material " + std::to_string(n_materials + 1) +
                           "/") != std::string::npos)
        ++n_materials;
      MaterialPointMethod<dim>::declare_parameters(prm, n_materials);
      set_parameters(prm,
                     "Quadrature/Type = points\n"
                     "Output/Directory = .\nOutput/Terminal = quiet\n"
                     "Postprocess/Write grid = false\n"
                     "Postprocess/Write material points = false\n" +
                       settings);
      recorded()   = {};
      auto problem = std::make_unique<MaterialPointMethod<dim>>(MPI_COMM_WORLD);
      problem->parse_parameters(prm);
      problem->run();
      return problem;
    }

    /** For set_parameters(): the grid moves with the body and is never put
     * back. */
    inline const std::string keep_grid =
      "Grid reset/Steps between resets = 0\n"
      "Grid reset/Smallest element quality = 0\n";

    /** Of the last step's statistics. */
    template <int dim>
    double
    get(const MaterialPointMethod<dim> &problem, const std::string &column)
    {
      return problem.last_statistics().get(column);
    }

    /** The same, of three columns: of the x in @p column, and of y and z in its
     * place. */
    inline Tensor<1, 3>
    get_vector(const MaterialPointMethod<3> &problem, const std::string &column)
    {
      const auto   x = column.find(" x ") + 1;
      Tensor<1, 3> v;
      for (unsigned int a = 0; a < 3; ++a)
        v[a] = get(problem, std::string(column).replace(x, 1, 1, "xyz"[a]));
      return v;
    }

    /** |value / expected - 1| */
    inline double
    relative(const double value, const double expected)
    {
      return std::abs(value / expected - 1);
    }

    /** Print "what: OK", or what went wrong, from rank 0 or where it did. */
    inline void
    check(const std::string &what, const bool ok, const std::string &details)
    {
      const bool all_ok = Utilities::MPI::min(ok ? 1 : 0, MPI_COMM_WORLD) == 1;
      if (!ok)
        std::cout << what << ": FAILED, " << details << std::endl;
      else if (all_ok && Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << what << ": OK" << std::endl;
    }

    /** As above, for an error that must not exceed a tolerance. */
    inline void
    check_error(const std::string &what,
                const double       error,
                const double       tolerance)
    {
      std::ostringstream details;
      details << "error " << error << " > " << tolerance;
      check(what, error <= tolerance, details.str());
    }

    /** @p text in one line: deal.II breaks the lines of messages anywhere. */
    inline std::string
    one_line(const std::string &text)
    {
      std::istringstream words(text);
      std::string        line;
      for (std::string word; words >> word;)
        line += (line.empty() ? "" : " ") + word;
      return line;
    }

    /** The largest value of @p column in statistics.txt, which rank 0 has. */
    inline double
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
