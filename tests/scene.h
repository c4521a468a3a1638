/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_tests_scene_h
#define isochor_tests_scene_h

// Scenes run through the library, for tests that look into the problem. Where
// run_scene.h alone has all that a test needs, it is compiled much faster.

#include <deal.II/base/mpi.h>

#include <isochor/step/material_point_method.h>

#include <fstream>

#include "run_scene.h"

namespace isochor
{
  namespace test
  {
    /** Set the parameters listed in @p settings, one "Section/Name = value" a
     * line. */
    void
    set_parameters(ParameterHandler &prm, const std::string &settings);

    /** The sections that these name, with @p n_materials at least. */
    SceneSections
    sections_of(const std::string &settings, unsigned int n_materials = 1);

    /** As get(), of three columns: of the x in @p column, and of y and z in its
     * place. */
    inline Tensor<1, 3>
    get_vector(const MaterialPointMethod<3> &problem, const std::string &column)
    {
      const auto   x = column.find(" x ") + 1;
      Tensor<1, 3> v;
      for (unsigned int a = 0; a < 3; ++a)
        v[a] = get(problem, std::string(column).replace(x, 1, 1, "xyz"[a]));
      return v;
    }
  } // namespace test
} // namespace isochor

#endif
