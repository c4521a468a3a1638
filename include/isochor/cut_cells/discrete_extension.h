/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_discrete_extension_h
#define isochor_discrete_extension_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/base/statistics.h>
#include <isochor/cut_cells/dependent_nodes.h>
#include <isochor/equations/equation_term.h>

#include <cstdint>
#include <map>
#include <vector>

namespace isochor
{
  /**
   * Ties nodes that hardly any material touches to the cells of the body next
   * to them, so that the condition number is bounded however small a cut is. A
   * node whose NodalSupport φ_I is below
   * the parameter `Smallest support` is unsupported; so is one with less than
   * this part of its stiffness of its own (see DependentNodes). Its unknowns,
   * displacement and pressure, are the linear continuation of those of a cell R
   * all of whose nodes are supported,
   *
   *   u_I = Σ_J λ_J u_J,   λ_J the barycentric coordinates of x_I in R,
   *
   * and what acts on node I acts on the nodes of R. The unknowns are eliminated
   * (see NodalTies): there is no stiffness, no coefficient, and no work done by
   * a tie. This is aggregation: Badia, Verdugo & Martín, Comput. Methods Appl.
   * Mech. Eng. 336 (2018) 533-553; as a discrete extension: Burman, Hansbo &
   * Larson, "On the design of locking free ghost penalty stabilization and the
   * relation to CutFEM with discrete extension", 2022.
   *
   * R is looked for layer by layer through the cells that hold material,
   * beginning with those around I, so that it belongs to the same body. Of the
   * first layer with such a cell the one with the smallest Σ λ_J² is taken, and
   * the mean of several if they are equal: the result does not depend on how
   * the grid is numbered. A node without such a cell (the body is thinner there
   * than some tenth of a cell) stays free.
   *
   * Components that a boundary condition prescribes are not tied. On a grid
   * that is kept (see GridReset) ties stay those of the reset: since an affine
   * map leaves barycentric coordinates as they are, the node remains on the
   * continuation of R.
   */
  template <int dim>
  class DiscreteExtension
  {
  public:
    /** x_I as an affine combination of other vertices. */
    struct Tie
    {
      unsigned int              vertex;
      std::vector<unsigned int> masters; ///< vertices, ascending
      std::vector<double>       weights; ///< λ_J, which add up to one
      std::vector<unsigned int> cells;   ///< R, or those R is the mean of

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &vertex &masters &weights &cells;
      }
    };

    DiscreteExtension(const BackgroundGrid<dim> &grid,
                      const CellOccupancy<dim>  &occupancy);

    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm);

    /** Whether nodes are tied; @p quadrature_asks for it, see
     * BodyQuadrature::ties_cut_cells(). */
    bool
    is_active(const bool quadrature_asks) const;

    /** These vertices are not to be tied: they follow others anyway, or others
     * that have support follow them. */
    void
    exempt(const std::vector<unsigned int> &vertices);

    /**
     * Find the ties of the unsupported ones among the @p vertices touched by
     * this rank, and add the vertices they are tied to. @p points are those of
     * the step with their weights, occupancy is up to date. Collective.
     */
    void
    update(const PointArrays<dim> &points, std::vector<unsigned int> &vertices);

    /** The ties of all vertices that this rank touches, its own and others',
     * by ascending vertex. A master is never tied itself. */
    const std::vector<Tie> &
    ties() const
    {
      return found;
    }

    /** A hash of the set of active nodes that are not tied, the same for any
     * number of ranks. Collective. */
    std::uint64_t
    hash_free_nodes(const ActiveNodes<dim> &nodes) const;

    /** Tie the nodes of the step. */
    void
    constrain(const StepContext<dim> &step,
              NodalConstraints       &constraints) const;

    /**
     * The step has converged: set the columns of the statistics, and find what
     * ties carry. @p energy is this rank's Σ_p |V_p τ:Δε| of the step and,
     * in dynamics, the kinetic energy of its points (J). What ties carry is
     * measured by the work of the forces that they hand on from unsupported
     * nodes, as these move against the mean of their masters by the strain of
     * R, Σ_I |f_I · Δε_R (x_I - x_mean)|. Collective.
     */
    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const MixedSystem<dim> &system,
             const double            energy,
             Statistics             &statistics);

    /** What evaluate() has found: the part of the work that ties carry. */
    double
    share_of_work() const
    {
      return share;
    }
    /** How many nodes of all ranks could not be tied, then. */
    double
    n_free_nodes() const
    {
      return n_free_of_all;
    }

    /** The ties found last. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &found &n_free;
    }

  private:
    bool
    is_supported(const unsigned int vertex) const;
    bool
    may_be_tied(const unsigned int vertex) const
    {
      return !is_supported(vertex) && exempted.count(vertex) == 0;
    }
    /** The tie of the unsupported @p vertex; without masters if there is no
     * cell to tie it to. */
    Tie
    find_tie(const unsigned int vertex) const;
    /** Mean of the affine combinations by @p cells. */
    Tie
    make_tie(const unsigned int               vertex,
             const std::vector<unsigned int> &cells) const;
    void
    add_ties_of_others(
      const std::map<unsigned int, std::vector<unsigned int>> &questions,
      std::map<unsigned int, Tie>                             &ties);
    /** The work that is nothing but rounding where the body moves by the
     * increments @p unknowns without strain, at most. Collective. */
    double
    work_of_rounding(const StepContext<dim> &step,
                     const NodalField       &unknowns) const;
    double
    work(const StepContext<dim> &step,
         const NodalField       &unknowns,
         const Tie              &tie,
         const Tensor<1, dim>   &force) const;

    /** Layers of cells around a node in which R is looked for. All ranks know
     * that much around their cells, see CellOccupancy. */
    static constexpr unsigned int n_layers = (dim == 2 ? 4 : 3);

    enum class Use
    {
      automatic,
      always,
      never
    } use                   = Use::automatic;
    double smallest_support = 0.01;

    const BackgroundGrid<dim> &grid;
    const CellOccupancy<dim>  &occupancy;

    NodalSupport<dim>                support;
    DependentNodes<dim>              dependent;
    std::vector<Tie>                 found;
    std::unordered_set<unsigned int> exempted;
    /** Unsupported nodes of this rank that could not be tied. */
    unsigned int n_free = 0;
    double       share = 0, n_free_of_all = 0;
  };
} // namespace isochor

#endif
