#include "core/elements/lanes/tetrahedra_lanes.h"

#include <limits>

#include "core/elements/lanes/four.h"

namespace dartboard {

#ifdef DARTBOARD_HAS_AVX2
namespace {

/// The stresses at f, as the laws of elastic_laws.h compute them. False if one of the four has to be computed alone.
DARTBOARD_AVX2_INLINE bool stress_of(const NeoHookeanConstants& law, const FourMatrices& f, FourMatrices& stress) {
  const FourMatrices cof = cofactors(f);
  const Four det = determinant(f, cof), one = four(1.0);
  stress = (four(law.mu) * (one - one / (product(f, f) + one))) * f +
           (four(law.lambda) * ((det - one) - four(law.slack))) * cof;
  return true;
}

/// Symmetric matrices, by their numbers on the diagonal and beside it.
struct FourSymmetric {
  Four xx, yy, zz, xy, xz, yz;
};
DARTBOARD_AVX2_INLINE FourMatrices operator*(const FourMatrices& m, const FourSymmetric& s) {
  return m * FourMatrices{{s.xx, s.xy, s.xz}, {s.xy, s.yy, s.yz}, {s.xz, s.yz, s.zz}};
}
/// The stress of a strain (of its rate): shape e + bulk tr(e) I. The latter is also added beside the diagonal, times
/// zero, as a sum with it has no minus where it vanishes.
DARTBOARD_AVX2_INLINE FourSymmetric isotropic(Four shape, Four bulk, const FourSymmetric& e) {
  const Four pressure = bulk * (e.xx + (e.yy + e.zz)), none = pressure * four(0.0);
  return {shape * e.xx + pressure, shape * e.yy + pressure, shape * e.zz + pressure,
          shape * e.xy + none,     shape * e.xz + none,     shape * e.yz + none};
}
/// F'F.
DARTBOARD_AVX2_INLINE FourSymmetric square(const FourMatrices& f) {
  return {dot(f.a, f.a), dot(f.b, f.b), dot(f.c, f.c), dot(f.a, f.b), dot(f.a, f.c), dot(f.b, f.c)};
}

DARTBOARD_AVX2_INLINE bool stress_of(const StVenantKirchhoffConstants& law, const FourMatrices& f,
                                     FourMatrices& stress) {
  const Four half = four(0.5), one = four(1.0);
  const FourSymmetric c = square(f);
  stress = f * isotropic(four(2.0 * law.mu), four(law.lambda),
                         {half * (c.xx - one), half * (c.yy - one), half * (c.zz - one), half * c.xy, half * c.xz,
                          half * c.yz});
  return true;
}

DARTBOARD_AVX2_INLINE bool all(Four condition) { return _mm256_movemask_pd(condition) == 15; }

/// The rotations of f as `polar_rotation` computes them. False if one of them needs eigenvectors, or is none.
DARTBOARD_AVX2_INLINE bool polar_rotations(const FourMatrices& f, FourMatrices& rotation) {
  const Four zero = four(0.0), size = product(f, f);
  const FourMatrices cof = cofactors(f);
  const Four det = determinant(f, cof);
  const Four eight_det = four(8.0) * det, four_cof_size = four(4.0) * product(cof, cof);
  Four sum = _mm256_sqrt_pd(four(3.0) * size);
  Four goes_on = _mm256_cmp_pd(zero, zero, _CMP_EQ_OQ);
  for (int k = 0; k < 60; ++k) {
    const Four excess = sum * sum - size;
    const Four value = excess * excess - eight_det * sum - four_cof_size;
    const Four slope = four(4.0) * sum * excess - eight_det;
    const Four next = sum - value / slope;
    goes_on = _mm256_and_pd(
        goes_on, _mm256_and_pd(_mm256_cmp_pd(slope, zero, _CMP_GT_OQ), _mm256_cmp_pd(next, sum, _CMP_LT_OQ)));
    if (_mm256_movemask_pd(goes_on) == 0) break;
    sum = _mm256_blendv_pd(sum, next, goes_on);
  }
  const Four k = four(0.5) * (sum * sum - size);
  const Four z = k * sum - det;
  // nor does this hold where the size is zero or not finite
  if (!all(_mm256_cmp_pd(z, four(1e-6) * size * _mm256_sqrt_pd(size), _CMP_GT_OQ))) return false;
  const FourMatrices r = ((k + size) * f + sum * cof - f * square(f)) / z;
  const FourMatrices r_cof = cofactors(r);
  const Four r_det = determinant(r, r_cof);
  const Four error = _mm256_andnot_pd(four(-0.0), r_det - four(1.0));
  if (!all(_mm256_cmp_pd(error, four(1e-6), _CMP_LT_OQ))) return false;
  rotation = four(0.5) * (r + r_cof / r_det);
  return true;
}

DARTBOARD_AVX2_INLINE bool stress_of(const CorotationalConstants& law, const FourMatrices& f, FourMatrices& stress) {
  FourMatrices r;
  if (!polar_rotations(f, r)) return false;
  stress = four(2.0 * law.mu) * (f - r) + (four(law.lambda) * (product(r, f) - four(3.0))) * r;
  return true;
}

DARTBOARD_AVX2_INLINE FourVectors corners_at(const double* x, const std::array<std::uint32_t, 4>* n,
                                             std::size_t corner) {
  return vectors_at(x + std::size_t{3} * n[0][corner], x + std::size_t{3} * n[1][corner],
                    x + std::size_t{3} * n[2][corner], x + std::size_t{3} * n[3][corner]);
}

template <class Constants>
DARTBOARD_AVX2 std::size_t add_in_lanes(const TetrahedraAt& at, const Constants& law, std::size_t first,
                                        std::size_t last) {
  const std::array<std::uint32_t, 4>* const nodes = at.nodes;
  const double *const x = at.x->data(), *const shapes = at.shape->data(), *const mass = at.mass;
  double* const force = at.force->data();
  const Four minus_per_mass = four(-at.per_mass);
  std::size_t c = first;
  for (; c + 4 <= last; c += 4) {
    const std::array<std::uint32_t, 4>* const n = nodes + c;
    const FourMatrices shape = matrices_at(shapes + 9 * c);
    const FourVectors origin = corners_at(x, n, 0);
    const FourMatrices edges{corners_at(x, n, 1) - origin, corners_at(x, n, 2) - origin, corners_at(x, n, 3) - origin};
    FourMatrices stress;
    if (!stress_of(law, edges * shape, stress)) break;
    const FourMatrices weighted = (minus_per_mass * _mm256_loadu_pd(mass + c)) * stress;
    // by the rows of the shape
    const FourVectors one = weighted * FourVectors{shape.a.x, shape.b.x, shape.c.x};
    const FourVectors two = weighted * FourVectors{shape.a.y, shape.b.y, shape.c.y};
    const FourVectors three = weighted * FourVectors{shape.a.z, shape.b.z, shape.c.z};
    const FourRows sums = rows_of(one + two + three);
    const FourRows ones = rows_of(one), twos = rows_of(two), threes = rows_of(three);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      subtract_from(force + std::size_t{3} * n[lane][0], sums.xy[lane], sums.z[lane]);
      add_to(force + std::size_t{3} * n[lane][1], ones.xy[lane], ones.z[lane]);
      add_to(force + std::size_t{3} * n[lane][2], twos.xy[lane], twos.z[lane]);
      add_to(force + std::size_t{3} * n[lane][3], threes.xy[lane], threes.z[lane]);
    }
  }
  return c;
}

// Products of edges and the gradients of their corners. One by one they are added to zero, which only changes the sign
// of a zero, and that gets lost below where forces are added to zero.
DARTBOARD_AVX2_INLINE FourVectors sum_of(const FourMatrices& edges, const FourVectors& gradient) {
  return gradient.x * edges.a + gradient.y * edges.b + gradient.z * edges.c;
}
DARTBOARD_AVX2_INLINE FourMatrices gradients_of(const double* x, const std::array<std::uint32_t, 4>* n,
                                                const FourMatrices& shape) {
  const FourVectors origin = corners_at(x, n, 0);
  const FourMatrices edges{corners_at(x, n, 1) - origin, corners_at(x, n, 2) - origin, corners_at(x, n, 3) - origin};
  return {sum_of(edges, shape.a), sum_of(edges, shape.b), sum_of(edges, shape.c)};
}

DARTBOARD_AVX2 std::size_t add_damping(const TetrahedraAt& at, const Eigen::Vector3d* velocities,
                                       const DampingConstants& material, std::size_t count) {
  const std::array<std::uint32_t, 4>* const nodes = at.nodes;
  const double *const x = at.x->data(), *const v = velocities->data(), *const shapes = at.shape->data(),
                      *const mass = at.mass;
  double* const force = at.force->data();
  const Four per_mass = four(at.per_mass), half = four(0.5);
  std::size_t c = 0;
  for (; c + 4 <= count; c += 4) {
    const std::array<std::uint32_t, 4>* const n = nodes + c;
    const FourMatrices shape = matrices_at(shapes + 9 * c);
    const FourMatrices f = gradients_of(x, n, shape), rate = gradients_of(v, n, shape);
    const FourSymmetric strain{
        half * (dot(f.a, rate.a) + dot(f.a, rate.a)), half * (dot(f.b, rate.b) + dot(f.b, rate.b)),
        half * (dot(f.c, rate.c) + dot(f.c, rate.c)), half * (dot(f.a, rate.b) + dot(f.b, rate.a)),
        half * (dot(f.a, rate.c) + dot(f.c, rate.a)), half * (dot(f.b, rate.c) + dot(f.c, rate.b))};
    const FourMatrices weighted =
        ((per_mass * _mm256_loadu_pd(mass + c)) * f) * isotropic(four(material.shape), four(material.bulk), strain);
    const FourVectors none{four(0.0), four(0.0), four(0.0)};
    const FourVectors one = none + weighted * FourVectors{shape.a.x, shape.b.x, shape.c.x};
    const FourVectors two = none + weighted * FourVectors{shape.a.y, shape.b.y, shape.c.y};
    const FourVectors three = none + weighted * FourVectors{shape.a.z, shape.b.z, shape.c.z};
    const FourRows sums = rows_of(none + one + two + three);
    const FourRows ones = rows_of(one), twos = rows_of(two), threes = rows_of(three);
    for (std::size_t lane = 0; lane < 4; ++lane) {
      subtract_from(force + std::size_t{3} * n[lane][1], ones.xy[lane], ones.z[lane]);
      subtract_from(force + std::size_t{3} * n[lane][2], twos.xy[lane], twos.z[lane]);
      subtract_from(force + std::size_t{3} * n[lane][3], threes.xy[lane], threes.z[lane]);
      add_to(force + std::size_t{3} * n[lane][0], sums.xy[lane], sums.z[lane]);
    }
  }
  return c;
}

}  // namespace

template <class Constants>
std::size_t add_forces_in_lanes(const TetrahedraAt& at, const Constants& law, std::size_t first, std::size_t last) {
  return add_in_lanes(at, law, first, last);
}
std::size_t add_damping_in_lanes(const TetrahedraAt& at, const Eigen::Vector3d* v, const DampingConstants& material,
                                 std::size_t count) {
  return count < 4 ? 0 : add_damping(at, v, material, count);
}
#else
template <class Constants>
std::size_t add_forces_in_lanes(const TetrahedraAt&, const Constants&, std::size_t first, std::size_t) {
  return first;
}
std::size_t add_damping_in_lanes(const TetrahedraAt&, const Eigen::Vector3d*, const DampingConstants&, std::size_t) {
  return 0;
}
#endif

template std::size_t add_forces_in_lanes(const TetrahedraAt&, const NeoHookeanConstants&, std::size_t, std::size_t);
template std::size_t add_forces_in_lanes(const TetrahedraAt&, const StVenantKirchhoffConstants&, std::size_t,
                                         std::size_t);
template std::size_t add_forces_in_lanes(const TetrahedraAt&, const CorotationalConstants&, std::size_t, std::size_t);

}  // namespace dartboard
