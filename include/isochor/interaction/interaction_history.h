/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_interaction_history_h
#define isochor_interaction_history_h

#include <isochor/interaction/surface_memory.h>

#include <string>

namespace isochor
{
  /** What interactions of a surface remember from step to step. */
  template <int dim>
  struct InteractionHistory
  {
    /** Of each Gauss point InteractionKernel::remembered(), of the face the
     * part of its elastic strain that its point kept in the last step. */
    SurfaceMemory<dim> gaps;
    /** The forces at the end of the last step (N): with the pressures that
     * nodes of another grid get from the points they would be others. */
    SurfaceMemory<dim> forces;

    void
    start_noting()
    {
      gaps.start_noting();
      forces.start_noting();
    }
    void
    accept()
    {
      gaps.accept();
      forces.accept();
    }
    /** See SurfaceMemory. Collective, as save() is. */
    void
    send(const BodySurface<dim> &surface, const MPI_Comm comm)
    {
      gaps.send(surface, comm);
      forces.send(surface, comm);
    }
    std::string
    save(const MPI_Comm comm) const
    {
      const std::string first = gaps.save(comm);
      return std::to_string(first.size()) + '\n' + first + forces.save(comm);
    }
    void
    load(const std::string &state)
    {
      const std::size_t line = state.find('\n');
      if (line == std::string::npos)
        return;
      const std::size_t size = std::stoul(state);
      gaps.load(state.substr(line + 1, size));
      forces.load(state.substr(line + 1 + size));
    }
  };
} // namespace isochor

#endif
