/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_lattice_source_h
#define isochor_lattice_source_h

#include <isochor/grid/grid_source.h>

#include <vector>

namespace isochor
{
  /**
   * Grids that are the image of a lattice of boxes in the unit square or cube,
   * each box split into simplices. A class derived from this one says by
   * place() where points go, and declares and parses the parameters of this one
   * along with its own. Boundaries are called left, right, bottom, top, front
   * and back, after the sides of the unit square or cube.
   */
  template <int dim>
  class LatticeSource : public GridSource<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm) override;

    MeshGroups
    make_mesh(Triangulation<dim> &tria) const override;

    std::vector<Hypercube<dim>>
    hypercubes() const override;

    bool
    has_coarse_cells() const override
    {
      return true;
    }
    CoarseGrid<dim>
    coarse_cells(MeshGroups &groups) const override;

    std::set<std::string>
    parameters_of_simplices() const override
    {
      return {"Diagonals", "Offset"};
    }

    /** Where the point @p unit of the unit square or cube is (m). It has to be
     * continuous and one-to-one; mirrored images are allowed. */
    virtual Point<dim>
    place(const Point<dim> &unit) const = 0;

  private:
    std::vector<unsigned int> subdivisions;
    std::vector<double>       offset;
    std::string               diagonals;
  };

  /** The point whose coordinates are listed in @p text. Throws, naming
   * @p parameter, if there are not dim of them. */
  template <int dim>
  Point<dim>
  parse_point(const std::string &text, const std::string &parameter);
} // namespace isochor

#endif
