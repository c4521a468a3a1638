/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_arrays_h
#define isochor_point_arrays_h

#include <deal.II/base/numbers.h>
#include <deal.II/base/tensor.h>
#include <deal.II/particles/particle.h>

#include <isochor/base/thickness.h>
#include <isochor/grid/simplex_geometry.h>
#include <isochor/material_points/point_field.h>
#include <isochor/material_points/seeding.h>

#include <algorithm>
#include <array>
#include <map>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Σ V/G and Σ ρ V/G of the points in a cell, V the reference volume that
   * each integrates: what the stabilisation needs (MixedKernel). */
  struct CellCompliance
  {
    double volume = 0, mass = 0;

    /** @p V_over_G: of points with @p density. */
    void
    add(const double V_over_G, const double density)
    {
      volume += V_over_G;
      mass += density * V_over_G;
    }
    void
    add(const CellCompliance &other)
    {
      volume += other.volume;
      mass += other.mass;
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &volume &mass;
    }
  };

  /** A cell of the stabilisation where points have stencils: one that their
   * domains overlap, or whose element holds some; with the part of the points
   * in it and its vertices at the start of the step. */
  template <int dim>
  struct OverlappedCell
  {
    unsigned int                    cell;
    CellCompliance                  compliance;
    std::array<Point<dim>, dim + 1> corners;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &cell &compliance &corners;
    }
  };

  /** Of points that have domains: what the corners of these act on, and which
   * faces are on the surface of the body. */
  struct DomainCorners
  {
    /** Bit c stands for the face opposite to corner c; and the numbers of the
     * points. If the layout has them. */
    std::vector<unsigned char>         outer_faces;
    std::vector<types::particle_index> id;

    /** The size of a domain over that at t = 0, in each direction. */
    std::vector<double> stretch;

    /** Pairs (point, cell) for the corners, at least dim + 1 a point: the cells
     * whose nodes corners touch. */
    std::vector<std::pair<unsigned int, unsigned int>> cells;

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &outer_faces &id &cells &stretch;
    }
  };

  /**
   * The material points of this rank in typed arrays, ordered by cell: what
   * the hot loops of one step work on. Cell k of the list `cell` holds the
   * points cell_start[k] <= q < cell_start[k+1].
   */
  template <int dim>
  struct PointArrays
  {
    std::vector<unsigned int> cell;       ///< occupied cells, ascending
    std::vector<unsigned int> cell_start; ///< size cell.size() + 1

    std::vector<std::array<double, dim + 1>> shape;  ///< N_I at the point
    PointField<double>                       volume; ///< V_0
    PointField<double>                       mass;
    std::vector<double>                      weight; ///< volume of integration
    PointField<double>                       pressure;
    PointField<Tensor<2, dim>>               F;
    std::vector<unsigned char>               material; ///< its index
    /** In axisymmetry, the distance from the axis (m) at the start of the step;
     * else empty. */
    std::vector<double> radius;
    std::vector<double> history; ///< n_history values a point
    /** |dev σ| (Pa) at the start of the step, of laws that dissipate, else 0;
     * empty if there are none, and in form u. See
     * MixedKernel::unseen_stiffness(). */
    std::vector<double>         shear_stress;
    std::vector<Tensor<1, dim>> velocity, acceleration; ///< in dynamics
    /** What F maps to the domains, relative to the points, if the layout has
     * them. */
    std::vector<CornerVectors<dim>> domain;
    /** Where the points were at t = 0, and their displacements at the start of
     * the step. Only if they have domains. If functions are linear on these
     * (BodyQuadrature::is_linear_on_domains()), N_I at x in the domain of point
     * p is N_pI + ∇N_pI·(x - x_p). */
    std::vector<Point<dim>>     reference;
    std::vector<Tensor<1, dim>> displacement;

    /**
     * If points reach beyond their cell, or the shape functions are not linear
     * in it: their nodes in compressed-row form, by vertex, with N_I and its
     * gradient. Empty otherwise.
     */
    std::vector<std::size_t>    stencil_start;
    std::vector<unsigned int>   stencil_vertex;
    std::vector<double>         stencil_shape;
    std::vector<Tensor<1, dim>> stencil_gradient;
    DomainCorners               domain_corners;
    /** Cells of the stabilisation; all of their nodes are active. */
    std::vector<OverlappedCell<dim>> overlapped_cells;

    /** A cell as the motion of the body since the last reset of the grid has
     * deformed it: its vertices and the gradients of its N_I. */
    struct DeformedCell
    {
      std::array<Point<dim>, dim + 1>     corners;
      std::array<Tensor<1, dim>, dim + 1> gradients;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &corners &gradients;
      }
    };
    /** By cell of the list; empty as long as they are undeformed. See
     * GridReset. */
    std::vector<DeformedCell> deformed_cell;

    unsigned int n_history = 0;

    /** Vertex @p v of cell k of the list at the start of the step. */
    const Point<dim> &
    corner(const SimplexGeometry<dim> &geometry,
           const unsigned int          k,
           const unsigned int          v) const
    {
      return deformed_cell.empty() ?
               geometry.vertices()[geometry.vertex_indices(cell[k])[v]] :
               deformed_cell[k].corners[v];
    }

    /** All of them. */
    std::array<Point<dim>, dim + 1>
    corners(const SimplexGeometry<dim> &geometry, const unsigned int k) const
    {
      if (!deformed_cell.empty())
        return deformed_cell[k].corners;
      std::array<Point<dim>, dim + 1> result;
      for (unsigned int v = 0; v <= dim; ++v)
        result[v] = corner(geometry, k, v);
      return result;
    }

    /** Where point @p q of cell k of the list is at the start of the step: with
     * a domain, as the means over this have moved it, not as its cell has. */
    Point<dim>
    location(const SimplexGeometry<dim> &geometry,
             const unsigned int          k,
             const unsigned int          q) const
    {
      if (!reference.empty())
        return reference[q] + displacement[q];
      Point<dim> x;
      for (unsigned int v = 0; v <= dim; ++v)
        x += shape[q][v] * corner(geometry, k, v);
      return x;
    }

    /** ∇_n N_I in cell k of the list: with respect to the grid at the start of
     * the step. */
    const std::array<Tensor<1, dim>, dim + 1> &
    gradients(const SimplexGeometry<dim> &geometry, const unsigned int k) const
    {
      return deformed_cell.empty() ? geometry.gradients(cell[k]) :
                                     deformed_cell[k].gradients;
    }

    /** Barycentric coordinates of @p x with respect to cell k of the list at
     * the start of the step. */
    typename SimplexGeometry<dim>::Barycentric
    barycentric(const SimplexGeometry<dim> &geometry,
                const unsigned int          k,
                const Point<dim>           &x) const
    {
      if (deformed_cell.empty())
        return geometry.barycentric(cell[k], x);
      typename SimplexGeometry<dim>::Barycentric lambda;
      const Tensor<1, dim> distance = x - deformed_cell[k].corners[0];
      lambda[0]                     = 1.;
      for (unsigned int i = 1; i <= dim; ++i)
        {
          lambda[i] = deformed_cell[k].gradients[i] * distance;
          lambda[0] -= lambda[i];
        }
      return lambda;
    }

    /** Give deformed_cell its entries, if it has none: undeformed cells. */
    void
    deform_cells(const SimplexGeometry<dim> &geometry)
    {
      if (!deformed_cell.empty())
        return;
      std::vector<DeformedCell> cells(cell.size());
      for (unsigned int k = 0; k < cell.size(); ++k)
        {
          for (unsigned int v = 0; v <= dim; ++v)
            cells[k].corners[v] = corner(geometry, k, v);
          cells[k].gradients = gradients(geometry, k);
        }
      deformed_cell.swap(cells);
    }

    /** Where the occupied cell @p c stands in the list. */
    unsigned int
    position(const unsigned int c) const
    {
      return std::lower_bound(cell.begin(), cell.end(), c) - cell.begin();
    }

    /** From now on points have stencils, but none yet. */
    void
    clear_stencils()
    {
      stencil_start.assign(1, 0);
      stencil_vertex.clear();
      stencil_shape.clear();
      stencil_gradient.clear();
      domain_corners.cells.clear();
      overlapped_cells.clear();
    }

    /** Let overlapped_cells be those of @p compliance, by cell. */
    void
    set_overlapped_cells(
      const SimplexGeometry<dim>                   &geometry,
      const std::map<unsigned int, CellCompliance> &compliance);

    /** Whether points have stencils of their own. */
    bool
    has_stencils() const
    {
      return !stencil_start.empty();
    }

    /**
     * What integrals over the plane are multiplied by at point @p q: 1 or, in
     * axisymmetry, 2πR, R = r / F_θθ its distance from the axis at t = 0 (m).
     * Volumes and weights, cells and domains are those of the plane.
     */
    double
    thickness(const unsigned int q) const
    {
      return radius.empty() ?
               1. :
               isochor::thickness(
                 true,
                 radius[q] / history[q * static_cast<std::size_t>(n_history)]);
    }

    /** The volume that point @p q integrates, at t = 0 (m^dim; in axisymmetry
     * m^3, of the ring). */
    double
    measure(const unsigned int q) const
    {
      return weight[q] * thickness(q);
    }

    /** The nodes of the longest stencil. */
    unsigned int
    most_nodes() const;

    /** The nodes of a point. */
    struct Stencil
    {
      unsigned int          n_nodes;
      const unsigned int   *vertex;
      const double         *shape;
      const Tensor<1, dim> *gradient;
    };

    /** The nodes of point @p q in cell k of the list. */
    Stencil
    stencil(const SimplexGeometry<dim> &geometry,
            const unsigned int          k,
            const unsigned int          q) const
    {
      if (!has_stencils())
        return {dim + 1,
                geometry.vertex_indices(cell[k]).data(),
                shape[q].data(),
                gradients(geometry, k).data()};
      const std::size_t begin = stencil_start[q];
      return {static_cast<unsigned int>(stencil_start[q + 1] - begin),
              stencil_vertex.data() + begin,
              stencil_shape.data() + begin,
              stencil_gradient.data() + begin};
    }

    unsigned int
    n_points() const
    {
      return weight.size();
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &cell &cell_start &shape &weight &material &history &velocity
        &acceleration &domain &stencil_start &stencil_vertex &stencil_shape
          &stencil_gradient &domain_corners &overlapped_cells &deformed_cell
            &n_history &radius &reference &displacement &shear_stress;
    }
  };
} // namespace isochor

#endif
