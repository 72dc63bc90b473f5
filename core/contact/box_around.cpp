#include "core/contact/box_around.h"

#include <algorithm>
#include <array>

#include "core/base/avx2.h"
#include "core/base/lanes.h"

namespace dartboard {
namespace {

#ifdef DARTBOARD_HAS_AVX2
#define DARTBOARD_FOUR(expression) \
  DARTBOARD_AVX2_INLINE __m256d four(std::size_t i) const { return expression; }
#else
#define DARTBOARD_FOUR(expression)
#endif

// Numbers of columns, one or four at a time from the i-th on.
struct Places {
  const double* x;
  double one(std::size_t i) const { return x[i]; }
  DARTBOARD_FOUR(_mm256_loadu_pd(x + i))
};
struct Ways {
  const double *from, *x;
  double one(std::size_t i) const { return x[i] - from[i]; }
  DARTBOARD_FOUR(_mm256_sub_pd(_mm256_loadu_pd(x + i), _mm256_loadu_pd(from + i)))
};
struct WaysWithinStep {
  const double *from, *x, *w;
  double t;
  double one(std::size_t i) const { return (x[i] - from[i]) + t * w[i]; }
  DARTBOARD_FOUR(_mm256_add_pd(_mm256_sub_pd(_mm256_loadu_pd(x + i), _mm256_loadu_pd(from + i)),
                               _mm256_mul_pd(_mm256_set1_pd(t), _mm256_loadu_pd(w + i))))
};

/// Widens a box by the vectors from the number `i` on.
template <class Column>
void widen(BoxAround& box, const Column& column, std::size_t i, std::size_t end) {
  for (; i < end; i += 3)
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = column.one(i + c);
      auto &low = box.low[static_cast<Eigen::Index>(c)], &high = box.high[static_cast<Eigen::Index>(c)];
      low = value < low ? value : low;
      high = value > high ? value : high;
    }
}

#ifdef DARTBOARD_HAS_AVX2
struct Twelve {
  __m256d part[3];
};

template <class Column>
DARTBOARD_AVX2 void widen_in_lanes(BoxAround& box, const Column& column, std::size_t end) {
  Twelve low, high;  // four vectors of three numbers
  for (std::size_t k = 0; k < 3; ++k) {
    low.part[k] = _mm256_set1_pd(BoxAround::infinity);
    high.part[k] = _mm256_set1_pd(-BoxAround::infinity);
  }
  std::size_t i = 0;
  for (; i + 12 <= end; i += 12)
    for (std::size_t k = 0; k < 3; ++k) {
      const __m256d values = column.four(i + 4 * k);
      low.part[k] = _mm256_min_pd(values, low.part[k]);  // the second of the two where the first is not a number
      high.part[k] = _mm256_max_pd(values, high.part[k]);
    }
  std::array<double, 12> lows{}, highs{};
  for (std::size_t k = 0; k < 3; ++k) {
    _mm256_storeu_pd(&lows[4 * k], low.part[k]);
    _mm256_storeu_pd(&highs[4 * k], high.part[k]);
  }
  widen(box, Places{lows.data()}, 0, 12);
  widen(box, Places{highs.data()}, 0, 12);
  widen(box, column, i, end);
}
#endif

template <class Column>
void widen(BoxAround& box, const Column& column, std::size_t vectors) {
#ifdef DARTBOARD_HAS_AVX2
  if (vectors >= 4 && lanes_are_on()) {
    widen_in_lanes(box, column, 3 * vectors);
    return;
  }
#endif
  widen(box, column, 0, 3 * vectors);
}

const double* numbers_of(std::span<const Eigen::Vector3d> column) { return column.data()->data(); }

}  // namespace

BoxAround box_around(std::span<const Eigen::Vector3d> x) {
  BoxAround box;
  if (!x.empty()) widen(box, Places{numbers_of(x)}, x.size());
  return box;
}

void add_ways(BoxAround& box, std::span<const Eigen::Vector3d> from, const StagePlaces& to, std::size_t first) {
  const std::size_t count = from.size();
  if (count == 0) return;
  const double* const x = numbers_of(to.x.subspan(first, count));
  if (to.w.empty())
    widen(box, Ways{numbers_of(from), x}, count);
  else
    widen(box, WaysWithinStep{numbers_of(from), x, numbers_of(to.w.subspan(first, count)), to.t}, count);
}

}  // namespace dartboard
