/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_safe_file_h
#define isochor_safe_file_h

#include <deal.II/base/mpi.h>

#include <functional>
#include <iosfwd>
#include <string>

namespace isochor
{
  using namespace dealii;

  /** Whether a file has to survive a crash of the machine, or of the program
   * only. */
  enum class Durability
  {
    of_program,
    of_machine
  };

  /**
   * Write a file that is at every moment either as it was before or complete:
   * @p write fills a file of another name, which then takes the place of
   * @p file_name. Throws ExcMessage if that fails, as on a full disk.
   */
  void
  write_file_safely(const std::string                         &file_name,
                    const std::function<void(std::ostream &)> &write,
                    const Durability durability = Durability::of_program);

  /**
   * Call @p action on all ranks of @p comm; it must not communicate. If it
   * throws on any, all ranks throw an ExcMessage with the message of the first
   * that did, so that none waits for ever for the others. Collective.
   */
  void
  run_on_all_ranks(const MPI_Comm &comm, const std::function<void()> &action);
} // namespace isochor

#endif
