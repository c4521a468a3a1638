/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/mpi_sums.h>
#include <isochor/base/plain_message.h>
#include <isochor/equations/pressure_groups.h>
#include <isochor/interaction/interaction_term.h>
#include <isochor/step/free_motions.h>
#include <isochor/step/scene.h>
#include <isochor/step/scene_checks.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <vector>

namespace isochor
{
  /** K/G from which on a material hardly changes its volume: that of Poisson's
   * ratio of 0.48. */
  static constexpr double nearly_incompressible = 25;



  template <int dim>
  void
  check_body(const StepContext<dim> &step)
  {
    const MPI_Comm comm = step.grid.communicator();
    // a body that fills less than this part of the cells it is in isn't
    // resolved by them, whatever its shape
    constexpr double                smallest_share = 0.01;
    std::array<double, 3>           sums{}; // body, its cells, number of them
    const std::size_t               n_materials = step.kernel.materials.size();
    std::vector<unsigned long long> n_points(n_materials, 0);
    const PointArrays<dim>         &points = step.points;
    for (unsigned int k = 0; k < points.n_occupied_cells; ++k)
      {
        sums[1] += step.grid.geometry().measure(points.cell[k]);
        sums[2] += 1;
        for (unsigned int q = points.cell_start[k];
             q < points.cell_start[k + 1];
             ++q)
          {
            sums[0] += points.volume[q];
            ++n_points[points.material[q]];
          }
      }
    sum_over_ranks(sums, comm);
    Utilities::MPI::sum(n_points, comm, n_points);
    const std::string unit = dim == 2 ? " m^2" : " m^3";
    if (sums[0] < smallest_share * sums[1])
      {
        std::ostringstream numbers;
        numbers.precision(3);
        numbers << "fills " << 100 * sums[0] / sums[1] << " % of the "
                << sums[2] << " cell(s) it is in (" << sums[0] << " of "
                << sums[1] << unit << ")";
        step.warnings.add("a body smaller than a cell",
                          "The body " + numbers.str() +
                            ": no cell resolves it. Are the lengths in <Grid> "
                            "and <Material points> in the same unit? Otherwise "
                            "raise <Grid/Subdivisions>, or use a finer mesh.");
      }
    for (unsigned int m = 1; m < n_materials; ++m)
      if (n_points[m] == 0)
        step.warnings.add(
          "no point of material " + std::to_string(m + 1),
          "No material point is made of <Material " + std::to_string(m + 1) +
            ">: <Material points/Materials in zones> has no zone with that "
            "number that holds a point, or later zones hold wherever it does: "
            "the last one counts.");
  }



  /** Tell of materials that the scene's parameters hardly mean, and of such as
   * lock in the u form. */
  template <int dim>
  static void
  check_materials(const Scene<dim> &scene, Warnings &warnings)
  {
    const auto &materials = scene.kernel.materials;
    bool        locks     = false;
    for (unsigned int m = 0; m < materials.size(); ++m)
      {
        const std::string name =
          m == 0 ? "Material" : "Material " + std::to_string(m + 1);
        const std::string text = materials[m]->doubts();
        if (!text.empty())
          warnings.add("a parameter that is hardly meant",
                       "Of <" + name + ">: " + text);
        locks = locks || materials[m]->shear_modulus() *
                             materials[m]->inverse_bulk_modulus() <
                           1 / nearly_incompressible;
      }
    if (!scene.mixed() && (locks || scene.may_yield))
      warnings.add(
        "elements that lock",
        std::string("<Formulation/Type = u>: ") +
          (locks ? "with a <Poisson ratio> near 0.5" :
                   "where the material yields and keeps its volume") +
          " linear displacements are too stiff, forces and limit loads too "
          "large and pressures wrong, by half and more on coarse grids. Use "
          "<Formulation/Type = u-p>, unless this is what you want to see.");
  }



  void
  check_supports(const SparseSystem &matrix, Warnings &warnings)
  {
    constexpr unsigned int      most   = 3;
    const std::vector<FreeBody> bodies = find_free_bodies(matrix);
    if (bodies.empty())
      return;
    std::ostringstream text;
    text.precision(4);
    text << "Nothing holds "
         << (bodies.size() == 1 ? "a body" :
                                  std::to_string(bodies.size()) + " bodies")
         << " against: ";
    for (unsigned int b = 0; b < std::min<std::size_t>(bodies.size(), most);
         ++b)
      {
        text << (b > 0 ? "; " : "");
        for (unsigned int m = 0; m < bodies[b].motions.size(); ++m)
          text << (m > 0 ? ", " : "") << bodies[b].motions[m];
        text << " (the one around (";
        for (unsigned int d = 0; d < bodies[b].centre.size(); ++d)
          text << (d > 0 ? ", " : "") << bodies[b].centre[d];
        text << "), " << bodies[b].n_equations << " displacement equations)";
      }
    if (bodies.size() > most)
      text << "; ...";
    text << ". In statics the displacement is then not unique, and there is no "
            "equilibrium if a load acts along such a motion. Hold the body by "
            "<Boundary conditions/Displacement> or a section <Interaction: "
            "name - place>, or give it inertia: <Dynamics/Inertia = true>.";
    warnings.add("a body that nothing holds", text.str());
  }



  /** In the mixed form warn of materials of different groups that meet at
   * nodes, where the mean stress may jump, but not p. Whether it jumps depends
   * on the loads. At the start. Collective. */
  template <int dim>
  static void
  check_interfaces(const StepContext<dim> &step)
  {
    const MaterialGroups groups(step.kernel, much_stiffer);
    if (!step.mixed() || groups.size() < 2)
      return;
    const PressureGroups pressures(step, groups);
    unsigned int         n_between = 0, n_all = 0;
    for (std::size_t v = 0; v < step.grid.geometry().vertices().size(); ++v)
      {
        n_all += pressures.has_any(v) ? 1 : 0;
        n_between += pressures.has_several(v) ? 1 : 0;
      }
    if (n_between > 0)
      step.warnings.add(
        "materials that share pressures",
        "Materials of other stiffness (shear or bulk moduli that differ by "
        "more than half, or laws that yield) meet at " +
          rounded(100. * n_between / n_all) +
          " % of the nodes of the body. The mean stress may jump there, but "
          "the pressure of <Formulation/Type = u-p> can't. Where it does, it "
          "is wrong in the cells along the interface, and with it "
          "displacements and forces, by about as much as these cells are of "
          "the layers (7 to 32 % with four cells across each, if moduli differ "
          "by 100 to 1). Where both are nearly incompressible, the one that is "
          "less so makes the other one give way as it does itself: the "
          "compression of a layer may be several times too large. Nothing is "
          "wrong where the mean stress does not jump, as of layers with the "
          "same Poisson's ratio under a load across them. In "
          "statics, with <Quadrature/Type = CPDI>, each material has pressures "
          "of its own, if they are two to three cells thick at least: use it, "
          "or take smaller cells.");
  }



  template <int dim>
  void
  check_first_step(const Scene<dim>       &scene,
                   const StepContext<dim> &step,
                   const SparseSystem     &matrix)
  {
    step.grid.check_motion(step.warnings);
    check_body(step);
    check_interfaces(step);
    check_materials(scene, step.warnings);
    scene.shape.check_mesh(step.warnings);
    scene.points.check_seeding(scene.quadrature->needs_domains(),
                               step.warnings);
    for (const auto &condition : scene.boundary_conditions)
      condition->check_scene(step);
    for (const auto &postprocessor : scene.postprocessors)
      postprocessor->check_scene(step);
    if (!scene.has_inertia())
      check_supports(matrix, step.warnings);
    if (scene.mixed() && scene.kernel.ppp_coefficient == 0)
      step.warnings.add(
        "pressures without stabilisation",
        "<Formulation/Stabilisation = none> or <PPP coefficient = 0>: "
        "displacements and pressures of the same order are not stable "
        "together. Pressures may oscillate from node to node" +
          std::string(scene.may_yield ?
                        ", and a body that yields and is unloaded may end in a "
                        "wrong state" :
                        "") +
          ". Set <Formulation/Stabilisation = PPP>, unless this is what you "
          "want to see.");
    constexpr double soft_coefficient = 8; // as in the paper
    if (scene.kernel.ppp_coefficient > soft_coefficient)
      step.warnings.add(
        "a stabilisation that softens",
        "<Formulation/PPP coefficient> = " +
          rounded(scene.kernel.ppp_coefficient) +
          ": the stabilisation takes pressures that vary within a cell for "
          "oscillations and lets the volume change there. A body that bends "
          "is then too soft (a beam with 4 cells over its height bends too "
          "much by 20 % with 8 and by 48 % with 20), and finer grids cure it "
          "slowly. Take 1, unless this is what you want to see.");
    bool may_let_go = false;
    for (const auto &condition : scene.boundary_conditions)
      if (const auto *const interactions =
            dynamic_cast<const InteractionTerm<dim> *>(condition.get()))
        may_let_go = may_let_go || interactions->may_let_go();
    if (scene.mixed() && !may_let_go && has_free_pressure(matrix))
      step.warnings.add(
        "a pressure that nothing determines",
        "The material is incompressible (<Material/Poisson ratio> = 0.5) and "
        "the whole surface of the body is held, so that a pressure that is "
        "the same everywhere acts on nothing: pressures are known up to a "
        "constant only, which may be anything and change from step to step. "
        "Look at differences of pressure, leave a part of the surface free, or "
        "let the material be compressible (0.4999).");
  }



  template <int dim>
  void
  warn_of_rounding(Scene<dim>         &scene,
                   const NewtonReport &newton,
                   const double        zero_force)
  {
    constexpr double small = 0.01, large = 1e6;
    const double     residual = newton.iterations.back().displacement;
    // a body at rest, or carried along, has no other forces
    if (scene.has_inertia() || residual <= small ||
        newton.force_scale <= large * zero_force)
      return;
    std::ostringstream text;
    text.precision(2);
    text << "At t = " << scene.time.next_time()
         << " the residual forces that remain are " << 100 * residual
         << " % of the forces: less can't be told from rounding, as the forces "
            "are tiny beside the stiffness. Are loads and <Material/Young "
            "modulus> in the same units?";
    scene.warnings.add("forces near rounding", text.str());
  }



  template <int dim>
  void
  warn_of_instability(Scene<dim>             &scene,
                      const StepContext<dim> &step,
                      const long              n_modes)
  {
    scene.warnings.add(
      "an equilibrium that isn't stable",
      "The step to t = " + rounded(step.time) + " (from " +
        rounded(step.old_time) +
        ") has found an equilibrium in which the matrix has " +
        std::to_string(n_modes) +
        " negative pivot(s) of displacements; where the body is stable it has "
        "none. The body would leave it at the least disturbance, as a column "
        "that stays straight beyond its buckling load: its loads are beyond "
        "what it can carry, and what follows is hardly what a real body does. "
        "(Where nothing can buckle, as in a body that is strongly pressed or "
        "stretched on a grid that is put back, it may be modes of the grid: "
        "compare with smaller cells, or a grid that is kept.) "
        "To follow that, give it a larger imperfection or disturbance, and "
        "smaller steps up to here, prescribe displacements instead of loads, "
        "or give it inertia (<Dynamics/Inertia = true>). It is told once only.");
  }



  template <int dim>
  void
  warn_if_nothing_moves(Scene<dim>         &scene,
                        const NewtonReport &newton,
                        const NodalField   &unknowns)
  {
    // in dynamics the trial steps may have left nothing to iterate on
    if (scene.time.step == 0 && newton.n_iterations() == 0 &&
        unknowns.linfty_norm() == 0)
      scene.warnings.add(
        "nothing loads the scene",
        "The first step, to t = " + std::to_string(scene.time.next_time()) +
          ", needed no iteration: no load and no displacement acts on the body "
          "up to then. That is as it should be if they begin later. Otherwise "
          "set loads in <Boundary conditions> or <Dynamics/Initial velocity>.");
  }



  template void
  check_body<2>(const StepContext<2> &);
  template void
  check_body<3>(const StepContext<3> &);
  template void
  check_first_step<2>(const Scene<2> &,
                      const StepContext<2> &,
                      const SparseSystem &);
  template void
  check_first_step<3>(const Scene<3> &,
                      const StepContext<3> &,
                      const SparseSystem &);
  template void
  warn_of_rounding<2>(Scene<2> &, const NewtonReport &, const double);
  template void
  warn_of_rounding<3>(Scene<3> &, const NewtonReport &, const double);
  template void
  warn_of_instability<2>(Scene<2> &, const StepContext<2> &, const long);
  template void
  warn_of_instability<3>(Scene<3> &, const StepContext<3> &, const long);
  template void
  warn_if_nothing_moves<2>(Scene<2> &,
                           const NewtonReport &,
                           const NodalField &);
  template void
  warn_if_nothing_moves<3>(Scene<3> &,
                           const NewtonReport &,
                           const NodalField &);
} // namespace isochor
