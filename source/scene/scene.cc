/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/base/parameter_list.h>
#include <isochor/base/plain_message.h>
#include <isochor/base/plugin_registry.h>
#include <isochor/boundary_condition/periodic_vertices.h>
#include <isochor/interaction/body_pair_term.h>
#include <isochor/interaction/interaction_term.h>
#include <isochor/material_model/axisymmetric_material.h>
#include <isochor/rigid_body/rigid_body.h>
#include <isochor/scene/scene.h>

#include <algorithm>
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



    void
    declare_formulation(ParameterHandler &prm)
    {
      prm.enter_subsection("Formulation");
      prm.declare_entry(
        "Type",
        "u-p",
        Patterns::Selection("u|u-p"),
        "u: displacements are the only unknowns; nearly incompressible bodies "
        "and those that flow plastically are then much too stiff. u-p: "
        "displacements and pressure.");
      prm.declare_entry("Geometry",
                        "plane strain",
                        Patterns::Selection("plane strain|axisymmetric"),
                        "In 2D: a slice of a body that is long in z, or a "
                        "section of an axisymmetric body, x being the distance "
                        "from the axis (r) and y the place along it (z). "
                        "Volumes, forces and energies are then those of the "
                        "whole circle.");
      prm.declare_entry(
        "Stabilisation",
        "auto",
        Patterns::Selection("auto|none|PPP|OSS"),
        "Of u-p, against pressures that oscillate from node to node, with which "
        "bodies that yield and are unloaded may end in wrong states. PPP: "
        "Polynomial Pressure Projection, without inertia of what is left "
        "without the pressure that is in equilibrium with <Boundary conditions/"
        "Gravity>. OSS: orthogonal subscales, of what is left without all that "
        "weights and accelerations of nodes balance, so that waves of pressure "
        "in nearly incompressible bodies have their speed. auto: PPP, in "
        "dynamics OSS.");
      prm.declare_entry(
        "PPP coefficient",
        "1",
        Patterns::Double(0),
        "The factor alpha of alpha/G in the stabilisation. Useful is 1, and "
        "less where pressures are far above the shear modulus G. A larger one "
        "makes the pressure smoother, and the body softer where the pressure "
        "varies much within a cell: a beam with 4 cells over its height bends "
        "20 % too much with 8 (8 cells: 6 %). 8 is for grids that resolve the "
        "pressure with many cells.");
      prm.leave_subsection();
    }



    template <int dim>
    void
    declare_materials(const unsigned int n_materials, ParameterHandler &prm)
    {
      for (unsigned int m = 0; m < n_materials; ++m)
        {
          prm.enter_subsection(material_section(m));
          prm.declare_entry(
            "Model",
            "Neo-Hookean",
            Patterns::Selection(PluginRegistry<MaterialModel<dim>>::names()),
            "The constitutive law. What it needs besides elasticity is in the "
            "subsection of its name; see doc/materials.md.");
          IsotropicElasticity::declare_parameters(prm);
          PluginRegistry<MaterialModel<dim>>::declare_parameters(prm);
          prm.leave_subsection();
        }
    }



    /** Declare the parameters of all plugins in @p section, and of one each in
     * @p named sections. */
    template <typename Plugin>
    void
    declare_plugins(const std::string               &section,
                    const std::vector<NamedSection> &named,
                    ParameterHandler                &prm)
    {
      using Registry = PluginRegistry<Plugin>;
      prm.enter_subsection(section);
      Registry::declare_parameters(prm);
      prm.leave_subsection();
      const auto types = Utilities::split_string_list(Registry::names(), '|');
      for (const NamedSection &entry : named)
        {
          const bool known =
            std::find(types.begin(), types.end(), entry.type) != types.end();
          prm.enter_subsection(entry.section);
          prm.declare_entry("Type",
                            known ? entry.type : types.front(),
                            Patterns::Selection(Registry::names()),
                            "Which of the objects of the section '" + section +
                              "' this is one more of. The section has the "
                              "parameters of that one.");
          if (known)
            Registry::declare_parameters(entry.type, prm);
          else // the error is to be that of the type
            Registry::declare_parameters(prm);
          prm.leave_subsection();
        }
    }



    /** Make the objects of all plugins, then those of named sections, and let
     * them read their parameters. */
    template <typename Plugin>
    void
    create_plugins(ParameterHandler                     &prm,
                   std::vector<std::unique_ptr<Plugin>> &objects)
    {
      PluginRegistry<Plugin>::create_all(objects);
      const std::string kind = objects.front()->section;
      for (const auto &path : ParameterList(prm).subsections)
        if (path.size() == 1 && path.front().rfind(kind + ": ", 0) == 0)
          {
            prm.enter_subsection(path.front());
            const std::string type = prm.get("Type");
            prm.leave_subsection();
            objects.push_back(PluginRegistry<Plugin>::create(type));
            Plugin &object  = *objects.back();
            object.section  = path.front();
            object.instance = path.front().substr(kind.size() + 2);
            object.name     = type + ": " + object.instance;
          }
      for (const auto &object : objects)
        {
          prm.enter_subsection(object->section);
          object->parse_parameters(prm);
          prm.leave_subsection();
        }
    }
  } // namespace



  SceneSections
  SceneSections::find(const std::vector<ParameterStatement> &statements)
  {
    SceneSections sections(n_numbered_subsections(statements, "Material"));
    sections.boundary_conditions =
      named_subsections(statements, "Boundary conditions");
    sections.postprocessors = named_subsections(statements, "Postprocess");
    sections.interactions = named_subsections(statements, "Interaction", false);
    sections.rigid_bodies = named_subsections(statements, "Rigid body", false);
    return sections;
  }



  template <int dim>
  Scene<dim>::Scene(const MPI_Comm comm)
    : grid(comm)
    , points(grid)
  {}



  template <int dim>
  void
  Scene<dim>::declare_parameters(ParameterHandler    &prm,
                                 const SceneSections &sections)
  {
    BackgroundGrid<dim>::declare_parameters(prm);
    GridAdaptation<dim>::declare_parameters(prm);
    MaterialPoints<dim>::declare_parameters(prm);
    LoadStepping::declare_parameters(prm);
    BodyQuadrature<dim>::declare_quadratures(prm);
    InertiaTerm<dim>::declare_parameters(prm);

    declare_formulation(prm);
    declare_materials<dim>(sections.n_materials, prm);
    declare_plugins<BoundaryCondition<dim>>("Boundary conditions",
                                            sections.boundary_conditions,
                                            prm);
    declare_plugins<Postprocessor<dim>>("Postprocess",
                                        sections.postprocessors,
                                        prm);
    for (const NamedSection &entry : sections.interactions)
      {
        prm.enter_subsection(entry.section);
        Interaction<dim>::declare_parameters(prm, entry.section);
        prm.leave_subsection();
      }
    for (const NamedSection &entry : sections.rigid_bodies)
      {
        prm.enter_subsection(entry.section);
        RigidBody<dim>::declare_parameters(prm);
        prm.leave_subsection();
      }
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
    inertia.parse_parameters(prm, *quadrature);
    AssertThrow(points_have_domains() || !grid.source().is_adaptive(),
                ExcMessage("Points without subdomains (<Quadrature/Type = "
                           "points>) can't be divided where an adaptive grid "
                           "becomes finer: use CPDI, the default, or another "
                           "<Grid/Type>."));
    points.check_numbers(points_have_domains());
    parse_formulation(prm);
    parse_materials(prm);
    parse_plugins(prm);
  }



  template <int dim>
  void
  Scene<dim>::parse_formulation(ParameterHandler &prm)
  {
    prm.enter_subsection("Formulation");
    n_components                     = prm.get("Type") == "u-p" ? dim + 1 : dim;
    kernel.has_pressures             = mixed();
    const std::string stabilisation  = prm.get("Stabilisation");
    kernel.stabilisation.coefficient = mixed() && stabilisation != "none" ?
                                         prm.get_double("PPP coefficient") :
                                         0.;
    kernel.stabilisation.has_orthogonal_subscales =
      kernel.stabilisation.coefficient > 0 &&
      (stabilisation == "OSS" || (stabilisation == "auto" && has_inertia()));
    kernel.axisymmetric = prm.get("Geometry") == "axisymmetric";
    prm.leave_subsection();
    prm.enter_subsection("Boundary conditions");
    const bool has_weight = !prm.get("Gravity").empty();
    prm.leave_subsection();
    AssertThrow(
      !(mixed() && stabilisation == "PPP" && has_inertia() && has_weight),
      ExcMessage("With <Dynamics/Inertia = true>, <Formulation/"
                 "Stabilisation = PPP> takes the pressure of <Boundary "
                 "conditions/Gravity> for an oscillation, and volumes "
                 "are wrong by it. Use <Stabilisation = OSS>, or leave "
                 "it out."));
    AssertThrow(dim == 2 || !kernel.axisymmetric,
                ExcMessage("The parameter <Formulation/Geometry = "
                           "axisymmetric> needs <Dimension = 2>: the plane is "
                           "a section of the body."));
  }



  template <int dim>
  void
  Scene<dim>::parse_materials(ParameterHandler &prm)
  {
    for (unsigned int m = 0;
         m == 0 || prm.subsection_path_exists({material_section(m)});
         ++m)
      {
        prm.enter_subsection(material_section(m));
        const std::string model = prm.get("Model");
        kernel.materials.push_back(create_material(model));
        laws.push_back(model);
        MaterialModel<dim> &material = *kernel.materials.back();
        material.parse_parameters(prm);
        prm.leave_subsection();
        check_material(material, model, m);
        symmetric = symmetric && material.has_symmetric_tangent();
        may_yield = may_yield || material.dissipates();
      }
  }



  template <int dim>
  std::unique_ptr<MaterialModel<dim>>
  Scene<dim>::create_material(const std::string &model) const
  {
    if constexpr (dim == 2)
      if (kernel.axisymmetric)
        return std::make_unique<AxisymmetricMaterial>(
          PluginRegistry<MaterialModel<3>>::create(model));
    return PluginRegistry<MaterialModel<dim>>::create(model);
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
    AssertThrow(!has_inertia() || material.density() > 0,
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
    create_plugins(prm, boundary_conditions);
    create_plugins(prm, postprocessors);
    parse_rigid_bodies(prm);
    parse_interactions(prm);
  }



  template <int dim>
  void
  Scene<dim>::create(const PointArrays<dim> &arrays)
  {
    grid.create();
    adaptation.make_initial_grid(grid);
    check_axis();
    points.set_periods(find_periods(grid, boundary_conditions));
    points.seed(kernel.materials,
                has_inertia(),
                inertia.initial_velocity,
                points_have_domains(),
                kernel.axisymmetric,
                mixed(),
                inertia.is_from_stresses(),
                [this](const unsigned int n_bodies) {
                  grid.set_layers(n_bodies);
                });
    shape.initialize(grid, points_have_domains(), points.bodies());
    if (body_pairs != nullptr)
      body_pairs->set_bodies(points.bodies().names());
    if (surface_interactions != nullptr)
      surface_interactions->set_bodies(points.bodies().names());
    for (auto &condition : boundary_conditions)
      {
        condition->set_body(shape, arrays);
        condition->initialize(grid);
      }
    motion_starts.initialize(boundary_conditions);
    for (const auto *const condition :
         with_role<const ActsByAssembly<dim>>(boundary_conditions))
      symmetric = symmetric && condition->has_symmetric_matrix();
    kernel.upper_blocks_only = symmetric;
    for (auto &postprocessor : postprocessors)
      postprocessor->initialize(grid);
  }



  template <int dim>
  void
  Scene<dim>::check_axis() const
  {
    if (!kernel.axisymmetric)
      return;
    double least = 0, largest = 0;
    for (const Point<dim> &vertex : grid.geometry().vertices())
      {
        least   = std::min(least, vertex[0]);
        largest = std::max(largest, vertex[0]);
      }
    AssertThrow(least >= -1e-12 * largest,
                ExcMessage("With <Formulation/Geometry = axisymmetric> x is "
                           "the distance from the axis, but the grid of <Grid/"
                           "Type> reaches to x = " +
                           rounded(least) +
                           ". Let it begin at x = 0 or to the right of it."));
  }



  template <int dim>
  std::vector<std::string>
  Scene<dim>::not_needed() const
  {
    std::vector<std::string> list;
    if (!mixed())
      list.push_back("pressures at the nodes");
    if (!mixed() || kernel.stabilisation.coefficient == 0)
      list.push_back("stabilisation of the pressure");
    if (!has_inertia())
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
