/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The matrix of InteractionTerm, all of it, against finite differences of its
// residual: in the second step of scenes, when the surface has been deformed
// and friction remembers, at unknowns that are out of equilibrium.

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/interaction/interaction_term.h>
#include <isochor/interaction/rigid_partner.h>

#include "material_test_tools.h"
#include "scene.h"

using namespace isochor;

namespace
{
  /** Of the case at hand: "Law = ..." and what else a section of an interaction
   * has; "Shape = ..." and what else that of a rigid body has. */
  std::vector<std::string> laws, bodies;
  /** What was measured. */
  double       worst = 0;
  unsigned int n_checked;

  template <int dim>
  std::vector<std::unique_ptr<Interaction<dim>>>
  make_interactions()
  {
    std::vector<std::unique_ptr<Interaction<dim>>> all;
    for (unsigned int i = 0; i < laws.size(); ++i)
      {
        ParameterHandler prm, of_body;
        Interaction<dim>::declare_parameters(prm);
        test::set_parameters(prm, laws[i]);
        RigidPartner<dim>::declare_parameters(of_body);
        test::set_parameters(of_body, bodies[i]);
        const bool is_rigid = !bodies[i].empty();
        all.push_back(std::make_unique<Interaction<dim>>(
          prm,
          is_rigid ? "Interaction: body - tool" : "Interaction: body - place"));
        if (is_rigid)
          all.back()->partner =
            std::make_unique<RigidPartner<dim>>(of_body, "Rigid body: tool");
      }
    return all;
  }
} // namespace

namespace isochor
{
  /** Interactions of the case, checked at the start of step 2. */
  template <int dim>
  class Checked : public InteractionTerm<dim>
  {
  public:
    Checked()
      : InteractionTerm<dim>(make_interactions<dim>())
    {}

    void
    prepare_contact(const StepContext<dim> &step) override
    {
      InteractionTerm<dim>::prepare_contact(step);
      if (step.old_time > 0)
        check(step);
    }

  private:
    void
    check(const StepContext<dim> &step)
    {
      const unsigned int n = step.n_components;
      ElementNodes       elements;
      this->collect_elements(step, elements);
      NodalConstraints none;
      none.reinit(step.nodes.n_local() * n, step.nodes.control_entries(n));
      MixedSystem<dim> system(step.nodes);
      system.reinit(true, n, elements, none, false);
      NodalField unknowns, zero;
      step.nodes.initialize(unknowns, n);
      step.nodes.initialize(zero, n);
      test::Random random;
      for (unsigned int i = 0; i < step.nodes.n_local() * n; ++i)
        unknowns.local_element(i) = (int(i % n) < dim ? 0.01 : 0.3) * random();
      const auto assemble = [&](const bool with_matrix) {
        system.start_assembly(with_matrix);
        const auto status =
          this->assemble(step, unknowns, zero, 0, with_matrix, system);
        system.finish_assembly(zero);
        AssertThrow(status == EvaluationStatus::success, ExcInternalError());
      };
      assemble(true);
      const SparseSystem A = system.matrix();
      FullMatrix<double> matrix(A.n_equations, A.n_equations);
      for (unsigned int i = 0; i < A.n_equations; ++i)
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          matrix(i, A.column[k]) = A.values[k];
      const double   h     = 1e-6;
      const double   scale = matrix.linfty_norm();
      Vector<double> difference(A.n_equations);
      for (unsigned int j = 0; j < step.nodes.n_local() * n; ++j)
        {
          const double x = unknowns.local_element(j);
          difference     = 0.;
          for (const double sign : {1., -1.})
            {
              unknowns.local_element(j) = x + sign * h;
              assemble(false);
              for (unsigned int i = 0; i < step.nodes.n_local() * n; ++i)
                if (system.equation(i) != numbers::invalid_unsigned_int)
                  difference[system.equation(i)] +=
                    sign * system.residual.local_element(i) / (2 * h);
            }
          unknowns.local_element(j) = x;
          if (system.equation(j) == numbers::invalid_unsigned_int)
            continue;
          for (unsigned int i = 0; i < A.n_equations; ++i)
            test::add_error(
              worst,
              std::abs(difference[i] - matrix(i, system.equation(j))) / scale);
        }
      n_checked += A.n_equations;
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(BoundaryCondition, Checked, "Checked")
} // namespace isochor

namespace
{
  /** The largest error of the matrix over its norm. */
  template <int dim>
  void
  check(const std::string &what, const std::string &settings)
  {
    worst                   = 0;
    n_checked               = 0;
    const std::string cells = dim == 2 ? "4, 4" : "2, 3, 2",
                      size  = dim == 2 ? "1.3, 1.6" : "1.2, 1.5, 1.1",
                      zero  = dim == 2 ? "x=0, y=0" : "x=0, y=0, z=0";
    test::run_scene<dim>(
      "Grid/Upper corner = " + size + "\nGrid/Subdivisions = " + cells +
      "\nMaterial points/Region = x<1 && y<1\nQuadrature/Type = CPDI\n"
      "Material/Young modulus = 1\nMaterial/Density = 1\n"
      "Material/Poisson ratio = 0.3\nTime/Step size = 0.05\n"
      "Time/End time = 0.1\nInteraction: body - place/Law = tie\n"
      "Interaction: body - place/Surface = y<0.01\n"
      "Interaction: body - place/Displacement = " +
      zero + '\n' + settings);
    test::check(what + ", dim " + std::to_string(dim),
                n_checked > 20 && worst < 1e-7,
                std::to_string(n_checked) + " equations, error " +
                  test::in_short(worst * 1e9) + "e-9");
  }

  const std::string unilateral = "Law = unilateral",
                    sticks     = "Law = Coulomb\nFriction coefficient = 100",
                    slides     = "Law = Coulomb\nFriction coefficient = 0.01",
                    glued      = "Law = Coulomb\nAdhesion = 0.02\n"
                                 "Friction coefficient = 0.3",
                    capped     = "Law = Coulomb\nFriction coefficient = 1\n"
                                 "Largest shear stress = 0.01";

  const std::vector<std::pair<std::string, std::string>> forms = {
    {"u", "Formulation/Type = u\n"},
    {"u-p", "Formulation/Type = u-p\n"},
    {"u-p, nu = 0.5", "Material/Poisson ratio = 0.5\n"},
    {"u, inertia", "Formulation/Type = u\nDynamics/Inertia = true\n"},
    {"u-p, inertia", "Dynamics/Inertia = true\n"}};

  template <int dim>
  void
  check_shapes(const std::vector<std::pair<std::string, std::string>> &shapes,
               const std::string &geometry = "")
  {
    for (const auto &[form, settings] : forms)
      for (const auto &[name, shape] : shapes)
        for (const std::string &law : {std::string("Law = tie"),
                                       unilateral,
                                       sticks,
                                       slides,
                                       glued,
                                       capped})
          {
            laws              = {law + "\nSurface = y>0.5"};
            bodies            = {shape};
            std::string label = law;
            std::replace(label.begin(), label.end(), '\n', ',');
            check<dim>(geometry + name + ", " + form + ": " + label.substr(6),
                       (geometry.empty() ?
                          "" :
                          "Formulation/Geometry = axisymmetric\n") +
                         settings);
          }
  }
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string turning = "\nMotion = rotation=0.5*t, x=0.2*t, y=-0.3*t";
  check_shapes<2>(
    {{"half plane",
      "Shape = half plane\nPoint = 0, 1\nNormal = 0.1, -1" + turning},
     {"circle", "Shape = circle\nCentre = 0.4, 1.49\nRadius = 0.5" + turning},
     {"corner",
      "Shape = box\nLower corner = 0.4, 0.98\n"
      "Upper corner = 3, 3" +
        turning}});
}
