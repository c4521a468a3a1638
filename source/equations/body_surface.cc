/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/body_surface.h>
#include <isochor/material_points/outer_faces.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  namespace
  {
    /** The area vector of the face of a simplex opposite to corner @p c,
     * outward. */
    template <int dim>
    Tensor<1, dim>
    area_vector(const CornerVectors<dim> &corners, const unsigned int c)
    {
      AssertIndexRange(c, dim + 1);
      std::array<Tensor<1, dim>, dim> face;
      for (unsigned int other = 0, i = 0; other <= dim; ++other)
        if (other != c)
          face[i++] = corners[other];
      Tensor<1, dim> area;
      if constexpr (dim == 2)
        area = cross_product_2d(face[1] - face[0]);
      else
        area = cross_product_3d(face[1] - face[0], face[2] - face[0]) / 2;
      return area * (face[0] - corners[c]) > 0 ? area : -area;
    }
  } // namespace



  template <int dim>
  void
  BodySurface<dim>::find(const PointArrays<dim> &points)
  {
    all_faces.clear();
    if (points.domain_corners.outer_faces.empty())
      return;
    for (unsigned int k = 0; k < points.cell.size(); ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          if (points.domain_corners.outer_faces[q] == 0)
            continue;
          const CornerVectors<dim> &corners = points.domain[q];
          const std::size_t         first   = all_faces.size();
          double                    area = 0, volume = 0;
          for (unsigned int c = 0; c <= dim; ++c)
            {
              const Tensor<1, dim> A = area_vector<dim>(corners, c);
              // the height is (dim + 1) times the distance of the centroid
              const unsigned int other = (c == 0 ? 1 : 0);
              volume = (corners[other] - corners[c]) * A / dim;
              if (((points.domain_corners.outer_faces[q] >> c) & 1) == 0)
                continue;
              Face face;
              face.k        = k;
              face.q        = q;
              face.id       = points.domain_corners.id[q];
              face.opposite = c;
              face.meets_other_body =
                (points.domain_corners.outer_faces[q] >> c &
                 meets_other_body) != 0;
              face.area      = A.norm();
              face.stretch   = points.domain_corners.stretch[q];
              face.normal    = A / face.area;
              face.reference = points.reference[q];
              for (unsigned int o = 0, i = 0; o <= dim; ++o)
                if (o != c)
                  face.corners[i++] = corners[o];
              area += face.area;
              all_faces.push_back(face);
            }
          for (std::size_t f = first; f < all_faces.size(); ++f)
            all_faces[f].area_per_volume = area / volume;
        }
  }



  template <int dim>
  std::array<double, dim>
  BodySurface<dim>::coordinates(const unsigned int g)
  {
    if constexpr (dim == 2)
      {
        const double half = 0.5 / std::sqrt(3.);
        const double x    = (g == 0 ? 0.5 - half : 0.5 + half);
        return {{1 - x, x}};
      }
    else
      {
        std::array<double, dim> lambda;
        lambda.fill(1. / 6);
        lambda[g] = 2. / 3;
        return lambda;
      }
  }



  template <int dim>
  typename BodySurface<dim>::Place
  BodySurface<dim>::place(const SimplexGeometry<dim> &geometry,
                          const PointArrays<dim>     &points,
                          const Face                 &face,
                          const unsigned int          g)
  {
    AssertIndexRange(face.k, points.cell.size());
    AssertIndexRange(face.q, points.n_points());
    const auto     lambda = coordinates(g);
    Tensor<1, dim> before_F, R; // from the subdomain's point; R at t = 0
    for (unsigned int i = 0; i < dim; ++i)
      before_F += lambda[i] * face.corners[i];
    R = before_F / face.stretch;
    Place                 place;
    const Point<dim>      x = points.location(geometry, face.k, face.q);
    const Tensor<1, dim> &u = points.displacement[face.q];
    place.r                 = points.F[face.q] * before_F;
    place.X                 = face.reference + R;
    place.x                 = x + place.r;
    place.displacement      = u + place.r - R;
    place.weight            = 1. / n_gauss;
    return place;
  }



  template <int dim>
  Point<dim>
  BodySurface<dim>::centre(const Face &face)
  {
    Point<dim> X = face.reference;
    for (unsigned int i = 0; i < dim; ++i)
      X += corner_at_start(face, i) / static_cast<double>(dim);
    return X;
  }



  template <int dim>
  double
  surface_stiffness(const StepContext<dim>   &step,
                    const SurfaceStress<dim> &stress,
                    const MaterialModel<dim> &material,
                    const double              area_per_volume)
  {
    Assert(area_per_volume > 0, ExcInternalError());
    double modulus = stress.normal_modulus;
    if (stress.mixed && step.has_inertia && step.step_size() > 0)
      {
        const double speed    = 2 / (area_per_volume * step.step_size()),
                     resolved = material.density() * speed * speed;
        modulus +=
          resolved / std::max(1., resolved * material.inverse_bulk_modulus());
      }
    return modulus * area_per_volume;
  }



  template double
  surface_stiffness(const StepContext<2> &,
                    const SurfaceStress<2> &,
                    const MaterialModel<2> &,
                    const double);
  template double
  surface_stiffness(const StepContext<3> &,
                    const SurfaceStress<3> &,
                    const MaterialModel<3> &,
                    const double);
  template class BodySurface<2>;
  template class BodySurface<3>;
} // namespace isochor
