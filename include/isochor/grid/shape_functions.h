/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_shape_functions_h
#define isochor_shape_functions_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/parameter_handler.h>

#include <isochor/grid/grid_source.h>
#include <isochor/grid/simplex_geometry.h>

#include <boost/container/small_vector.hpp>

#include <array>
#include <memory>

namespace isochor
{
  using namespace dealii;

  /**
   * Interface of the shape functions: what displacements and pressures are
   * between the nodes. Whatever they are, the grid consists of simplices, in
   * which points are located and the body's place is told, and the nodes are
   * its vertices; an *element* is a cell, or several cells together, in which
   * the functions are smooth. To add one, write `source/grid/<name>.cc` with
   * the class and its registration; its parameters live in the subsection
   * "Grid", where `Shape functions` names it.
   *
   * Functions of one element must add up to one and reproduce linear fields,
   * Σ N_I x_I = x; their value at a vertex must be the unknown of its node, and
   * on an edge of the grid's boundary they must depend on the nodes of this
   * edge only.
   */
  template <int dim>
  class ShapeFunctions
  {
  public:
    /** The most nodes that may act at a place. */
    static constexpr unsigned int max_nodes = 1u << dim;

    using Barycentric = typename SimplexGeometry<dim>::Barycentric;

    /** Node by node at a place: its vertex, N_I and ∇N_I (1/m). */
    struct Values
    {
      unsigned int                          n_nodes = 0;
      std::array<unsigned int, max_nodes>   vertex;
      std::array<double, max_nodes>         shape;
      std::array<Tensor<1, dim>, max_nodes> gradient;
    };

    using Cells = boost::container::small_vector<unsigned int, 6>;

    virtual ~ShapeFunctions() = default;

    /** Declare `Shape functions` and the parameters of all of them, in the
     * subsection "Grid". */
    static void
    declare_functions(ParameterHandler &prm);
    /** Those that @p prm, which is in the subsection "Grid", names. */
    static std::unique_ptr<ShapeFunctions<dim>>
    create(ParameterHandler &prm);

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Whether they are the barycentric coordinates of the cells. Points then
     * need no lists of nodes of their own, and elements are summed over their
     * points before they meet the gradients. */
    virtual bool
    are_linear() const
    {
      return false;
    }

    /** The grid has been made by @p source, or replaced. @p geometry stays the
     * same object; its vertices may move later on. Throws if the grid doesn't
     * have what the functions need. */
    virtual void
    set_grid(const GridSource<dim>      &source,
             const SimplexGeometry<dim> &geometry) = 0;

    /** The vertices of the element that @p cell belongs to. */
    virtual ArrayView<const unsigned int>
    nodes(const unsigned int cell) const = 0;

    /** The cells of this element, @p cell among them. */
    virtual Cells
    element(const unsigned int cell) const = 0;

    /**
     * The functions at the place with the barycentric coordinates @p lambda of
     * @p cell, for all nodes() in their order or for the vertices of the cell
     * only. Places outside of the cell have coordinates below zero; there, and
     * in particular outside of the grid, linear functions are good enough.
     */
    virtual void
    evaluate(const unsigned int cell,
             const Barycentric &lambda,
             Values            &values) const = 0;
  };
} // namespace isochor

#endif
