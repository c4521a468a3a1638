/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// Dynamics: what energy and momenta do, the acceleration a body starts with,
// and prescribed motions from rest.

#include <algorithm>
#include <map>

#include "scene.h"

using namespace isochor;

/** Columns of the statistics, a value per step, of the scene run last. */
std::map<std::string, std::vector<double>> &
columns()
{
  static std::map<std::string, std::vector<double>> c;
  return c;
}

namespace isochor
{
  /** Fills columns(). */
  template <int dim>
  class Columns : public Postprocessor<dim>
  {
  public:
    void
    evaluate_points(const StepResult<dim> &result,
                    Statistics            &statistics) override
    {
      if (result.time.step == 1)
        columns().clear();
      for (const std::string name :
           {"Kinetic energy (J)",
            "Strain energy (J)",
            "Plastic work (J)",
            "External work (J)",
            "Energy lost by the scheme (J)",
            "Momentum x (kg m/s)",
            "Momentum y (kg m/s)",
            "Angular momentum z (kg m^2/s)",
            "Reaction x on left (N)",
            "Reaction x on right (N)",
            "Reaction y on bottom (N)"})
        try
          {
            columns()[name].push_back(statistics.get(name));
          }
        catch (const std::exception &)
          {}
    }
  };
  ISOCHOR_REGISTER_FOR_DIMENSION(Postprocessor, Columns, "Z: after all others")
} // namespace isochor

/** Kinetic and strain energy after each step; the first entry is the energy at
 * the start, of a body that nothing acts on. */
std::vector<double>
total_energy()
{
  std::vector<double> energy;
  const auto         &kinetic = columns()["Kinetic energy (J)"];
  const auto         &strain  = columns()["Strain energy (J)"];
  energy.push_back(kinetic[0] + strain[0] - columns()["External work (J)"][0] +
                   columns()["Energy lost by the scheme (J)"][0]);
  for (unsigned int i = 0; i < kinetic.size(); ++i)
    energy.push_back(kinetic[i] + strain[i]);
  return energy;
}

/** A free elastic square that turns once in 50 steps. At the start it isn't
 * stretched, so that it breathes, too. */
void
test_spin(const std::string &quadrature, const std::string &formulation)
{
  test::run_scene<2>(
    "Quadrature/Type = " + quadrature + "\nFormulation/Type = " + formulation +
    "\nGrid/Lower corner = -1, -1\nGrid/Upper corner = 1, 1\n"
    "Grid/Subdivisions = 10, 10\nMaterial points/Points per cell = 4\n"
    "Material points/Region = abs(x) < 0.5 && abs(y) < 0.5\n"
    "Material/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
    "Dynamics/Inertia = true\nDynamics/Initial velocity = -y, x\n"
    "Ghost penalty/Use = never\n"
    "Time/End time = 2*pi\nTime/Step size = 0.12566370614359172\n");
  const auto energy = total_energy();
  const auto &L     = columns()["Angular momentum z (kg m^2/s)"];
  const std::string what = "spin, " + quadrature + ", " + formulation + ", ";
  double            spin = 0, momentum = 0;
  for (unsigned int i = 0; i < L.size(); ++i)
    {
      test::add_error(spin, std::abs(L[i] / L[0] - 1));
      test::add_error(momentum,
                      std::hypot(columns()["Momentum x (kg m/s)"][i],
                                 columns()["Momentum y (kg m/s)"][i]) /
                        1000);
    }
  test::check_error(what + "energy lost", 1 - energy.back() / energy[0], 0.01);
  test::check_error(what + "energy gained",
                    *std::max_element(energy.begin(), energy.end()) /
                        energy[0] -
                      1,
                    1e-3);
  test::check_error(what + "angular momentum", spin, 1e-3);
  test::check_error(what + "momentum", momentum, 1e-12);
}
