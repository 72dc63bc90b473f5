#include "core/time/system/spring_lanes.h"

#include <algorithm>
#include <limits>

#include "core/base/avx2.h"
#include "core/base/lanes.h"

namespace dartboard {

#ifdef DARTBOARD_HAS_AVX2
namespace {

struct ThreeColumns {
  __m256d x, y, z;
};

/// Three numbers of each of four rows, and one that is not used.
DARTBOARD_AVX2_INLINE ThreeColumns columns_of(__m256d row0, __m256d row1, __m256d row2, __m256d row3) {
  const __m256d low01 = _mm256_unpacklo_pd(row0, row1), high01 = _mm256_unpackhi_pd(row0, row1);
  const __m256d low23 = _mm256_unpacklo_pd(row2, row3), high23 = _mm256_unpackhi_pd(row2, row3);
  return {_mm256_permute2f128_pd(low01, low23, 0x20), _mm256_permute2f128_pd(high01, high23, 0x20),
          _mm256_permute2f128_pd(low01, low23, 0x31)};
}

/// Rest lengths, stiffnesses and damping of four springs. Nothing is read behind the fourth.
DARTBOARD_AVX2_INLINE ThreeColumns columns_of(const Spring* spring) {
  const double* const row = &spring->rest_length;
  return columns_of(_mm256_loadu_pd(row), _mm256_loadu_pd(row + 3), _mm256_loadu_pd(row + 6),
                    _mm256_permute4x64_pd(_mm256_loadu_pd(row + 8), 0x39));
}
DARTBOARD_AVX2_INLINE ThreeColumns columns_of(const UndampedSpring* spring) {
  const double* const row = &spring->rest_length;
  const __m256d even = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(row)), _mm_loadu_pd(row + 4), 1);
  const __m256d odd = _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(row + 2)), _mm_loadu_pd(row + 6), 1);
  return {_mm256_unpacklo_pd(even, odd), _mm256_unpackhi_pd(even, odd), _mm256_setzero_pd()};
}

/// The numbers of a vertex, and one that is not used: it reads one number behind rows of three.
DARTBOARD_AVX2_INLINE __m256d row_at(const Eigen::Vector3d* column, std::uint32_t vertex) {
  return _mm256_loadu_pd(column[vertex].data());
}
DARTBOARD_AVX2_INLINE __m256d row_at(const PaddedVector* column, std::uint32_t vertex) {
  return _mm256_load_pd(column[vertex].number);
}

/// From the first end of a spring to the second.
template <class Row>
DARTBOARD_AVX2_INLINE __m256d line(const Row* column, const SpringEnds& ends) {
  const __m256d from = row_at(column, ends[0]);
  return _mm256_sub_pd(row_at(column, ends[1]), from);
}

// In the order of the terms, as Eigen's sums are (core/cmake/DartboardOptions.cmake).
DARTBOARD_AVX2_INLINE __m256d dot(const ThreeColumns& a, const ThreeColumns& b) {
  return _mm256_add_pd(_mm256_add_pd(_mm256_mul_pd(a.x, b.x), _mm256_mul_pd(a.y, b.y)), _mm256_mul_pd(a.z, b.z));
}

/// Add f to one end and subtract it from the other, rows of three by a packet and a number each: stores of whole rows
/// would overlap, and loads would have to wait for them.
DARTBOARD_AVX2_INLINE void add_to_ends(Eigen::Vector3d* force, const SpringEnds& ends, __m256d f) {
  double *const first = force[ends[0]].data(), *const second = force[ends[1]].data();
  const __m128d xy = _mm256_castpd256_pd128(f), z = _mm256_extractf128_pd(f, 1);
  _mm_storeu_pd(first, _mm_add_pd(_mm_loadu_pd(first), xy));
  _mm_store_sd(first + 2, _mm_add_sd(_mm_load_sd(first + 2), z));
  _mm_storeu_pd(second, _mm_sub_pd(_mm_loadu_pd(second), xy));
  _mm_store_sd(second + 2, _mm_sub_sd(_mm_load_sd(second + 2), z));
}
DARTBOARD_AVX2_INLINE void add_to_ends(PaddedVector* force, const SpringEnds& ends, __m256d f) {
  double *const first = force[ends[0]].number, *const second = force[ends[1]].number;
  _mm256_store_pd(first, _mm256_add_pd(_mm256_load_pd(first), f));
  _mm256_store_pd(second, _mm256_sub_pd(_mm256_load_pd(second), f));
}

/// Is this vertex an end of one of four springs?
DARTBOARD_AVX2_INLINE bool is_an_end(std::uint32_t vertex, const SpringEnds* ends) {
  const __m256i eight = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(ends));
  const __m256i equal = _mm256_cmpeq_epi32(eight, _mm256_set1_epi32(static_cast<int>(vertex)));
  return _mm256_testz_si256(equal, equal) == 0;
}

template <bool damped, class Row, class SomeSpring>
DARTBOARD_AVX2 std::size_t add_in_lanes(const SpringColumnsAt<Row>& at, std::span<const SomeSpring> springs) {
  const std::size_t count = springs.size() / 4 * 4;
  const SomeSpring* const row = springs.data();
  const SpringEnds* const all_ends = at.ends;
  const Row *const x = at.x.data(), *const v = at.v;
  Row* const force = at.force;
  // behind the three numbers of the last vertex there may be nothing to read
  constexpr bool is_padded = sizeof(Row) == sizeof(__m256d);
  const auto last = static_cast<std::uint32_t>(at.x.size() - 1);
  for (std::size_t s = 0; s < count; s += 4) {
    const SpringEnds* const ends = all_ends + s;
    if (!is_padded && is_an_end(last, ends)) {
      add_forces_one_by_one<damped>(at, row, s, s + 4);
      continue;
    }
    const __m256d line0 = line(x, ends[0]), line1 = line(x, ends[1]), line2 = line(x, ends[2]),
                  line3 = line(x, ends[3]);
    const ThreeColumns dx = columns_of(line0, line1, line2, line3);
    const ThreeColumns spring = columns_of(row + s);
    const __m256d length = _mm256_sqrt_pd(dot(dx, dx));
    const __m256d inverse = _mm256_div_pd(_mm256_set1_pd(1.0), length);
    __m256d tension = _mm256_mul_pd(spring.y, _mm256_sub_pd(length, spring.x));
    if constexpr (damped) {
      const ThreeColumns dv = columns_of(line(v, ends[0]), line(v, ends[1]), line(v, ends[2]), line(v, ends[3]));
      tension = _mm256_add_pd(tension, _mm256_mul_pd(spring.z, _mm256_mul_pd(dot(dv, dx), inverse)));
    }
    // none at zero length; what is not a number stays so
    const __m256d has_length = _mm256_cmp_pd(length, _mm256_setzero_pd(), _CMP_NEQ_UQ);
    const __m256d factor = _mm256_and_pd(_mm256_mul_pd(tension, inverse), has_length);
    add_to_ends(force, ends[0], _mm256_mul_pd(_mm256_permute4x64_pd(factor, 0x00), line0));
    add_to_ends(force, ends[1], _mm256_mul_pd(_mm256_permute4x64_pd(factor, 0x55), line1));
    add_to_ends(force, ends[2], _mm256_mul_pd(_mm256_permute4x64_pd(factor, 0xAA), line2));
    add_to_ends(force, ends[3], _mm256_mul_pd(_mm256_permute4x64_pd(factor, 0xFF), line3));
  }
  return count;
}

DARTBOARD_AVX2 std::size_t find_in_lanes(std::span<const SpringEnds> ends, std::span<const Eigen::Vector3d> x,
                                         Eigen::Vector3d* directions) {
  const std::size_t count = ends.size() / 4 * 4;
  const Eigen::Vector3d* const at = x.data();
  const auto last = static_cast<std::uint32_t>(x.size() - 1);
  for (std::size_t s = 0; s < count; s += 4) {
    const SpringEnds* const four = ends.data() + s;
    if (!is_an_end(last, four)) {
      const __m256d line0 = line(at, four[0]), line1 = line(at, four[1]), line2 = line(at, four[2]),
                    line3 = line(at, four[3]);
      const ThreeColumns dx = columns_of(line0, line1, line2, line3);
      const __m256d length = _mm256_sqrt_pd(dot(dx, dx));
      if (_mm256_movemask_pd(_mm256_cmp_pd(length, _mm256_setzero_pd(), _CMP_EQ_OQ)) == 0) {
        const __m256d inverse = _mm256_div_pd(_mm256_set1_pd(1.0), length);
        // a row reaches into the next one, which is stored after it
        double* const row = directions[s].data();
        _mm256_storeu_pd(row, _mm256_mul_pd(_mm256_permute4x64_pd(inverse, 0x00), line0));
        _mm256_storeu_pd(row + 3, _mm256_mul_pd(_mm256_permute4x64_pd(inverse, 0x55), line1));
        _mm256_storeu_pd(row + 6, _mm256_mul_pd(_mm256_permute4x64_pd(inverse, 0xAA), line2));
        const __m256d end = _mm256_mul_pd(_mm256_permute4x64_pd(inverse, 0xFF), line3);
        _mm_storeu_pd(row + 9, _mm256_castpd256_pd128(end));
        _mm_store_sd(row + 11, _mm256_extractf128_pd(end, 1));
        continue;
      }
    }
    for (std::size_t k = 0; k < 4; ++k) directions[s + k] = direction_of(four[k], at);
  }
  return count;
}

}  // namespace

std::size_t find_directions_in_lanes(std::span<const SpringEnds> ends, std::span<const Eigen::Vector3d> x,
                                     Eigen::Vector3d* directions) {
  return ends.size() >= 4 && lanes_are_on() ? find_in_lanes(ends, x, directions) : 0;
}

template <bool damped, class Row, class SomeSpring>
std::size_t add_forces_in_lanes(const SpringColumnsAt<Row>& at, std::span<const SomeSpring> springs) {
  return springs.size() >= 4 && lanes_are_on() ? add_in_lanes<damped>(at, springs) : 0;
}
#else
template <bool damped, class Row, class SomeSpring>
std::size_t add_forces_in_lanes(const SpringColumnsAt<Row>&, std::span<const SomeSpring>) {
  return 0;
}
std::size_t find_directions_in_lanes(std::span<const SpringEnds>, std::span<const Eigen::Vector3d>, Eigen::Vector3d*) {
  return 0;
}
#endif

template std::size_t add_forces_in_lanes<true>(const SpringColumnsAt<Eigen::Vector3d>&, std::span<const Spring>);
template std::size_t add_forces_in_lanes<false>(const SpringColumnsAt<Eigen::Vector3d>&, std::span<const Spring>);
template std::size_t add_forces_in_lanes<false>(const SpringColumnsAt<Eigen::Vector3d>&,
                                                std::span<const UndampedSpring>);
template std::size_t add_forces_in_lanes<true>(const SpringColumnsAt<PaddedVector>&, std::span<const Spring>);
template std::size_t add_forces_in_lanes<false>(const SpringColumnsAt<PaddedVector>&, std::span<const Spring>);
template std::size_t add_forces_in_lanes<false>(const SpringColumnsAt<PaddedVector>&, std::span<const UndampedSpring>);

}  // namespace dartboard
