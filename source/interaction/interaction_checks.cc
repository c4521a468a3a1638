/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/interaction/interaction_checks.h>

namespace isochor
{
  template <int dim>
  std::string
  check_faces(
    const std::vector<std::unique_ptr<Interaction<dim>>>     &interactions,
    const std::vector<std::vector<double>>                   &areas_here,
    const std::vector<std::pair<unsigned int, unsigned int>> &tied_twice,
    const MPI_Comm                                            comm)
  {
    const unsigned int        n = interactions.size();
    std::vector<unsigned int> n_faces(n), both_tie(n * n);
    std::vector<double>       areas(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        n_faces[i] = areas_here[i].size();
        for (const double area : areas_here[i])
          areas[i] += area;
      }
    for (const auto &[i, j] : tied_twice)
      both_tie[i * n + j] = 1;
    Utilities::MPI::sum(n_faces, comm, n_faces);
    Utilities::MPI::sum(areas, comm, areas);
    Utilities::MPI::max(both_tie, comm, both_tie);
    std::string found;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Interaction<dim> &one = *interactions[i];
        AssertThrow(n_faces[i] > 0,
                    ExcMessage(
                      "The section <" + one.section + "> acts on nothing: " +
                      (one.region ?
                         "<" + one.region->parameter + " = " + one.body + ": " +
                           one.region->condition +
                           "> has the centre of no face of a body's "
                           "surface at t = 0." :
                         "the body <" + one.body + "> has no surface.")));
        found += (i > 0 ? "\n<" : "<") + one.section +
                 ">: " + std::to_string(n_faces[i]) +
                 (n_faces[i] == 1 ? " face, " : " faces, ") +
                 rounded(areas[i]) + (dim == 2 ? " m" : " m^2");
        for (unsigned int j = 0; j < n; ++j)
          AssertThrow(both_tie[i * n + j] == 0,
                      ExcMessage("The sections <" + one.section + "> and <" +
                                 interactions[j]->section +
                                 "> tie the same faces. Leave what they have "
                                 "in common out of one of them, or make it a "
                                 "surface of its own."));
      }
    return found;
  }



  template std::string
  check_faces(const std::vector<std::unique_ptr<Interaction<2>>> &,
              const std::vector<std::vector<double>> &,
              const std::vector<std::pair<unsigned int, unsigned int>> &,
              const MPI_Comm);
  template std::string
  check_faces(const std::vector<std::unique_ptr<Interaction<3>>> &,
              const std::vector<std::vector<double>> &,
              const std::vector<std::pair<unsigned int, unsigned int>> &,
              const MPI_Comm);
} // namespace isochor
