/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_checkpoint_h
#define isochor_checkpoint_h

#include <isochor/boundary_condition/boundary_condition.h>
#include <isochor/diagnosis/diagnoses.h>
#include <isochor/postprocess/postprocessor.h>
#include <isochor/step/step_setup.h>
#include <isochor/transfer/last_motion.h>

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /**
   * Saves a run between two steps and restores it, so that the resumed run
   * gives bit by bit what the uninterrupted one does on the same number of
   * ranks. What a step leaves to the next is all there is to save: the points
   * in their order, the load stepping, the last motion, the grid if it is kept,
   * and what boundary conditions and post-processors remember.
   *
   * Each rank writes the files `checkpoint-0.<rank>.bin` and
   * `checkpoint-1.<rank>.bin` in turn, each complete or not at all. So a run
   * that is killed at any moment leaves at least one set that is complete on
   * all ranks; the newest such set is read. Files are binary and for the
   * machine that wrote them; magic word, version and checksum guard them.
   */
  template <int dim>
  class Checkpoint
  {
  public:
    /** What is saved and restored. */
    struct State
    {
      MaterialPoints<dim>                                  &points;
      LoadStepping                                         &time;
      LastMotion                                           &last_motion;
      StepSetup<dim>                                       &setup;
      std::vector<std::unique_ptr<BoundaryCondition<dim>>> &boundary_conditions;
      std::vector<std::unique_ptr<Postprocessor<dim>>>     &postprocessors;
      Diagnoses<dim>                                       &diagnoses;
    };

    static void
    declare_parameters(ParameterHandler &prm);

    /** Reads its subsection, and from all others what describes the problem:
     * @p prm has to be at its top level. A resumed run may change the
     * parameters whose path ("Section/Entry") starts with one of @p changeable:
     * what says how to go on, not what the problem is. Their owners know which.
     */
    void
    parse_parameters(ParameterHandler               &prm,
                     const std::vector<std::string> &changeable);

    /** The parameters of this class that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters();

    /**
     * Once, when all of @p state is set up as for the start of a run. If the
     * parameters ask to resume, overwrite it by the newest complete checkpoint
     * in @p directory; throws if there is none or if it belongs to another
     * problem. Otherwise discard the checkpoints of an earlier run, which no
     * longer belong to the other files there. Returns what to tell the user,
     * if anything. Collective.
     */
    std::string
    start(const BackgroundGrid<dim> &grid,
          const std::string         &directory,
          const State               &state);

    /** Whether start() will resume a run. */
    bool
    resumes() const
    {
      return resume;
    }

    /** What start() does if the parameters ask to resume; nothing else. */
    void
    resume_if_asked(const BackgroundGrid<dim> &grid,
                    const std::string         &directory,
                    const State               &state);

    /** After a step: write a checkpoint if it is time to, and return whether
     * it was. Throws on all ranks if that fails on any; the previous one is
     * then still there. Collective. */
    bool
    write_if_due(const State &state);

  private:
    struct Contents;

    /** The result of reading a slot: nothing in it if it can't be used. */
    struct Slot
    {
      std::unique_ptr<Contents> contents;
      std::string               error;
    };

    std::string
    file_name(const unsigned int slot) const;
    Contents
    collect(const State &state) const;
    Slot
    read_slot(const unsigned int slot) const;
    void
    check_problem(const Contents &contents) const;
    void
    restore(const Contents &contents, const State &state) const;
    std::string
    resume_from_newest(const State &state);
    /** Rename the checkpoints of an earlier run; returns what rank 0 is to
     * tell. */
    std::string
    put_aside_old() const;

    unsigned int step_interval = 0;
    double       wall_interval = 0;
    bool         resume        = false;

    /** The parameters that a resumed run must share, by path, and others. */
    std::map<std::string, std::string> problem, settings;
    std::uint64_t                      grid_fingerprint = 0;
    const BackgroundGrid<dim>         *grid             = nullptr;
    std::string                        directory;

    unsigned int                          next_slot = 0;
    unsigned int                          last_step = 0;
    std::chrono::steady_clock::time_point last_time;
  };
} // namespace isochor

#endif
