/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/expression.h>
#include <isochor/base/plain_message.h>
#include <isochor/boundary_condition/body_surface_conditions.h>
#include <isochor/diagnosis/diagnosis.h>
#include <isochor/grid/nearest_cells.h>

#include <algorithm>

namespace isochor
{
  namespace
  {
    /** Whether a formula that stands for a condition, which holds where it is
     * above 0, has names in it, but nothing that compares or chooses. It may be
     * meant all the same: as one that is below 0 elsewhere. */
    bool
    compares_nothing(const std::string &formula)
    {
      const auto names = names_in_formula(formula);
      return !names.empty() &&
             std::find(names.begin(), names.end(), "if") == names.end() &&
             formula.find_first_of("<>=!&|?") == std::string::npos;
    }
  } // namespace



  /** Formulas that stand for conditions, but hold nearly everywhere. */
  template <int dim>
  class ConditionFormulas : public Diagnosis<dim>
  {
  public:
    void
    step_set_up(const Scene<dim> &scene,
                const StepContext<dim> & /*step*/,
                const SparseSystem & /*matrix*/) override
    {
      const auto &body = scene.points.body_seeding().parameters_read();
      // it need not have values beside a mesh of the body
      if (body.body_mesh.empty())
        look(scene, body.region, "Material points/Region", true);
      for (const auto &[zones, name] :
           {std::make_pair(body.material_zones, "Materials in zones"),
            std::make_pair(body.zones, "Points per cell in zones")})
        for (const auto &zone : split_named_list(zones, ""))
          look(scene,
               zone.second,
               std::string("Material points/") + name,
               false);
      for (const auto *const loads :
           with_role<const BodySurfaceConditions<dim>>(
             scene.boundary_conditions))
        for (const auto &place : loads->parameters().named)
          if (scene.grid.boundary_names().count(place.condition) == 0)
            look(scene, place.condition, place.parameter, false);
    }

  private:
    /** Of a @p formula of @p parameter, in the middle of all cells or at the
     * material points. Collective. */
    void
    look(const Scene<dim>  &scene,
         const std::string &formula,
         const std::string &parameter,
         const bool         in_grid) const
    {
      if (!compares_nothing(formula))
        return;
      const Expression<dim> condition(formula, parameter);
      double                n = 0, n_above = 0, n_others = 0;
      double                least = 1e300, most = -1e300;
      const auto            add = [&](const Point<dim> &x) {
        const double value = condition(x, 0.);
        n += 1;
        n_above += value > 0;
        n_others += value != 0 && value != 1;
        least = std::min(least, value);
        most  = std::max(most, value);
      };
      const SimplexGeometry<dim> &geometry = scene.grid.geometry();
      const MPI_Comm              comm     = scene.grid.communicator();
      try
        {
          const unsigned int rank = Utilities::MPI::this_mpi_process(comm);
          for (unsigned int cell = 0;
               in_grid && cell < geometry.n_cells_of_first_layer();
               ++cell)
            if (geometry.owner(cell) == rank)
              add(cell_centroid(geometry, cell));
          if (!in_grid)
            for (const auto &point : scene.points.handler())
              add(point.get_location());
        }
      catch (const StandardExceptions::ExcMessage &)
        {
          n = n_above = 0; // a surface's need have values there only
        }
      for (double *const sum : {&n, &n_above, &n_others})
        *sum = Utilities::MPI::sum(*sum, comm);
      least = Utilities::MPI::min(least, comm);
      most  = Utilities::MPI::max(most, comm);
      if (n_others > 0 && least >= 0 && 2 * n_above >= n && n_above > 0)
        this->warn("<" + formula + "> of <" + parameter +
                   "> holds where it is above 0, which it is in " +
                   rounded(100 * n_above / n) +
                   " % of the places in question, with values from " +
                   rounded(least) + " to " + rounded(most) +
                   ". Write a comparison, as 'y < 0.5', or '1'.");
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    ConditionFormulas,
    "a condition that compares nothing",
    ISOCHOR_ESSENTIAL,
    "`Material points/Region`, a zone of `Materials in zones` or `Points "
    "per cell in zones`, or a place of `Surfaces of body` is a formula "
    "without a comparison (no `<`, `>`, `==`, `&&`, `\\|\\|`, `if`) that is"
    " nowhere below 0 and above 0 at most places, with other values than 0 "
    "and 1, as `y` where y > 0: it holds nearly everywhere. The region is "
    "looked at in the middle of the cells of the grid, zones and surfaces at "
    "the material points",
    "a comparison, such as `y < 0.5`, a formula that is below 0 elsewhere, "
    "or `1`")
} // namespace isochor
