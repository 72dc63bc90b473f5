#pragma once
// The stresses of elastic_laws.h and strain_damping.h for four deformation gradients at a time, with the bits of one at
// a time.

#include "core/base/four.h"
#include "core/elements/lanes/law_constants.h"

#ifdef DARTBOARD_HAS_AVX2
namespace dartboard {

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
/// The stress of a strain (of its rate): shape e + bulk tr(e) I. Adding zero times the trace off the diagonal
/// reproduces the sign of zero of the scalar code.
DARTBOARD_AVX2_INLINE FourSymmetric isotropic(Four shape, Four bulk, const FourSymmetric& e) {
  const Four pressure = bulk * (e.xx + e.yy + e.zz), none = pressure * four(0.0);
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

/// The stress of damping times a size, at f and its rate.
DARTBOARD_AVX2_INLINE FourMatrices damping_of(const DampingConstants& material, Four size, const FourMatrices& f,
                                              const FourMatrices& rate) {
  const Four half = four(0.5);
  const FourSymmetric strain{
      half * (dot(f.a, rate.a) + dot(f.a, rate.a)), half * (dot(f.b, rate.b) + dot(f.b, rate.b)),
      half * (dot(f.c, rate.c) + dot(f.c, rate.c)), half * (dot(f.a, rate.b) + dot(f.b, rate.a)),
      half * (dot(f.a, rate.c) + dot(f.c, rate.a)), half * (dot(f.b, rate.c) + dot(f.c, rate.b))};
  return (size * f) * isotropic(four(material.shape), four(material.bulk), strain);
}

}  // namespace dartboard
#endif
