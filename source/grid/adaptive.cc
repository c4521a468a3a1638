/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/grid_source.h>

namespace isochor
{
  /**
   * A forest over the coarse cells of another source, see AdaptiveGrid; the
   * section "Adaptive grid" (GridAdaptation) says how it is refined.
   */
  template <int dim>
  class AdaptiveSource : public GridSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Coarse cells",
                        "box",
                        Patterns::Selection(
                          GridSource<dim>::names_with_coarse_cells()),
                        "What an adaptive grid is refined from: the "
                        "'Subdivisions' of a box or a trapezoid, or the "
                        "quadrilaterals (2D) or hexahedra (3D) of a gmsh "
                        "file.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      coarse = GridSource<dim>::create(prm.get("Coarse cells"), prm);
    }

    std::set<std::string>
    parameters_in_use() const override
    {
      std::set<std::string> names = coarse->parameters_in_use();
      for (const std::string &name : coarse->parameters_of_simplices())
        names.erase(name);
      names.insert("Coarse cells");
      return names;
    }

    bool
    is_adaptive() const override
    {
      return true;
    }

    CoarseGrid<dim>
    coarse_cells(MeshGroups &groups) const override
    {
      return coarse->coarse_cells(groups);
    }

  private:
    std::unique_ptr<GridSource<dim>> coarse;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, AdaptiveSource, "adaptive")
} // namespace isochor
