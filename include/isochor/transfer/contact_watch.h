/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_contact_watch_h
#define isochor_contact_watch_h

#include <isochor/equations/element_nodes.h>
#include <isochor/equations/equation_term.h>

namespace isochor
{
  /**
   * Tells when bodies meet. Where they have nodes in common they are one, from
   * up to a cell before they touch, without slip, and also if they are pulled
   * apart: there is no law of contact between bodies, and forces differ from
   * what such a law would give.
   *
   * Bodies are what has no node in common at t = 0. If that is one body nothing
   * is looked for, also if it breaks.
   */
  template <int dim>
  class ContactWatch
  {
  public:
    /** The grid was put back, and the equations have these @p elements.
     * @p is_kept: it isn't put back before each step. */
    void
    look(const StepContext<dim> &step,
         const ElementNodes     &elements,
         const bool              at_start,
         const bool              is_kept);

    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int /*version*/)
    {
      archive &n_bodies &has_several;
    }

  private:
    bool         has_several = false; ///< at t = 0
    unsigned int n_bodies    = 0;     ///< at the last reset
  };
} // namespace isochor

#endif
