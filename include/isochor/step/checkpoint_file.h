/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_checkpoint_file_h
#define isochor_checkpoint_file_h

#include <cstddef>
#include <cstdint>
#include <string>

namespace isochor
{
  /** The hash FNV-1a of 64 bits, continued from @p hash. */
  std::uint64_t
  fnv1a(const void         *data,
        const std::size_t   n_bytes,
        const std::uint64_t hash = 14695981039346656037ull);

  /** Write @p data of a problem in @p dimension dimensions as the file @p name,
   * which afterwards is complete or not there. It is for the machine that
   * wrote it; magic word, version and checksum guard it. Throws if it can't. */
  void
  write_checkpoint_file(const std::string &name,
                        const unsigned int dimension,
                        const std::string &data);

  /** Read what the above wrote into @p data. Returns why it can't be used,
   * empty if it can. */
  std::string
  read_checkpoint_file(const std::string &name,
                       const unsigned int dimension,
                       std::string       &data);
} // namespace isochor

#endif
