/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/shape_functions.h>

namespace isochor
{
  /**
   * The functions of P1, in the way of those that are not linear in a cell:
   * each point gets a list of its nodes with N and ∇N at its place. The
   * shortest example of shape functions, to begin others with; as it stands it
   * gives the results of P1, but more slowly.
   */
  template <int dim>
  class LinearByPoints : public ShapeFunctions<dim>
  {
  public:
    using typename ShapeFunctions<dim>::Barycentric;
    using typename ShapeFunctions<dim>::Cells;
    using typename ShapeFunctions<dim>::Values;

    void
    set_grid(const GridSource<dim> & /*source*/,
             const SimplexGeometry<dim> &geometry) override
    {
      simplices = &geometry;
    }

    // here each cell is an element of its own. Elements of several cells ask
    // the source for the hypercubes, as source/grid/q1.cc
    ArrayView<const unsigned int>
    nodes(const unsigned int cell) const override
    {
      const auto &vertices = simplices->vertex_indices(cell);
      return ArrayView<const unsigned int>(vertices.data(), vertices.size());
    }

    Cells
    element(const unsigned int cell) const override
    {
      return {cell};
    }

    // at any place, also a bit outside of the cell
    void
    evaluate(const unsigned int cell,
             const Barycentric &lambda,
             Values            &values) const override
    {
      values.n_nodes = dim + 1;
      for (unsigned int v = 0; v <= dim; ++v)
        {
          values.vertex[v]   = simplices->vertex_indices(cell)[v];
          values.shape[v]    = lambda[v];
          values.gradient[v] = simplices->gradients(cell)[v];
        }
    }

  private:
    const SimplexGeometry<dim> *simplices = nullptr;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(ShapeFunctions,
                                 LinearByPoints,
                                 "linear by points")
} // namespace isochor
