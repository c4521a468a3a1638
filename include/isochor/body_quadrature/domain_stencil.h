/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_stencil_h
#define isochor_domain_stencil_h

#include <isochor/grid/shape_functions.h>
#include <isochor/material_points/point_arrays.h>
#include <isochor/material_points/point_locator.h>

#include <array>
#include <utility>
#include <vector>

namespace isochor
{
  /** The nodes that the corner of a domain acts on, with their shape functions.
   */
  template <int dim>
  class CornerNodes
  {
  public:
    std::vector<std::pair<unsigned int, double>> nodes;

    /** At @p place, or at @p x the functions of @p other, unless that is
     * SimplexGeometry::no_cell, continued to there. */
    void
    evaluate(const ShapeFunctions<dim>  &functions,
             const SimplexGeometry<dim> &geometry,
             const LocateResult<dim>    &place,
             const unsigned int          other,
             const Point<dim>           &x);

    /** Whether it acts on nodes that none of the elements of @p cells has,
     * however little. */
    bool
    touches_others(const ShapeFunctions<dim>       &functions,
                   const std::vector<unsigned int> &cells) const;

  private:
    typename ShapeFunctions<dim>::Values at;
  };



  /** The nodes of one domain, and sums over its corners: the functions that its
   * point sees, see CPDI. */
  template <int dim>
  class DomainStencil
  {
  public:
    using Corners = std::array<CornerNodes<dim>, dim + 1>;

    /** N and N ∇λ of the nodes of @p corners, which lie at @p places from each
     * other (m). */
    void
    set(const Corners &corners, const CornerVectors<dim> &places);

    /** The functions after set() are those in the middle of the corners: make
     * them those at @p r from there (m). */
    void
    move(const Tensor<1, dim> &r);

    void
    append_to(PointArrays<dim> &points) const;

  private:
    /** The number here of the node @p vertex. */
    unsigned int
    entry(const unsigned int vertex);

    unsigned int                n_nodes = 0;
    std::vector<unsigned int>   vertices;
    std::vector<double>         shape;
    std::vector<Tensor<1, dim>> gradients;
  };



  /** Of the volume of a domain with corners at @p whole, what is left if they
   * are at @p inside; 1 but for rounding is 1. */
  template <int dim>
  double
  part_of_domain(const CornerVectors<dim> &inside,
                 const CornerVectors<dim> &whole);
} // namespace isochor

#endif
