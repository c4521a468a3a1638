/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

#include "../scene_messages.h"

#include <isochor/base/explanation.h>

#include <algorithm>

#include "../scene.h"

template <int dim>
std::string
messages(const std::string &settings,
         const bool         validate,
         const unsigned int n_materials)
{
  ParameterHandler prm;
  MaterialPointMethod<dim>::declare_parameters(prm,
                                               test::sections_of(settings,
                                                                 n_materials));
  test::set_parameters(prm,
                       "Output/Directory = scene_checks\n"
                       "Output/Terminal = quiet\n"
                       "Postprocess/Write grid = false\n"
                       "Postprocess/Write material points = false\n" +
                         settings);
  MaterialPointMethod<dim> problem(MPI_COMM_WORLD);
  std::string              text;
  std::ostringstream       errors; // where warnings are printed, too
  std::streambuf *const    original = std::cerr.rdbuf(errors.rdbuf());
  try
    {
      problem.parse_parameters(prm);
      validate ? problem.validate() : problem.run();
    }
  catch (const std::exception &exc)
    {
      text = std::string("ERROR ") + exc.what() + ' ';
    }
  std::cerr.rdbuf(original);
  for (const auto &warning : problem.all_warnings().all())
    {
      text += "WARNING " + warning.subject + " | " + warning.text + ' ';
      const std::string printed =
        Warnings::printed(warning.subject, warning.text);
      if (find_explanation(warning.subject) == nullptr)
        text += "ERROR of the test: it is not explained ";
      if (std::count(printed.begin(), printed.end(), '\n') > 2)
        text += "ERROR of the test: it has more than three lines ";
    }
  return test::one_line(text);
}

template std::string
messages<2>(const std::string &, const bool, const unsigned int);
template std::string
messages<3>(const std::string &, const bool, const unsigned int);
