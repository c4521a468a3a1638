/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_face_copies_h
#define isochor_face_copies_h

#include <deal.II/numerics/rtree.h>

#include <isochor/equations/body_surface.h>
#include <isochor/equations/surface_stress.h>
#include <isochor/interaction/face_loads.h>
#include <isochor/interaction/surface_memory.h>

#include <utility>
#include <vector>

namespace isochor
{
  /** A face of a body's surface with all that its subdomain's stress needs, as
   * any rank may have it. */
  template <int dim>
  struct FaceCopy
  {
    unsigned int              body, material;
    std::uint64_t             key;
    Tensor<2, dim>            F; ///< of the subdomain, at the start of the step
    std::vector<double>       history;
    double                    radius = 0;
    double                    pressure; ///< of its point (Pa)
    std::vector<unsigned int> loads;    ///< FaceLoads::on_face()
    double                    stretch;  ///< of BodySurface::Face
    std::vector<unsigned int> vertex;
    std::vector<double>       shape; ///< at its point
    std::vector<Tensor<1, dim>> gradient;
    Tensor<1, dim>              normal;     ///< outward, at t = 0
    Tensor<1, dim>              normal_now; ///< at the start of the step
    double                      area, area_per_volume;
    std::array<Point<dim>, dim> X; ///< corners at t = 0
    std::array<Point<dim>, dim> x; ///< at the start of the step
    std::array<Tensor<1, dim>, dim>
      r; ///< from the subdomain's point, at t_n (m)
    /** SurfaceStress::Flow::kept of the last step. */
    double kept       = 1;
    double gamma      = 0; ///< as InteractionKernel wants it, one half (Pa/m)
    double area_ratio = 1; ///< of the area at t_n to that at t = 0
    /** B_J,b of SurfaceStress at the start of the step; empty in statics. */
    std::vector<Tensor<1, dim>> adjoint;

    /** At t = 0. */
    Point<dim>
    centre() const
    {
      Point<dim> centre;
      for (const Point<dim> &corner : X)
        centre += corner / static_cast<double>(dim);
      return centre;
    }

    /** The shape functions of all nodes at @p r from the subdomain's point. */
    double
    shape_at(const unsigned int I, const Tensor<1, dim> &r) const
    {
      return shape[I] + gradient[I] * r;
    }

    /** For SurfaceStress. */
    typename SurfaceStress<dim>::Domain
    domain(const MixedKernel<dim> &kernel) const
    {
      return {kernel.materials[material].get(),
              F,
              history.data(),
              radius,
              {static_cast<unsigned int>(vertex.size()),
               vertex.data(),
               shape.data(),
               gradient.data()},
              kept};
    }

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &body &material &key &F &history &radius &pressure &vertex &shape
        &gradient &normal &normal_now &area &area_per_volume &X &x &r &kept
          &loads &stretch;
    }
  };

  /** Of all ranks' faces, first those of rank 0, without what start_step()
   * sets. @p loads: null if there are none. Collective. */
  template <int dim>
  std::vector<FaceCopy<dim>>
  copy_faces(const BackgroundGrid<dim> &grid,
             const PointArrays<dim>    &points,
             const BodySurface<dim>    &surface,
             const SurfaceMemory<dim>  &memory,
             const FaceLoads<dim>      *loads);

  /** Set gamma, area_ratio and, in dynamics, the adjoint of a copy. */
  template <int dim>
  void
  start_step(const StepContext<dim> &step, FaceCopy<dim> &copy);
} // namespace isochor

#endif
