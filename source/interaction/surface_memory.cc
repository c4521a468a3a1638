/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/surface_memory.h>

#include <limits>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  SurfaceMemory<dim>::send(const BodySurface<dim> &surface, const MPI_Comm comm)
  {
    std::map<std::uint64_t, OfFace> kept;
    const auto                      take = [&](auto &from) {
      for (const auto &face : surface.faces())
        {
          const auto found = from.find(BodySurface<dim>::key(face));
          if (found != from.end())
            kept.insert(from.extract(found));
        }
    };
    take(faces);
    // what is left belongs to points that went to other ranks
    using Orphans = std::vector<std::pair<std::uint64_t, OfFace>>;
    std::map<std::uint64_t, OfFace> others;
    for (const Orphans &orphans :
         Utilities::MPI::all_gather(comm, Orphans(faces.begin(), faces.end())))
      others.insert(orphans.begin(), orphans.end());
    take(others);
    faces.swap(kept);
  }



  template <int dim>
  std::string
  SurfaceMemory<dim>::save(const MPI_Comm comm) const
  {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, faces))
      for (const auto &[key, face] : of_rank)
        {
          text << key << ' ' << face.kept;
          for (const Tensor<1, dim> &vector : face.at)
            text << ' ' << vector;
          text << '\n';
        }
    return text.str();
  }



  template <int dim>
  void
  SurfaceMemory<dim>::load(const std::string &state)
  {
    std::istringstream text(state);
    std::uint64_t      key;
    while (text >> key)
      {
        OfFace &face = faces[key];
        text >> face.kept;
        for (Tensor<1, dim> &vector : face.at)
          for (unsigned int d = 0; d < dim; ++d)
            text >> vector[d];
      }
  }



  template class SurfaceMemory<2>;
  template class SurfaceMemory<3>;
} // namespace isochor
