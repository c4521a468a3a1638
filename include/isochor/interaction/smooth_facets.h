/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_smooth_facets_h
#define isochor_smooth_facets_h

#include <deal.II/base/point.h>
#include <deal.II/base/symmetric_tensor.h>

#include <array>
#include <memory>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /**
   * A surface of segments (2D) or triangles (3D) with a normal at each corner,
   * which need not be closed, and the signed distance from it. At the nearest
   * place p = Σ_v λ_v X_v of the nearest facet, the surface has the normal n =
   * Σ λ_v n_v, and with d(y) = Σ_v λ_v n_v·(y - X_v) the distance of x is d(x)
   * - d(p)/2: with normals that are exact at the corners, this is exact for a
   * surface that is a quadratic function over the facet. Sharp edges divide the
   * surface into parts.
   */
  template <int dim>
  class SmoothFacets
  {
  public:
    /** What becomes of the surface at an edge of a facet (in 2D, an end). */
    enum class Rim
    {
      none,    ///< it goes on smoothly
      concave, ///< beyond, it would be behind what bounds the space it faces
      free     ///< it ends there
    };

    struct Facet
    {
      std::array<Point<dim>, dim>     corners;
      std::array<Tensor<1, dim>, dim> normals; ///< at the corners
      Tensor<1, dim>                  normal;  ///< of the plane facet
      std::array<Rim, dim>            rims;    ///< opposite of the corners
      unsigned int                    part;    ///< parts are numbered from 0
    };

    struct Place
    {
      double                  distance; ///< positive where normals point to (m)
      Tensor<1, dim>          normal;
      SymmetricTensor<2, dim> curvature; ///< ∂n/∂x (1/m)
      unsigned int            facet = 0;
      /** Of the nearest place on it: barycentric coordinates. */
      std::array<double, dim> weights{};
    };

    explicit SmoothFacets(std::vector<Facet> &&facets);
    ~SmoothFacets();

    /**
     * The place of the surface that a body's surface at @p x with the outward
     * normal @p nu can touch: of parts that nu points to the one with the least
     * distance, negative ones included; of all if nu points to none. Beyond a
     * concave rim the surface goes on along its tangent; beyond a free one
     * there is nothing, and the distance is that from the rim.
     */
    Place
    nearest(const Point<dim> &x, const Tensor<1, dim> &nu) const;

    /** Whether all parts are planes that go on at their rims. */
    bool
    is_flat() const;

    const std::vector<Facet> &
    facets() const
    {
      return all_facets;
    }

  private:
    struct Part;

    Place
    evaluate(const unsigned int             facet,
             const std::array<double, dim> &weights,
             const Point<dim>              &x) const;
    Place
    nearest_of(const Part &part, const Point<dim> &x) const;

    std::vector<Facet> all_facets;
    std::vector<Part>  parts;
  };
} // namespace isochor

#endif
