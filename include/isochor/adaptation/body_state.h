/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_body_state_h
#define isochor_body_state_h

#include <deal.II/base/symmetric_tensor.h>

#include <isochor/equations/equation_term.h>

#include <array>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** The material points of this rank at the end of a step, in the cells that
   * the step was made with. */
  template <int dim>
  struct BodyState
  {
    const BackgroundGrid<dim> &grid;
    unsigned int               n_materials;
    double                     time;

    std::vector<unsigned int>                cell;
    std::vector<std::array<double, dim + 1>> shape;  ///< N_I in the cell
    std::vector<double>                      volume; ///< J V_0
    std::vector<SymmetricTensor<2, 3>>       stress; ///< Cauchy (Pa)
    std::vector<unsigned char>               material;
    std::vector<double> shear_modulus, inverse_bulk_modulus; ///< Pa, 1/Pa
    /** Of the equivalent plastic strain in the step; 0 for elastic laws. */
    std::vector<double> plastic_increment;

    unsigned int
    size() const
    {
      return cell.size();
    }
  };

  /** What @p unknowns make of the points of @p step, which haven't moved yet.
   */
  template <int dim>
  BodyState<dim>
  state_of_body(const StepContext<dim> &step, const NodalField &unknowns);
} // namespace isochor

#endif
