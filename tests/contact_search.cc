/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */

// The search for the nodes that a one-sided wall holds: it ends with none that
// objects, or with an error, never quietly; and a step that is cut begins with
// the nodes of the last step that was accepted, not with those of the failure.

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/boundary_condition/contact_search.h>

#include "run_scene.h"

using namespace isochor;

/** A node that objects to both of its sides, beside one that is content: as in
 * a body that has no equilibrium with either. */
void
test_unsettled()
{
  WallNode                      node, other;
  const std::vector<WallNode *> nodes = {&node, &other};
  ContactSearch                 search;
  search.start();
  ContactChange change;
  unsigned int  n_changes = 0;
  bool          in_turn   = true;
  do
    {
      const bool was_released = node.released;
      change  = search.change({was_released ? penetrates : pulls, none},
                             true,
                             nodes,
                             "Boundary conditions/Walls",
                             "bottom");
      in_turn = in_turn && node.released != was_released && !other.released;
      n_changes += change.any ? 1 : 0;
    }
  while (change.any && n_changes < 1000);
  test::check("an objection is never passed over",
              n_changes > 10 && n_changes < 1000,
              std::to_string(n_changes));
  test::check("contact that does not settle is an error",
              change.failure.find("the contact of <Boundary conditions/Walls> "
                                  "on <bottom> does not settle") == 0,
              change.failure);
  search.start();
  test::check("the next search begins anew",
              search.change({pulls, none}, true, nodes, "", "").any,
              "failed");
}

/** A block on a wall is pressed more at its left than at its right end, which
 * lifts. The step is tried as a whole, fails, and is cut: from there on all is
 * as if the half had been asked for. */
void
test_cut_step()
{
  const std::string block =
    "Grid/Upper corner = 2.5, 1\nGrid/Subdivisions = 20, 8\nMaterial "
    "points/Region = x < 2\nFormulation/Type = u\nMaterial/Young modulus = 1e4\nMaterial/Poisson ratio = 0.3\n"
    "Boundary conditions/Displacement = left: x=0; top: x=0, y = 0.2*t*(x-2.2); bottom: y "
    ">= 0\nPostprocess/Reactions = bottom\nNewton/Maximum iterations = 4\n"
    "Newton/Reuse factorisation = 0\nNewton/Predictor = none\n"
    "Time/Growth factor = 1\nTime/End time = 1\n";
  const std::string force = "Reaction y on bottom (N)";
  test::record_columns({force});
  test::run_scene<2>(block + "Time/Step size = 0.5\n");
  const test::Recorded halves = test::recorded();
  test::run_scene<2>(block + "Time/Step size = 1\n");
  const test::Recorded &cut = test::recorded();
  test::check("the step was cut", cut.times.front() == 0.5, "");
  test::check("the same steps from there on",
              cut.times == halves.times,
              std::to_string(cut.times.size()));
  bool same = true;
  for (unsigned int i = 0; i < cut.newton.size(); ++i)
    same = same && i < halves.newton.size() &&
           cut.newton[i].n_iterations() == halves.newton[i].n_iterations();
  test::check("the same iterations", same, "");
  test::check("the same forces",
              cut.columns.at(force) == halves.columns.at(force),
              "");
}

int
main(int argc, char **argv)
{
  test::MPISession mpi(argc, argv);
  test_unsettled();
  test_cut_step();
}
