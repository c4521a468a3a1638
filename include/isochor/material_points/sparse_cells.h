/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_sparse_cells_h
#define isochor_sparse_cells_h

#include <deal.II/base/mpi.h>

#include <isochor/grid/simplex_geometry.h>
#include <isochor/material_points/point_domain.h>

#include <functional>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Cells inside of the body that hold too few points although domains of
   * points cover them, and the domains whose bisection brings more points
   * there. A cell without points counts as inside if a domain covers its
   * centre, one with some points if domains cover the middle of the way from
   * the centre to each vertex, too. Domains are looked for in cells that are a
   * few faces away.
   */
  template <int dim>
  class SparseCells
  {
  public:
    using Domains = std::vector<const PointDomain<dim> *>;

    /** Cells should have @p least points; 0: any number. @p geometry is of the
     * whole grid, on each rank. */
    SparseCells(const SimplexGeometry<dim> &geometry,
                const unsigned int          least,
                const MPI_Comm              comm);

    /** By domain: whether it should be bisected. @p domains are those of the
     * points of this rank, in any order. Collective. */
    std::vector<unsigned char>
    find_domains(const Domains &domains);

  private:
    /** A domain less than this part of the share of a point of its cell is
     * left alone: what it lies in is torn, not sparse. */
    static constexpr double       smallest_share = 0.1;
    static constexpr unsigned int n_places       = dim + 2;

    /** Count points, and collect cells that hold or are near to own ones. */
    void
    collect_cells(const Domains &domains);
    /** Call @p visit with the cells a few faces from @p cell, itself
     * among them, until it returns true. */
    void
    visit_cells_around(const unsigned int                             cell,
                       const std::function<bool(const unsigned int)> &visit);
    /** The own domain that covers @p x, in or near @p cell; domains.size() if
     * none does. */
    unsigned int
    find_domain(const Domains     &domains,
                const unsigned int cell,
                const Point<dim>  &x);
    bool
    is_worth_it(const PointDomain<dim> &domain, const unsigned int cell) const;
    /** Flag a domain for each cell without points. */
    void
    fill_empty_cells(const Domains &domains, std::vector<unsigned char> &flags);
    /** Flag the largest domains of cells with too few points. */
    void
    fill_sparse_cells(const Domains              &domains,
                      std::vector<unsigned char> &flags);

    const SimplexGeometry<dim> &geometry;
    const unsigned int          least;
    const MPI_Comm              comm;
    /** By cell: points of all ranks; where its own begin in the next. */
    std::vector<unsigned int> n_points, first;
    std::vector<unsigned int> domains_by_cell;
    std::vector<unsigned int> cells_nearby;
    /** For visit_cells_around(): by cell, the last visit. */
    std::vector<unsigned int> visited, queue;
    unsigned int              n_visits = 0;
  };
} // namespace isochor

#endif
