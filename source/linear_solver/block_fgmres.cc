/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_gmres.h>
#include <deal.II/lac/trilinos_parallel_block_vector.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <isochor/linear_solver.h>
#include <isochor/trilinos_export.h>

#include <Epetra_Import.h>
#include <Epetra_MultiVector.h>
#include <Epetra_Vector.h>
#include <Teuchos_ParameterList.hpp>

#include <array>
#include <cmath>

namespace isochor
{
  namespace
  {
    using DistributedVector      = TrilinosWrappers::MPI::Vector;
    using DistributedBlockVector = TrilinosWrappers::MPI::BlockVector;

    /** [[K, B], [B*, -C]] by blocks, without assembling the whole. */
    struct SaddlePointMatrix
    {
      SaddlePointMatrix(const SparseSystem   &A,
                        const EquationSubset &displacements,
                        const EquationSubset &pressures)
        : K(A, displacements, displacements)
        , B(A, displacements, pressures)
        , B_star(A, pressures, displacements)
        , minus_C(A, pressures, pressures)
      {}

      void
      copy_values(const SparseSystem &A)
      {
        for (TrilinosBlock *block : {&K, &B, &B_star, &minus_C})
          block->copy_values(A);
      }

      void
      vmult(DistributedBlockVector       &dst,
            const DistributedBlockVector &src) const
      {
        K.vmult(dst.block(0), src.block(0));
        B.vmult_add(dst.block(0), src.block(1));
        B_star.vmult(dst.block(1), src.block(0));
        minus_C.vmult_add(dst.block(1), src.block(1));
      }

      /** In bytes, on this rank. */
      double
      memory_consumption() const
      {
        double n_entries = 0.;
        for (const TrilinosBlock *block : {&K, &B, &B_star, &minus_C})
          n_entries += block->matrix().NumMyNonzeros();
        return n_entries * (sizeof(double) + sizeof(int));
      }

      TrilinosBlock K, B, B_star, minus_C;
    };

    /**
     * Twice the diagonal of C + B* diag(K)^{-1} B, an approximation of the
     * Schur complement C + B* K^{-1} B. Up to a factor near one it is the
     * pressure mass matrix, lumped and divided by the shear modulus, plus the
     * diagonal of C: unlike the whole of that product, whose iteration counts
     * grow as cells shrink, it is spectrally equivalent to the Schur complement
     * of a Stokes-like system whatever the mesh size, and it needs no material
     * constants. The factor two is an experiment's: it takes the fewest
     * iterations in 2D, and a fifth less than one in 3D.
     */
    DistributedVector
    schur_complement_diagonal(const SaddlePointMatrix &A,
                              const EquationSubset    &pressures,
                              const MPI_Comm           comm)
    {
      const Epetra_CrsMatrix &K = A.K.matrix(), &B_star = A.B_star.matrix(),
                             &minus_C = A.minus_C.matrix();
      Epetra_Vector K_owned(K.RowMap()), K_diagonal(B_star.ColMap());
      K.ExtractDiagonalCopy(K_owned);
      K_diagonal.Import(K_owned,
                        Epetra_Import(B_star.ColMap(), K.RowMap()),
                        ::Insert);
      Epetra_Vector C_diagonal(minus_C.RowMap());
      minus_C.ExtractDiagonalCopy(C_diagonal);

      DistributedVector diagonal(pressures.locally_owned, comm);
      const double      factor = 2.;
      for (int i = 0; i < B_star.NumMyRows(); ++i)
        {
          int     n_entries;
          double *values;
          int    *columns;
          B_star.ExtractMyRowView(i, n_entries, values, columns);
          double sum = -C_diagonal[i];
          for (int k = 0; k < n_entries; ++k)
            sum += values[k] * values[k] / K_diagonal[columns[k]];
          diagonal.begin()[i] = factor * sum;
        }
      return diagonal;
    }

    /**
     * The rigid body modes of the displacement equations in 2D, the
     * translations in 3D (where the rotations cost more than they save).
     */
    Epetra_MultiVector
    near_null_space(const SparseSystem &A, const EquationSubset &displacements)
    {
      const unsigned int n_modes = (A.dim == 2 ? 3 : A.dim);
      Epetra_MultiVector modes(displacements.owned_map, n_modes, true);
      int                row = 0;
      for (std::size_t i = 0; i < displacements.local_equation.size(); ++i)
        if (displacements.is_owned[i])
          {
            const unsigned int equation = displacements.local_equation[i];
            const unsigned int c        = A.component[equation];
            modes[c][row]               = 1.;
            if (A.dim == 2)
              modes[2][row] = (c == 0 ? -A.position[2 * equation + 1] :
                                        A.position[2 * equation]);
            ++row;
          }
      return modes;
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
        B->vmult(residual, dst.block(1));
        residual.sadd(-1., 1., src.block(0));
        K_inverse->vmult(dst.block(0), residual);
      }

      const TrilinosBlock                     *B;
      const TrilinosWrappers::PreconditionAMG *K_inverse;
      DistributedVector                        minus_S_inverse;
      mutable DistributedVector                residual;
    };
  } // namespace

  /**
   * FGMRES on the saddle-point system with a block-triangular preconditioner
   * (Elman, Silvester & Wathen, Finite Elements and Fast Iterative Solvers,
   * ch. 9): algebraic multigrid (ML) for the displacements, a diagonal for the
   * Schur complement of the pressures. Systems without pressures are solved by
   * conjugate gradients, or FGMRES if unsymmetric, with the multigrid alone.
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
                        "Largest residual relative to the right-hand side.");
      prm.declare_entry("Maximum iterations",
                        "1000",
                        Patterns::Integer(1),
                        "More iterations are an error.");
      prm.declare_entry("Basis size",
                        "100",
                        Patterns::Integer(2),
                        "Restart after as many iterations. Twice as many "
                        "vectors are kept.");
      prm.leave_subsection();
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      prm.enter_subsection("Block FGMRES");
      relative_tolerance   = prm.get_double("Relative tolerance");
      n_maximum_iterations = prm.get_integer("Maximum iterations");
      basis_size           = prm.get_integer("Basis size");
      prm.leave_subsection();
    }

    bool
    is_iterative() const override
    {
      return true;
    }

    LinearSolverReport
    factorise(const SparseSystem &A) override
    {
      LinearSolverReport report;
      assert_finite(A);
      comm      = A.comm;
      symmetric = A.symmetric;
      if (!matrix || pattern_id != A.pattern_id)
        {
          matrix.reset();
          displacements =
            std::make_unique<EquationSubset>(A,
                                             SparseSystem::Field::displacement);
          pressures =
            std::make_unique<EquationSubset>(A, SparseSystem::Field::pressure);
          matrix =
            std::make_unique<SaddlePointMatrix>(A, *displacements, *pressures);
          pattern_id      = A.pattern_id;
          report.analysed = true;
        }
      else
        matrix->copy_values(A);

      build_multigrid(A);
      if (pressures->locally_owned.size() > 0)
        build_block_preconditioner();
      report.factorised      = true;
      report.memory_in_bytes = matrix->memory_consumption();
      return report;
    }

    LinearSolverReport
    solve(const DistributedVector &b, DistributedVector &x) override
    {
      return pressures->locally_owned.size() > 0 ? solve_mixed(b, x) :
                                                   solve_displacements(b, x);
    }

  private:
    void
    build_multigrid(const SparseSystem &A)
    {
      TrilinosWrappers::PreconditionAMG::AdditionalData data;
      data.elliptic              = true;
      data.smoother_sweeps       = 2;
      data.aggregation_threshold = 0.02;

      const Epetra_CrsMatrix             &K = matrix->K.matrix();
      Teuchos::ParameterList              parameters;
      std::unique_ptr<Epetra_MultiVector> unused;
      data.set_parameters(parameters, unused, K);

      Epetra_MultiVector modes = near_null_space(A, *displacements);
      parameters.set("null space: type", "pre-computed");
      parameters.set("null space: dimension", modes.NumVectors());
      // ML takes a null pointer, which a rank without rows has, for modes that
      // are missing.
      double no_values = 0.;
      parameters.set("null space: vectors",
                     modes.MyLength() > 0 ? modes.Values() : &no_values);
      multigrid.initialize(K, parameters);
    }

    void
    build_block_preconditioner()
    {
      preconditioner.B         = &matrix->B;
      preconditioner.K_inverse = &multigrid;
      preconditioner.residual.reinit(displacements->locally_owned, comm);

      DistributedVector &diagonal = preconditioner.minus_S_inverse;
      diagonal = schur_complement_diagonal(*matrix, *pressures, comm);
      int ok   = 1;
      for (double &entry : diagonal)
        {
          ok    = ok && std::isfinite(entry) && entry != 0.;
          entry = -1. / entry;
        }
      AssertThrow(Utilities::MPI::min(ok, comm) == 1,
                  ExcLinearSolverFailed(
                    "Block FGMRES: the diagonal of C + B* diag(K)^-1 B has "
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
      DistributedBlockVector solution;
      solution.reinit(rhs);

      SolverFGMRES<DistributedBlockVector>::AdditionalData data;
      data.max_basis_size = basis_size;
      const auto report   = run(
        [&](SolverControl &control) {
          SolverFGMRES<DistributedBlockVector>(control, data)
            .solve(*matrix, solution, rhs, preconditioner);
        },
        rhs.l2_norm());
      DistributedBlockVector residual;
      residual.reinit(rhs);
      matrix->vmult(residual, solution);
      residual -= rhs;
      assert_true_residual(residual.l2_norm(), rhs.l2_norm());
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
          if (symmetric)
            SolverCG<DistributedVector>(control).solve(matrix->K,
                                                       solution,
                                                       rhs,
                                                       multigrid);
          else
            SolverFGMRES<DistributedVector>(control, data)
              .solve(matrix->K, solution, rhs, multigrid);
        },
        rhs.l2_norm());
      DistributedVector residual(rhs);
      matrix->K.vmult(residual, solution);
      residual -= rhs;
      assert_true_residual(residual.l2_norm(), rhs.l2_norm());
      displacements->insert(solution, x);
      return report;
    }

    /** The residual that a Krylov method updates departs from the true one
     * when the matrix is singular: the solution then grows without bounds. */
    void
    assert_true_residual(const double residual, const double rhs_norm) const
    {
      const double rounding = 100.;
      AssertThrow(residual <= rounding * relative_tolerance * rhs_norm,
                  ExcLinearSolverFailed(
                    "Block FGMRES: the iteration converged, but the true "
                    "residual is " +
                    Utilities::to_string(residual) +
                    ". The matrix is singular or nearly so."));
    }

    /** Run @p iteration and turn its failure into ours. */
    template <typename Iteration>
    LinearSolverReport
    run(const Iteration &iteration, const double rhs_norm) const
    {
      AssertThrow(std::isfinite(rhs_norm),
                  ExcLinearSolverFailed("Block FGMRES: the right-hand side "
                                        "has entries that are not finite."));
      SolverControl control(n_maximum_iterations,
                            relative_tolerance * rhs_norm);
      try
        {
          iteration(control);
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
      LinearSolverReport report;
      report.iterations = control.last_step();
      return report;
    }

    double       relative_tolerance   = 1e-10;
    unsigned int n_maximum_iterations = 1000;
    unsigned int basis_size           = 100;

    MPI_Comm      comm       = MPI_COMM_NULL;
    unsigned long pattern_id = 0;
    bool          symmetric  = true;

    // In the order of dependence.
    std::unique_ptr<EquationSubset>    displacements, pressures;
    std::unique_ptr<SaddlePointMatrix> matrix;
    TrilinosWrappers::PreconditionAMG  multigrid;
    BlockTriangularPreconditioner      preconditioner;
  };

  ISOCHOR_REGISTER(LinearSolver, BlockFGMRES, "Block FGMRES")
} // namespace isochor
