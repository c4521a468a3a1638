/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_field_h
#define isochor_point_field_h

#include <deal.II/base/exceptions.h>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace isochor
{
  using namespace dealii;

  /** Where the properties of the material points of this rank stand in the
   * memory of deal.II's ParticleHandler: those of point q in block slot[q]. */
  struct PointSlots
  {
    const double             *properties   = nullptr; ///< block 0
    unsigned int              n_properties = 0;       ///< of a block
    std::vector<unsigned int> slot;

    /** The block of point @p q. */
    const double *
    block(const unsigned int q) const
    {
      return properties + slot[q] * static_cast<std::size_t>(n_properties);
    }

    /** Ask the memory for entries [@p first, @p first + @p n) of a point that
     * a loop over all will come to after point @p q: points are read one after
     * the other, but after some resets neighbours stand far from each other in
     * memory. The wait for it took a fifth of the assembly. (Unless inlined at
     * once, GCC 12 takes a call that does nothing else for superfluous.) */
    inline DEAL_II_ALWAYS_INLINE void
    prefetch(const unsigned int q,
             const unsigned int first,
             const unsigned int n) const
    {
      constexpr unsigned int n_ahead = 16;
      constexpr std::size_t  line    = 64; // bytes of a line of a cache
      if (q + n_ahead >= slot.size())
        return;
      const char *const values =
        reinterpret_cast<const char *>(block(q + n_ahead) + first);
      const std::size_t size = n * sizeof(double);
      for (std::size_t byte = 0; byte < size; byte += line)
        __builtin_prefetch(values + byte);
      __builtin_prefetch(values + size - 1);
    }
  };

  /**
   * A field of the points, numbers or tensors, that is not copied for a step:
   * it is read where MaterialPoints keeps it, by what PointSlots says. So it
   * changes as soon as GridToPoints writes what a step has found, and can be
   * read from MaterialPoints::gather() or update() until the points are located
   * anew. As long as it isn't attached, the values are its own.
   *
   * What is read in each iteration may be copied all the same, if there is
   * memory for it: the properties of a point are far more than this field, and
   * all of them pass through the processor's caches with it.
   */
  template <typename T>
  class PointField
  {
  public:
    T
    operator[](const unsigned int q) const
    {
      return q < copied.size() ? copied[q] : slots ? read(q) : own[q];
    }

    /** Read the points of @p slots there, from entry @p first_entry of their
     * properties on. Where @p values_are_copied, refresh() has to come next. */
    void
    attach(std::shared_ptr<const PointSlots> slots_,
           const unsigned int                first_entry,
           const bool                        values_are_copied = false)
    {
      slots = std::move(slots_);
      entry = first_entry;
      own.clear();
      copied.resize(values_are_copied ? size() : 0);
    }

    /** The points have others now: read again what is copied. */
    void
    refresh()
    {
      for (unsigned int q = 0; q < copied.size(); ++q)
        copied[q] = read(q);
    }

    /** Material point @p q has @p value now. */
    void
    refresh(const unsigned int q, const T &value)
    {
      if (q < copied.size())
        copied[q] = value;
    }

    /** Be attached to nothing, without values. */
    void
    clear()
    {
      slots.reset();
      own.clear();
      copied.clear();
    }

    void
    push_back(const T &value)
    {
      Assert(slots == nullptr, ExcMessage("The values are the points'."));
      own.push_back(value);
    }

    std::size_t
    size() const
    {
      return slots ? slots->slot.size() : own.size();
    }

    /** A copy of all. */
    std::vector<T>
    values() const
    {
      std::vector<T> copy;
      copy.reserve(size());
      for (unsigned int q = 0; q < size(); ++q)
        copy.push_back((*this)[q]);
      return copy;
    }

  private:
    T
    read(const unsigned int q) const
    {
      slots->prefetch(q, entry, sizeof(T) / sizeof(double));
      const double *const values = slots->block(q) + entry;
      if constexpr (std::is_same_v<T, double>)
        return *values;
      else
        {
          T tensor;
          for (unsigned int i = 0; i < T::dimension; ++i)
            for (unsigned int j = 0; j < T::dimension; ++j)
              tensor[i][j] = values[i * T::dimension + j];
          return tensor;
        }
    }

    std::shared_ptr<const PointSlots> slots;
    unsigned int                      entry = 0;
    std::vector<T>                    own, copied;
  };
} // namespace isochor

#endif
