/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#include <isochor/interaction/slip_memory.h>

#include <limits>
#include <sstream>

namespace isochor
{
  template <int dim>
  void
  SlipMemory<dim>::send(const BodySurface<dim> &surface, const MPI_Comm comm)
  {
    std::map<std::uint64_t, Slips> kept;
    const auto                     take = [&](auto &from) {
      for (const auto &face : surface.faces())
        {
          const auto found = from.find(BodySurface<dim>::key(face));
          if (found != from.end())
            kept.insert(from.extract(found));
        }
    };
    take(slips);
    // what is left belongs to points that went to other ranks
    using Orphans = std::vector<std::pair<std::uint64_t, Slips>>;
    std::map<std::uint64_t, Slips> others;
    for (const Orphans &orphans :
         Utilities::MPI::all_gather(comm, Orphans(slips.begin(), slips.end())))
      others.insert(orphans.begin(), orphans.end());
    take(others);
    slips.swap(kept);
  }



  template <int dim>
  std::string
  SlipMemory<dim>::save(const MPI_Comm comm) const
  {
    std::ostringstream text;
    text.precision(std::numeric_limits<double>::max_digits10);
    for (const auto &of_rank : Utilities::MPI::all_gather(comm, slips))
      for (const auto &[key, values] : of_rank)
        {
          text << key;
          for (const Tensor<1, dim> &slip : values)
            text << ' ' << slip;
          text << '\n';
        }
    return text.str();
  }



  template <int dim>
  void
  SlipMemory<dim>::load(const std::string &state)
  {
    std::istringstream text(state);
    std::uint64_t      key;
    while (text >> key)
      for (Tensor<1, dim> &slip : slips[key])
        for (unsigned int d = 0; d < dim; ++d)
          text >> slip[d];
  }



  template class SlipMemory<2>;
  template class SlipMemory<3>;
} // namespace isochor
