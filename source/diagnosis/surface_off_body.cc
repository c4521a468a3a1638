/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/body_surface_conditions.h>
#include <isochor/diagnosis/diagnosis.h>

namespace isochor
{
  /** Loads on faces of which the body has a part. */
  template <int dim>
  class SurfaceOffBody : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      for (const auto *const loads :
           with_role<const BodySurfaceConditions<dim>>(
             scene.boundary_conditions))
        for (unsigned int s = 0; s < loads->covered_shares().size(); ++s)
          if (const auto &place = loads->parameters().surfaces[s].place;
              loads->covered_shares()[s] <= 0.99 && !place.on_grid_boundary)
            this->warn("only " + rounded(100 * loads->covered_shares()[s]) +
                       " % of the area of <" + place.name + "> of <" +
                       place.parameter +
                       "> belong to the body; its load acts on this part "
                       "alone, however small the cells. Give <Material "
                       "points/Body mesh> and <" +
                       loads->parameter("Mesh of body surfaces") + ">.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SurfaceOffBody,
    "surface in part off the body",
    ISOCHOR_ESSENTIAL,
    "the faces of cells that a surface of `Boundary conditions/Surfaces of "
    "body` with a load consists of belong to the body by less than 99 % of "
    "their area: its loads act on this part and are too small by the rest, "
    "however small the cells (a bore with pressure whose surface is steps of "
    "cells: half of the load). Not with CPDI, where loads act on the outer "
    "faces of subdomains",
    "`Quadrature/Type = CPDI`; the body's mesh in `Body mesh` and `Mesh of "
    "body surfaces`")
} // namespace isochor
