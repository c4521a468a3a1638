/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <deal.II/base/mpi.h>

#include <isochor/base/plain_message.h>
#include <isochor/interaction/interaction_checks.h>

#include <algorithm>
#include <array>
#include <limits>

namespace isochor
{
  namespace
  {
    /** Number and area of faces, and the box around them. */
    template <int dim>
    struct Extent
    {
      double n = 0, area = 0;
      /** Largest x, y(, z) and largest -x, -y(, -z). */
      std::array<double, 2 * dim> largest;

      Extent(const std::vector<typename BodySurface<dim>::Face> &faces,
             const MPI_Comm                                      comm)
      {
        largest.fill(std::numeric_limits<double>::lowest());
        for (const auto &face : faces)
          {
            n += 1;
            area += face.area;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double x =
                    face.reference[d] +
                    BodySurface<dim>::corner_at_start(face, i)[d];
                  largest[d]       = std::max(largest[d], x);
                  largest[dim + d] = std::max(largest[dim + d], -x);
                }
          }
        n    = Utilities::MPI::sum(n, comm);
        area = Utilities::MPI::sum(area, comm);
        Utilities::MPI::max(ArrayView<const double>(largest.data(), 2 * dim),
                            comm,
                            ArrayView<double>(largest.data(), 2 * dim));
      }

      std::string
      text() const
      {
        std::string text = rounded(n) + (n == 1 ? " face, " : " faces, ") +
                           rounded(area) + (dim == 2 ? " m in " : " m^2 in ");
        // without the last digits of corners
        const double size =
          8 * *std::max_element(largest.begin(), largest.end());
        for (unsigned int d = 0; d < dim; ++d)
          text += (d > 0 ? " x [" : "[") +
                  rounded(size - largest[dim + d] - size) + ", " +
                  rounded(largest[d] + size - size) + "]";
        return text;
      }
    };
  } // namespace



  template <int dim>
  std::string
  check_faces(
    const std::vector<std::unique_ptr<Interaction<dim>>>     &interactions,
    const FacesOfInteractions<dim>                           &faces,
    const std::vector<std::pair<unsigned int, unsigned int>> &tied_twice,
    const MPI_Comm                                            comm)
  {
    const unsigned int        n = interactions.size();
    std::vector<unsigned int> both_tie(n * n);
    for (const auto &[i, j] : tied_twice)
      both_tie[i * n + j] = 1;
    Utilities::MPI::max(both_tie, comm, both_tie);
    std::string found;
    for (unsigned int i = 0; i < n; ++i)
      {
        const Interaction<dim> &one = *interactions[i];
        const Extent<dim>       extent(faces[i], comm);
        AssertThrow(extent.n > 0, ExcMessage(one.what_is_missing()));
        found += (i > 0 ? "\n<" : "<") + one.title() + ">: " + extent.text();
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
              const FacesOfInteractions<2> &,
              const std::vector<std::pair<unsigned int, unsigned int>> &,
              const MPI_Comm);
  template std::string
  check_faces(const std::vector<std::unique_ptr<Interaction<3>>> &,
              const FacesOfInteractions<3> &,
              const std::vector<std::pair<unsigned int, unsigned int>> &,
              const MPI_Comm);
} // namespace isochor
