/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_grid_source_h
#define isochor_grid_source_h

#include <deal.II/base/parameter_handler.h>
#include <deal.II/grid/tria.h>

#include <isochor/grid/coarse_grid.h>
#include <isochor/grid/mesh_reader.h>

#include <array>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Cells that together are a quadrilateral (two triangles) or a hexahedron
   * (six tetrahedra). */
  template <int dim>
  struct Hypercube
  {
    /** Numbered in binary: bit d says at which end of axis d the vertex is. */
    std::array<unsigned int, (1u << dim)>      vertices;
    std::array<unsigned int, dim == 2 ? 2 : 6> cells;
  };

  /**
   * Interface of the ways to make a background grid. To add one, write
   * `source/grid/<name>.cc` with the class and its registration; its parameters
   * live in the subsection "Grid", where `Type` names it, and may be shared
   * with others of the same name and meaning. What others have to know of a way
   * to make a grid they ask by the functions below, not by its name.
   *
   * LatticeSource does all of the work for grids that are the image of a box:
   * those only say where a point of the unit square or cube goes.
   */
  template <int dim>
  class GridSource
  {
  public:
    virtual ~GridSource() = default;

    /** Declare `Type` and the parameters of all sources, in the subsection
     * "Grid". */
    static void
    declare_sources(ParameterHandler &prm);
    /** The source that is called @p name, its parameters read from @p prm,
     * which is in the subsection "Grid". */
    static std::unique_ptr<GridSource<dim>>
    create(const std::string &name, ParameterHandler &prm);
    /** "first|second|...": those that can say has_coarse_cells(). */
    static std::string
    names_with_coarse_cells();

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** The parameters of "Grid" that matter. By default those that the class
     * has declared. */
    virtual std::set<std::string>
    parameters_in_use() const
    {
      return declared;
    }

    /** Whether the grid is a forest over coarse_cells(), which can be replaced
     * by another one (BackgroundGrid::change()). Then there is no
     * make_mesh(). */
    virtual bool
    is_adaptive() const
    {
      return false;
    }

    /**
     * Fill the empty @p tria with triangles or tetrahedra of one level, give
     * their faces on the boundary their ids, and return the names of boundaries
     * and groups of cells. The same on all ranks: each makes the whole mesh.
     */
    virtual MeshGroups
    make_mesh(Triangulation<dim> &tria) const;

    /** What the cells of make_mesh() are parts of, each of one, by the numbers
     * of cells and vertices that make_mesh() gave; empty if they aren't. */
    virtual std::vector<Hypercube<dim>>
    hypercubes() const
    {
      return {};
    }

    /** Whether coarse_cells() can be called: whether an adaptive grid can be
     * refined from this one. */
    virtual bool
    has_coarse_cells() const
    {
      return false;
    }
    /** The quadrilaterals or hexahedra of which a forest consists at first, and
     * in @p groups the names of their boundaries and groups. */
    virtual CoarseGrid<dim>
    coarse_cells(MeshGroups &groups) const;
    /** Of parameters_in_use(): those that coarse_cells() doesn't need. */
    virtual std::set<std::string>
    parameters_of_simplices() const
    {
      return {};
    }

  private:
    std::set<std::string> declared;
  };
} // namespace isochor

#endif
