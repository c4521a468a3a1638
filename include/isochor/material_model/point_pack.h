/* ---------------------------------------------------------------------
 * Isochor: implicit, stabilised mixed Material Point Method on deal.II.
 * SPDX-License-Identifier: LGPL-2.1-or-later
 * --------------------------------------------------------------------- */
#ifndef isochor_point_pack_h
#define isochor_point_pack_h

#include <array>
#include <cmath>

#if defined(__SSE2__)
#  include <emmintrin.h>
#endif

namespace isochor
{
  /**
   * A number at each of two material points, which one instruction of the
   * processor works on. Not deal.II's VectorizedArray: where deal.II was built
   * for any processor of its kind, as Debian's is, that holds a single number.
   */
  class PointPack
  {
  public:
    static constexpr unsigned int size = 2;

    PointPack() = default;
    PointPack(const double same)
      : numbers{same, same}
    {}
    PointPack(const double first, const double second)
      : numbers{first, second}
    {}

    double
    operator[](const unsigned int i) const
    {
      return numbers[i];
    }

    PointPack &
    operator+=(const PointPack &other)
    {
      numbers += other.numbers;
      return *this;
    }
    PointPack &
    operator-=(const PointPack &other)
    {
      numbers -= other.numbers;
      return *this;
    }

    friend PointPack
    operator+(const PointPack &a, const PointPack &b)
    {
      return PointPack(a.numbers + b.numbers);
    }
    friend PointPack
    operator-(const PointPack &a, const PointPack &b)
    {
      return PointPack(a.numbers - b.numbers);
    }
    friend PointPack
    operator*(const PointPack &a, const PointPack &b)
    {
      return PointPack(a.numbers * b.numbers);
    }
    friend PointPack
    operator/(const PointPack &a, const PointPack &b)
    {
      return PointPack(a.numbers / b.numbers);
    }
    friend PointPack
    sqrt(const PointPack &a)
    {
#if defined(__SSE2__)
      return PointPack(_mm_sqrt_pd(a.numbers)); // compilers take two roots
#else
      return PointPack(std::sqrt(a[0]), std::sqrt(a[1]));
#endif
    }

    /** @p value where @p a > @p b, else @p other. */
    friend PointPack
    where_greater(const PointPack &a,
                  const PointPack &b,
                  const PointPack &value,
                  const PointPack &other)
    {
      return PointPack(a.numbers > b.numbers ? value.numbers : other.numbers);
    }
    friend bool
    is_greater_anywhere(const PointPack &a, const PointPack &b)
    {
      return a[0] > b[0] || a[1] > b[1];
    }

    /** The sum over the points. */
    friend double
    sum(const PointPack &a)
    {
      return a[0] + a[1];
    }

  private:
    using Numbers = double __attribute__((vector_size(size * sizeof(double))));

    explicit PointPack(const Numbers numbers)
      : numbers(numbers)
    {}

    Numbers numbers;
  };

  /** The same of one point, for what is written for both. */
  inline double
  where_greater(const double a,
                const double b,
                const double value,
                const double other)
  {
    return a > b ? value : other;
  }
  inline bool
  is_greater_anywhere(const double a, const double b)
  {
    return a > b;
  }

  /** A second-order tensor at the points of a pack. */
  template <int dim>
  using TensorPack = std::array<std::array<PointPack, dim>, dim>;
} // namespace isochor

#endif
