/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_domain_relaxation_h
#define isochor_domain_relaxation_h

#include <isochor/material_model/material_model.h>
#include <isochor/material_points/material_points.h>
#include <isochor/material_points/place_table.h>
#include <isochor/material_points/point_domain.h>

#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * Moves corners of domains inside of a body so that each domain comes nearer
   * to the share of the material that it had at t = 0: where UnseenVolume lets
   * material pass between domains some would grow and others vanish. The
   * material stays where it is, domains go on tiling the body, and its surface
   * does not move: a domain takes what its faces pass over, at the density of
   * t = 0, so that mass is conserved.
   *
   * A pass is one of Jacobi's method, damped, for the least squares
   *   Σ_p ((V_0p + ΔV_p)/V_p - 1)²,  V_p = V_0p at t = 0,
   * over the places of the corners; a corner moves so little that none of its
   * domains loses more than a part of its volume.
   */
  template <int dim>
  class DomainRelaxation
  {
  public:
    using Materials = std::vector<std::unique_ptr<MaterialModel<dim>>>;

    /** Domains of @p points that have passed material on, and their neighbours.
     * Collective. */
    DomainRelaxation(MaterialPoints<dim>       &points,
                     const BackgroundGrid<dim> &grid,
                     const Materials           &materials);

    /** Relax them. Collective. */
    void
    relax();

  private:
    struct Domain
    {
      typename PointDomain<dim>::Corners corners;
      std::array<unsigned int, dim + 1>  vertex;
      double                             volume;   ///< of the corners
      double                             filled;   ///< V_0
      double                             at_start; ///< V_0 at t = 0
      double density; ///< V_0 over the volume where J = 1: F_θθ
      Particles::ParticleIterator<dim> particle;
    };
    /** What corners of several domains have in common; sums over these. */
    struct Vertex
    {
      Point<dim>     place; ///< before it moves
      unsigned int   body      = 0;
      bool           is_shared = false; ///< perhaps with other ranks
      bool           is_held   = false;
      Tensor<1, dim> move;
      double         weight = 0;
      /** Of the move: so that all domains keep enough of their volume. */
      double part = 1;
    };

    static double
    volume(const typename PointDomain<dim>::Corners &corners);
    /** ∂V/∂x of corner @p c. */
    static Tensor<1, dim>
    gradient(const typename PointDomain<dim>::Corners &corners,
             const unsigned int                        c);

    bool
    is_needed() const;
    void
    find_domains();
    unsigned int
    find_vertex(const Point<dim> &place, const unsigned int body);
    void
    pass();
    /** Add what other ranks have for the vertices that are shared, or take the
     * smallest parts of moves. */
    void
    exchange(const bool of_parts);
    /** Let the points know their new domains. */
    void
    store(const Domain &domain) const;

    MaterialPoints<dim>       &points;
    const BackgroundGrid<dim> &grid;
    const Materials           &materials;
    std::vector<Domain>        domains;
    std::vector<Vertex>        vertices;
    /** By body: places of vertices, and their numbers. */
    std::vector<PlaceTable<dim>>           tables;
    std::vector<std::vector<unsigned int>> numbers;
  };
} // namespace isochor

#endif
