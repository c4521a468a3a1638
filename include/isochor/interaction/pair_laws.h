/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_pair_laws_h
#define isochor_pair_laws_h

#include <isochor/interaction/face_copies.h>
#include <isochor/interaction/interaction.h>

#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** The laws between faces of bodies: that of the interaction that they belong
   * to, where one of a part of a body's surface counts more than one of the
   * body; contact without friction if there is none. */
  template <int dim>
  class PairLaws
  {
  public:
    explicit PairLaws(
      std::vector<std::unique_ptr<Interaction<dim>>> &&interactions);

    /** The names of the bodies, by layer of the grid, once they are known. */
    void
    set_bodies(const std::vector<std::string> &names);

    /** See Interaction. */
    void
    find_places(const BackgroundGrid<dim> &grid)
    {
      for (const auto &interaction : interactions)
        interaction->find_place(grid);
    }

    /** The law that is given for two faces, or null. */
    const InteractionLaw<dim> *
    given(const FaceCopy<dim> &own, const FaceCopy<dim> &other) const;

    /** That, or the one of contact. */
    const InteractionLaw<dim> &
    of(const FaceCopy<dim> &own, const FaceCopy<dim> &other) const;

    /** Whether faces of these bodies may come into contact. */
    bool
    have_contact(const unsigned int body, const unsigned int other) const;

  private:
    /** The first that two faces belong to is theirs. */
    std::vector<std::unique_ptr<Interaction<dim>>> interactions;
    std::unique_ptr<InteractionLaw<dim>>           contact;
  };
} // namespace isochor

#endif
