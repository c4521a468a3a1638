/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/mpi_sums.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/diagnosis/touched_boundary.h>
#include <isochor/grid/extent.h>

#include <set>

namespace isochor
{
  namespace
  {
    /** The vertices of cells with material points, of all ranks: nodes may be
     * active by conditions only. Collective. */
    template <int dim>
    std::set<unsigned int>
    vertices_at_points(const StepContext<dim> &step)
    {
      const SimplexGeometry<dim>     &geometry = step.grid.geometry();
      const std::vector<unsigned int> cells(step.points.cell.begin(),
                                            step.points.cell.begin() +
                                              step.points.cell.size());
      std::set<unsigned int>          vertices;
      for (const unsigned int cell :
           union_over_ranks(cells, step.grid.communicator()))
        for (const unsigned int v : geometry.vertex_indices(cell))
          vertices.insert(v);
      return vertices;
    }

    /** Whether material points are in cells at the boundary @p id. Collective.
     */
    template <int dim>
    bool
    has_points_at(const StepContext<dim> &step, const types::boundary_id id)
    {
      const auto with_points = vertices_at_points(step);
      for (const BoundaryFace &face : step.grid.boundary_faces())
        for (unsigned int v = 0; v <= dim && face.id == id; ++v)
          if (v != face.opposite_vertex &&
              with_points.count(
                step.grid.geometry().vertex_indices(face.cell)[v]) > 0)
            return true;
      return false;
    }
  } // namespace



  /** Boundaries of the grid that are named, but which the body isn't at. */
  template <int dim>
  class UntouchedBoundary : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim>       &scene,
                const StepContext<dim> &step,
                const SparseSystem & /*matrix*/) override
    {
      for (const auto &condition : scene.boundary_conditions)
        for (const auto &boundary : condition->named_boundaries())
          look(step, boundary);
      for (const auto &postprocessor : scene.postprocessors)
        for (const auto &boundary : postprocessor->named_boundaries())
          look(step, boundary);
    }

  private:
    void
    look(const StepContext<dim> &step, const NamedBoundary &named) const
    {
      const SimplexGeometry<dim> &geometry   = step.grid.geometry();
      const bool                  everywhere = named.name == "everywhere";
      const types::boundary_id    id =
        everywhere ? 0 : step.grid.boundary_id(named.name, named.parameter);
      if (named.has_own_nodes ? has_points_at(step, id) :
                                is_touched(step, id, everywhere))
        return;
      Extent<dim> boundary, body;
      for (const BoundaryFace &face : step.grid.boundary_faces())
        if (everywhere || face.id == id)
          for (unsigned int v = 0; v <= dim; ++v)
            if (v != face.opposite_vertex)
              boundary.include(
                geometry.vertices()[geometry.vertex_indices(face.cell)[v]]);
      const MPI_Comm comm = step.grid.communicator();
      for (unsigned int k = 0; k < step.points.cell.size(); ++k)
        for (const unsigned int vertex :
             geometry.vertex_indices(step.points.cell[k]))
          body.include(geometry.vertices()[vertex]);
      body.merge(comm);
      this->warn("no effect at the start: the body's cells lie in " +
                   body.text() + ", the boundary in " + boundary.text() +
                   ". If the body reaches it later, use <Walls = " +
                   named.name + ": n >= 0>; else check its place.",
                 named.name + "> of <" + named.parameter);
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    UntouchedBoundary,
    "no material at <boundary> of <parameter>",
    ISOCHOR_ESSENTIAL,
    "an entry of `Displacement`, `Walls`, `Periodic sides` or `Reactions` "
    "names a boundary that the material does not touch at the start: it has"
    " no effect then. What holds nodes stops a body that comes to it up to "
    "a cell early and doesn't let it go",
    "nothing, if the body reaches the wall later (`Walls = name: n >= 0`); "
    "else correct the name, the grid or the place of the body")
} // namespace isochor
