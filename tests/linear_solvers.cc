/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
// Every registered linear solver on systems with known solutions: symmetric and
// not, mixed and not, 2D and 3D; changed values, changed patterns, repeated
// right-hand sides, and matrices that are singular or not finite.

#include <deal.II/base/conditional_ostream.h>
#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/packed_columns.h>

#include <iostream>
#include <limits>
#include <sstream>

#include "elasticity_system.h"

using namespace isochor;
using DistributedVector = TrilinosWrappers::MPI::Vector;

namespace
{
  std::ostream &
  out()
  {
    static std::ostream silence(nullptr);
    return Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0 ? std::cout :
                                                                   silence;
  }

  /** A rough manufactured solution. */
  double
  exact(const types::global_dof_index i, const double phase)
  {
    return 1. + std::sin(0.7 * i + phase);
  }

  /** y = A x from the definition of a SparseSystem, x replicated. */
  std::vector<double>
  multiply(const SparseSystem &A, const std::vector<double> &x)
  {
    std::vector<double> y(A.n_equations, 0.);
    for (unsigned int r = 0; r + 1 < A.row_start.size(); ++r)
      for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
        {
          const auto i = A.global_equation[r];
          const auto j = A.global_equation[A.column[k]];
          y[i] += A.values[k] * x[j];
          if (A.symmetric && i != j)
            y[j] += A.values[k] * x[i];
        }
    std::vector<double> total(y.size());
    Utilities::MPI::sum(y, A.comm, total);
    return total;
  }

  std::vector<double>
  replicate(const DistributedVector &v, const SparseSystem &A)
  {
    std::vector<double> all(A.n_equations, 0.), total(A.n_equations);
    for (const auto i : A.locally_owned)
      all[i] = v(i);
    Utilities::MPI::sum(all, A.comm, total);
    return total;
  }

  double
  relative_difference(const std::vector<double> &a,
                      const std::vector<double> &b)
  {
    double difference = 0., norm = 0.;
    for (std::size_t i = 0; i < a.size(); ++i)
      {
        difference += (a[i] - b[i]) * (a[i] - b[i]);
        norm += b[i] * b[i];
      }
    return std::sqrt(difference / norm);
  }

  DistributedVector
  distribute(const std::vector<double> &all, const SparseSystem &A)
  {
    DistributedVector v(A.locally_owned, A.comm);
    for (const auto i : A.locally_owned)
      v(i) = all[i];
    v.compress(VectorOperation::insert);
    return v;
  }

  void
  report(const std::string &test, const bool ok, const std::string &details)
  {
    out() << "  " << test << ": " << (ok ? "OK" : "FAILED " + details)
          << std::endl;
  }

  /** Solve and compare with the manufactured solution. */
  void
  check_solve(const std::string  &test,
              LinearSolver       &solver,
              const SparseSystem &A,
              const double        phase = 0.)
  {
    std::vector<double> x_exact(A.n_equations);
    for (types::global_dof_index i = 0; i < A.n_equations; ++i)
      x_exact[i] = exact(i, phase);
    const std::vector<double> b = multiply(A, x_exact);
    DistributedVector         x(A.locally_owned, A.comm);
    solver.solve(distribute(b, A), x);

    const auto         x_all    = replicate(x, A);
    const double       error    = relative_difference(x_all, x_exact);
    const double       residual = relative_difference(multiply(A, x_all), b);
    std::ostringstream details;
    details << "error " << error << ", residual " << residual;
    report(test, error < 1e-6 && residual < 1e-9, details.str());
  }

  /** The message of the ExcLinearSolverFailed that @p action has to throw. */
  template <typename Action>
  void
  check_failure(const std::string &test, const Action &action)
  {
    try
      {
        action();
      }
    catch (const ExcLinearSolverFailed &)
      {
        report(test, true, "");
        return;
      }
    report(test, false, "no exception");
  }

  SparseSystem
  make(const ElasticitySystemOptions &options)
  {
    return ElasticitySystem<2>(MPI_COMM_WORLD, options).A;
  }

  /** A solver may free the values, and must give back the same. */
  void
  check_handing_over(const std::string  &what,
                     LinearSolver       &solver,
                     const SparseSystem &A)
  {
    SparseSystem mine = A;
    solver.factorise_and_free(mine);
    check_solve(what, solver, A);
    if (mine.values.empty())
      solver.restore_values(mine);
    report("gives all back",
           mine.values == A.values && mine.column == A.column,
           "other numbers");
  }

  /** The rows of a node have the same columns. */
  void
  check_packed_columns(const SparseSystem &A)
  {
    SparseSystem mine = A;
    std::size_t  size;
    {
      const PackedColumns packed(mine);
      size = packed.size();
    }
    report("packed columns",
           mine.column == A.column &&
             (A.column.empty() || 2 * size < A.column.size()),
           std::to_string(size) + " of " + std::to_string(A.column.size()));
  }

  void
  check_right_systems(LinearSolver &solver)
  {
    ElasticitySystemOptions options;
    SparseSystem            A = make(options);

    auto done = solver.factorise(A);
    report("reports work", done.analysed && done.factorised, "");
    check_solve("mixed", solver, A);
    check_solve("repeated right-hand side", solver, A, 1.);

    for (double &value : A.values)
      value *= 3.;
    for (std::size_t r = 0; r + 1 < A.row_start.size(); ++r)
      for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
        if (A.column[k] == r && A.component[r] < A.dim)
          A.values[k] += 1.;
    done = solver.factorise(A);
    report("keeps the analysis", !done.analysed && done.factorised, "");
    check_solve("changed values", solver, A);

    options.idle_rank             = true;
    const SparseSystem unbalanced = make(options);
    solver.factorise(unbalanced);
    check_solve("a rank without equations", solver, unbalanced);
    options.idle_rank = false;

    options.n_cells_per_edge  = 11;
    options.poisson_ratio     = 0.5;
    const SparseSystem larger = make(options);
    done                      = solver.factorise(larger);
    report("notices a changed pattern", done.analysed, "");
    check_solve("incompressible", solver, larger);

    options.skewness               = 0.1;
    const SparseSystem unsymmetric = make(options);
    solver.factorise(unsymmetric);
    check_solve("unsymmetric", solver, unsymmetric);

    options.mixed                              = false;
    options.poisson_ratio                      = 0.3;
    const SparseSystem unsymmetric_irreducible = make(options);
    solver.factorise(unsymmetric_irreducible);
    check_solve("unsymmetric without pressure",
                solver,
                unsymmetric_irreducible);

    options.skewness               = 0.;
    const SparseSystem irreducible = make(options);
    solver.factorise(irreducible);
    check_solve("without pressure", solver, irreducible);

    options.mixed            = true;
    options.poisson_ratio    = 0.499;
    options.n_cells_per_edge = 4;
    const SparseSystem three_dimensional =
      ElasticitySystem<3>(MPI_COMM_WORLD, options).A;
    solver.factorise(three_dimensional);
    check_solve("3D", solver, three_dimensional);
    check_handing_over("handed over", solver, three_dimensional);
    check_handing_over("handed over, unsymmetric", solver, unsymmetric);
  }

  void
  check_wrong_systems(LinearSolver &solver)
  {
    ElasticitySystemOptions options;
    options.clamped             = false;
    const SparseSystem floating = make(options);
    DistributedVector  b(floating.locally_owned, floating.comm), x(b);
    b = 1.;
    check_failure("body that nothing holds", [&] {
      solver.factorise(floating);
      solver.solve(b, x);
    });

    // Only one rank knows, all have to throw.
    options.clamped  = true;
    SparseSystem bad = make(options);
    if (Utilities::MPI::this_mpi_process(bad.comm) == 0)
      bad.values[bad.values.size() / 2] =
        std::numeric_limits<double>::quiet_NaN();
    check_failure("not a number in the matrix", [&] {
      solver.factorise(bad);
      DistributedVector rhs(bad.locally_owned, bad.comm), solution(rhs);
      rhs = 1.;
      solver.solve(rhs, solution);
    });

    const SparseSystem good = make(options);
    solver.factorise(good);
    check_solve("recovers", solver, good);
  }

  std::unique_ptr<LinearSolver>
  create(const std::string &name,
         const std::string &parameter = "",
         const std::string &value     = "")
  {
    ParameterHandler prm;
    prm.enter_subsection("Linear solver");
    PluginRegistry<LinearSolver>::declare_parameters(prm);
    if (!parameter.empty())
      {
        prm.enter_subsection(name);
        prm.set(parameter, value);
        prm.leave_subsection();
      }
    auto solver = PluginRegistry<LinearSolver>::create(name);
    solver->parse_parameters(prm);
    prm.leave_subsection();
    return solver;
  }

  /** In any units of displacements and pressures the solution is the same. */
  void
  check_units(const std::string &test, const SparseSystem &A)
  {
    for (const double factor : {1e-9, 1e9})
      {
        SparseSystem        B = A;
        std::vector<double> unit(A.n_equations, 0.), x_exact(A.n_equations);
        const auto          unit_of = [&](const unsigned int r) {
          return A.field[r] == SparseSystem::Field::pressure ? factor :
                                                                        1 / factor;
        };
        for (std::size_t r = 0; r + 1 < A.row_start.size(); ++r)
          {
            for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
              B.values[k] *= unit_of(r) * unit_of(A.column[k]);
            if (A.locally_owned.is_element(A.global_equation[r]))
              unit[A.global_equation[r]] = unit_of(r);
          }
        Utilities::MPI::sum(unit, A.comm, unit);
        for (types::global_dof_index i = 0; i < A.n_equations; ++i)
          x_exact[i] = exact(i, 0.) / unit[i];
        const auto solver = create("MUMPS");
        solver->factorise(B);
        DistributedVector x(B.locally_owned, B.comm);
        solver->solve(distribute(multiply(B, x_exact), B), x);
        std::vector<double> found = replicate(x, B);
        for (types::global_dof_index i = 0; i < A.n_equations; ++i)
          {
            found[i] *= unit[i];
            x_exact[i] *= unit[i];
          }
        const double error = relative_difference(found, x_exact);
        report(test, error < 1e-9, std::to_string(error));
      }
  }

  /** For a plane matrix whose pattern lasts another ordering is tried once,
   * and not kept if factors are larger with it, as those of this lattice. */
  void
  check_lasting_pattern()
  {
    ElasticitySystemOptions options;
    options.n_cells_per_edge   = 42;
    SparseSystem       A       = make(options);
    const auto         solver  = create("MUMPS");
    LinearSolverReport first   = solver->factorise(A), last;
    unsigned int       n_again = 0;
    for (unsigned int i = 0; i < 11; ++i)
      {
        last = solver->factorise(A);
        n_again += last.analysed;
      }
    // On several ranks MUMPS spreads fronts by the load that it sees, by which
    // the number of entries differs a little from run to run.
    const double tolerance = 1e-2 * first.n_factor_entries;
    report("a pattern that lasts",
           n_again == 1 &&
             last.n_factor_entries <= first.n_factor_entries + tolerance,
           std::to_string(n_again) + " times, " +
             std::to_string(first.n_factor_entries) + " and " +
             std::to_string(last.n_factor_entries) + " entries");
    check_solve("is solved as before", *solver, A);

    A.pattern_id       = make(options).pattern_id;
    last               = solver->factorise(A);
    const double other = last.n_factor_entries - first.n_factor_entries;
    report("and another begins anew",
           last.analysed && std::abs(other) <= tolerance,
           std::to_string(other) + " entries more");
  }

  /** What only MUMPS tells: a saddle point has a negative pivot for each
   * pressure (Sylvester's law of inertia), whatever the ordering. */
  void
  check_mumps()
  {
    ElasticitySystemOptions options;
    options.poisson_ratio = 0.5;
    const SparseSystem A  = make(options);
    check_packed_columns(A);
    const unsigned int n_pressures =
      (options.n_cells_per_edge + 1) * (options.n_cells_per_edge + 1);
    for (const std::string ordering :
         {"automatic", "AMD", "AMF", "QAMD", "PORD", "METIS"})
      {
        const auto solver = create("MUMPS", "Ordering", ordering);
        const auto done   = solver->factorise(A);
        report("negative pivots with " + ordering,
               done.n_negative_pivots == n_pressures,
               std::to_string(done.n_negative_pivots));
        check_solve("solution with " + ordering, *solver, A);
      }

    check_lasting_pattern();
    check_units("units", A);
    SparseSystem unstabilised = A; // no pressure has a diagonal entry
    for (std::size_t r = 0; r + 1 < A.row_start.size(); ++r)
      for (std::size_t k = A.row_start[r]; k < A.row_start[r + 1]; ++k)
        if (A.field[r] == SparseSystem::Field::pressure && A.column[k] == r)
          unstabilised.values[k] = 0.;
    check_units("units, pressures without diagonal", unstabilised);
    options.skewness = 0.1;
    check_units("units, unsymmetric", make(options));
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  std::stringstream                names(PluginRegistry<LinearSolver>::names());
  for (std::string name; std::getline(names, name, '|');)
    {
      out() << name << std::endl;
      const auto solver = create(name);
      check_right_systems(*solver);
      check_wrong_systems(*solver);
    }
  out() << "MUMPS in particular" << std::endl;
  check_mumps();
  return 0;
}
