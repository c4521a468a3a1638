/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/adaptation/cell_size_criterion.h>

#include <algorithm>

namespace isochor
{
  /** Small cells where the body ends inside of the grid, wherever that is. */
  template <int dim>
  class SizeAtSurface : public CellSizeCriterion<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Cell size at surface of body",
                        "0",
                        Patterns::Double(0),
                        "The largest size of cells (m) with material that "
                        "share a vertex with an empty cell. 0: any.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      size = prm.get_double("Cell size at surface of body");
    }

    bool
    needs_state() const override
    {
      return size > 0;
    }

    bool
    writes_statistics() const override
    {
      return false;
    }

    void
    limit_sizes(const BodyState<dim> &state,
                const LevelRule<dim> & /*rule*/,
                std::vector<double> &sizes,
                Statistics & /*statistics*/) const override
    {
      AssertDimension(sizes.size(), state.size());
      const SimplexGeometry<dim> &geometry = state.grid.geometry();
      std::vector<unsigned int>   occupied(geometry.n_cells(), 0);
      for (const unsigned int cell : state.cell)
        occupied[cell] = 1;
      Utilities::MPI::max(occupied, state.grid.communicator(), occupied);
      std::vector<unsigned char> at_empty(geometry.vertices().size(), 0);
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        if (occupied[cell] == 0)
          for (const unsigned int v : geometry.vertex_indices(cell))
            at_empty[v] = 1;
      for (unsigned int q = 0; q < state.size(); ++q)
        {
          const auto &vertices = geometry.vertex_indices(state.cell[q]);
          if (std::any_of(vertices.begin(),
                          vertices.end(),
                          [&](const unsigned int v) { return at_empty[v]; }))
            sizes[q] = std::min(sizes[q], size);
        }
    }

  private:
    double size = 0;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(CellSizeCriterion,
                                 SizeAtSurface,
                                 "Cell size at surface of body")
} // namespace isochor
