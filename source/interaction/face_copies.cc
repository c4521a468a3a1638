/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/interaction/face_copies.h>

namespace isochor
{
  namespace
  {
    template <int dim>
    Tensor<1, dim>
    area_vector(const std::array<Point<dim>, dim> &corners)
    {
      if constexpr (dim == 2)
        return cross_product_2d(corners[1] - corners[0]);
      else
        return cross_product_3d(corners[1] - corners[0],
                                corners[2] - corners[0]);
    }

    template <int dim>
    FaceCopy<dim>
    copy_face(const BackgroundGrid<dim>             &grid,
              const PointArrays<dim>                &points,
              const typename BodySurface<dim>::Face &face)
    {
      const auto stencil  = points.stencil(grid.geometry(), face.k, face.q);
      const Point<dim> at = points.location(grid.geometry(), face.k, face.q);
      FaceCopy<dim>    copy;
      copy.body     = grid.layer_of_cell(points.cell[face.k]);
      copy.material = points.material[face.q];
      copy.key      = BodySurface<dim>::key(face);
      copy.F        = points.F[face.q];
      const double *const history =
        points.history.data() + face.q * std::size_t(points.n_history);
      copy.history.assign(history, history + points.n_history);
      if (!points.radius.empty())
        copy.radius = points.radius[face.q];
      copy.pressure = points.pressure[face.q];
      copy.stretch  = face.stretch;
      copy.vertex.assign(stencil.vertex, stencil.vertex + stencil.n_nodes);
      copy.shape.assign(stencil.shape, stencil.shape + stencil.n_nodes);
      copy.gradient.assign(stencil.gradient,
                           stencil.gradient + stencil.n_nodes);
      copy.normal          = face.normal;
      copy.area            = face.area;
      copy.area_per_volume = face.area_per_volume;
      for (unsigned int i = 0; i < dim; ++i)
        {
          copy.X[i] =
            face.reference + BodySurface<dim>::corner_at_start(face, i);
          copy.r[i] = copy.F * face.corners[i];
          copy.x[i] = at + copy.r[i];
        }
      // outward in this order
      if (area_vector<dim>(copy.X) * copy.normal < 0)
        {
          std::swap(copy.X[0], copy.X[1]);
          std::swap(copy.x[0], copy.x[1]);
          std::swap(copy.r[0], copy.r[1]);
        }
      copy.normal_now = area_vector<dim>(copy.x);
      copy.normal_now /= copy.normal_now.norm();
      return copy;
    }
  } // namespace



  template <int dim>
  std::vector<FaceCopy<dim>>
  copy_faces(const BackgroundGrid<dim> &grid,
             const PointArrays<dim>    &points,
             const BodySurface<dim>    &surface,
             const SurfaceMemory<dim>  &memory,
             const FaceLoads<dim>      *loads)
  {
    std::vector<FaceCopy<dim>> own;
    for (const auto &face : surface.faces())
      {
        own.push_back(copy_face(grid, points, face));
        own.back().kept = memory.kept(own.back().key);
        if (loads != nullptr && !face.meets_other_body)
          own.back().loads =
            loads->on_face(own.back().body, own.back().centre());
      }
    if (Utilities::MPI::n_mpi_processes(grid.communicator()) == 1)
      return own;
    std::vector<FaceCopy<dim>> all;
    for (auto &of_rank : Utilities::MPI::all_gather(grid.communicator(), own))
      all.insert(all.end(),
                 std::make_move_iterator(of_rank.begin()),
                 std::make_move_iterator(of_rank.end()));
    return all;
  }



  template <int dim>
  void
  start_step(const StepContext<dim> &step, FaceCopy<dim> &copy)
  {
    SurfaceStress<dim> stress;
    const auto         domain = copy.domain(step.kernel);
    const auto         status = stress.evaluate(
      step.kernel,
      domain,
      copy.normal,
      [](const unsigned int) { return Tensor<1, dim>(); },
      [&](const unsigned int) { return copy.pressure; },
      true);
    AssertThrow(status == EvaluationStatus::success,
                ExcMessage("The stress of a point can't be evaluated as it was "
                           "at the end of the last step."));
    copy.gamma =
      surface_stiffness(step, stress, *domain.material, copy.area_per_volume);
    copy.area_ratio = stress.area.norm();
    copy.adjoint.clear();
    for (unsigned int J = 0; J < copy.vertex.size() && step.has_inertia; ++J)
      for (unsigned int b = 0; b < dim; ++b)
        copy.adjoint.push_back(stress.elastic_traction_by_displacement(J, b));
  }



  template std::vector<FaceCopy<2>>
  copy_faces(const BackgroundGrid<2> &,
             const PointArrays<2> &,
             const BodySurface<2> &,
             const SurfaceMemory<2> &,
             const FaceLoads<2> *);
  template void
  start_step(const StepContext<2> &, FaceCopy<2> &);
  template std::vector<FaceCopy<3>>
  copy_faces(const BackgroundGrid<3> &,
             const PointArrays<3> &,
             const BodySurface<3> &,
             const SurfaceMemory<3> &,
             const FaceLoads<3> *);
  template void
  start_step(const StepContext<3> &, FaceCopy<3> &);
} // namespace isochor
