/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/shape_functions.h>

namespace isochor
{
  /** Linear in each cell: the functions are its barycentric coordinates. */
  template <int dim>
  class P1 : public ShapeFunctions<dim>
  {
  public:
    using typename ShapeFunctions<dim>::Barycentric;
    using typename ShapeFunctions<dim>::Cells;
    using typename ShapeFunctions<dim>::Values;

    bool
    are_linear() const override
    {
      return true;
    }

    void
    set_grid(const GridSource<dim> & /*source*/,
             const SimplexGeometry<dim> &geometry) override
    {
      simplices = &geometry;
    }

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

  ISOCHOR_REGISTER_FOR_DIMENSION(ShapeFunctions, P1, "P1")
} // namespace isochor
