/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/cell_size_criterion.h>
#include <isochor/adaptation/stress_recovery.h>
#include <isochor/base/mpi_sums.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  /**
   * The error of the stresses, see recovered_error(), relative to their norm.
   * Errors of a leaf decrease with its size h as h^(1 + dim/2) if the solution
   * is smooth. Sizes are such that all leaves get the same error, and the sum
   * of the squares the target, or the number of leaves (Li & Bettess, Commun.
   * Numer. Meth. Eng. 11 (1995) 857-863).
   */
  template <int dim>
  class ErrorIndicator : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Target of relative error",
                        "0",
                        Patterns::Double(0, 1),
                        "Cells become so small that the estimated error of the "
                        "stresses in the energy norm, relative to the norm of "
                        "the stresses, is this. 0: no target.");
      prm.declare_entry("Target number of leaves",
                        "0",
                        Patterns::Integer(0),
                        "So many leaves (squares or cubes of cells) with "
                        "material are placed where the estimated error is "
                        "largest. 0: no target. With a <Target of relative "
                        "error>: about so many at most.");
      prm.declare_entry("Estimate error",
                        "false",
                        Patterns::Bool(),
                        "Whether the estimated relative error of the stresses "
                        "is a column of the statistics without a target, too.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      target_error  = prm.get_double("Target of relative error");
      target_number = prm.get_integer("Target number of leaves");
      estimates     = prm.get_bool("Estimate error");
    }

    bool
    needs_state() const override
    {
      return target_error > 0 || target_number > 0 || estimates;
    }

    unsigned int
    largest_number_of_leaves() const override
    {
      return target_number;
    }

    void
    limit_sizes(const BodyState<dim> &state,
                const LevelRule<dim> &rule,
                std::vector<double>  &sizes,
                Statistics           &statistics) const override;

  private:
    /** How the size of leaf @p i is to change, times the constant that is to
     * be found. */
    static double
    size_ratio(const double squared_error)
    {
      return std::pow(squared_error, -1. / (2 + dim));
    }
    /** The constant that brings the error to its target. */
    double
    constant_of_error(const std::vector<double> &squares,
                      const double               norm_square) const;
    /** The smallest constant that needs no more leaves than the target. */
    double
    constant_of_number(const BodyState<dim>      &state,
                       const LevelRule<dim>      &rule,
                       const std::vector<double> &squares) const;
    /** The size to ask for in @p leaf, so that it gets the level nearest to
     * what is needed. */
    static double
    size(const AdaptiveGrid<dim> &forest,
         const Leaf<dim>         &leaf,
         const double             squared_error,
         const double             constant);

    double       target_error  = 0;
    unsigned int target_number = 0;
    bool         estimates     = false;
  };



  template <int dim>
  double
  ErrorIndicator<dim>::size(const AdaptiveGrid<dim> &forest,
                            const Leaf<dim>         &leaf,
                            const double             squared_error,
                            const double             constant)
  {
    Assert(squared_error >= 0, ExcInternalError());
    // at most two levels finer, one coarser than the leaf is
    const double ratio =
      squared_error > 0 ?
        std::min(2., std::max(0.25, constant * size_ratio(squared_error))) :
        2.;
    return forest.size(leaf.tree, leaf.level) * ratio * numbers::SQRT2;
  }



  template <int dim>
  double
  ErrorIndicator<dim>::constant_of_error(const std::vector<double> &squares,
                                         const double norm_square) const
  {
    // Σ η² r² is the square of the error to come
    double sum = 0;
    for (const double square : squares)
      if (square > 0)
        sum += square * std::pow(size_ratio(square), 2);
    return std::sqrt(target_error * target_error * norm_square / sum);
  }



  template <int dim>
  double
  ErrorIndicator<dim>::constant_of_number(
    const BodyState<dim>      &state,
    const LevelRule<dim>      &rule,
    const std::vector<double> &squares) const
  {
    AssertDimension(squares.size(), state.grid.adaptive_grid().leaves().size());
    const AdaptiveGrid<dim>      &forest = state.grid.adaptive_grid();
    const std::vector<Leaf<dim>> &leaves = forest.leaves();
    // the number of leaves falls with the constant: between two that enclose it
    const auto number = [&](const double constant) {
      double sum = 0;
      for (unsigned int i = 0; i < leaves.size(); ++i)
        if (squares[i] > 0)
          sum +=
            std::pow(2.,
                     dim * (static_cast<double>(rule.level(
                              forest,
                              leaves[i],
                              size(forest, leaves[i], squares[i], constant))) -
                            leaves[i].level));
      return sum;
    };
    double lower = 1e-30, upper = 1e30;
    for (unsigned int i = 0; i < 120; ++i)
      {
        const double middle = std::sqrt(lower * upper);
        (number(middle) > target_number ? lower : upper) = middle;
      }
    return upper;
  }



  template <int dim>
  void
  ErrorIndicator<dim>::limit_sizes(const BodyState<dim> &state,
                                   const LevelRule<dim> &rule,
                                   std::vector<double>  &sizes,
                                   Statistics           &statistics) const
  {
    AssertDimension(sizes.size(), state.size());
    const AdaptiveGrid<dim>      &forest = state.grid.adaptive_grid();
    const std::vector<Leaf<dim>> &leaves = forest.leaves();
    const StressError             error  = recovered_error(state);
    std::vector<double>           squares(leaves.size(), 0.);
    for (unsigned int q = 0; q < state.size(); ++q)
      squares[forest.leaf_of_cell(state.cell[q])] += error.squares[q];
    const MPI_Comm comm        = state.grid.communicator();
    const double   norm_square = Utilities::MPI::sum(error.norm_square, comm);
    Utilities::MPI::sum(squares, comm, squares);
    double error_square = 0;
    for (const double square : squares)
      error_square += square;
    statistics.set("Estimated relative error of stresses",
                   norm_square > 0 ? std::sqrt(error_square / norm_square) :
                                     0.);
    if (!(error_square > 0) || (target_error == 0 && target_number == 0))
      return;
    // sums depend on the number of ranks by rounding; what decides must not
    for (double &square : squares)
      square = static_cast<float>(square);
    double constant =
      target_error > 0 ? constant_of_error(squares, norm_square) : 0.;
    if (target_number > 0)
      constant = std::max(constant, constant_of_number(state, rule, squares));
    constant *= 1 + 1e-7;
    for (unsigned int q = 0; q < state.size(); ++q)
      {
        const unsigned int i = forest.leaf_of_cell(state.cell[q]);
        sizes[q] =
          std::min(sizes[q], size(forest, leaves[i], squares[i], constant));
      }
  }

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion,
                                 ErrorIndicator,
                                 "Error indicator")
} // namespace isochor
