/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_surface_h
#define isochor_body_surface_h

#include <isochor/equations/equation_term.h>
#include <isochor/equations/nodal_unknowns.h>
#include <isochor/equations/surface_stress.h>

#include <array>
#include <vector>

namespace isochor
{
  /**
   * Where the bodies end: the outer faces of the CPDI subdomains of this rank's
   * points (PointArrays::outer_faces), with Gauss points on them. A place of a
   * face belongs to the subdomain and sees its functions, so that what acts on
   * the surface is integrated like stresses: the faces move with the body,
   * whatever the grid's cells, and nothing but the numbers of a stencil changes
   * when the grid is reset.
   */
  template <int dim>
  class BodySurface
  {
  public:
    /** Gauss points of a face: exact for polynomials of degree 3 (2D), 2 (3D).
     */
    static constexpr unsigned int n_gauss = dim == 2 ? 2 : 3;

    /** An outer face of a subdomain. */
    struct Face
    {
      unsigned int          k, q;     ///< cell of the list and point
      types::particle_index id;       ///< number of the point
      unsigned int          opposite; ///< the corner that the face doesn't have
      bool meets_other_body; ///< whether one is behind the face at t = 0
      Tensor<1, dim> normal; ///< outward, before F
      /** Before F (m^(dim-1), of the plane in axisymmetry); and the ratio of
       * lengths there to those at t = 0 (DomainCorners::stretch). */
      double area, stretch;
      /** Areas of all outer faces of the subdomain over its volume (1/m): the
       * constant of the trace inequality for functions linear on it. */
      double area_per_volume;
      /** Before F, from the point of the subdomain (m). */
      std::array<Tensor<1, dim>, dim> corners;
      Point<dim>                      reference; ///< of the point, at t = 0
    };

    /** Corner @p i of a face at t = 0, from the point of the subdomain. */
    static Tensor<1, dim>
    corner_at_start(const Face &face, const unsigned int i)
    {
      return face.corners[i] / face.stretch;
    }

    /** A Gauss point. */
    struct Place
    {
      Point<dim>     X;            ///< at t = 0
      Point<dim>     x;            ///< at the start of the step
      Tensor<1, dim> displacement; ///< x - X, not as that difference (m)
      Tensor<1, dim> r;            ///< from the subdomain's point, at t_n (m)
      double         weight;       ///< of the face's area

      /** Go to another place of the body, @p way from it, that takes part
       * instead of this one. */
      void
      shift(const Tensor<1, dim> &way)
      {
        x += way;
        displacement += way;
        r += way;
      }
    };

    /** Find the faces of @p points, as they are at the start of a step. */
    void
    find(const PointArrays<dim> &points);

    const std::vector<Face> &
    faces() const
    {
      return all_faces;
    }

    /** Gauss point @p g of @p face at the start of the step. */
    static Place
    place(const SimplexGeometry<dim> &geometry,
          const PointArrays<dim>     &points,
          const Face                 &face,
          const unsigned int          g);
    static Place
    place(const StepContext<dim> &step, const Face &face, const unsigned int g)
    {
      return place(step.grid.geometry(), step.points, face, g);
    }

    /** Its barycentric coordinates on the face. */
    static std::array<double, dim>
    coordinates(const unsigned int g);

    /** The centre of a face at t = 0. */
    static Point<dim>
    centre(const Face &face);

    /** A number for @p face that no other one has, on no rank. */
    static std::uint64_t
    key(const Face &face)
    {
      return static_cast<std::uint64_t>(face.id) * (dim + 1) + face.opposite;
    }

  private:
    std::vector<Face> all_faces;
  };

  /**
   * γ of a subdomain (Pa/m): |N·A·N| times @p area_per_volume, the constant of
   * the trace inequality. In u-p A are the deviatoric moduli, and contact that
   * begins with a pressure p loses the energy p²/(2γ) in dynamics
   * (InteractionKernel::add()). There the bulk modulus is added as far as the
   * @p step resolves it, min(K, ρ (2 d/Δt)²) with d = 1/area_per_volume:
   * ω Δt = 2 for what vibrates in the subdomain.
   */
  template <int dim>
  double
  surface_stiffness(const StepContext<dim>   &step,
                    const SurfaceStress<dim> &stress,
                    const MaterialModel<dim> &material,
                    const double              area_per_volume);
} // namespace isochor

#endif
