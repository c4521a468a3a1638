/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The matrix of interactions, all of it, against finite differences of the
// residual: after the second step of scenes, when the surface has been deformed
// and friction remembers, at unknowns that are out of equilibrium.

#include <deal.II/lac/full_matrix.h>

#include <isochor/interaction/interaction_term.h>

#include "material_test_tools.h"
#include "scene.h"

using namespace isochor;

namespace
{
  // what was measured
  double       worst = 0, norm = 0;
  unsigned int n_checked, n_kinks;
} // namespace

namespace isochor
{
  template <int dim>
  class TangentCheck : public Postprocessor<dim>
  {
  public:
    void
    evaluate_nodes(const StepResult<dim> &result, Statistics &) override
    {
      for (const auto &condition : result.conditions)
        {
          auto *const term =
            dynamic_cast<InteractionTerm<dim> *>(condition.get());
          if (term != nullptr && result.step.old_time > 0)
            check(result.step, result.unknowns, *term);
        }
    }

  private:
    static void
    check(const StepContext<dim> &step,
          const NodalField       &solution,
          InteractionTerm<dim>   &term)
    {
      const unsigned int n = step.n_components, all = step.nodes.n_local() * n;
      ElementNodes       elements;
      term.collect_elements(step, elements);
      NodalConstraints none;
      none.reinit(all, step.nodes.control_entries(n));
      MixedSystem<dim> system(step.nodes);
      system.reinit(true, n, elements, none, false);
      NodalField unknowns(solution), zero;
      step.nodes.initialize(zero, n);
      test::Random random;
      for (unsigned int i = 0; i < all; ++i)
        unknowns.local_element(i) +=
          (static_cast<int>(i % n) < dim ? 0.003 : 0.03) * random();
      const auto assemble = [&](const bool with_matrix) {
        system.start_assembly(with_matrix);
        const auto status =
          term.assemble(step, unknowns, zero, 0, with_matrix, system);
        system.finish_assembly(zero);
        AssertThrow(status == EvaluationStatus::success, ExcInternalError());
      };
      assemble(true);
      const SparseSystem &A = system.matrix();
      FullMatrix<double>  matrix(A.n_equations, A.n_equations);
      for (unsigned int i = 0; i < A.n_equations; ++i)
        for (std::size_t k = A.row_start[i]; k < A.row_start[i + 1]; ++k)
          matrix(i, A.column[k]) = A.values[k];
      norm                  = matrix.linfty_norm();
      const auto difference = [&](const unsigned int j, const double h) {
        const double   x = unknowns.local_element(j);
        Vector<double> result(A.n_equations);
        for (const double sign : {1., -1.})
          {
            unknowns.local_element(j) = x + sign * h;
            assemble(false);
            for (unsigned int i = 0; i < all; ++i)
              if (system.equation(i) != numbers::invalid_unsigned_int)
                result[system.equation(i)] +=
                  sign * system.residual.local_element(i) / (2 * h);
          }
        unknowns.local_element(j) = x;
        return result;
      };
      for (unsigned int j = 0; j < all; ++j)
        {
          if (system.equation(j) == numbers::invalid_unsigned_int)
            continue;
          // where both differ there is a kink: contact begins or ends
          const Vector<double> fine   = difference(j, 1e-6),
                               coarse = difference(j, 2e-6);
          for (unsigned int i = 0; i < A.n_equations; ++i)
            {
              const double error =
                std::abs(fine[i] - matrix(i, system.equation(j))) / norm;
              if (error > 1e-7 &&
                  std::abs(fine[i] - coarse[i]) > 0.1 * error * norm)
                ++n_kinks;
              else
                test::add_error(worst, error);
            }
        }
      n_checked += A.n_equations;
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, TangentCheck, "Tangent check")
} // namespace isochor

namespace
{
  using Variants = std::vector<std::pair<std::string, std::string>>;

  /** Scenes of all @p laws with one @p tool of a certain @p form: the largest
   * error of the matrix over its norm. */
  template <int dim>
  void
  check(const std::pair<std::string, std::string> &form,
        const std::pair<std::string, std::string> &tool,
        const Variants                            &laws)
  {
    const std::string cells = dim == 2 ? "4, 4" : "2, 2, 2",
                      size  = dim == 2 ? "1.3, 1.6" : "1.6, 1.6, 1.6",
                      zero  = dim == 2 ? "x=0, y=0" : "x=0, y=0, z=0";
    std::string wrong;
    for (const auto &[name, law] : laws)
      {
        worst     = 0;
        n_checked = 0;
        n_kinks   = 0;
        test::run_scene<dim>(
          "Grid/Upper corner = " + size + "\nGrid/Subdivisions = " + cells +
          "\nMaterial points/Region = x<1 && y<1" +
          (dim == 3 ? " && z<1" : "") +
          "\nQuadrature/Type = CPDI\n"
          "Material/Young modulus = 1\nMaterial/Density = 1\n"
          "Material/Poisson ratio = 0.3\nTime/Step size = 0.05\n"
          "Time/End time = 0.1\nBoundary conditions/Surfaces of body = "
          "foot: y<0.01; upper: y>0.5\n"
          "Interaction: foot - place/Displacement = " +
          zero + '\n' + tool.second + law + form.second);
        if (!(n_checked > 20 && norm > 0 && worst < 1e-7 &&
              n_kinks < n_checked / 2))
          wrong += name + ": " + std::to_string(n_checked) + " equations, " +
                   std::to_string(n_kinks) + " at kinks, error " +
                   test::in_short(worst) + "; ";
      }
    test::check(tool.first + ", " + form.first + ", " + std::to_string(dim) +
                  "D: " + std::to_string(laws.size()) + " laws",
                wrong.empty(),
                wrong);
  }

  const std::string at    = "Interaction: upper - tool/",
                    shape = "Rigid body: tool/";
  const Variants laws     = {
        {"tie", at + "Law = tie\n"},
        {"unilateral", at + "Law = unilateral\n"},
        {"sticks", at + "Law = Coulomb\n" + at + "Friction coefficient = 100\n"},
        {"slides", at + "Law = Coulomb\n" + at + "Friction coefficient = 0.01\n"},
        {"adhesion",
         at + "Law = Coulomb\n" + at + "Friction coefficient = 0.1\n" + at +
           "Adhesion = 0.01\n"},
        {"slides under a pressure",
         at + "Law = Coulomb\n" + at + "Friction coefficient = 0.01\n" +
           "Boundary conditions/Pressure on body = upper: 0.01*t\n"},
        {"capped",
         at + "Law = Coulomb\n" + at + "Friction coefficient = 1\n" + at +
           "Largest shear stress = 0.003\n"}};
} // namespace

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  const std::string                motion =
                      shape + "Motion = rotation=0.5*t, x=0.2*t, y=-0.3*t\n",
                    turning =
                      shape +
                      "Motion = rx=0.2*t, rz=0.5*t, x=0.1*t, y=-0.3*t\n",
                    plane  = shape + "Shape = half plane\n" + shape,
                    circle = shape + "Shape = circle\n" + shape +
                             "Radius = 0.5\n" + shape,
                    box = shape + "Shape = box\n" + shape;
  const Variants forms  = {
     {"u", "Formulation/Type = u\n"},
     {"u-p", ""},
     {"u-p, nu = 0.5", "Material/Poisson ratio = 0.5\n"},
     {"u-p, inertia", "Dynamics/Inertia = true\n"},
     {"u, Mohr-Coulomb",
      "Formulation/Type = u\nMaterial/Model = Mohr-Coulomb\n"
       "Material/Mohr-Coulomb/Cohesion = 0.01\n"},
     {"u-p, J2", "Material/Model = J2\nMaterial/J2/Yield stress = 0.05\n"},
     {"u-p, axisymmetric", "Formulation/Geometry = axisymmetric\n"}};
  const Variants tools = {
    {"half plane", plane + "Point = 0, 1\n" + shape + "Normal = 0.1, -1\n"},
    {"circle", circle + "Centre = 0.4, 1.49\n"},
    {"rounded corner",
     box + "Lower corner = 0.4, 0.98\n" + shape + "Upper corner = 3, 3\n" +
       shape + "Edge radius = 0.1\n"}};
  for (const auto &form : forms)
    for (const auto &[name, tool] : tools)
      {
        check<2>(form, {name, tool + motion}, laws);
      }
  for (const auto &form : forms)
    check<2>(form,
             {"place of one component",
              "Interaction: foot - place/Displacement = y=0\n"},
             {{"tie", ""}});
  for (unsigned int i = 0; i < 4; ++i)
    {
      check<3>(forms[i],
               {"half plane",
                plane + "Point = 0, 1, 0\n" + shape +
                  "Normal = 0.1, -1, 0.1\n" + turning},
               laws);
      check<3>(forms[i],
               {"sphere", circle + "Centre = 0.4, 1.48, 0.3\n" + turning},
               laws);
    }
  // rotations that are unknowns, in statics beside prescribed ones
  const std::string turns = shape + "Motion = x=0.2*t, y=-0.3*t\n" + shape +
                            "Free = rotation\n" + shape +
                            "Moment = rotation=0.002*t\n" + shape +
                            "Reference point = 0.5, 1\n",
                    turns_in_space = shape + "Motion = y=-0.3*t, ry=0.5*t\n" +
                                     shape + "Free = rx, rz\n" + shape +
                                     "Moment = rx=2e-3*t, rz=1e-3*t\n" + shape +
                                     "Reference point = 0.5, 1, 0.5\n",
                    moves =
                      shape + "Motion = y=-0.3*t\n" + shape + "Free = x, ",
                    inertia = shape + "Mass = 1\n" + shape +
                              "Moment of inertia = 0.3\n",
                    solid_plane = plane + "Point = 0, 0.99, 0\n" + shape +
                                  "Normal = 0.01, -1, 0.02\n",
                    sphere = circle + "Centre = 0.4, 1.48, 0.3\n";
  const std::string free   = " that turns freely";
  for (const unsigned int i : {0, 2})
    {
      check<2>(forms[i],
               {tools[0].first + free, tools[0].second + turns},
               laws);
      for (const unsigned int tool : {1, 2})
        check<2>(forms[i],
                 {tools[tool].first + free, tools[tool].second + turns},
                 {laws[0]});
      check<3>(forms[i],
               {"half plane" + free, solid_plane + turns_in_space},
               laws);
      check<3>(forms[i], {"sphere" + free, sphere + turns_in_space}, {laws[0]});
    }
  for (const auto &[name, tool] : tools)
    check<2>(forms[3],
             {name + free, tool + moves + "rotation\n" + inertia},
             laws);
  for (const auto &[name, tool] :
       Variants{{"half plane", solid_plane}, {"sphere", sphere}})
    check<3>(forms[3],
             {name + free, tool + moves + "rx, ry, rz\n" + inertia},
             laws);
  return 0;
}
