#include "core/contact/way_out.h"

#include <algorithm>
#include <bit>

#include "core/base/four.h"

namespace dartboard {

#ifdef DARTBOARD_HAS_AVX2
namespace {

using FourTetrahedra = const SkinTetrahedron* [4];

DARTBOARD_AVX2_INLINE FourVectors rows_at(const Eigen::Vector3d* column, const FourTetrahedra& t, std::size_t corner) {
  const double* const row = column->data();
  return vectors_at(row + std::size_t{3} * t[0]->nodes[corner], row + std::size_t{3} * t[1]->nodes[corner],
                    row + std::size_t{3} * t[2]->nodes[corner], row + std::size_t{3} * t[3]->nodes[corner]);
}
/// As StagePlaces::place.
DARTBOARD_AVX2_INLINE FourVectors places_at(const StagePlaces& at, const FourTetrahedra& t, std::size_t corner) {
  const FourVectors x = rows_at(at.x.data(), t, corner);
  return at.w.empty() ? x : x + four(at.t) * rows_at(at.w.data(), t, corner);
}

/// Whether parts are below what they may be at a face: zero on the boundary, a little less within the body.
template <int face>
DARTBOARD_AVX2_INLINE Four is_beyond(Four part, Four within, __m128i outer) {
  const Four on_boundary = _mm256_castsi256_pd(_mm256_cvtepi32_epi64(_mm_slli_epi32(outer, 31 - face)));
  return _mm256_cmp_pd(part, _mm256_blendv_pd(within, four(0.0), on_boundary), _CMP_LT_OQ);
}

DARTBOARD_AVX2 std::size_t skip(const TetrahedraToTest& tetrahedra, std::size_t first, const StagePlaces& at,
                                const Eigen::Vector3d& place, std::size_t& inverted) {
  const std::uint32_t* const number = tetrahedra.numbers.data();
  const std::size_t count = tetrahedra.numbers.size();
  const FourVectors y{four(place.x()), four(place.y()), four(place.z())};
  const Four zero = four(0.0);
  for (std::size_t k = first; k < count; k += 4) {
    FourTetrahedra t;  // the last one again, where less are left
    for (std::size_t lane = 0; lane < 4; ++lane) t[lane] = tetrahedra.all + number[std::min(k + lane, count - 1)];
    const FourVectors p = places_at(at, t, 0), a = places_at(at, t, 1) - p, b = places_at(at, t, 2) - p,
                      c = places_at(at, t, 3) - p, r = y - p, normal = cross(b, c);
    const Four volume = dot(a, normal), within = four(-2.0 * seam_of_sides) * volume;
    const __m128i outer = _mm_set_epi32(t[3]->outer, t[2]->outer, t[1]->outer, t[0]->outer);
    const Four part1 = dot(r, normal), part2 = dot(r, cross(c, a)), part3 = dot(r, cross(a, b));
    const Four beyond_first = _mm256_cmp_pd(part1 + part2 + part3, four(beyond_the_first) * volume, _CMP_GT_OQ);
    const Four outside =
        _mm256_or_pd(_mm256_or_pd(is_beyond<1>(part1, within, outer), is_beyond<2>(part2, within, outer)),
                     _mm256_or_pd(is_beyond<3>(part3, within, outer), beyond_first));
    const auto right = static_cast<unsigned>(_mm256_movemask_pd(_mm256_cmp_pd(volume, zero, _CMP_GT_OQ)));
    const unsigned wrong = ~right & 15u;
    const unsigned skipped = wrong | static_cast<unsigned>(_mm256_movemask_pd(outside));
    const std::size_t lane = std::min<std::size_t>(static_cast<std::size_t>(std::countr_one(skipped)), count - k);
    inverted += static_cast<std::size_t>(std::popcount(wrong & ((1u << lane) - 1u)));
    if (lane < 4) return k + lane;
  }
  return count;
}

}  // namespace

std::size_t skip_outside(const TetrahedraToTest& tetrahedra, std::size_t first, const StagePlaces& at,
                         const Eigen::Vector3d& y, std::size_t& inverted) {
  return skip(tetrahedra, first, at, y, inverted);
}
#else
std::size_t skip_outside(const TetrahedraToTest&, std::size_t first, const StagePlaces&, const Eigen::Vector3d&,
                         std::size_t&) {
  return first;
}
#endif

}  // namespace dartboard
