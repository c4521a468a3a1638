/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/grid/adaptive_grid.h>
#include <isochor/grid/grid_source.h>
#include <isochor/grid/near_numbers.h>

namespace isochor
{
  /** A mesh from a file of gmsh. */
  template <int dim>
  class GmshGrid : public GridSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("File", "", Patterns::FileName(), "A gmsh .msh file.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      file = prm.get("File");
    }

    MeshGroups
    make_mesh(Triangulation<dim> &tria) const override
    {
      Triangulation<dim> mesh;
      const MeshGroups   groups = read_mesh<dim>(file, "Grid/File", mesh);
      copy_with_near_numbers(mesh, tria);
      return groups;
    }

    bool
    has_coarse_cells() const override
    {
      return true;
    }

    CoarseGrid<dim>
    coarse_cells(MeshGroups &groups) const override
    {
      Triangulation<dim> mesh;
      groups = read_mesh<dim>(file, "Grid/File", mesh, MeshCells::hypercubes);
      return coarse_grid(mesh);
    }

  private:
    std::string file;
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(GridSource, GmshGrid, "gmsh")
} // namespace isochor
