/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// With CPDI a homogeneous stress is in equilibrium with its load on the surface
// of the body, wherever this lies in the cells, and with the penalty that moves
// a surface. The exact solutions are those of the Neo-Hookean law,
// F = diag(stretches).

#include "mesh_file.h"

using namespace isochor;

namespace
{
  bool                recording = false;
  std::vector<double> reactions;
} // namespace

namespace isochor
{
  template <int dim>
  class Watch : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &, Statistics &statistics) override
    {
      if (recording)
        reactions.push_back(statistics.get("Force x on tip by place (N)"));
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Watch, "Z: after all others")
} // namespace isochor

namespace
{
  constexpr double E = 100;

  double
  poisson_ratio(const std::string &formulation)
  {
    return formulation == "u" ? 0.3 : 0.499;
  }

  /** The principal values of P (Pa) at the stretches @p l. */
  std::array<double, 3>
  nominal_stress(const std::array<double, 3> &l, const std::string &formulation)
  {
    const double          nu = poisson_ratio(formulation);
    const double          G = E / (2 * (1 + nu)), K = E / (3 * (1 - 2 * nu));
    const double          J     = l[0] * l[1] * l[2];
    const double          third = (l[0] * l[0] + l[1] * l[1] + l[2] * l[2]) / 3;
    std::array<double, 3> P;
    for (unsigned int d = 0; d < 3; ++d)
      P[d] =
        (G * std::pow(J, -2. / 3) * (l[d] * l[d] - third) + K * (J - 1) * J) /
        l[d];
    return P;
  }

  /** Where the increasing @p function is zero. */
  double
  zero_of(const std::function<double(double)> &function,
          double                               lower,
          double                               upper)
  {
    for (unsigned int i = 0; i < 100; ++i)
      {
        const double middle                    = (lower + upper) / 2;
        (function(middle) < 0 ? lower : upper) = middle;
      }
    return (lower + upper) / 2;
  }

  std::string
  number(const double value)
  {
    return '(' + Utilities::to_string(value, 17) + ')';
  }

  std::string
  material(const std::string &formulation)
  {
    return "Quadrature/Type = CPDI\nNewton/Tolerance = 1e-12\n"
           "Material/Young modulus = " +
           number(E).substr(1, number(E).size() - 2) +
           "\nMaterial/Poisson ratio = " +
           Utilities::to_string(poisson_ratio(formulation)) +
           "\nFormulation/Type = " + formulation + '\n';
  }

  /** Compare displacements and stresses of all points with the exact ones. */
  template <int dim>
  void
  compare(const std::string              &name,
          const MaterialPointMethod<dim> &problem,
          const std::array<double, 3>    &l,
          const std::string              &formulation)
  {
    const std::array<double, 3> P      = nominal_stress(l, formulation);
    const double                J      = l[0] * l[1] * l[2];
    const PointLayout          &layout = problem.material_points().layout();
    double                      u = 0, stress = 0, largest = 0;
    for (unsigned int d = 0; d < 3; ++d)
      largest = std::max(largest, std::abs(P[d] * l[d] / J));
    for (const auto &particle : problem.material_points().handler())
      {
        const auto values = particle.get_properties();
        for (unsigned int d = 0; d < dim; ++d)
          test::add_error(u,
                          std::abs(values[layout.displacement + d] -
                                   (1 - 1 / l[d]) *
                                     particle.get_location()[d]));
        for (unsigned int i = 0; i < n_symmetric_components<dim>; ++i)
          test::add_error(stress,
                          std::abs(values[layout.stress + i] -
                                   (i < 3 ? P[i] * l[i] / J : 0.)));
      }
    test::check_error(name + ", " + formulation + ", dim " +
                        std::to_string(dim) + ": stress",
                      stress / largest,
                      1e-8);
    test::check_error("displacement", u, 1e-8);
  }
} // namespace

/** A block between smooth walls under a tenth of E, in as many steps as cells:
 * the loaded surface moves through two rows of them. */
void
test_pressed(const std::string &formulation,
             const std::string &load,
             const double       q)
{
  std::array<double, 3> l = {{1, 1, 1}};
  l[1]                    = zero_of(
    [&](const double y) {
      return nominal_stress({{1, y, 1}}, formulation)[1] - q;
    },
    0.5,
    2);
  const auto problem = test::run_scene<2>(
    material(formulation) +
    "Grid/Upper corner = 1, 1.25\nGrid/Subdivisions = 16, 20\n"
    "Grid/Diagonals = alternating\nTime/Step size = 0.1\n"
    "Material points/Region = y < 1\n"
    "Boundary conditions/Displacement = left: x=0; right: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = up: y > 0.999\n"
    "Boundary conditions/" +
    load + '\n');
  compare(load, *problem, l, formulation);
}

/** A bar is pulled at its end until it is twice as long, and contracts. */
template <int dim>
void
test_pulled(const std::string &formulation,
            const std::string &settings,
            const std::string &name)
{
  std::array<double, 3> l = {{1, 2, 1}};
  const double          x = zero_of(
    [&](const double x) {
      return nominal_stress({{x, 2, dim == 2 ? 1 : x}}, formulation)[0];
    },
    0.3,
    1.5);
  l[0]                 = x;
  l[2]                 = (dim == 2 ? 1 : x);
  const double q       = nominal_stress(l, formulation)[1];
  const auto   problem = test::run_scene<dim>(
    material(formulation) + "Time/Step size = 0.1\n" +
    "Boundary conditions/Displacement = left: x=0; bottom: y=0" +
    (dim == 3 ? "; front: z=0\n" : "\n") +
    "Boundary conditions/Surfaces of body = end: y > 0.599\n"
      "Boundary conditions/Traction on body = end: 0, t*" +
    number(q) + (dim == 3 ? ", 0\n" : "\n") + settings);
  compare(name, *problem, l, formulation);
}

template <int dim>
void
test_pulled(const std::string &formulation)
{
  test_pulled<dim>(formulation,
                   dim == 2 ? "Grid/Upper corner = 0.3, 1.3\n"
                              "Grid/Subdivisions = 3, 13\n"
                              "Material points/Region = x < 0.2 && y < 0.6\n" :
                              "Grid/Upper corner = 0.3, 1.3, 0.2\n"
                              "Grid/Subdivisions = 3, 13, 2\n"
                              "Material points/Region = x < 0.2 && y < 0.6 && "
                              "z < 0.1\n",
                   "a bar that is pulled");
}

/** A simplex, one face of which is inclined and loaded; its mesh is not that of
 * the grid. */
template <int dim>
void
test_inclined(const std::string           &formulation,
              const std::array<double, 3> &l,
              const bool                   by_pressure)
{
  const std::array<double, 3> lengths = {{0.83, 0.67, 0.74}};
  std::vector<Point<dim>>     vertices(dim + 1);
  CellData<dim>               cell(dim + 1);
  Tensor<1, dim>              normal;
  for (unsigned int d = 0; d < dim; ++d)
    {
      vertices[d + 1][d] = lengths[d];
      normal[d]          = 1 / lengths[d];
    }
  for (unsigned int v = 0; v <= dim; ++v)
    cell.vertices[v] = v;
  test::write_mesh<dim>("body.msh",
                        vertices,
                        {cell},
                        {},
                        [](const unsigned int, const unsigned int) {
                          return false;
                        });
  normal /= normal.norm();
  const auto  P = nominal_stress(l, formulation);
  std::string load;
  if (by_pressure)
    load = "Pressure on body = slope: t*" + number(-P[0] / (l[1] * l[2]));
  else
    for (unsigned int d = 0; d < dim; ++d)
      load += (d == 0 ? "Traction on body = slope: t*" : ", t*") +
              number(P[d] * normal[d]);
  const auto problem = test::run_scene<dim>(
    material(formulation) +
    (dim == 2 ? "Grid/Upper corner = 1.2, 1.2\nGrid/Subdivisions = 7, 7\n"
                "Material points/Points per cell = 64\n" :
                "Grid/Upper corner = 1.2, 1.2, 1.2\n"
                "Grid/Subdivisions = 6, 6, 6\n"
                "Material points/Points per cell = 216\n") +
    "Time/Step size = 0.25\nMaterial points/Body mesh = body.msh\n"
    "Boundary conditions/Mesh of body surfaces = body.msh\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0" +
    (dim == 3 ? "; front: z=0\n" : "\n") +
    "Boundary conditions/Surfaces of body = slope: x/0.83 + y/0.67" +
    (dim == 3 ? " + z/0.74 > 0.999\n" : " > 0.999\n") + "Boundary conditions/" +
    load + '\n');
  compare(by_pressure ? "an inclined face under pressure" :
                        "an inclined face under traction",
          *problem,
          l,
          formulation);
}

/** An incompressible block is pressed to 0.6 of its height by a plate that is a
 * surface of the body. Its penalty leaves a gap, the same everywhere. */
void
test_squeezed()
{
  const auto problem = test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 2, 1\n"
    "Grid/Subdivisions = 20, 10\nMaterial points/Region = x < 1\n"
    "Material/Young modulus = 3\nMaterial/Poisson ratio = 0.5\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
    "Boundary conditions/Surfaces of body = plate: y > 0.999\n"
    "Interaction: plate - place/Displacement = y = -0.4*t\n"
    "Time/Step size = 0.02\nPostprocess/Reactions = bottom\n");
  const PointLayout &layout = problem->material_points().layout();
  double             worst = 0, lambda = 0;
  for (const auto &particle : problem->material_points().handler())
    lambda = std::max(lambda, particle.get_properties()[layout.F + 3]);
  lambda = Utilities::MPI::max(lambda, MPI_COMM_WORLD);
  for (const auto &particle : problem->material_points().handler())
    {
      const double *F = &particle.get_properties()[layout.F];
      test::add_error(worst, std::abs(F[0] - 1 / lambda));
      test::add_error(worst, std::abs(F[1]));
      test::add_error(worst, std::abs(F[2]));
      test::add_error(worst, std::abs(F[3] - lambda));
    }
  test::check_error("a squeezed block is strained alike everywhere",
                    worst,
                    1e-7);
  test::check_error("the gap at the plate", std::abs(lambda - 0.6), 1e-3);
  test::check_error("the plate's load",
                    test::relative(test::get(*problem,
                                             "Reaction y on bottom (N)"),
                                   std::pow(lambda, -3) - lambda),
                    1e-7);
}

/** The force of a surface that begins to move, over two periods of the waves in
 * a bar, gives it its momentum: at the start of each step, too, from which
 * the step's acceleration follows. */
void
test_pushed()
{
  recording = true;
  test::run_scene<2>(
    "Quadrature/Type = CPDI\nGrid/Upper corner = 1.5, 0.2\n"
    "Grid/Subdivisions = 15, 2\nMaterial points/Region = x < 1\n"
    "Formulation/Type = u\nMaterial/Young modulus = 1e4\n"
    "Material/Poisson ratio = 0\nMaterial/Density = 1\n"
    "Boundary conditions/Displacement = bottom: y=0; top: y=0\n"
    "Boundary conditions/Surfaces of body = tip: x > 0.999\n"
    "Interaction: tip - place/Displacement = x=0.05*(1-cos(pi*t))\n"
    "Dynamics/Inertia = true\nTime/End time = 0.08\n"
    "Time/Step size = 0.005\n");
  recording      = false;
  double impulse = -0.005 / 2 * reactions.back();
  for (const double force : reactions)
    impulse += 0.005 * force;
  const double pi = numbers::PI;
  test::check_error("the impulse on a bar",
                    test::relative(impulse,
                                   0.2 * 0.05 * pi * std::sin(0.08 * pi)),
                    0.05);
}

/** A region that ends within cells: the load acts on the faces of the domains
 * that there are, and is in equilibrium with them. */
void
test_rounded_region()
{
  const auto problem = test::run_scene<2>(
    material("u") +
    "Grid/Subdivisions = 5, 5\nMaterial points/Region = x < 0.43\n"
    "Boundary conditions/Displacement = left: x=0; bottom: y=0\n"
    "Boundary conditions/Traction = top: 0, -t\n");
  const double area = test::get(*problem, "Material volume (m^2)") /
                      test::get(*problem, "Largest J");
  test::check_error("a region that is rounded: load",
                    test::relative(test::get(*problem, "Load y on top (N)"),
                                   -test::get(*problem, "Time (s)") * area),
                    1e-8);
  test::check_error("a region that is rounded: volumes",
                    test::get(*problem, "Largest J") -
                      test::get(*problem, "Smallest J"),
                    1e-8);
}

int
main(int argc, char **argv)
{
  Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const std::string formulation : {"u", "u-p"})
    {
      test_pressed(formulation, "Traction on body = up: 0, -10*t", -10);
      test_pressed(formulation, "Pressure on body = up: 10*t", -10);
      test_pressed(formulation, "Traction on body = up: 0, 10*t", 10);
      test_pulled<2>(formulation);
      test_pulled<3>(formulation);
      test_pulled<2>(formulation,
                     "Grid/Type = adaptive\nGrid/Coarse cells = box\n"
                     "Grid/Upper corner = 0.4, 1.6\nGrid/Subdivisions = 2, 8\n"
                     "Adaptive grid/Maximum level = 3\n"
                     "Adaptive grid/Minimum level = 1\n"
                     "Adaptive grid/Cell size = if(abs(y - 0.8) < 0.1, 0.025, "
                     "0.1)\n"
                     "Material points/Region = x < 0.2 && y < 0.6\n",
                     "a bar pulled through a fine band");
      const double p = (formulation == "u" ? 0.95 : 0.999);
      test_inclined<2>(formulation, {{1.15, 1.001 / 1.15, 1}}, false);
      test_inclined<2>(formulation, {{p, p, 1}}, true);
      test_inclined<3>(formulation, {{1.1, 0.95, 1.001 / 1.045}}, false);
      test_inclined<3>(formulation, {{p, p, p}}, true);
    }
  test_squeezed();
  test_pushed();
  test_rounded_region();
  return 0;
}
