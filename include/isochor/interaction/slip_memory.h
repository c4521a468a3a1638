/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_slip_memory_h
#define isochor_slip_memory_h

#include <isochor/equations/body_surface.h>

#include <map>
#include <string>

namespace isochor
{
  /** A vector at each Gauss point that is remembered from step to step, by
   * face. Of friction the tangential gap g_t = T (t - f)/γ (m). */
  template <int dim>
  class SlipMemory
  {
  public:
    using Slips = std::array<Tensor<1, dim>, BodySurface<dim>::n_gauss>;

    /** Of Gauss point @p g of the face with this BodySurface::key(); zero if
     * nothing is known of it. */
    Tensor<1, dim>
    get(const std::uint64_t key, const unsigned int g) const
    {
      const auto found = slips.find(key);
      return found == slips.end() ? Tensor<1, dim>() : found->second[g];
    }

    bool
    knows(const std::uint64_t key) const
    {
      return slips.count(key) > 0;
    }

    /** Note the vector at the end of the step. */
    void
    set_next(const std::uint64_t   key,
             const unsigned int    g,
             const Tensor<1, dim> &slip)
    {
      next[key][g] = slip;
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
      slips.swap(next);
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
    std::map<std::uint64_t, Slips> slips, next;
  };
} // namespace isochor

#endif
