/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/transfer/volume_projection.h>

namespace isochor
{
  template <int dim>
  void
  VolumeProjection<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.enter_subsection("Formulation");
    prm.declare_entry(
      "Project volume change",
      "false",
      Patterns::Bool(),
      "Of u-p: at the end of a step, the difference between the elastic "
      "volume change of a point and p/K is replaced by its mean around the "
      "point. Without that the volumes of points drift apart in long flows. "
      "Not for CPDI where the material flows: the domains don't follow.");
    prm.leave_subsection();
  }



  template <int dim>
  bool
  VolumeProjection<dim>::is_asked_for(ParameterHandler &prm)
  {
    prm.enter_subsection("Formulation");
    const bool active = prm.get_bool("Project volume change");
    prm.leave_subsection();
    return active;
  }



  template <int dim>
  bool
  VolumeProjection<dim>::parse_parameters(ParameterHandler          &prm,
                                          const BodyQuadrature<dim> &quadrature)
  {
    const bool active = is_asked_for(prm);
    prm.enter_subsection("Formulation");
    AssertThrow(!active || prm.get("Type") == "u-p",
                ExcMessage("<Formulation/Project volume change> needs the "
                           "pressure field of <Formulation/Type = u-p>."));
    prm.leave_subsection();
    AssertThrow(!active || quadrature.allows_change_of_F(),
                ExcMessage("<Formulation/Project volume change> changes F, not "
                           "the domains of points: it can't be used with "
                           "<Quadrature/Type = CPDI>."));
    return active;
  }



  template <int dim>
  void
  VolumeProjection<dim>::start(const StepContext<dim> &step)
  {
    excess.assign(step.points.weight.size(), 0.);
    step.nodes.initialize(mean, 1);
    step.nodes.initialize(weight, 1);
  }



  template <int dim>
  void
  VolumeProjection<dim>::project(const StepContext<dim> &step)
  {
    const PointArrays<dim> &points = step.points;
    // the occupied cells: a hole has no point that could carry anything
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      for (unsigned int q = points.cell_start[k]; q < points.cell_start[k + 1];
           ++q)
        {
          const auto stencil = points.stencil(step.grid.geometry(), k, q);
          for (unsigned int I = 0; I < stencil.n_nodes; ++I)
            {
              const unsigned int node = step.nodes.node(stencil.vertex[I]);
              const double       wN   = stencil.shape[I] * points.measure(q);
              weight.local_element(node) += wN;
              mean.local_element(node) += wN * excess[q];
            }
        }
    weight.compress(VectorOperation::add);
    mean.compress(VectorOperation::add);
    for (unsigned int node = 0; node < step.nodes.n_owned(); ++node)
      if (weight.local_element(node) > 0)
        mean.local_element(node) /= weight.local_element(node);
    mean.update_ghost_values();
  }



  template <int dim>
  double
  VolumeProjection<dim>::correction(const StepContext<dim> &step,
                                    const unsigned int      k,
                                    const unsigned int      q) const
  {
    const auto stencil = step.points.stencil(step.grid.geometry(), k, q);
    double     e       = -excess[q];
    for (unsigned int I = 0; I < stencil.n_nodes; ++I)
      e += stencil.shape[I] *
           mean.local_element(step.nodes.node(stencil.vertex[I]));
    return e;
  }



  template <int dim>
  void
  VolumeProjection<dim>::apply(const StepContext<dim> &step,
                               MaterialPoints<dim>    &points)
  {
    const PointLayout &l = points.layout();
    project(step);
    points.for_each([&](const unsigned int k,
                        const unsigned int q,
                        Point<dim> & /*location*/,
                        ArrayView<double> properties) {
      Tensor<2, dim> F;
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          F[a][b] = properties[l.F + a * dim + b];
      auto stress = load_symmetric<dim>(&properties[l.stress]);
      step.kernel.change_volume(step.points,
                                q,
                                correction(step, k, q),
                                F,
                                stress,
                                l.n_history > 0 ? &properties[l.history] :
                                                  nullptr);
      for (unsigned int a = 0; a < dim; ++a)
        for (unsigned int b = 0; b < dim; ++b)
          properties[l.F + a * dim + b] = F[a][b];
      store_symmetric<dim>(stress, &properties[l.stress]);
    });
  }



  template class VolumeProjection<2>;
  template class VolumeProjection<3>;
} // namespace isochor
