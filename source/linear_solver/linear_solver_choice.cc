/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/linear_solver/linear_solver_choice.h>

namespace isochor
{
  namespace
  {
    const std::string direct_name = "MUMPS", iterative_default = "Block FGMRES";

    /** Where the iterative solver begins to be faster for a step, measured: see
     * doc/solvers.md. */
    unsigned int
    crossover(const unsigned int dim)
    {
      return dim == 2 ? 2000000 : 8000;
    }
  } // namespace



  void
  LinearSolverChoice::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Solver",
      "auto",
      Patterns::Selection("auto|" + PluginRegistry<LinearSolver>::names()),
      "MUMPS: direct, LDL^T where the matrix is symmetric. Block FGMRES: "
      "iterative; takes less memory and, in large 3D scenes, much less time. "
      "auto: MUMPS up to <Largest direct system>, else Block FGMRES. Where an "
      "iterative solver fails MUMPS takes over.");
    prm.declare_entry("Largest direct system",
                      "0",
                      Patterns::Integer(0),
                      "The number of equations up to which <auto> takes the "
                      "direct solver. 0: where measurements say, " +
                        std::to_string(crossover(2)) + " in 2D and " +
                        std::to_string(crossover(3)) + " in 3D.");
    PluginRegistry<LinearSolver>::declare_parameters(prm);
  }



  std::vector<std::string>
  LinearSolverChoice::candidates(const std::string &solver)
  {
    if (solver == "auto")
      return {direct_name, iterative_default};
    if (PluginRegistry<LinearSolver>::create(solver)->is_iterative())
      return {direct_name, solver};
    return {solver};
  }



  void
  LinearSolverChoice::parse_parameters(ParameterHandler &prm)
  {
    const std::string name  = prm.get("Solver");
    automatic               = (name == "auto");
    largest_direct_system   = prm.get_integer("Largest direct system");
    const auto solver_names = candidates(name);
    direct = PluginRegistry<LinearSolver>::create(solver_names[0]);
    direct->parse_parameters(prm);
    if (solver_names.size() > 1)
      {
        iterative = PluginRegistry<LinearSolver>::create(solver_names[1]);
        iterative->parse_parameters(prm);
      }
    in_use = direct.get();
  }



  bool
  LinearSolverChoice::is_iterative() const
  {
    return in_use->is_iterative();
  }



  void
  LinearSolverChoice::set_accuracy(const SolutionAccuracy &accuracy)
  {
    if (iterative)
      iterative->set_accuracy(accuracy);
  }



  LinearSolver &
  LinearSolverChoice::choose(const SparseSystem &A) const
  {
    Assert(A.dim == 2 || A.dim == 3, ExcInternalError());
    const unsigned int largest =
      largest_direct_system > 0 ? largest_direct_system : crossover(A.dim);
    const bool directly = !iterative || failed_pattern == A.pattern_id ||
                          (automatic && A.n_equations <= largest);
    return directly ? *direct : *iterative;
  }



  LinearSolverReport
  LinearSolverChoice::factorise(const SparseSystem &A)
  {
    matrix       = &A;
    freed_matrix = nullptr;
    in_use       = &choose(A);
    try
      {
        return in_use->factorise(A);
      }
    catch (const ExcLinearSolverFailed &exc)
      {
        if (in_use == direct.get())
          throw;
        return fall_back(plain_message(exc));
      }
  }



  LinearSolverReport
  LinearSolverChoice::factorise_and_free(SparseSystem &A)
  {
    in_use = &choose(A);
    if (in_use == direct.get())
      return factorise(A);
    matrix = freed_matrix = &A;
    try
      {
        return iterative->factorise_and_free(A);
      }
    catch (const ExcLinearSolverFailed &exc)
      {
        return fall_back(plain_message(exc));
      }
  }



  LinearSolverReport
  LinearSolverChoice::solve(const TrilinosWrappers::MPI::Vector &b,
                            TrilinosWrappers::MPI::Vector       &x)
  {
    Assert(in_use != nullptr, ExcMessage("factorise() comes first."));
    try
      {
        return in_use->solve(b, x);
      }
    catch (const ExcLinearSolverFailed &exc)
      {
        if (in_use == direct.get())
          throw;
        fall_back(plain_message(exc));
      }
    return in_use->solve(b, x);
  }



  LinearSolverReport
  LinearSolverChoice::fall_back(const std::string &failure)
  {
    Assert(matrix != nullptr || freed_matrix != nullptr, ExcInternalError());
    if (freed_matrix && freed_matrix->values.empty())
      iterative->restore_values(*freed_matrix);
    const SparseSystem &A = *matrix;
    in_use                = direct.get();
    failed_pattern        = A.pattern_id;
    last_failure          = failure;
    return direct->factorise(A);
  }

} // namespace isochor
