/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_parts_of_body_h
#define isochor_parts_of_body_h

#include <isochor/material_points/body_seeding.h>

#include <utility>
#include <vector>

namespace isochor
{
  /** The part of the body that each seed belongs to, numbered from 0 on: seeds
   * whose domains have a corner in common are in one part. Empty if that can't
   * be told, without domains or where coordinates are so large that rounding
   * hides what places are the same. */
  template <int dim>
  std::vector<unsigned int>
  parts_by_domains(const std::vector<Seed<dim>> &seeds);

  /** The seeds with faces of their domains that are one of the @p periods
   * apart. */
  template <int dim>
  std::vector<std::pair<unsigned int, unsigned int>>
  pairs_across(const std::vector<Seed<dim>>      &seeds,
               const std::vector<Tensor<1, dim>> &periods);
} // namespace isochor

#endif
