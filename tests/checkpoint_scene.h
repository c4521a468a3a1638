/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_test_checkpoint_scene_h
#define isochor_test_checkpoint_scene_h

// A scene in which points change cells and ranks all the time, and its runs.

#include <isochor/base/parameter_file.h>
#include <isochor/step/material_point_method.h>

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "scene.h"

constexpr unsigned int dim = 2;

using namespace isochor;

// A block flies and turns through the grid under gravity and deforms: its
// points change cells and ranks in every step.
inline const char *const scene = R"(
  subsection Grid
    set Type         = box
    set Upper corner = 4, 4
    set Subdivisions = 20, 20
  end
  subsection Material points
    set Points per cell = 3
    set Region          = (x-1.2)*(2.2-x)*if(y>1,1,0)*if(y<2.4,1,0)
  end
  subsection Material
    set Young modulus = 1e4
    set Poisson ratio = 0.4
    set Density       = 100
  end
  subsection Dynamics
    set Inertia          = true
    set Initial velocity = 3 - 2*(y-1.7), 1 + 2*(x-1.7)
  end
  subsection Time
    set End time        = 0.16
    set Step size       = 0.02
    set Output interval = 0.04
  end
  subsection Boundary conditions
    set Gravity = 0, -9.81
  end
  subsection Postprocess
    set Point probes = centre: 1.7, 1.7
  end
  subsection Output
    set Terminal = quiet
  end
  subsection Checkpoint
    set Interval = 2
  end)";



struct Result
{
  std::string         error;
  std::vector<double> points; ///< of this rank, in the handler's order
};



inline Result
run(const MPI_Comm                                         &comm,
    const std::string                                      &directory,
    const std::vector<std::pair<std::string, std::string>> &settings = {})
{
  ParameterHandler prm;
  std::string      names;
  for (const auto &setting : settings)
    names += setting.first + '\n';
  MaterialPointMethod<dim>::declare_parameters(prm, test::sections_of(names));
  prm.parse_input_from_string(scene);
  prm.enter_subsection("Output");
  prm.set("Directory", directory);
  prm.leave_subsection();
  // MUMPS on several ranks adds in the order in which messages come: two runs
  // differ by rounding, interrupted or not
  if (Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    {
      prm.enter_subsection("Linear solver");
      prm.set("Solver", "Amesos");
      prm.leave_subsection();
    }
  for (const auto &setting : settings)
    apply_parameters(
      {parse_override(setting.first + "=" + setting.second, "test")}, prm);
  create_output_directory(directory, comm);

  Result                   result;
  MaterialPointMethod<dim> problem(comm);
  try
    {
      problem.parse_parameters(prm);
      problem.run();
    }
  catch (const ExceptionBase &exception)
    {
      std::ostringstream text;
      exception.print_info(text);
      result.error = Utilities::trim(text.str());
    }
  const auto &handler = problem.material_points().handler();
  for (const auto &particle : handler)
    {
      result.points.push_back(particle.get_id());
      for (unsigned int d = 0; d < dim; ++d)
        result.points.push_back(particle.get_location()[d]);
      for (const double value : particle.get_properties())
        result.points.push_back(value);
    }
  return result;
}

#endif
