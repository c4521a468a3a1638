/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/equations/invariants.h>
#include <isochor/postprocess/grid_fields.h>

#include <algorithm>
#include <array>

namespace isochor
{
  namespace
  {
    /** A nodal field and the rows of its components. */
    struct NodalRows
    {
      const NodalField *field;
      unsigned int      vector, scalar;

      /** Copy the values at a @p node to the vertex @p v of a patch. */
      template <int dim, typename Patch>
      void
      copy(const StepContext<dim> &step,
           const unsigned int      node,
           const unsigned int      v,
           Patch                  &patch) const
      {
        const unsigned int first = node * step.n_components;
        for (unsigned int a = 0; a < dim; ++a)
          patch.data(vector + a, v) = field->local_element(first + a);
        if (step.mixed())
          patch.data(scalar, v) = field->local_element(first + dim);
      }
    };
  } // namespace



  template <int dim>
  FieldPatches<dim, dim>
  grid_fields(const StepContext<dim> &step,
              const NodalField       &unknowns,
              const NodalField       *residual)
  {
    Assert(invariants::fits(unknowns, step.nodes, step.n_components),
           ExcOtherNodes());
    Assert(residual == nullptr ||
             invariants::fits(*residual, step.nodes, step.n_components),
           ExcInternalError());
    FieldPatches<dim, dim> patches;
    std::vector<NodalRows> all_rows;
    all_rows.push_back({&unknowns,
                        patches.add_vector("displacement_increment"),
                        step.mixed() ? patches.add_scalar("pressure") : 0});
    const bool         has_bodies = step.grid.n_layers() > 1;
    const unsigned int body_row   = has_bodies ? patches.add_scalar("body") : 0;
    const bool         is_adaptive = step.grid.is_adaptive();
    const unsigned int level_row =
      is_adaptive ? patches.add_scalar("level") : 0;
    if (residual != nullptr)
      all_rows.push_back(
        {residual,
         patches.add_vector("residual_force"),
         step.mixed() ? patches.add_scalar("residual_of_pressure_equation") :
                        0});

    const SimplexGeometry<dim> &geometry = step.grid.geometry();
    patches.reserve(step.points.cell.size());
    std::array<Point<dim>, dim + 1> corners;
    for (unsigned int k = 0; k < step.points.cell.size(); ++k)
      {
        const auto &vertices = geometry.vertex_indices(step.points.cell[k]);
        if (std::any_of(
              vertices.begin(), vertices.end(), [&step](const unsigned int v) {
                return step.nodes.node(v) == numbers::invalid_unsigned_int;
              }))
          continue; // the points' domains miss a node of the cell
        for (unsigned int v = 0; v <= dim; ++v)
          corners[v] = step.points.corner(geometry, k, v);
        auto &patch = patches.add_patch(
          ArrayView<const Point<dim>>(corners.data(), dim + 1));
        for (unsigned int v = 0; v <= dim && has_bodies; ++v)
          patch.data(body_row, v) =
            step.grid.layer_of_cell(step.points.cell[k]);
        if (is_adaptive)
          {
            const AdaptiveGrid<dim> &forest = step.grid.adaptive_grid();
            const Leaf<dim>         &leaf =
              forest.leaves()[forest.leaf_of_cell(step.points.cell[k])];
            for (unsigned int v = 0; v <= dim; ++v)
              patch.data(level_row, v) = leaf.level;
          }
        for (unsigned int v = 0; v <= dim; ++v)
          for (const NodalRows &rows : all_rows)
            rows.copy(step, step.nodes.node(vertices[v]), v, patch);
      }
    return patches;
  }



  template FieldPatches<2, 2>
  grid_fields<2>(const StepContext<2> &,
                 const NodalField &,
                 const NodalField *);
  template FieldPatches<3, 3>
  grid_fields<3>(const StepContext<3> &,
                 const NodalField &,
                 const NodalField *);
} // namespace isochor
