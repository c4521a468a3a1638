/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// A scene alone and on all ranks, compared point by point.

#ifndef isochor_tests_ranks_alike_h
#define isochor_tests_ranks_alike_h

#include <isochor/base/safe_file.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scene.h"

using namespace isochor;

namespace
{
  /** Of the scene run last: per step, and at the first one after the grid was
   * divided anew. */
  struct Shares
  {
    double       largest = 0, after_division = 0;
    unsigned int n_divisions = 0;
    bool         is_new      = false;
    /** How often points have come to another cell, and of the points of this
     * rank the cells. */
    unsigned int                                  n_crossings = 0;
    std::map<types::particle_index, unsigned int> cells;
    bool has_idle_rank = false; ///< one without points
  };
  Shares shares;

  /** A run ends after the outputs of this step, before its checkpoint. */
  unsigned int crash_after_step = numbers::invalid_unsigned_int;

  /** What must not depend on the ranks: by name, or by point. */
  struct Results
  {
    std::map<types::particle_index, std::vector<double>> points;
    std::map<std::string, double>                        statistics;
  };
} // namespace

namespace isochor
{
  template <int dim>
  class ShareRecorder : public Postprocessor<dim>
  {
  public:
    void
    owners_changed(const BackgroundGrid<dim> & /*grid*/) override
    {
      ++shares.n_divisions;
      shares.is_new = true;
    }

    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      const double n_own = result.points.handler().n_locally_owned_particles();
      const auto   n =
        Utilities::MPI::min_max_avg(n_own, result.step.grid.communicator());
      const double imbalance = n.max / n.avg - 1;
      shares.largest         = std::max(shares.largest, imbalance);
      if (shares.is_new)
        shares.after_division = std::max(shares.after_division, imbalance);
      shares.is_new = false;

      const MPI_Comm comm  = result.step.grid.communicator();
      shares.has_idle_rank = shares.has_idle_rank || n.min == 0;
      unsigned int                                  n_crossed = 0;
      std::map<types::particle_index, unsigned int> cells;
      for (const auto &particle : result.points.handler())
        {
          const unsigned int cell =
            particle.get_surrounding_cell()->active_cell_index();
          const auto before = shares.cells.find(particle.get_id());
          n_crossed += before == shares.cells.end() || before->second != cell;
          cells[particle.get_id()] = cell;
        }
      n_crossed = Utilities::MPI::sum(n_crossed, comm);
      if (result.time.step > 0)
        shares.n_crossings += n_crossed;
      shares.cells = cells;
    }

    void
    evaluate_points(const StepResult<dim> &result, Statistics &) override
    {
      AssertThrow(result.time.step != crash_after_step, ExcMessage("crash"));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, ShareRecorder, "Share recorder")
} // namespace isochor

/** Run the scene on the ranks of @p comm: place, pressure and stress of all
 * points, and @p columns of the statistics. */
template <int dim>
Results
run(const MPI_Comm                  comm,
    const std::string              &settings,
    const std::vector<std::string> &columns)
{
  const bool        alone = Utilities::MPI::n_mpi_processes(comm) == 1;
  const std::string directory =
    alone ? "alone-" +
              std::to_string(Utilities::MPI::this_mpi_process(MPI_COMM_WORLD)) :
            "together";
  create_output_directory(directory, comm);
  ParameterHandler prm;
  MaterialPointMethod<dim>::declare_parameters(prm,
                                               test::sections_of(settings));
  test::set_parameters(prm,
                       "Output/Terminal = quiet\n"
                       "Postprocess/Write grid = false\n"
                       "Postprocess/Write material points = false\n"
                       "Newton/Tolerance = 1e-11\n"
                       "Output/Directory = " +
                         directory + '\n' + settings);
  shares = {};
  MaterialPointMethod<dim> problem(comm);
  problem.parse_parameters(prm);
  problem.run();

  Results            results;
  const PointLayout &l = problem.material_points().layout();
  for (const auto &particle : problem.material_points().handler())
    {
      std::vector<double> &values = results.points[particle.get_id()];
      for (unsigned int d = 0; d < dim; ++d)
        values.push_back(particle.get_location()[d]);
      values.push_back(particle.get_properties()[l.pressure]);
      for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
        values.push_back(particle.get_properties()[l.stress + i]);
    }
  for (const std::string &column : columns)
    results.statistics[column] = problem.last_statistics().get(column);
  return results;
}

/** The scene alone and on all ranks. Stresses are compared with the largest
 * one. */
template <int dim>
void
compare_results(const std::string              &name,
                const std::string              &settings,
                const std::vector<std::string> &columns)
{
  const Results alone    = run<dim>(MPI_COMM_SELF, settings, columns);
  const Results together = run<dim>(MPI_COMM_WORLD, settings, columns);
  double        motion = 0, stresses = 0, others = 0, largest = 0;
  for (const auto &point : alone.points)
    for (unsigned int i = dim; i < point.second.size(); ++i)
      largest = std::max(largest, std::abs(point.second[i]));
  for (const auto &[id, values] : together.points)
    {
      const auto &expected = alone.points.at(id);
      for (unsigned int i = 0; i < values.size(); ++i)
        test::add_error(i < dim ? motion : stresses,
                        std::abs(values[i] - expected[i]) /
                          (i < dim ? 1. : largest));
    }
  const unsigned int n =
    Utilities::MPI::sum(together.points.size(), MPI_COMM_WORLD);
  test::check(name + ": all points are there",
              n == alone.points.size(),
              std::to_string(n));
  test::check_error("displacements", motion, 1e-9);
  test::check_error("pressures and stresses", stresses, 1e-9);
  for (const auto &[column, value] : together.statistics)
    {
      const double expected = alone.statistics.at(column);
      test::add_error(others, std::abs(value / expected - 1));
    }
  if (!columns.empty())
    test::check_error("forces and energies", others, 1e-9);
}

#endif
