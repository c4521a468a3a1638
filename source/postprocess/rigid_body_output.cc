/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/rigid_body_term.h>
#include <isochor/postprocess/field_output.h>
#include <isochor/postprocess/postprocessor.h>

namespace isochor
{
  /**
   * The surfaces of rigid bodies as files for ParaView, at the output times:
   * lines in 2D, triangles in 3D, with how far they have moved since t = 0.
   */
  template <int dim>
  class RigidBodyOutput : public Postprocessor<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm)
    {
      prm.declare_entry("Write rigid bodies",
                        "true",
                        Patterns::Bool(),
                        "Whether the surfaces of rigid bodies, if there are "
                        "any, are written at the output times, as "
                        "rigid_bodies.pvd and what it lists; in a section "
                        "'Postprocess: name' as rigid_bodies-name.pvd. What "
                        "has no end, as a half plane, is drawn as far as the "
                        "grid reaches.");
    }

    void
    parse_parameters(ParameterHandler &prm) override
    {
      enabled = prm.get_bool("Write rigid bodies");
      series  = OutputSeries("rigid_bodies", this->instance);
    }

    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics & /*statistics*/) override
    {
      if (!enabled || !result.time.output_due())
        return;
      const RigidBodyTerm<dim> *term = nullptr;
      for (const auto &condition : result.conditions)
        if (const auto *const found =
              dynamic_cast<const RigidBodyTerm<dim> *>(condition.get()))
          term = found;
      if (term == nullptr || !series.takes_next(result.time.finished()))
        return;
      const MPI_Comm             comm = result.step.grid.communicator();
      FieldPatches<dim - 1, dim> patches;
      patches.add_scalar("rigid_body");
      patches.add_vector("displacement");
      // the same on all ranks
      if (Utilities::MPI::this_mpi_process(comm) == 0)
        add_surfaces(*term, result.step.grid, patches);
      series.write(patches, result.time.time, result.output_directory, comm);
    }

    std::string
    save_state() const override
    {
      return series.save_state();
    }

    void
    load_state(const std::string &state) override
    {
      series.load_state(state);
    }

  private:
    /** As they are at the end of the step that is over. */
    static void
    add_surfaces(const RigidBodyTerm<dim>   &term,
                 const BackgroundGrid<dim>  &grid,
                 FieldPatches<dim - 1, dim> &patches)
    {
      const BoundingBox<dim> box(grid.geometry().vertices());
      const double           reach = box.get_boundary_points().first.distance(
        box.get_boundary_points().second);
      double number = 0;
      for (const auto &one : term.all_bodies())
        {
          const RigidPose<dim> &pose = one->body.old_pose();
          for (const auto &facet : one->body.surface(pose, reach))
            {
              auto &patch = patches.add_patch({facet.data(), facet.size()});
              for (unsigned int v = 0; v < dim; ++v)
                {
                  const Tensor<1, dim> moved =
                    facet[v] - pose.original(facet[v]);
                  patch.data(0, v) = number;
                  for (unsigned int d = 0; d < dim; ++d)
                    patch.data(1 + d, v) = moved[d];
                }
            }
          ++number;
        }
    }

    bool         enabled = true;
    OutputSeries series{"rigid_bodies"};
  };

  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor,
                                 RigidBodyOutput,
                                 "Write rigid bodies")
} // namespace isochor
