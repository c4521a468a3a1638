/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/vector_memory.h>

#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/multigrid.h>
#include <isochor/linear_solver/packed_columns.h>
#include <isochor/linear_solver/saddle_point_matrix.h>

#include <algorithm>
#include <cmath>
#include <optional>
#ifdef __GLIBC__
#  include <malloc.h>
#endif

namespace isochor
{
  namespace
  {
    using DistributedVector      = TrilinosWrappers::MPI::Vector;
    using DistributedBlockVector = TrilinosWrappers::MPI::BlockVector;

    /** Give the system what has been freed between arrays in use: new ones, of
     * other sizes, often don't fit there. */
    void
    give_back_memory()
    {
#ifdef __GLIBC__
      malloc_trim(0);
#endif
    }

    /** Upper block triangle of the factors of a saddle-point matrix. */
    struct BlockTriangularPreconditioner
    {
      void
      vmult(DistributedBlockVector       &dst,
            const DistributedBlockVector &src) const
      {
        dst.block(1) = src.block(1);
        dst.block(1).scale(minus_S_inverse);
        scaled_pressure.equ(matrix->scale, dst.block(1));
        matrix->B.vmult(residual, scaled_pressure);
        residual.sadd(-1., 1., src.block(0));
        K_inverse->vmult(dst.block(0), residual);
      }

      const SaddlePointMatrix  *matrix;
      const Multigrid          *K_inverse;
      DistributedVector         minus_S_inverse;
      mutable DistributedVector residual, scaled_pressure;
    };
  } // namespace

  /**
   * FGMRES on the saddle-point system with a block-triangular preconditioner
   * (Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers,
   * ch. 9): algebraic multigrid for the displacements, a diagonal for the
   * Schur complement of the pressures. Systems without pressures are solved by
   * conjugate gradients, or FGMRES if unsymmetric, with the multigrid alone.
   *
   * The multigrid hierarchy is kept as long as the pattern stays and iterations
   * do not become many more than they were with it at first. The matrix of the
   * finest level is always the present one.
   */
  class BlockFGMRES : public LinearSolver
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.enter_subsection("Block FGMRES");
      prm.declare_entry("Relative tolerance",
                        "1e-10",
                        Patterns::Double(0., 1.),
                        "Residual relative to the right-hand side at which a "
                        "solve ends, unless Newton's method is content with "
                        "more, see <Newton/Inexact>.");
      prm.declare_entry("Maximum iterations",
                        "300",
                        Patterns::Integer(1),
                        "More iterations are a failure; the direct solver "
                        "then takes over.");
      prm.declare_entry("Basis size",
                        "100",
                        Patterns::Integer(2),
                        "Restart after as many iterations. Twice as many "
                        "vectors are kept.");
      prm.declare_entry("Slowdown",
                        "1.5",
                        Patterns::Double(1.),
                        "The multigrid hierarchy is built anew when a solve "
                        "needs that many times the iterations, for the same "
                        "accuracy, of the first one with it. 1: for each "
                        "matrix.");
      prm.declare_entry("Multigrid",
                        "auto",
                        Patterns::Selection("auto|" +
                                            PluginRegistry<Multigrid>::names()),
                        "The algebraic multigrid method for the displacements. "
                        "BoomerAMG: of hypre. ML: smoothed aggregation of "
                        "Trilinos, takes less memory. auto: BoomerAMG where "
                        "materials may yield, which takes it a third of the "
                        "time, else ML.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("Block FGMRES");
      relative_tolerance   = prm.get_double("Relative tolerance");
      n_maximum_iterations = prm.get_integer("Maximum iterations");
      basis_size           = prm.get_integer("Basis size");
      slowdown             = prm.get_double("Slowdown");
      multigrid_name       = prm.get("Multigrid");
      prm.leave_subsection();
    }

    bool
    is_iterative() const override
    {
      return true;
    }

    void
    set_accuracy(const SolutionAccuracy &a) override
    {
      accuracy = a;
    }

    LinearSolverReport
    factorise(const SparseSystem &A) override
    {
      take_matrix(A);
      build_preconditioner(nullptr);
      return set_up;
    }

    LinearSolverReport
    factorise_and_free(SparseSystem &A) override
    {
      take_matrix(A);
      // of several ranks, the blocks hold the sum
      if (Utilities::MPI::n_mpi_processes(A.comm) == 1)
        std::vector<double>().swap(A.values);
      build_preconditioner(&A);
      return set_up;
    }

    void
    restore_values(SparseSystem &A) const override
    {
      // else A has none, or still has them
      if (matrix && Utilities::MPI::n_mpi_processes(A.comm) == 1)
        matrix->restore_values(A);
    }

    LinearSolverReport
    solve(const DistributedVector &b, DistributedVector &x) override
    {
      try
        {
          return pressures->locally_owned.size() > 0 ?
                   solve_mixed(b, x) :
                   solve_displacements(b, x);
        }
      catch (const ExcLinearSolverFailed &)
        {
          hierarchy_serves = false;
          if (hierarchy_is_new)
            throw;
        }
      build_multigrid();
      return solve(b, x);
    }

  private:
    /** Copy @p A to the blocks, which are laid out anew if its pattern is. */
    void
    take_matrix(const SparseSystem &A)
    {
      set_up = LinearSolverReport();
      assert_finite(A);
      system = &A;
      comm   = A.comm;
      if (matrix && pattern_id == A.pattern_id)
        matrix->copy_values(A);
      else
        {
          multigrid = create_multigrid(A.may_yield); // refers to the matrix
          hierarchy_serves = false;
          matrix.reset();
          displacements =
            std::make_unique<EquationSubset>(A,
                                             SparseSystem::Field::displacement,
                                             true);
          pressures =
            std::make_unique<EquationSubset>(A, SparseSystem::Field::pressure);
          matrix =
            std::make_unique<SaddlePointMatrix>(A, *displacements, *pressures);
          pattern_id      = A.pattern_id;
          set_up.analysed = true;
        }
      set_up.memory_in_bytes = matrix->memory_consumption();
    }

    /** The one that the parameters and what is there call for. */
    std::unique_ptr<Multigrid>
    create_multigrid(const bool may_yield) const
    {
      std::string name = multigrid_name;
      if (name == "auto")
        {
          const std::string all = PluginRegistry<Multigrid>::names();
          const bool has_hypre  = all.find("BoomerAMG") != std::string::npos;
          name                  = may_yield && has_hypre ? "BoomerAMG" : "ML";
        }
      return PluginRegistry<Multigrid>::create(name);
    }

    /** @p idle_matrix: null, or the matrix, which may be packed meanwhile. */
    void
    build_preconditioner(SparseSystem *idle_matrix)
    {
      if (!hierarchy_serves || slowdown == 1.)
        {
          std::optional<PackedColumns> packed;
          if (idle_matrix != nullptr)
            packed.emplace(*idle_matrix);
          build_multigrid();
        }
      else
        multigrid->update_finest_level();
      if (pressures->locally_owned.size() > 0)
        build_block_preconditioner();
      set_up.factorised = true;
    }

    void
    build_multigrid()
    {
      multigrid->clear();
      // The largest products of matrices are made now: the basis of the last
      // solve, which is kept for the next one, would only be in the way.
      GrowingVectorMemory<DistributedVector>::release_unused_memory();
      GrowingVectorMemory<DistributedBlockVector>::release_unused_memory();
      give_back_memory();
      multigrid->build(
        matrix->K.matrix(),
        system->dim,
        [this] { return near_null_space(*system, *displacements); },
        pressures->locally_owned.size() == 0);
      give_back_memory(); // a quarter of what is in use
      hierarchy_serves = hierarchy_is_new = true;
    }

    void
    build_block_preconditioner()
    {
      preconditioner.matrix    = matrix.get();
      preconditioner.K_inverse = multigrid.get();
      preconditioner.residual.reinit(displacements->locally_owned, comm);
      preconditioner.scaled_pressure.reinit(pressures->locally_owned, comm);

      DistributedVector &diagonal = preconditioner.minus_S_inverse;
      diagonal = schur_complement_diagonal(*matrix, *pressures, *system);
      const double square = matrix->scale * matrix->scale;
      int          ok     = 1;
      for (double &entry : diagonal)
        {
          ok    = ok && std::isfinite(entry) && entry != 0.;
          entry = -1. / (square * entry);
        }
      AssertThrow(Utilities::MPI::min(ok, comm) == 1,
                  ExcLinearSolverFailed(
                    "Block FGMRES: the diagonal of C + B^T diag(K)^-1 B has "
                    "a zero or an entry that isn't finite: a pressure is "
                    "coupled to nothing."));
    }

    LinearSolverReport
    solve_mixed(const DistributedVector &b, DistributedVector &x)
    {
      DistributedBlockVector rhs({displacements->locally_owned,
                                  pressures->locally_owned},
                                 comm);
      displacements->extract(b, rhs.block(0));
      pressures->extract(b, rhs.block(1));
      rhs.block(1) *= matrix->scale;
      DistributedBlockVector solution;
      solution.reinit(rhs);

      SolverFGMRES<DistributedBlockVector>::AdditionalData data;
      data.max_basis_size = basis_size;
      const auto report   = run(
        [&](SolverControl &control) {
          SolverFGMRES<DistributedBlockVector>(control, data)
            .solve(*matrix, solution, rhs, preconditioner);
          DistributedBlockVector residual;
          residual.reinit(rhs);
          matrix->vmult(residual, solution);
          residual -= rhs;
          return residual.l2_norm();
        },
        rhs.l2_norm(),
        std::min(accuracy.displacement, matrix->scale * accuracy.pressure));
      solution.block(1) *= matrix->scale;
      displacements->insert(solution.block(0), x);
      pressures->insert(solution.block(1), x);
      return report;
    }

    LinearSolverReport
    solve_displacements(const DistributedVector &b, DistributedVector &x)
    {
      DistributedVector rhs(displacements->locally_owned, comm);
      DistributedVector solution(displacements->locally_owned, comm);
      displacements->extract(b, rhs);

      SolverFGMRES<DistributedVector>::AdditionalData data;
      data.max_basis_size = basis_size;
      const auto report   = run(
        [&](SolverControl &control) {
          if (system->symmetric)
            SolverCG<DistributedVector>(control).solve(matrix->K,
                                                       solution,
                                                       rhs,
                                                       *multigrid);
          else
            SolverFGMRES<DistributedVector>(control, data)
              .solve(matrix->K, solution, rhs, *multigrid);
          DistributedVector residual(rhs);
          matrix->K.vmult(residual, solution);
          residual -= rhs;
          return residual.l2_norm();
        },
        rhs.l2_norm(),
        accuracy.displacement);
      displacements->insert(solution, x);
      return report;
    }

    /** The residual that a Krylov method updates departs from the true one
     * when the matrix is singular: the solution then grows without bounds. */
    void
    assert_true_residual(const double residual,
                         const double asked_for,
                         const double rhs_norm) const
    {
      const double rounding = 1e-8;
      AssertThrow(residual <= std::max(2. * asked_for, rounding * rhs_norm),
                  ExcLinearSolverFailed(
                    "Block FGMRES: the iteration converged, but the true "
                    "residual is " +
                    Utilities::to_string(residual) +
                    ". The matrix is singular or nearly so."));
    }

    /** The iterations to reduce a residual by a @p factor after which to give
     * up: with a hierarchy that has served before, many times those that it
     * took. */
    unsigned int
    most_iterations(const double factor) const
    {
      if (hierarchy_is_new || !(factor > 1.))
        return n_maximum_iterations;
      const double usual = first_iterations_per_digit * std::log10(factor);
      return std::min<double>(n_maximum_iterations, 20. + 4. * usual);
    }

    /** Run @p iteration, which returns the true residual, until it is a part
     * of @p rhs_norm or below @p absolute; turn its failure into ours. */
    template <typename Iteration>
    LinearSolverReport
    run(const Iteration &iteration,
        const double     rhs_norm,
        const double     absolute)
    {
      AssertThrow(std::isfinite(rhs_norm),
                  ExcLinearSolverFailed("Block FGMRES: the right-hand side "
                                        "has entries that are not finite."));
      const double  part      = std::max(relative_tolerance, accuracy.relative);
      const double  tolerance = std::max(part * rhs_norm, absolute);
      SolverControl control(most_iterations(rhs_norm / tolerance), tolerance);
      double        residual = 0;
      try
        {
          residual = iteration(control);
        }
      catch (const std::exception &)
        {
          AssertThrow(false,
                      ExcLinearSolverFailed(
                        "Block FGMRES: after " +
                        std::to_string(control.last_step()) +
                        " iterations the residual is " +
                        Utilities::to_string(control.last_value()) + ", not " +
                        Utilities::to_string(control.tolerance()) + "."));
        }
      assert_true_residual(residual, control.tolerance(), rhs_norm);
      judge_hierarchy(control, rhs_norm);
      LinearSolverReport report;
      report.iterations = control.last_step();
      return report;
    }

    /** Decide whether the next matrix gets a hierarchy of its own. */
    void
    judge_hierarchy(const SolverControl &control, const double rhs_norm)
    {
      const double digits = std::log10(rhs_norm / control.last_value());
      // of a solve that was over at once nothing can be said
      if (!(digits > 0.5))
        return;
      const double iterations_per_digit = control.last_step() / digits;
      if (hierarchy_is_new)
        first_iterations_per_digit = iterations_per_digit;
      else if (iterations_per_digit > slowdown * first_iterations_per_digit)
        hierarchy_serves = false;
      hierarchy_is_new = false;
    }

    double           relative_tolerance   = 1e-10;
    unsigned int     n_maximum_iterations = 300;
    unsigned int     basis_size           = 100;
    double           slowdown             = 1.5;
    std::string      multigrid_name       = "auto";
    SolutionAccuracy accuracy;

    LinearSolverReport  set_up; ///< of the last matrix
    MPI_Comm            comm       = MPI_COMM_NULL;
    unsigned long       pattern_id = 0;
    const SparseSystem *system     = nullptr;

    // In the order of dependence.
    std::unique_ptr<EquationSubset>    displacements, pressures;
    std::unique_ptr<SaddlePointMatrix> matrix;
    std::unique_ptr<Multigrid>         multigrid;
    BlockTriangularPreconditioner      preconditioner;

    /** Whether the hierarchy is good enough for the next matrix, and whether it
     * has not been judged yet. */
    bool   hierarchy_serves = false, hierarchy_is_new = true;
    double first_iterations_per_digit = 0;
  };

  ISOCHOR_REGISTER(LinearSolver, BlockFGMRES, "Block FGMRES")
} // namespace isochor
