/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include <deal.II/base/mpi.h>

#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/matrix_scaling.h>
#include <isochor/linear_solver/mumps_instance.h>
#include <isochor/linear_solver/nested_dissection.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>

namespace isochor
{
  namespace
  {
    /** What is left of this machine's memory, in bytes, or infinity if the
     * system doesn't tell. */
    double
    available_memory()
    {
      std::ifstream file("/proc/meminfo");
      std::string   name;
      double        kilobytes = 0;
      while (file >> name)
        if (name == "MemAvailable:" && file >> kilobytes)
          return 1024. * kilobytes;
      return std::numeric_limits<double>::infinity();
    }

    /** The values of ICNTL(7) for the orderings inside MUMPS. */
    const std::map<std::string, int> mumps_orderings = {{"AMD", 0},
                                                        {"AMF", 2},
                                                        {"SCOTCH", 3},
                                                        {"PORD", 4},
                                                        {"QAMD", 6}};
  } // namespace

  /**
   * The multifrontal direct solver MUMPS (Amestoy, Duff, L'Excellent & Koster,
   * SIAM J. Matrix Anal. Appl. 23 (2001) 15-41): LDL^T with 2x2 pivots of
   * symmetric indefinite matrices, LU of others. The names ICNTL, CNTL, INFO
   * are those of its users' guide.
   *
   * The matrix goes to MUMPS as it is: its values are not copied, the analysis
   * is kept while SparseSystem::pattern_id stays, but for
   * try_nested_dissection().
   */
  class MUMPS : public LinearSolver
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.enter_subsection("MUMPS");
      prm.declare_entry(
        "Ordering",
        "automatic",
        Patterns::Selection("automatic|AMD|AMF|QAMD|PORD|METIS|SCOTCH"),
        "Fill-reducing ordering of the equations. <automatic> is METIS' "
        "nested dissection in 3D, where the factors decide; in 2D it is AMF, "
        "the approximate minimum fill, whose analysis takes a fifth of the "
        "time, and after ten factorisations of one pattern METIS, if its "
        "factors are smaller. SCOTCH is there if MUMPS was built with it.");
      prm.declare_entry(
        "Pivot threshold",
        "0.01",
        Patterns::Double(0., 1.),
        "Relative threshold of numerical pivoting (CNTL(1); at most 0.5 is "
        "used for symmetric matrices). Zero disables pivoting: a tenth "
        "faster, and safe only for positive definite displacement blocks.");
      prm.declare_entry("Iterative refinement steps",
                        "0",
                        Patterns::Integer(0, 10),
                        "Largest number of iterative refinement steps of a "
                        "solution.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("MUMPS");
      ordering           = prm.get("Ordering");
      pivot_threshold    = prm.get_double("Pivot threshold");
      n_refinement_steps = prm.get_integer("Iterative refinement steps");
      prm.leave_subsection();
    }

    LinearSolverReport
    factorise(const SparseSystem &A) override
    {
      LinearSolverReport report;
      factorised = false;
      if (A.n_equations == 0)
        return report;

      assert_finite(A);
      const bool is_new = !mumps || pattern_id != A.pattern_id ||
                          comm != A.comm || symmetric != A.symmetric;
      if (is_new)
        {
          n_of_pattern  = 0;
          largest_scale = 0;
        }
      report.analysed = is_new || has_come_to_stay(A);
      if (is_new)
        analyse(A);
      else if (report.analysed)
        try_nested_dissection(A);
      ++n_of_pattern;
      set_values(A);
      set_scale(A);
      factorise_with_enough_memory();
      factorised        = true;
      report.factorised = true;

      const auto &id = mumps->id;
      if (symmetric)
        report.n_negative_pivots = entry(id.infog, 12);
      report.knows_pivots     = symmetric;
      report.n_factor_entries = count(id.infog, 29);
      report.memory_in_bytes  = 1e6 * entry(id.info, 22);
      return report;
    }

    LinearSolverReport
    solve(const TrilinosWrappers::MPI::Vector &b,
          TrilinosWrappers::MPI::Vector       &x) override
    {
      if (b.size() == 0)
        return LinearSolverReport();
      AssertThrow(factorised,
                  ExcMessage("MUMPS: solve() needs a matrix that was "
                             "factorised successfully."));
      x        = b;
      auto &id = mumps->id;
      id.nrhs  = 1;
      id.lrhs  = id.n;
      if (n_ranks == 1)
        {
          id.rhs = x.begin();
          check(mumps->run(3), "solve");
        }
      else
        {
          gather(x);
          id.rhs = centralised.data();
          check(mumps->run(3), "solve");
          scatter(x);
        }
      id.rhs = nullptr;
      check_consistency();
      AssertThrow(std::isfinite(x.l2_norm()),
                  ExcLinearSolverFailed(
                    "the solution has entries that are not finite numbers."));
      return LinearSolverReport();
    }

  private:
    /** Whether it pays to look for a better ordering of this pattern. */
    bool
    has_come_to_stay(const SparseSystem &A) const
    {
      constexpr types::global_dof_index large = 5000; // equations
      return n_of_pattern == lasting && ordering == "automatic" && A.dim == 2 &&
             A.n_equations >= large;
    }

    /** In 2D nested dissection takes longer. On irregular grids its factors are
     * smaller by 5 to 15 %, on lattices larger. */
    void
    try_nested_dissection(const SparseSystem &A)
    {
      std::unique_ptr<MumpsInstance> cheap = std::move(mumps);
      analyse(A);
      constexpr int foreseen = 20; // entries of the factors
      if (count(mumps->id.infog, foreseen) > count(cheap->id.infog, foreseen))
        mumps = std::move(cheap);
    }

    /** The symbolic phase: order the equations and plan the factorisation. */
    void
    analyse(const SparseSystem &A)
    {
      AssertThrow(A.n_equations < static_cast<types::global_dof_index>(
                                    std::numeric_limits<int>::max()),
                  ExcMessage("MUMPS numbers equations by 32-bit integers."));
      mumps.reset();
      comm      = A.comm;
      symmetric = A.symmetric;
      n_ranks   = Utilities::MPI::n_mpi_processes(comm);
      mumps     = std::make_unique<MumpsInstance>(comm, symmetric);

      set_pattern(A);
      set_values(A);
      set_options();
      std::vector<int> permutation;
      set_ordering(A.dim, permutation);
      const int status = mumps->run(1);
      if (status < 0)
        {
          const std::string message = explanation(status, "analysis");
          mumps.reset();
          AssertThrow(false, ExcLinearSolverFailed(message));
        }
      mumps->id.perm_in = nullptr;
      check_ordering();
      assert_enough_memory();
      pattern_id = A.pattern_id;
      share_ownership(A);
    }

    /** Coordinates of the entries. A rank alone passes its matrix centralised,
     * which is analysed faster than the same matrix as distributed. */
    void
    set_pattern(const SparseSystem &A)
    {
      row.resize(A.column.size());
      column.resize(A.column.size());
      for (std::size_t i = 0; i + 1 < A.row_start.size(); ++i)
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          {
            row[k]    = A.global_equation[i] + 1;
            column[k] = A.global_equation[A.column[k]] + 1;
          }

      auto &id = mumps->id;
      id.n     = A.n_equations;
      if (n_ranks == 1)
        {
          entry(id.icntl, 18) = 0;
          id.nnz              = row.size();
          id.irn              = row.data();
          id.jcn              = column.data();
        }
      else
        {
          entry(id.icntl, 18) = 3;
          id.nnz_loc          = row.size();
          id.irn_loc          = row.data();
          id.jcn_loc          = column.data();
        }
    }

    /** MUMPS only reads the values, but its interface lacks the const. */
    void
    set_values(const SparseSystem &A)
    {
      (n_ranks == 1 ? mumps->id.a : mumps->id.a_loc) =
        const_cast<double *>(A.values.data());
    }

    /** The matrix of one rank is scaled here: MUMPS does it by sweeps that take
     * a tenth of the time of a factorisation. */
    void
    set_scale(const SparseSystem &A)
    {
      if (n_ranks > 1)
        return;
      scale            = matrix_scaling(A);
      mumps->id.rowsca = mumps->id.colsca = scale.data();
    }

    void
    set_options()
    {
      auto &id            = mumps->id;
      entry(id.icntl, 10) = n_refinement_steps;
      // Ask for null pivots to be detected; otherwise a singular matrix whose
      // last pivot is rounding noise passes for a regular one. Costs nothing.
      entry(id.icntl, 24) = 1;
      if (n_ranks == 1)
        entry(id.icntl, 8) = -1; // by set_scale()
      // ... on several ranks only if the last front stays out of ScaLAPACK
      entry(id.icntl, 13) = 1;
      // ... which are pivots below this, in the scaled matrix: by default just
      // rounding, which a faster BLAS may exceed
      entry(id.cntl, 3) = 1e-13;
      entry(id.cntl, 1) = pivot_threshold;
    }

    /** @p permutation has to live until the analysis is done. */
    void
    set_ordering(const unsigned int dim, std::vector<int> &permutation)
    {
      requested_ordering = ordering;
      if (ordering == "automatic")
        requested_ordering =
          (dim == 2 && n_of_pattern < lasting ? "AMF" : "METIS");

      auto &id            = mumps->id;
      entry(id.icntl, 28) = 1; // the analysis is sequential
      if (requested_ordering != "METIS")
        {
          entry(id.icntl, 7) = mumps_orderings.at(requested_ordering);
          return;
        }
      const auto rows    = Utilities::MPI::gather(comm, row);
      const auto columns = Utilities::MPI::gather(comm, column);
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        {
          permutation = nested_dissection(id.n, rows, columns);
          id.perm_in  = permutation.data();
        }
      entry(id.icntl, 7) = 1; // the permutation given
    }

    /** Better an error than a run that the system ends. */
    void
    assert_enough_memory() const
    {
      MPI_Comm  machine;
      const int ierr = MPI_Comm_split_type(
        comm, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
      AssertThrowMPI(ierr);
      const double needed =
        Utilities::MPI::sum(1e6 * entry(mumps->id.info, 15), machine);
      MPI_Comm_free(&machine);
      const double lacking =
        Utilities::MPI::max(needed - available_memory(), comm);
      AssertThrow(lacking <= 0,
                  ExcLinearSolverFailed(
                    "MUMPS: to factorise the matrix of " +
                    std::to_string(mumps->id.n) + " equations takes about " +
                    std::to_string(std::lround(needed / 1e6)) + " MB, " +
                    std::to_string(std::lround(lacking / 1e6)) +
                    " MB more than the machine has left. Set <Linear "
                    "solver/Solver = Block FGMRES> or use a coarser grid."));
    }

    /** MUMPS replaces an ordering that it was built without by another. */
    void
    check_ordering() const
    {
      if (requested_ordering != "METIS")
        AssertThrow(entry(mumps->id.infog, 7) ==
                      mumps_orderings.at(requested_ordering),
                    ExcMessage("The parameter <Linear solver/MUMPS/Ordering> "
                               "is <" +
                               requested_ordering +
                               ">, but this MUMPS was built without it."));
    }

    /** Factorise; where the estimated workspace is too small, give more. */
    void
    factorise_with_enough_memory()
    {
      // The codes of INFO(1) that say so.
      const auto more_workspace_helps = [](const int status) {
        return status == -8 || status == -9 || status == -11 || status == -12 ||
               status == -14 || status == -15 || status == -17 ||
               status == -18 || status == -20;
      };
      const int largest_increase = 1000; // percent
      int       status           = mumps->run(2);
      int      &increase         = entry(mumps->id.icntl, 14);
      while (more_workspace_helps(status) && increase < largest_increase)
        {
          increase = std::max(50, 2 * increase);
          status   = mumps->run(2);
        }
      check(status, "factorisation");

      n_null_pivots = entry(mumps->id.infog, 28);
      // for check_consistency(); costs a few products with the matrix
      entry(mumps->id.icntl, 11) = (n_null_pivots > 0 ? 2 : 0);
    }

    /**
     * A singular matrix is fine if the right-hand side has no part outside of
     * its range, as that of u-p without stabilisation and its pressures that
     * no point feels: the solution is then one of many. It is not if loads act
     * on a body that nothing holds. What is left over is measured by the
     * largest system of the same pattern: corrections get small and leave
     * nothing but rounding. Only the first solve with a factorisation is
     * checked: later the matrix may have been assembled anew.
     */
    void
    check_consistency()
    {
      if (entry(mumps->id.icntl, 11) == 0)
        return;
      entry(mumps->id.icntl, 11) = 0;
      const auto  &rinfog        = mumps->id.rinfog;
      const double scale = entry(rinfog, 4) * entry(rinfog, 5); // |A| |x|
      largest_scale      = std::max(largest_scale, scale);
      // the error analysis is known to the host only; nothing solves a system
      // without a right-hand side
      const bool consistent = Utilities::MPI::broadcast(
        comm, scale == 0 || entry(rinfog, 6) * scale < 1e-10 * largest_scale);
      AssertThrow(consistent,
                  ExcLinearSolverFailed(
                    "MUMPS: the matrix is singular, " +
                    std::to_string(n_null_pivots) +
                    " pivot(s) vanish, and there is no solution: the "
                    "boundary conditions may not be enough to hold every "
                    "body"));
    }

    void
    check(const int status, const std::string &phase) const
    {
      AssertThrow(status >= 0,
                  ExcLinearSolverFailed(explanation(status, phase)));
    }

    std::string
    explanation(const int status, const std::string &phase) const
    {
      std::string reason;
      if (status == -10 || status == -6)
        reason = ", the matrix is singular";
      else if (status == -13 || status == -7)
        reason = ", out of memory";
      return "MUMPS, " + phase + reason +
             ": INFOG(1:2) = " + std::to_string(status) + ", " +
             std::to_string(entry(mumps->id.infog, 2)) + ".";
    }

    /** Tell rank 0 who owns what: MUMPS wants the right-hand side there. */
    void
    share_ownership(const SparseSystem &A)
    {
      if (n_ranks == 1)
        return;
      const int n_owned = A.locally_owned.n_elements();
      const int begin = n_owned == 0 ? 0 : A.locally_owned.nth_index_in_set(0);
      n_owned_by      = Utilities::MPI::gather(comm, n_owned);
      owned_begin_of  = Utilities::MPI::gather(comm, begin);
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        centralised.resize(A.n_equations);
    }

    void
    gather(TrilinosWrappers::MPI::Vector &x)
    {
      const int ierr = MPI_Gatherv(x.begin(),
                                   x.end() - x.begin(),
                                   MPI_DOUBLE,
                                   centralised.data(),
                                   n_owned_by.data(),
                                   owned_begin_of.data(),
                                   MPI_DOUBLE,
                                   0,
                                   comm);
      AssertThrowMPI(ierr);
    }

    void
    scatter(TrilinosWrappers::MPI::Vector &x)
    {
      const int ierr = MPI_Scatterv(centralised.data(),
                                    n_owned_by.data(),
                                    owned_begin_of.data(),
                                    MPI_DOUBLE,
                                    x.begin(),
                                    x.end() - x.begin(),
                                    MPI_DOUBLE,
                                    0,
                                    comm);
      AssertThrowMPI(ierr);
    }

    /** Factorisations after which a pattern is taken to last. */
    static constexpr unsigned int lasting = 10;

    std::string ordering           = "automatic";
    double      pivot_threshold    = 0.01;
    int         n_refinement_steps = 0;

    std::unique_ptr<MumpsInstance> mumps;
    bool                           factorised    = false;
    int                            n_null_pivots = 0;
    double                         largest_scale = 0;
    unsigned long                  pattern_id    = 0;
    unsigned int                   n_of_pattern  = 0; ///< factorisations
    MPI_Comm                       comm          = MPI_COMM_NULL;
    unsigned int                   n_ranks       = 1;
    bool                           symmetric     = true;
    std::string                    requested_ordering;

    /** Coordinates of the entries, 1-based. */
    std::vector<int> row, column;

    /** On rank 0: the ranges of the ranks, and a vector over all equations. */
    std::vector<int>    n_owned_by, owned_begin_of;
    std::vector<double> centralised;

    std::vector<double> scale; ///< of rows and columns
  };

  ISOCHOR_REGISTER(LinearSolver, MUMPS, "MUMPS")
} // namespace isochor
