/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_quadrature_h
#define isochor_body_quadrature_h

#include <deal.II/base/parameter_handler.h>

#include <isochor/cut_cells/cell_occupancy.h>
#include <isochor/material_points/point_locator.h>

#include <map>

namespace isochor
{
  /**
   * Interface of the quadratures of the body: how integrals over it are
   * computed from its points. When points cross cells, the plain sum over
   * points is wrong by O(1) in each cell, whatever the grid's size, and
   * stresses don't converge; the others are remedies, each described in its
   * file. To add one, write `source/body_quadrature/<name>.cc` with the class
   * and its registration; its parameters live in the subsection "Quadrature",
   * where `Type` names it. What others have to know of a quadrature they ask by
   * the functions below, not by its name.
   */
  template <int dim>
  class BodyQuadrature
  {
  public:
    virtual ~BodyQuadrature() = default;

    /** Declare `Type` and the parameters of all quadratures. */
    static void
    declare_quadratures(ParameterHandler &prm);
    /** The quadrature that the parameters name, its own being read. */
    static std::unique_ptr<BodyQuadrature<dim>>
    create(ParameterHandler &prm);

    /** For those without parameters. */
    static void
    declare_parameters(ParameterHandler & /*prm*/)
    {}
    virtual void
    parse_parameters(ParameterHandler & /*prm*/)
    {}

    /** Whether each point must carry a simplex domain, and sees functions that
     * are linear on it, by the stencils that start_step() gives the point. Then
     * loads on the body's surface are integrated like stresses (FaceLoads). If
     * not, points get stencils of the grid's shape functions where needed. */
    virtual bool
    is_linear_on_domains() const
    {
      return false;
    }

    /** Whether start_step() needs to know the cells' occupancy. */
    virtual bool
    needs_occupancy() const
    {
      return true;
    }

    /** Whether cut cells are integrated well enough for ties to help, see
     * DiscreteExtension. */
    virtual bool
    ties_cut_cells() const
    {
      return true;
    }

    /** Whether internal forces jump when a point changes its cell. */
    virtual bool
    forces_jump() const
    {
      return true;
    }

    /**
     * Call start_step(), and let all points have stencils if the grid's shape
     * functions need them. Collective.
     */
    void
    set_up(PointArrays<dim>        &points,
           const PointLocator<dim> &locator,
           const MixedKernel<dim>  &kernel,
           const bool               with_occupancy,
           CellOccupancy<dim>      &occupancy) const;

    /**
     * Prepare weights and stencils of @p points, as gathered, for the coming
     * step. Updates @p occupancy if @p with_occupancy.
     * Collective.
     */
    virtual void
    start_step(PointArrays<dim>        &points,
               const PointLocator<dim> &locator,
               const MixedKernel<dim>  &kernel,
               const bool               with_occupancy,
               CellOccupancy<dim>      &occupancy) const = 0;
  };

  /** Call @p add(cell, part) for the cells of the element that @p cell is a
   * part of, with their parts of its volume: what the stabilisation acts on
   * because of points in @p cell. All of them, since a node of an element may
   * have no cell with points. */
  template <int dim, typename Add>
  void
  for_parts_of_element(const BackgroundGrid<dim> &grid,
                       const unsigned int         cell,
                       const Add                 &add)
  {
    if (grid.shape_functions().are_linear())
      {
        add(cell, 1.);
        return;
      }
    const auto element = grid.shape_functions().element(cell);
    double     measure = 0;
    for (const unsigned int part : element)
      measure += grid.geometry().measure(part);
    for (const unsigned int part : element)
      add(part, grid.geometry().measure(part) / measure);
  }
} // namespace isochor

#endif
