/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_surface_memory_h
#define isochor_surface_memory_h

#include <isochor/equations/body_surface.h>

#include <map>
#include <string>

namespace isochor
{
  /** What is remembered of the faces of surfaces from step to step: a vector at
   * each Gauss point, and a number. */
  template <int dim>
  class SurfaceMemory
  {
  public:
    /** Of Gauss point @p g of the face with this BodySurface::key(); zero if
     * nothing is known of it. */
    Tensor<1, dim>
    get(const std::uint64_t key, const unsigned int g) const
    {
      const auto found = faces.find(key);
      return found == faces.end() ? Tensor<1, dim>() : found->second.at[g];
    }
    /** Of the face; 1 if nothing is known of it. */
    double
    kept(const std::uint64_t key) const
    {
      const auto found = faces.find(key);
      return found == faces.end() ? 1. : found->second.kept;
    }

    bool
    knows(const std::uint64_t key) const
    {
      return faces.count(key) > 0;
    }

    /** Note both at the end of the step. */
    void
    set_next(const std::uint64_t   key,
             const unsigned int    g,
             const Tensor<1, dim> &vector,
             const double          kept = 1)
    {
      OfFace &face = next[key];
      face.at[g]   = vector;
      face.kept    = kept;
    }
    /** The step has converged: forget what was noted before. */
    void
    start_noting()
    {
      next.clear();
    }
    /** The next step begins. */
    void
    accept()
    {
      faces.swap(next);
    }

    /** Points have other owners, @p surface is that of this rank: bring what is
     * remembered of faces to the ranks that have them. Collective. */
    void
    send(const BodySurface<dim> &surface, const MPI_Comm comm);

    /** All ranks' as text. Collective. */
    std::string
    save(const MPI_Comm comm) const;
    /** The next send() finds out whose faces they are. */
    void
    load(const std::string &state);

  private:
    struct OfFace
    {
      std::array<Tensor<1, dim>, BodySurface<dim>::n_gauss> at;
      double                                                kept = 1;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &at &kept;
      }
    };
    std::map<std::uint64_t, OfFace> faces, next;
  };
} // namespace isochor

#endif
