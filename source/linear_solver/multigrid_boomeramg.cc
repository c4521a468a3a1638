/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/linear_solver/linear_solver.h>
#include <isochor/linear_solver/multigrid.h>

#include <Epetra_MpiComm.h>
#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  namespace
  {
    /** Throw if a call of hypre since the last check has failed. */
    void
    check_hypre(const char *where)
    {
      const HYPRE_Int error = HYPRE_GetError();
      HYPRE_ClearAllErrors();
      AssertThrow(error == 0,
                  ExcLinearSolverFailed(std::string("hypre: error ") +
                                        std::to_string(error) + " in " + where +
                                        "."));
    }

    void
    start_hypre()
    {
      static const bool once = [] {
        HYPRE_Init();
        HYPRE_ClearAllErrors(); // PETSc may have started it
        return true;
      }();
      (void)once;
    }

    /** A vector of hypre with this rank's rows. */
    class HypreVector
    {
    public:
      HypreVector(MPI_Comm comm, const HYPRE_BigInt first, const int n)
        : n(n)
      {
        HYPRE_IJVectorCreate(comm, first, first + n - 1, &vector);
        HYPRE_IJVectorSetObjectType(vector, HYPRE_PARCSR);
        HYPRE_IJVectorInitialize(vector);
        HYPRE_IJVectorAssemble(vector);
        void *object;
        HYPRE_IJVectorGetObject(vector, &object);
        parallel = static_cast<HYPRE_ParVector>(object);
      }
      ~HypreVector()
      {
        HYPRE_IJVectorDestroy(vector);
      }
      HypreVector(const HypreVector &) = delete;
      HypreVector &
      operator=(const HypreVector &) = delete;

      // without indices: all rows, in their order
      void
      set(const double *values)
      {
        HYPRE_IJVectorSetValues(vector, n, nullptr, values);
      }
      void
      get(double *values) const
      {
        HYPRE_IJVectorGetValues(vector, n, nullptr, values);
      }

      HYPRE_ParVector parallel;

    private:
      int            n;
      HYPRE_IJVector vector;
    };

    /** Call @p action (row, number of entries, values, columns; local numbers)
     */
    template <typename Action>
    void
    for_each_row(const Epetra_CrsMatrix &K, const Action &action)
    {
      for (int i = 0; i < K.NumMyRows(); ++i)
        {
          int     n_entries;
          double *values;
          int    *columns;
          K.ExtractMyRowView(i, n_entries, values, columns);
          action(i, n_entries, values, columns);
        }
    }

    /** The global number of this rank's first row, also if it has none: Epetra
     * doesn't know then. */
    HYPRE_BigInt
    first_row(const Epetra_CrsMatrix &K)
    {
      int n = K.NumMyRows(), end = 0;
      K.Comm().ScanSum(&n, &end, 1);
      return end - n;
    }

    /** Without values. */
    HYPRE_IJMatrix
    create_hypre_matrix(const Epetra_CrsMatrix &K, MPI_Comm comm)
    {
      const int              n     = K.NumMyRows();
      const HYPRE_BigInt     first = first_row(K);
      std::vector<HYPRE_Int> n_own(n, 0), n_others(n, 0);
      for_each_row(
        K, [&](const int i, const int n_entries, double *, int *columns) {
          for (int k = 0; k < n_entries; ++k)
            ++(K.RowMap().MyGID(K.GCID(columns[k])) ? n_own : n_others)[i];
        });
      HYPRE_IJMatrix copy;
      HYPRE_IJMatrixCreate(
        comm, first, first + n - 1, first, first + n - 1, &copy);
      HYPRE_IJMatrixSetObjectType(copy, HYPRE_PARCSR);
      HYPRE_IJMatrixSetDiagOffdSizes(copy, n_own.data(), n_others.data());
      HYPRE_IJMatrixInitialize(copy);
      return copy;
    }

    /** Copy all values; the pattern, too, the first time. */
    void
    copy_values(const Epetra_CrsMatrix &K, HYPRE_IJMatrix copy)
    {
      std::vector<HYPRE_BigInt> global;
      for_each_row(
        K, [&](const int i, HYPRE_Int n_entries, double *values, int *columns) {
          global.resize(n_entries);
          for (int k = 0; k < n_entries; ++k)
            global[k] = K.GCID(columns[k]);
          const HYPRE_BigInt row = K.GRID(i);
          HYPRE_IJMatrixSetValues(
            copy, 1, &n_entries, &row, global.data(), values);
        });
      HYPRE_IJMatrixAssemble(copy);
      check_hypre("copying the matrix");
    }
  } // namespace

  /**
   * BoomerAMG of hypre (Henson & Yang, Appl. Numer. Math. 41 (2002) 155-177)
   * for systems of equations: coarse nodes by HMIS, aggressively on the finest
   * level, extended+i interpolation of each component, Gauss-Seidel on each
   * rank. The settings are those that took the least time, see doc/solvers.md.
   */
  class BoomerAMG : public Multigrid
  {
  public:
    ~BoomerAMG() override
    {
      clear();
    }

    void
    build(const Epetra_CrsMatrix &K,
          const unsigned int      dim,
          const std::function<Epetra_MultiVector()> & /*near_null_space*/,
          const bool symmetric) override
    {
      clear();
      start_hypre();
      const MPI_Comm comm =
        dynamic_cast<const Epetra_MpiComm &>(K.Comm()).Comm();
      original = &K;
      matrix   = create_hypre_matrix(K, comm);
      copy_values(K, matrix);
      void *object;
      HYPRE_IJMatrixGetObject(matrix, &object);
      parallel_matrix = static_cast<HYPRE_ParCSRMatrix>(object);
      for (auto *vector : {&rhs, &solution})
        *vector =
          std::make_unique<HypreVector>(comm, first_row(K), K.NumMyRows());

      HYPRE_BoomerAMGCreate(&solver);
      HYPRE_BoomerAMGSetPrintLevel(solver, 0);
      HYPRE_BoomerAMGSetNumFunctions(solver, dim);
      HYPRE_BoomerAMGSetNodal(solver, 1); // Frobenius' norm of nodes' blocks
      HYPRE_BoomerAMGSetCoarsenType(solver, 10); // HMIS
      HYPRE_BoomerAMGSetAggNumLevels(solver, 1);
      HYPRE_BoomerAMGSetInterpType(solver, 6); // extended+i
      HYPRE_BoomerAMGSetPMaxElmts(solver, 4);
      HYPRE_BoomerAMGSetStrongThreshold(solver, 0.5);
      // Gauss-Seidel, or symmetric in the l1 norm; exactly on the coarsest
      // level
      HYPRE_BoomerAMGSetRelaxType(solver, symmetric ? 8 : 3);
      HYPRE_BoomerAMGSetCycleRelaxType(solver, 9, 3);
      HYPRE_BoomerAMGSetMaxIter(solver, 1);
      HYPRE_BoomerAMGSetTol(solver, 0.);
      HYPRE_BoomerAMGSetup(solver,
                           parallel_matrix,
                           rhs->parallel,
                           solution->parallel);
      check_hypre("setting up BoomerAMG");
    }

    void
    update_finest_level() override
    {
      copy_values(*original, matrix);
    }

    void
    clear() override
    {
      if (solver != nullptr)
        HYPRE_BoomerAMGDestroy(solver);
      solver = nullptr;
      if (matrix != nullptr)
        HYPRE_IJMatrixDestroy(matrix);
      matrix = nullptr;
      rhs.reset();
      solution.reset();
    }

    void
    vmult(TrilinosWrappers::MPI::Vector       &dst,
          const TrilinosWrappers::MPI::Vector &src) const override
    {
      rhs->set(src.begin());
      HYPRE_ParVectorSetConstantValues(solution->parallel, 0.);
      HYPRE_BoomerAMGSolve(solver,
                           parallel_matrix,
                           rhs->parallel,
                           solution->parallel);
      HYPRE_ClearAllErrors(); // that one cycle doesn't converge
      solution->get(dst.begin());
    }

  private:
    const Epetra_CrsMatrix      *original        = nullptr;
    HYPRE_Solver                 solver          = nullptr;
    HYPRE_IJMatrix               matrix          = nullptr;
    HYPRE_ParCSRMatrix           parallel_matrix = nullptr; ///< the same
    std::unique_ptr<HypreVector> rhs, solution;
  };

  ISOCHOR_REGISTER(Multigrid, BoomerAMG, "BoomerAMG")
} // namespace isochor
