/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_diagnoses_h
#define isochor_diagnoses_h

#include <deal.II/base/timer.h>

#include <isochor/diagnosis/diagnosis.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace isochor
{
  /** Those that look at a run, as `Diagnosis/Level` says. */
  template <int dim>
  class Diagnoses
  {
  public:
    /** @p timer gets their time. */
    Diagnoses(TimerOutput &timer)
      : timer(timer)
    {}

    static void
    declare_parameters(ParameterHandler &prm);
    /** @p print: whether this rank prints warnings. */
    void
    parse_parameters(ParameterHandler &prm, const bool print);
    /** The parameters, by path, that a resumed run may set anew. */
    static std::vector<std::string>
    changeable_parameters()
    {
      return {"Diagnosis/"};
    }

    /** Let each of them @p look. Collective if this is. */
    void
    each(const std::function<void(Diagnosis<dim> &)> &look) const;

    /** What they have to say in the end, or of a failure, a line each. */
    std::string
    run_ended() const;
    std::string
    run_failed() const;

    /** What they have warned of. */
    const Warnings &
    warnings() const
    {
      return found;
    }

    /** Their states, by name, a line each. */
    std::string
    save_state() const;
    void
    load_state(const std::string &states);

  private:
    TimerOutput                                 &timer;
    Warnings                                     found;
    std::vector<std::unique_ptr<Diagnosis<dim>>> all;
  };
} // namespace isochor

#endif
