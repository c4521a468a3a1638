/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/boundary_condition.h>
#include <isochor/boundary_points.h>
#include <isochor/mpi_sums.h>

#include <algorithm>
#include <cmath>

namespace isochor
{
  /**
   * Conditions on the surface of the body, wherever it is in the grid, by
   * boundary points b with reference area A_b:
   *  - dead loads t per reference area: f_I = Σ_b N_I A_b t;
   *  - a follower pressure p per present area: f_I = -Σ_b N_I p a_b;
   *  - prescribed displacements ū by a penalty, component by component,
   *    f_I = -Σ_b N_I β (G/h) A_b (u_b - ū), u_b the total displacement of the
   *    point. The force of a surface on the body is Σ_b of that.
   * Formulas are in the reference position.
   */
  template <int dim>
  class BodySurfaceConditions : public BoundaryCondition<dim>
  {
  public:
    static void
    declare_parameters(ParameterHandler &prm);
    void
    parse_parameters(ParameterHandler &prm) override;

    void
    initialize(const BackgroundGrid<dim> &grid) override;

    void
    check_scene(const StepContext<dim> &step) const override;

    void
    collect_elements(const StepContext<dim> &step,
                     ElementNodes           &elements) override;

    EvaluationStatus
    assemble(const StepContext<dim> &step,
             const NodalField       &unknowns,
             const NodalField       &pending,
             const unsigned int      first_element,
             const bool              with_matrix,
             MixedSystem<dim>       &system) override;

    void
    add_external_force(const StepContext<dim> &step,
                       NodalField             &force) const override;

    bool
    has_symmetric_matrix() const override;
    bool
    moves_body(const StepContext<dim> &step) const override;
    void
    add_boundary_force(const StepContext<dim> &step,
                       const NodalField       &unknowns,
                       NodalField             &force) const override;

    void
    evaluate(const StepContext<dim> &step,
             const NodalField       &unknowns,
             Statistics             &statistics) const override;
    void
    advance(const StepContext<dim> &step, const NodalField &unknowns) override;

    std::string
    save_state() const override;
    void
    load_state(const std::string &state) override;

  private:
    /** What is prescribed on a surface. */
    struct Surface
    {
      BodySurface<dim>             place;
      std::vector<Expression<dim>> traction; ///< dim or none
      std::vector<Expression<dim>> pressure; ///< one or none
      std::array<std::vector<Expression<dim>>, dim>
        displacement; ///< by component: one or none

      bool
      is_fixed() const
      {
        return std::any_of(displacement.begin(),
                           displacement.end(),
                           [](const auto &u) { return !u.empty(); });
      }
    };

    /** Residual and tangent of one point. */
    struct PointElement
    {
      static constexpr unsigned int max_dofs = (dim + 1) * (dim + 1);

      std::array<double, max_dofs>            residual;
      std::array<double, max_dofs * max_dofs> matrix;
    };

    void
    parse_loads(ParameterHandler &prm);
    void
    parse_displacements(ParameterHandler &prm);
    Surface &
    find_surface(const std::string &name, const std::string &parameter);

    /** β G/h A_b at a point. */
    double
    stiffness(const StepContext<dim> &step, const unsigned int b) const;
    Tensor<1, dim>
    displacement(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b) const;
    /** The penalty's force on the body. */
    Tensor<1, dim>
    penalty_force(const StepContext<dim> &step,
                  const NodalField       &unknowns,
                  const unsigned int      b) const;
    void
    evaluate_point(const StepContext<dim> &step,
                   const NodalField       &unknowns,
                   const unsigned int      b,
                   const bool              with_matrix,
                   PointElement           &element) const;
    void
    add_penalty(const StepContext<dim> &step,
                const NodalField       &unknowns,
                const unsigned int      b,
                const bool              with_matrix,
                PointElement           &element) const;
    void
    add_pressure(const StepContext<dim> &step,
                 const NodalField       &unknowns,
                 const unsigned int      b,
                 const bool              with_matrix,
                 PointElement           &element) const;

    std::vector<Surface>                 surfaces;
    unsigned int                         points_per_face = 3;
    std::string                          body_mesh;
    double                               penalty = 1e3;
    std::unique_ptr<BoundaryPoints<dim>> points;
    bool                                 seeded = false;
  };



  template <int dim>
  void
  BodySurfaceConditions<dim>::declare_parameters(ParameterHandler &prm)
  {
    prm.declare_entry(
      "Surfaces of body",
      "",
      Patterns::Anything(),
      "Parts of the body's surface at t = 0: 'name: place; name: place'. The "
      "place is the name of a boundary of the grid that the body touches, or "
      "a condition in x, y(, z) at the centres of the free faces of the cells "
      "that the body fills. Boundary points mark the surface and follow the "
      "body.");
    prm.declare_entry("Boundary points per face",
                      "3",
                      Patterns::Integer(1),
                      "Any in 2D; in 3D 1, 3, 4, 6, 7, 9, 12, 15, 16, ...");
    prm.declare_entry("Mesh of body surfaces",
                      "",
                      Patterns::Anything(),
                      "A gmsh .msh file of the body whose boundary faces are "
                      "its surface. Empty: the cells of the grid that the "
                      "body fills.");
    prm.declare_entry("Traction on body",
                      "",
                      Patterns::Anything(),
                      "Dead loads (Pa) per reference area on surfaces of the "
                      "body, formulas in the reference position x, y(, z) and "
                      "t: 'surface: t_x, t_y(, t_z); surface: ...'.");
    prm.declare_entry("Pressure on body",
                      "",
                      Patterns::Anything(),
                      "Follower loads (Pa): a pressure against surfaces of the "
                      "body as they are deformed, positive if it pushes: "
                      "'surface: formula; ...'.");
    prm.declare_entry("Displacement of body",
                      "",
                      Patterns::Anything(),
                      "Prescribed displacements (m) of surfaces of the body, "
                      "formulas in the reference position x, y(, z) and t: "
                      "'surface: x = formula, y = formula; surface: ...'. "
                      "Components not named are free.");
    prm.declare_entry("Penalty of body displacement",
                      "1e3",
                      Patterns::Double(0),
                      "Stiffness by which prescribed displacements of the body "
                      "are imposed, in units of shear modulus over cell size.");
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::parse_parameters(ParameterHandler &prm)
  {
    const std::string name = "Boundary conditions/Surfaces of body";
    for (const auto &entry :
         split_named_list(prm.get("Surfaces of body"), name))
      {
        Surface surface;
        surface.place.name      = entry.first;
        surface.place.condition = entry.second;
        surfaces.push_back(surface);
      }
    points_per_face = prm.get_integer("Boundary points per face");
    body_mesh       = prm.get("Mesh of body surfaces");
    penalty         = prm.get_double("Penalty of body displacement");
    parse_loads(prm);
    parse_displacements(prm);
    AssertThrow(penalty > 0,
                ExcMessage("The parameter <Boundary conditions/Penalty of body "
                           "displacement> must be positive."));
  }



  template <int dim>
  typename BodySurfaceConditions<dim>::Surface &
  BodySurfaceConditions<dim>::find_surface(const std::string &name,
                                           const std::string &parameter)
  {
    std::string known;
    for (Surface &surface : surfaces)
      {
        if (surface.place.name == name)
          return surface;
        known += (known.empty() ? "" : ", ") + surface.place.name;
      }
    AssertThrow(false,
                ExcMessage("The parameter <Boundary conditions/" + parameter +
                           "> names the surface <" + name +
                           ">. <Boundary conditions/Surfaces of body> lists: " +
                           (known.empty() ? "none" : known) + "."));
    return surfaces.front();
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::parse_loads(ParameterHandler &prm)
  {
    for (const std::string parameter : {"Traction on body", "Pressure on body"})
      {
        const std::string name    = "Boundary conditions/" + parameter;
        const bool        is_dead = parameter == "Traction on body";
        for (const auto &entry : split_named_list(prm.get(parameter), name))
          {
            Surface   &surface  = find_surface(entry.first, parameter);
            auto      &load     = is_dead ? surface.traction : surface.pressure;
            const auto formulas = is_dead ?
                                    split_formulas(entry.second, name) :
                                    std::vector<std::string>{entry.second};
            AssertThrow(!is_dead || formulas.size() == dim,
                        ExcMessage("The parameter <" + name + "> needs " +
                                   std::to_string(dim) + " components on <" +
                                   entry.first + ">."));
            AssertThrow(load.empty(),
                        ExcMessage("The parameter <" + name +
                                   "> names the surface <" + entry.first +
                                   "> twice."));
            for (const auto &formula : formulas)
              load.emplace_back(formula, name);
          }
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::parse_displacements(ParameterHandler &prm)
  {
    const std::string parameter = "Displacement of body";
    const std::string name      = "Boundary conditions/" + parameter;
    const std::string axes      = std::string("xyz").substr(0, dim);
    for (const auto &entry : split_named_list(prm.get(parameter), name))
      for (const auto &item : split_formulas(entry.second, name))
        {
          Surface          &surface = find_surface(entry.first, parameter);
          const auto        equals  = item.find('=');
          const std::string axis =
            Utilities::trim(item.substr(0, std::min(equals, item.size())));
          AssertThrow(equals != std::string::npos && axis.size() == 1 &&
                        axes.find(axis) != std::string::npos,
                      ExcMessage("The entry <" + item + "> of the parameter <" +
                                 name +
                                 "> must have the form <x = formula>, with a "
                                 "component out of " +
                                 axes + "."));
          surface.displacement[axes.find(axis)] = {
            Expression<dim>(item.substr(equals + 1), name)};
        }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::initialize(const BackgroundGrid<dim> &grid)
  {
    for (Surface &surface : surfaces)
      {
        const auto boundary =
          grid.boundary_names().find(surface.place.condition);
        if (boundary == grid.boundary_names().end())
          continue;
        AssertThrow(body_mesh.empty(),
                    ExcMessage("With <Boundary conditions/Mesh of body "
                               "surfaces> the surface <" +
                               surface.place.name +
                               "> needs a condition in the coordinates, not "
                               "the name of a boundary of the grid."));
        surface.place.on_grid_boundary = true;
        surface.place.id               = boundary->second;
      }
    if (!surfaces.empty())
      points = std::make_unique<BoundaryPoints<dim>>(grid);
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::check_scene(const StepContext<dim> &step) const
  {
    for (const Surface &surface : surfaces)
      if (surface.traction.empty() && surface.pressure.empty() &&
          !surface.is_fixed())
        step.warnings.add("no condition on <" + surface.place.name +
                            "> of <Surfaces of body>",
                          "The surface <" + surface.place.name +
                            "> of the parameter <Boundary conditions/Surfaces "
                            "of body> has no effect: name it in <Traction on "
                            "body>, <Pressure on body> or <Displacement of "
                            "body> of that section, or leave it out.");
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::collect_elements(const StepContext<dim> &step,
                                               ElementNodes           &elements)
  {
    if (surfaces.empty())
      return;
    if (!seeded)
      {
        std::vector<BodySurface<dim>> places;
        for (const Surface &surface : surfaces)
          places.push_back(surface.place);
        points->seed(step.points, places, points_per_face, body_mesh);
        seeded = true;
      }
    points->locate(step);
    for (unsigned int b = 0; b < points->size(); ++b)
      {
        std::array<unsigned int, dim + 1> nodes;
        for (unsigned int v = 0; v <= dim; ++v)
          {
            nodes[v] = step.nodes.node(
              step.grid.geometry().vertex_indices(points->cell(b))[v]);
            AssertThrow(nodes[v] != numbers::invalid_unsigned_int,
                        ExcMessage(
                          "A point of <Boundary conditions/Surfaces of body> "
                          "acts on a cell that the material touches only in "
                          "part. Use so many points that their domains are no "
                          "larger than the cells, or another "
                          "<Quadrature/Type> than CPDI."));
          }
        elements.add(nodes.begin(), nodes.end());
      }
  }



  template <int dim>
  EvaluationStatus
  BodySurfaceConditions<dim>::assemble(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       const NodalField       &pending,
                                       const unsigned int      first_element,
                                       const bool              with_matrix,
                                       MixedSystem<dim>       &system)
  {
    PointElement element;
    for (unsigned int b = 0; points && b < points->size(); ++b)
      {
        evaluate_point(step, unknowns, b, with_matrix, element);
        system.add_element(first_element + b,
                           element.residual.data(),
                           with_matrix ? element.matrix.data() : nullptr,
                           pending);
      }
    return EvaluationStatus::success;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::evaluate_point(const StepContext<dim> &step,
                                             const NodalField       &unknowns,
                                             const unsigned int      b,
                                             const bool    with_matrix,
                                             PointElement &element) const
  {
    element.residual.fill(0.);
    if (with_matrix)
      element.matrix.fill(0.);
    const Surface &surface = surfaces[points->surface(b)];
    if (surface.is_fixed())
      add_penalty(step, unknowns, b, with_matrix, element);
    if (!surface.pressure.empty())
      add_pressure(step, unknowns, b, with_matrix, element);
  }



  template <int dim>
  double
  BodySurfaceConditions<dim>::stiffness(const StepContext<dim> &step,
                                        const unsigned int      b) const
  {
    const unsigned int cell = points->cell(b);
    const unsigned int q = step.points.cell_start[step.points.position(cell)];
    const double       G =
      step.kernel.materials[step.points.material[q]]->shear_modulus();
    constexpr double factorial = (dim == 2) ? 2. : 6.;
    const double     h =
      std::pow(factorial * step.grid.geometry().measure(cell), 1. / dim);
    return penalty * G / h * points->reference_area(b).norm();
  }



  template <int dim>
  Tensor<1, dim>
  BodySurfaceConditions<dim>::displacement(const StepContext<dim> &step,
                                           const NodalField       &unknowns,
                                           const unsigned int      b) const
  {
    Tensor<1, dim> u     = points->displacement(b);
    const auto &vertices = step.grid.geometry().vertex_indices(points->cell(b));
    for (unsigned int I = 0; I <= dim; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        u[a] += points->shape(b)[I] *
                unknowns.local_element(
                  step.nodes.node(vertices[I]) * step.n_components + a);
    return u;
  }



  template <int dim>
  Tensor<1, dim>
  BodySurfaceConditions<dim>::penalty_force(const StepContext<dim> &step,
                                            const NodalField       &unknowns,
                                            const unsigned int      b) const
  {
    const Surface       &surface = surfaces[points->surface(b)];
    const Tensor<1, dim> u       = displacement(step, unknowns, b);
    const Point<dim>     X       = points->reference_location(b);
    const double         k       = stiffness(step, b);
    Tensor<1, dim>       force;
    for (unsigned int a = 0; a < dim; ++a)
      if (!surface.displacement[a].empty())
        force[a] = -k * (u[a] - surface.displacement[a].front()(X, step.time));
    return force;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_penalty(const StepContext<dim> &step,
                                          const NodalField       &unknowns,
                                          const unsigned int      b,
                                          const bool              with_matrix,
                                          PointElement           &element) const
  {
    const Surface       &surface = surfaces[points->surface(b)];
    const Tensor<1, dim> force   = penalty_force(step, unknowns, b);
    const auto          &N       = points->shape(b);
    const unsigned int   nc = step.n_components, n_dofs = (dim + 1) * nc;
    for (unsigned int I = 0; I <= dim; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        element.residual[I * nc + a] -= N[I] * force[a];
    if (!with_matrix)
      return;
    const double k = stiffness(step, b);
    for (unsigned int I = 0; I <= dim; ++I)
      for (unsigned int J = 0; J <= dim; ++J)
        for (unsigned int a = 0; a < dim; ++a)
          if (!surface.displacement[a].empty())
            element.matrix[(I * nc + a) * n_dofs + J * nc + a] +=
              k * N[I] * N[J];
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_pressure(const StepContext<dim> &step,
                                           const NodalField       &unknowns,
                                           const unsigned int      b,
                                           const bool              with_matrix,
                                           PointElement &element) const
  {
    const double p = surfaces[points->surface(b)].pressure.front()(
      points->reference_location(b), step.time);
    const auto &N = points->shape(b);
    const auto &gradients =
      step.points.gradients(step.grid.geometry(),
                            step.points.position(points->cell(b)));
    const auto &vertices = step.grid.geometry().vertex_indices(points->cell(b));
    Tensor<2, dim> F_increment = unit_symmetric_tensor<dim>();
    for (unsigned int I = 0; I <= dim; ++I)
      for (unsigned int a = 0; a < dim; ++a)
        F_increment[a] +=
          unknowns.local_element(
            step.nodes.node(vertices[I]) * step.n_components + a) *
          gradients[I];
    // Nanson: a = det F F^{-T} A_0
    const Tensor<2, dim> F = F_increment * points->F(b);
    const Tensor<1, dim> a =
      determinant(F) * (points->reference_area(b) * invert(F));

    const unsigned int nc = step.n_components, n_dofs = (dim + 1) * nc;
    for (unsigned int I = 0; I <= dim; ++I)
      for (unsigned int d = 0; d < dim; ++d)
        element.residual[I * nc + d] += p * N[I] * a[d];
    if (!with_matrix)
      return;
    // δa = (∇·δu) a - (∇δu)^T a
    const Tensor<2, dim> inverse = invert(F_increment);
    for (unsigned int J = 0; J <= dim; ++J)
      {
        const Tensor<1, dim> g = gradients[J] * inverse;
        for (unsigned int I = 0; I <= dim; ++I)
          for (unsigned int d = 0; d < dim; ++d)
            for (unsigned int e = 0; e < dim; ++e)
              element.matrix[(I * nc + d) * n_dofs + J * nc + e] +=
                p * N[I] * (g[e] * a[d] - g[d] * a[e]);
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_external_force(const StepContext<dim> &step,
                                                 NodalField &force) const
  {
    for (unsigned int b = 0; points && b < points->size(); ++b)
      {
        const Surface &surface = surfaces[points->surface(b)];
        if (surface.traction.empty())
          continue;
        const double     A = points->reference_area(b).norm();
        const Point<dim> X = points->reference_location(b);
        const auto      &vertices =
          step.grid.geometry().vertex_indices(points->cell(b));
        for (unsigned int a = 0; a < dim; ++a)
          {
            const double t = surface.traction[a](X, step.time);
            for (unsigned int I = 0; I <= dim; ++I)
              force.local_element(
                step.nodes.node(vertices[I]) * step.n_components + a) +=
                points->shape(b)[I] * A * t;
          }
      }
  }



  template <int dim>
  bool
  BodySurfaceConditions<dim>::has_symmetric_matrix() const
  {
    return std::all_of(surfaces.begin(), surfaces.end(), [](const auto &s) {
      return s.pressure.empty();
    });
  }



  template <int dim>
  bool
  BodySurfaceConditions<dim>::moves_body(const StepContext<dim> &step) const
  {
    for (unsigned int b = 0; points && b < points->size(); ++b)
      for (const auto &u : surfaces[points->surface(b)].displacement)
        if (!u.empty())
          {
            const Point<dim> X = points->reference_location(b);
            if (u.front()(X, step.time) != u.front()(X, step.old_time))
              return true;
          }
    return false;
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::add_boundary_force(const StepContext<dim> &step,
                                                 const NodalField &unknowns,
                                                 NodalField       &force) const
  {
    PointElement element;
    for (unsigned int b = 0; points && b < points->size(); ++b)
      {
        evaluate_point(step, unknowns, b, false, element);
        const auto &vertices =
          step.grid.geometry().vertex_indices(points->cell(b));
        for (unsigned int I = 0; I <= dim; ++I)
          for (unsigned int a = 0; a < step.n_components; ++a)
            force.local_element(
              step.nodes.node(vertices[I]) * step.n_components + a) -=
              element.residual[I * step.n_components + a];
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::evaluate(const StepContext<dim> &step,
                                       const NodalField       &unknowns,
                                       Statistics             &statistics) const
  {
    for (unsigned int s = 0; s < surfaces.size(); ++s)
      {
        if (!surfaces[s].is_fixed())
          continue;
        std::array<double, dim> force{};
        for (unsigned int b = 0; b < points->size(); ++b)
          if (points->surface(b) == s)
            {
              const Tensor<1, dim> f = penalty_force(step, unknowns, b);
              for (unsigned int a = 0; a < dim; ++a)
                force[a] += f[a];
            }
        sum_over_ranks(force, step.grid.communicator());
        for (unsigned int a = 0; a < dim; ++a)
          statistics.set(std::string("Reaction ") + "xyz"[a] + " on " +
                           surfaces[s].place.name + " by boundary points (N)",
                         force[a]);
      }
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::advance(const StepContext<dim> &step,
                                      const NodalField       &unknowns)
  {
    if (points)
      points->advance(step, unknowns);
  }



  template <int dim>
  std::string
  BodySurfaceConditions<dim>::save_state() const
  {
    return seeded ? points->save_state() : std::string();
  }



  template <int dim>
  void
  BodySurfaceConditions<dim>::load_state(const std::string &state)
  {
    if (state.empty() || !points)
      return;
    points->load_state(state);
    seeded = true;
  }



  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition,
                                 BodySurfaceConditions,
                                 "Surfaces of body")
} // namespace isochor
