/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/plugin_registry.h>
#include <isochor/step/scene.h>
#include <isochor/transfer/volume_projection.h>

#include <string>

namespace isochor
{
  namespace
  {
    std::string
    material_section(const unsigned int material)
    {
      return material == 0 ? "Material" :
                             "Material " + std::to_string(material + 1);
    }
  } // namespace



  template <int dim>
  Scene<dim>::Scene(const MPI_Comm comm)
    : grid(comm)
    , points(grid)
  {}



  template <int dim>
  void
  Scene<dim>::declare_parameters(ParameterHandler  &prm,
                                 const unsigned int n_materials)
  {
    BackgroundGrid<dim>::declare_parameters(prm);
    GridAdaptation<dim>::declare_parameters(prm);
    MaterialPoints<dim>::declare_parameters(prm);
    LoadStepping::declare_parameters(prm);
    BodyQuadrature<dim>::declare_quadratures(prm);
    InertiaTerm<dim>::declare_parameters(prm);

    prm.enter_subsection("Formulation");
    prm.declare_entry("Type",
                      "u-p",
                      Patterns::Selection("u|u-p"),
                      "Displacements as the only unknowns, or displacements "
                      "and pressure.");
    prm.declare_entry("Stabilisation",
                      "PPP",
                      Patterns::Selection("none|PPP"),
                      "Of u-p: none, or Polynomial Pressure Projection.");
    prm.declare_entry("PPP coefficient",
                      "1",
                      Patterns::Double(0),
                      "The factor alpha of alpha/G in the stabilisation; "
                      "useful are 1 to 8.");
    prm.leave_subsection();

    for (unsigned int m = 0; m < n_materials; ++m)
      {
        prm.enter_subsection(material_section(m));
        prm.declare_entry("Model",
                          "Neo-Hookean",
                          Patterns::Selection(
                            PluginRegistry<MaterialModel<dim>>::names()),
                          "The constitutive law.");
        IsotropicElasticity::declare_parameters(prm);
        PluginRegistry<MaterialModel<dim>>::declare_parameters(prm);
        prm.leave_subsection();
      }

    prm.enter_subsection("Boundary conditions");
    PluginRegistry<BoundaryCondition<dim>>::declare_parameters(prm);
    prm.leave_subsection();
    prm.enter_subsection("Postprocess");
    PluginRegistry<Postprocessor<dim>>::declare_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::parse_parameters(ParameterHandler &prm)
  {
    grid.parse_parameters(prm);
    adaptation.parse_parameters(prm);
    points.parse_parameters(prm);
    shape.parse_parameters(prm);
    time.parse_parameters(prm);
    quadrature = BodyQuadrature<dim>::create(prm);
    dynamic    = inertia.parse_parameters(prm, *quadrature);
    parse_formulation(prm);
    parse_materials(prm);
    parse_plugins(prm);
  }



  template <int dim>
  void
  Scene<dim>::parse_formulation(ParameterHandler &prm)
  {
    prm.enter_subsection("Formulation");
    n_components           = prm.get("Type") == "u-p" ? dim + 1 : dim;
    kernel.ppp_coefficient = mixed() && prm.get("Stabilisation") == "PPP" ?
                               prm.get_double("PPP coefficient") :
                               0.;
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::parse_materials(ParameterHandler &prm)
  {
    const bool rescales = VolumeProjection<dim>::is_asked_for(prm);
    for (unsigned int m = 0;
         m == 0 || prm.subsection_path_exists({material_section(m)});
         ++m)
      {
        prm.enter_subsection(material_section(m));
        const std::string model = prm.get("Model");
        kernel.materials.push_back(
          PluginRegistry<MaterialModel<dim>>::create(model));
        MaterialModel<dim> &material = *kernel.materials.back();
        material.parse_parameters(prm);
        if (rescales)
          material.prepare_rescaling();
        prm.leave_subsection();
        check_material(material, model, m);
        symmetric = symmetric && material.has_symmetric_tangent();
      }
  }



  template <int dim>
  void
  Scene<dim>::check_material(const MaterialModel<dim> &material,
                             const std::string        &model,
                             const unsigned int        m) const
  {
    AssertThrow(mixed() || material.inverse_bulk_modulus() > 0,
                ExcMessage("The parameter <" + material_section(m) +
                           "/Poisson ratio> must be less than 0.5 in the "
                           "formulation u. Set <Formulation/Type = u-p> for "
                           "an incompressible material."));
    AssertThrow(!dynamic || material.density() > 0,
                ExcMessage("The parameter <" + material_section(m) +
                           "/Density> must be positive in a scene with "
                           "<Dynamics/Inertia = true>."));
    AssertThrow(material.history_names().size() <= max_history,
                ExcMessage("The law <" + model + "> of <" +
                           material_section(m) + "/Model> keeps " +
                           std::to_string(material.history_names().size()) +
                           " history variables per point, but there is "
                           "room for " +
                           std::to_string(max_history) +
                           ": raise max_history in mixed_kernel.h."));
    AssertThrow(m < max_materials,
                ExcMessage("There may be no more than " +
                           std::to_string(max_materials) +
                           " materials: the sections <Material> to <" +
                           material_section(max_materials - 1) + ">."));
  }



  template <int dim>
  void
  Scene<dim>::parse_plugins(ParameterHandler &prm)
  {
    prm.enter_subsection("Boundary conditions");
    PluginRegistry<BoundaryCondition<dim>>::create_all(boundary_conditions);
    for (auto &condition : boundary_conditions)
      {
        condition->parse_parameters(prm);
        symmetric = symmetric && condition->has_symmetric_matrix();
      }
    prm.leave_subsection();

    prm.enter_subsection("Postprocess");
    PluginRegistry<Postprocessor<dim>>::create_all(postprocessors);
    for (auto &postprocessor : postprocessors)
      postprocessor->parse_parameters(prm);
    prm.leave_subsection();
  }



  template <int dim>
  void
  Scene<dim>::create(const PointArrays<dim> &arrays)
  {
    const bool with_domains = quadrature->needs_domains();
    grid.create();
    adaptation.make_initial_grid(grid);
    points.seed(kernel.materials,
                dynamic,
                inertia.initial_velocity,
                with_domains);
    shape.initialize(grid, with_domains);
    for (auto &condition : boundary_conditions)
      {
        condition->set_body(shape, arrays);
        condition->initialize(grid);
      }
    for (auto &postprocessor : postprocessors)
      postprocessor->initialize(grid);
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::not_needed() const
  {
    std::vector<std::string> list;
    if (!mixed())
      list.push_back("pressures at the nodes");
    if (!mixed() || kernel.ppp_coefficient == 0)
      list.push_back("stabilisation of the pressure");
    if (!dynamic)
      list.push_back("masses and inertia");
    if (points.layout().n_history == 0)
      list.push_back("history of the points");
    if (!points.layout().with_domains)
      list.push_back("domains of the points");
    if (symmetric)
      list.push_back("lower triangle of the matrix");
    return list;
  }



  template class Scene<2>;
  template class Scene<3>;
} // namespace isochor
