/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/equations/connected_parts.h>

#include <sstream>
#include <utility>

namespace isochor
{
  /**
   * Bodies that share one field. Where they have nodes in common they are one,
   * from up to a cell before they touch, without slip, and also if they are
   * pulled apart; as long as they have none, on a grid that is kept, they go
   * through each other.
   *
   * Bodies are what has no node in common at t = 0. If that is one body nothing
   * is looked for, also if it breaks.
   */
  template <int dim>
  class SharedField : public Diagnosis<dim>
  {
  public:
    void
    grid_reset(const Scene<dim>       &scene,
               const StepContext<dim> &step,
               const ElementNodes     &elements,
               const bool              is_kept) override
    {
      const bool at_start = scene.time.step == 0;
      // with domains Bodies has found what has a field of its own
      if ((!at_start && !has_several) || scene.points.layout().with_domains)
        return;
      const unsigned int n_before =
        std::exchange(n_bodies, number_of_parts(step, elements));
      if (at_start)
        has_several = n_bodies > 1;
      if (at_start && has_several && is_kept)
        this->warn(std::to_string(n_bodies) +
                   " bodies share no node of a grid that is not reset: they go "
                   "through each other. Use <Quadrature/Type = CPDI>.");
      else if (!at_start && n_bodies < n_before)
        this->warn("at t = " + rounded(step.old_time) +
                   " bodies have come to share nodes of the grid: from up to "
                   "a cell before they touch they are as one, without slip, "
                   "also if pulled apart. Use <Quadrature/Type = CPDI> and "
                   "<Interaction: body - body>.");
    }

    std::string
    save_state() const override
    {
      return std::to_string(n_bodies) + (has_several ? " 1" : " 0");
    }

    void
    load_state(const std::string &state) override
    {
      std::istringstream(state) >> n_bodies >> has_several;
    }

  private:
    bool         has_several = false; ///< at t = 0
    unsigned int n_bodies    = 0;     ///< at the last reset
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SharedField,
    "bodies in one field",
    ISOCHOR_ESSENTIAL,
    "two or more bodies that had no node of the grid in common at t = 0 have "
    "come to share some: they are as one from there on, from up to a cell "
    "before they touch, without slip, and if they are pulled apart (two discs "
    "with 32 cells over the radius: 1.5 times the force). Or they share none "
    "at the start of a run without resets (the default in dynamics), and go "
    "through each other. Not with `Quadrature/Type = CPDI`, where bodies have "
    "fields of their own, nor of parts of one body",
    "`Quadrature/Type = CPDI` and an interaction of the bodies; smaller cells "
    "where they meet")
} // namespace isochor
