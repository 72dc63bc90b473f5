#pragma once
// Four numbers, vectors and matrices at a time; sums are in the order of their terms, as those of one at a time.

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/avx2.h"

#ifdef DARTBOARD_HAS_AVX2
namespace dartboard {

/// Numbers; `+`, `-`, `*` and `/` of the compiler take them lane by lane.
using Four = __m256d;

DARTBOARD_AVX2_INLINE Four four(double number) { return _mm256_set1_pd(number); }

struct FourVectors {
  Four x, y, z;
};
/// Matrices by their columns.
struct FourMatrices {
  FourVectors a, b, c;
};

DARTBOARD_AVX2_INLINE FourVectors operator+(const FourVectors& u, const FourVectors& v) {
  return {u.x + v.x, u.y + v.y, u.z + v.z};
}
DARTBOARD_AVX2_INLINE FourVectors operator-(const FourVectors& u, const FourVectors& v) {
  return {u.x - v.x, u.y - v.y, u.z - v.z};
}
DARTBOARD_AVX2_INLINE FourVectors operator*(Four s, const FourVectors& v) { return {s * v.x, s * v.y, s * v.z}; }
DARTBOARD_AVX2_INLINE FourVectors operator/(const FourVectors& v, Four s) { return {v.x / s, v.y / s, v.z / s}; }
DARTBOARD_AVX2_INLINE FourMatrices operator+(const FourMatrices& m, const FourMatrices& n) {
  return {m.a + n.a, m.b + n.b, m.c + n.c};
}
DARTBOARD_AVX2_INLINE FourMatrices operator-(const FourMatrices& m, const FourMatrices& n) {
  return {m.a - n.a, m.b - n.b, m.c - n.c};
}
DARTBOARD_AVX2_INLINE FourMatrices operator*(Four s, const FourMatrices& m) { return {s * m.a, s * m.b, s * m.c}; }
DARTBOARD_AVX2_INLINE FourMatrices operator/(const FourMatrices& m, Four s) { return {m.a / s, m.b / s, m.c / s}; }

/// Of a column of a matrix with another one: u'v.
DARTBOARD_AVX2_INLINE Four dot(const FourVectors& u, const FourVectors& v) { return u.x * v.x + u.y * v.y + u.z * v.z; }
DARTBOARD_AVX2_INLINE FourVectors operator*(const FourMatrices& m, const FourVectors& v) {
  return v.x * m.a + v.y * m.b + v.z * m.c;
}
DARTBOARD_AVX2_INLINE FourMatrices operator*(const FourMatrices& m, const FourMatrices& n) {
  return {m * n.a, m * n.b, m * n.c};
}

DARTBOARD_AVX2_INLINE FourVectors cross(const FourVectors& u, const FourVectors& v) {
  return {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}
DARTBOARD_AVX2_INLINE FourMatrices cofactors(const FourMatrices& m) {
  return {cross(m.b, m.c), cross(m.c, m.a), cross(m.a, m.b)};
}
/// The product of the first rows of a matrix and its cofactors.
DARTBOARD_AVX2_INLINE Four determinant(const FourMatrices& m, const FourMatrices& cof) {
  return m.a.x * cof.a.x + m.b.x * cof.b.x + m.c.x * cof.c.x;
}
/// The sum of the nine products of their numbers.
DARTBOARD_AVX2_INLINE Four product(const FourMatrices& m, const FourMatrices& n) {
  return m.a.x * n.a.x + m.a.y * n.a.y + m.a.z * n.a.z + m.b.x * n.b.x + m.b.y * n.b.y + m.b.z * n.b.z + m.c.x * n.c.x +
         m.c.y * n.c.y + m.c.z * n.c.z;
}

/// Two numbers at each of two places.
DARTBOARD_AVX2_INLINE Four two_at(const double* low, const double* high) {
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(low)), _mm_loadu_pd(high), 1);
}
/// The three numbers at each of four places. Nothing is read before or behind them.
DARTBOARD_AVX2_INLINE FourVectors vectors_at(const double* p, const double* q, const double* r, const double* s) {
  const Four xy_even = two_at(p, r), xy_odd = two_at(q, s);
  return {_mm256_unpacklo_pd(xy_even, xy_odd), _mm256_unpackhi_pd(xy_even, xy_odd),
          _mm256_unpackhi_pd(two_at(p + 1, r + 1), two_at(q + 1, s + 1))};
}
/// Four matrices of nine numbers, one after the other.
DARTBOARD_AVX2_INLINE FourMatrices matrices_at(const double* m) {
  return {vectors_at(m, m + 9, m + 18, m + 27), vectors_at(m + 3, m + 12, m + 21, m + 30),
          vectors_at(m + 6, m + 15, m + 24, m + 33)};
}

/// Numbers of four vertices, or what is added to them: two of each vertex in a packet, and the third one first in
/// another.
struct FourRows {
  __m128d xy[4], z[4];
};
DARTBOARD_AVX2_INLINE FourRows rows_of(const FourVectors& v) {
  const Four even = _mm256_unpacklo_pd(v.x, v.y), odd = _mm256_unpackhi_pd(v.x, v.y);
  const __m128d z01 = _mm256_castpd256_pd128(v.z), z23 = _mm256_extractf128_pd(v.z, 1);
  return {{_mm256_castpd256_pd128(even), _mm256_castpd256_pd128(odd), _mm256_extractf128_pd(even, 1),
           _mm256_extractf128_pd(odd, 1)},
          {z01, _mm_unpackhi_pd(z01, z01), z23, _mm_unpackhi_pd(z23, z23)}};
}

// By a packet and a number each: stores of whole rows would overlap, and loads would have to wait for them.
DARTBOARD_AVX2_INLINE void add_to(double* row, __m128d xy, __m128d z) {
  _mm_storeu_pd(row, _mm_add_pd(_mm_loadu_pd(row), xy));
  _mm_store_sd(row + 2, _mm_add_sd(_mm_load_sd(row + 2), z));
}
DARTBOARD_AVX2_INLINE void subtract_from(double* row, __m128d xy, __m128d z) {
  _mm_storeu_pd(row, _mm_sub_pd(_mm_loadu_pd(row), xy));
  _mm_store_sd(row + 2, _mm_sub_sd(_mm_load_sd(row + 2), z));
}

}  // namespace dartboard
#endif
