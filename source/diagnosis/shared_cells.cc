/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/diagnosis/diagnosis.h>

#include <algorithm>
#include <vector>

namespace isochor
{
  namespace
  {
    /** How far a material reaches into a cell of another one, as a part of it,
     * and the ratio of their stiffnesses. */
    struct InterfaceCrossing
    {
      double depth = 0, ratio = 1;

      double
      weight() const
      {
        return depth * (ratio - 1);
      }
    };

    double
    larger_ratio(const double a, const double b)
    {
      return a == b ? 1. : std::max(a / b, b / a);
    }

    /** How much one material is stiffer than the other, the larger ratio of
     * shear and of bulk moduli; 2 at least if one may yield; 1 if they are
     * nearly the same. */
    template <int dim>
    double
    contrast(const MaterialModel<dim> &a, const MaterialModel<dim> &b)
    {
      constexpr double nearly_alike = 1.05;
      const double     ratio =
        std::max(larger_ratio(a.shear_modulus(), b.shear_modulus()),
                 larger_ratio(a.inverse_bulk_modulus(),
                              b.inverse_bulk_modulus()));
      if (ratio <= nearly_alike &&
          a.describe_strength() == b.describe_strength())
        return 1;
      return a.dissipates() || b.dissipates() ? std::max(ratio, 2.) : ratio;
    }

    /** The cell in which materials that differ share most. How far the smaller
     * part reaches into it is taken for its part of the volume. */
    template <int dim>
    InterfaceCrossing
    worst_shared_cell(const PointArrays<dim> &points,
                      const MixedKernel<dim> &kernel)
    {
      const auto         &materials = kernel.materials;
      InterfaceCrossing   worst;
      std::vector<double> volumes(materials.size());
      for (unsigned int k = 0; k < points.cell.size(); ++k)
        {
          std::fill(volumes.begin(), volumes.end(), 0.);
          double all = 0;
          for (unsigned int q = points.cell_start[k];
               q < points.cell_start[k + 1];
               ++q)
            {
              volumes[points.material[q]] += points.volume[q];
              all += points.volume[q];
            }
          for (unsigned int a = 0; a < volumes.size(); ++a)
            for (unsigned int b = 0; b < a && volumes[a] > 0; ++b)
              if (volumes[b] > 0)
                {
                  const InterfaceCrossing here = {
                    std::min(volumes[a], volumes[b]) / all,
                    contrast(*materials[a], *materials[b])};
                  if (here.weight() > worst.weight())
                    worst = here;
                }
        }
      return worst;
    }
  } // namespace



  /** Materials of other stiffness that share the functions of cells. */
  template <int dim>
  class SharedCells : public Diagnosis<dim>
  {
  public:
    void
    grid_reset(const Scene<dim>       &scene,
               const StepContext<dim> &step,
               const ElementNodes & /*elements*/,
               const bool /*is_kept*/) override
    {
      constexpr double        much = 0.2; // 3 % of the stress
      const MPI_Comm          comm = step.grid.communicator();
      const InterfaceCrossing worst =
        worst_shared_cell(step.points, step.kernel);
      const double weight = Utilities::MPI::max(worst.weight(), comm);
      if (weight < much)
        return;
      // of ranks that have found the same the same is told
      const bool   is_mine = worst.weight() == weight;
      const double depth =
        Utilities::MPI::max(is_mine ? worst.depth : 0., comm);
      this->warn("at t = " + rounded(step.old_time) +
                 " materials whose stiffnesses differ by up to " +
                 rounded(1 + weight / depth) +
                 " to 1, or whose strengths differ, meet within cells, " +
                 rounded(depth) +
                 " of which are of the one: stresses of the stiff one are "
                 "wrong. " +
                 (scene.points.layout().with_domains ?
                    "Let cells end where the materials meet." :
                    "Use <Quadrature/Type = CPDI>."));
    }
  };

  ISOCHOR_REGISTER_DIAGNOSIS(
    SharedCells,
    "material interface within cells",
    ISOCHOR_ESSENTIAL,
    "materials of other stiffness, or that may yield, share the functions of "
    "cells, as with other quadratures than CPDI, `Bodies = one` or where they "
    "meet across `Periodic sides`, and the ratio of their moduli less one (at "
    "least 1 if one may yield) times the "
    "part of a cell by which one reaches into it is more than 0.2. Both are "
    "strained alike there (100 to 1, half of a cell: the stress is wrong by up "
    "to 230 %, the settlement of two layers of four cells by 14 %; "
    "[verification.md](verification.md), Materials that share cells)",
    "`Quadrature/Type = CPDI`; with it cells that end where the materials meet")
} // namespace isochor
