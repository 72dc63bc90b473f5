#include "core/time/explicit/frozen_damping.h"

#include <algorithm>

#include "core/base/avx2.h"
#include "core/base/lanes.h"
#include "core/forces/mobility.h"
#include "core/forces/term_damping.h"
#include "core/time/system/spring_lanes.h"

namespace dartboard {

using Eigen::Vector3d;

namespace {

// Springs with near numbers tend to share an end, and each would wait for the one before. Taken in turn from eight
// distant places of the list they do not wait, and a sweep takes half the time.
constexpr std::size_t lanes = 8;

template <class F>
[[gnu::always_inline]] inline void forwards(std::size_t count, F&& f) {
  const std::size_t rows = (count + lanes - 1) / lanes;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t s = row; s < count; s += rows) f(s);
}

template <class F>
[[gnu::always_inline]] inline void backwards(std::size_t count, F&& f) {
  const std::size_t rows = (count + lanes - 1) / lanes;
  for (std::size_t row = rows; row-- > 0;)
    for (std::size_t s = row + (count - 1 - row) / rows * rows + rows; s > row;) f(s -= rows);
}

}  // namespace

void FrozenDamping::freeze(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> x) {
  if (!terms.damping) return;
  if (has_damped_terms(system)) at_.assign(x.begin(), x.end());
  along_.resize(system.springs.size());
  for (std::size_t s = find_directions_in_lanes(system.ends, x, along_.data()); s < along_.size(); ++s)
    along_[s] = direction_of(system.ends[s], x.data());
}

void FrozenDamping::apply(const SpringSystem& system, const Terms& terms, std::span<const Vector3d> v,
                          std::span<Vector3d> result) const {
  std::ranges::fill(result, Vector3d(0, 0, 0));
  if (terms.damping && has_damped_terms(system)) {
    for (const ForceTerm* term : system.terms)
      if (term->damping() != nullptr) term->damping()->add_forces({at_}, v, result);
    for (Vector3d& force : result) force = -force;
  }
  if (terms.damping && !system.springs.damped().empty()) {
    // copies, since the compiler must assume that a store into the result changes data accessed by reference
    const SpringEnds* const ends = system.ends.data();
    const Spring* const springs = system.springs.damped().data();
    const Vector3d *const along = along_.data(), *const speed = v.data();
    Vector3d* const sum = result.data();
    forwards(along_.size(), [=](std::size_t s) {
      const auto [i, j] = ends[s];
      const Vector3d f = (springs[s].damping * (speed[j] - speed[i]).dot(along[s])) * along[s];
      sum[i] -= f;
      sum[j] += f;
    });
  }
  if (terms.viscosity)
    for (std::size_t i = 0; i < result.size(); ++i) result[i] += system.viscosity[i] * v[i];
  for (std::size_t i = 0; i < result.size(); ++i) result[i] *= system.inverse_mass[i];
  free_along_axes(system, result);
  if (!terms.fixed) return;
  for (std::size_t i = 0; i < result.size(); ++i)
    if (system.fixed[i]) result[i].setZero();
}

void FrozenDamping::prepare_flow(const SpringSystem& system, const Terms& terms, double h) {
  if (h == flow_step_ && h != 0.0) return;
  flow_step_ = h;
  mobility_.assign(system.inverse_mass.begin(), system.inverse_mass.end());
  if (terms.fixed)
    for (std::size_t i = 0; i < mobility_.size(); ++i)
      if (system.fixed[i]) mobility_[i] = 0.0;
  impulse_.resize(terms.damping ? system.springs.size() : 0);
  for (std::size_t s = 0; s < impulse_.size(); ++s) {
    const double both = mobility_[system.ends[s][0]] + mobility_[system.ends[s][1]];  // 1 / mu
    impulse_[s] = both == 0.0 ? 0.0 : one_minus_exp_of_minus(system.springs[s].damping * both * h) / both;
  }
  remains_.resize(terms.viscosity ? system.vertex_count() : 0);
  for (std::size_t i = 0; i < remains_.size(); ++i) remains_[i] = exp_of_minus(system.viscosity[i] * mobility_[i] * h);
}

// The exact flow of one spring: a function of its number. It holds copies for the reason given in `apply`.
auto FrozenDamping::relaxation(const SpringSystem& system, std::span<Vector3d> v) const {
  return [ends = system.ends.data(), along = along_.data(), impulse = impulse_.data(), mobility = mobility_.data(),
          speed = v.data()](std::size_t s) {
    const auto [i, j] = ends[s];
    const Vector3d given = (impulse[s] * (speed[j] - speed[i]).dot(along[s])) * along[s];
    speed[i] += mobility[i] * given;
    speed[j] -= mobility[j] * given;
  };
}

// The same where vertices are held along axes: their response to an impulse depends on its direction.
auto FrozenDamping::relaxation_along_axes(const SpringSystem& system, double h, std::span<Vector3d> v) const {
  return [this, &system, h, v, mobility = Mobility(mobility_, system.held_axes.span())](std::size_t s) {
    const auto [i, j] = system.ends[s];
    const double both = mobility.along(i, along_[s]) + mobility.along(j, along_[s]);
    if (both == 0.0) return;
    const double lost = one_minus_exp_of_minus(system.springs[s].damping * both * h);
    const Vector3d given = (lost / both * (v[j] - v[i]).dot(along_[s])) * along_[s];
    v[i] += mobility.velocity_of(i, given);
    v[j] -= mobility.velocity_of(j, given);
  };
}

#ifdef DARTBOARD_HAS_AVX2
// The same as `relaxation`, with the same bits: a velocity is one load and one store.
DARTBOARD_AVX2 void FrozenDamping::relax_in_padded_rows(const SpringSystem& system, Sweep sweep) {
  const __m256i three = _mm256_setr_epi64x(-1, -1, -1, 0);
  const auto relax = [three, ends = system.ends.data(), along = along_.data(), impulse = impulse_.data(),
                      mobility = mobility_.data(), speed = padded_.data()](std::size_t s) DARTBOARD_AVX2 {
    const auto [i, j] = ends[s];
    double *const first = speed[i].number, *const second = speed[j].number;
    const __m256d direction = _mm256_maskload_pd(along[s].data(), three);
    const __m256d products = _mm256_mul_pd(_mm256_sub_pd(_mm256_load_pd(second), _mm256_load_pd(first)), direction);
    const __m128d xy = _mm256_castpd256_pd128(products), z = _mm256_extractf128_pd(products, 1);
    const __m128d relative = _mm_add_sd(_mm_add_sd(xy, _mm_unpackhi_pd(xy, xy)), z);
    const __m256d size = _mm256_broadcastsd_pd(_mm_mul_sd(_mm_load_sd(impulse + s), relative));
    const __m256d given = _mm256_mul_pd(size, direction);
    const __m256d of_first = _mm256_mul_pd(_mm256_broadcast_sd(mobility + i), given);
    const __m256d of_second = _mm256_mul_pd(_mm256_broadcast_sd(mobility + j), given);
    _mm256_store_pd(first, _mm256_add_pd(_mm256_load_pd(first), of_first));
    _mm256_store_pd(second, _mm256_sub_pd(_mm256_load_pd(second), of_second));
  };
  sweep == Sweep::forwards ? forwards(impulse_.size(), relax) : backwards(impulse_.size(), relax);
}
#else
void FrozenDamping::relax_in_padded_rows(const SpringSystem&, Sweep) {}
#endif

void FrozenDamping::relax_springs(const SpringSystem& system, double h, std::initializer_list<Sweep> sweeps,
                                  std::span<Vector3d> v) {
  const auto relax_all = [&](const auto& relax) {
    for (const Sweep sweep : sweeps)
      sweep == Sweep::forwards ? forwards(impulse_.size(), relax) : backwards(impulse_.size(), relax);
  };
  const bool is_padded = !impulse_.empty() && system.held_axes.empty() && lanes_are_on();
  padded_.resize(is_padded ? v.size() : 0);
  if (is_padded) {
    for (std::size_t i = 0; i < v.size(); ++i) padded_[i] = PaddedVector(v[i]);
    for (const Sweep sweep : sweeps) relax_in_padded_rows(system, sweep);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = three_of(padded_[i]);
  } else if (system.held_axes.empty()) {
    relax_all(relaxation(system, v));
  } else {
    relax_all(relaxation_along_axes(system, h, v));
  }
}

void FrozenDamping::relax_terms(const SpringSystem& system, double h, bool backwards, std::span<Vector3d> v) const {
  const std::size_t count = system.terms.size();
  for (std::size_t k = 0; k < count; ++k)
    if (const TermDamping* damping = system.terms[backwards ? count - 1 - k : k]->damping(); damping != nullptr)
      damping->decay(at_, h, {mobility_, system.held_axes.span()}, backwards, v);
}

void FrozenDamping::slow_down(std::span<Vector3d> v) const {
  for (std::size_t i = 0; i < remains_.size(); ++i) v[i] *= remains_[i];
}

void FrozenDamping::decay_symmetric(const SpringSystem& system, const Terms& terms, double h, std::span<Vector3d> v) {
  prepare_flow(system, terms, h / 2);
  slow_down(v);
  if (terms.damping && has_damped_terms(system)) {
    relax_springs(system, h / 2, {Sweep::forwards}, v);
    relax_terms(system, h / 2, false, v);
    relax_terms(system, h / 2, true, v);
    relax_springs(system, h / 2, {Sweep::backwards}, v);
  } else {
    relax_springs(system, h / 2, {Sweep::forwards, Sweep::backwards}, v);
  }
  slow_down(v);
}

void FrozenDamping::decay_once(const SpringSystem& system, const Terms& terms, double h, std::span<Vector3d> v) {
  prepare_flow(system, terms, h);
  slow_down(v);
  relax_springs(system, h, {Sweep::forwards}, v);
  if (terms.damping) relax_terms(system, h, false, v);
}

}  // namespace dartboard
