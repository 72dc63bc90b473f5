#include "core/time/explicit/padded_runge_kutta.h"

#include <atomic>
#include <cstdint>

#include "core/base/four.h"
#include "core/base/lanes.h"
#include "core/time/method/trial_state.h"
#include "core/time/system/spring_sums.h"

namespace dartboard {

bool PaddedRungeKutta::can_step(const SpringSystem& system) { return system.terms.empty() && lanes_are_on(); }

#ifdef DARTBOARD_HAS_AVX2
namespace {

using Eigen::Vector3d;

DARTBOARD_AVX2_INLINE Four load(const PaddedVector& row) { return _mm256_load_pd(row.number); }
DARTBOARD_AVX2_INLINE Four load(const Vector3d& v) {
  const double* const number = v.data();
  return _mm256_insertf128_pd(_mm256_castpd128_pd256(_mm_loadu_pd(number)), _mm_load_sd(number + 2), 1);
}
DARTBOARD_AVX2_INLINE void store(PaddedVector& row, Four numbers) { _mm256_store_pd(row.number, numbers); }
DARTBOARD_AVX2_INLINE void store(Vector3d& v, Four numbers) {
  double* const number = v.data();
  _mm_storeu_pd(number, _mm256_castpd256_pd128(numbers));
  _mm_store_sd(number + 2, _mm256_extractf128_pd(numbers, 1));
}

/// Zero along the axes that are held.
DARTBOARD_AVX2_INLINE Four free_part(HeldAxes held, Four v) {
  const __m256i bits = _mm256_and_si256(_mm256_set1_epi64x(held), _mm256_set_epi64x(0, 4, 2, 1));
  return _mm256_and_pd(v, _mm256_castsi256_pd(_mm256_cmpeq_epi64(bits, _mm256_setzero_si256())));
}

/// What turns the force on a vertex into its acceleration, by the operations of `accelerations` in their order.
struct Mechanics {
  const double *inverse_mass, *viscosity;
  const Vector3d* pull;       // null where there is none
  const HeldAxes* held_axes;  // likewise
  const std::uint8_t* fixed;  // likewise
  Vector3d gravity;

  Mechanics(const SpringSystem& system, const Terms& terms)
      : inverse_mass(system.inverse_mass.data()),
        viscosity(system.viscosity.data()),
        pull(system.pull.empty() ? nullptr : system.pull.data()),
        held_axes(system.held_axes.empty() ? nullptr : system.held_axes.data()),
        fixed(terms.fixed ? system.fixed.data() : nullptr),
        gravity(system.gravity) {}

  template <bool viscous>
  DARTBOARD_AVX2_INLINE Four acceleration(std::size_t i, Four force, Four v, Four g) const {
    if constexpr (viscous) force = force - four(viscosity[i]) * v;
    Four a = force * four(inverse_mass[i]) + g;
    if (pull != nullptr) a = a + load(pull[i]);
    if (held_axes != nullptr) a = free_part(held_axes[i], a);
    if (fixed != nullptr && fixed[i] != 0) a = four(0.0);
    return a;
  }
};

struct Columns {
  std::size_t size;
  const Vector3d *start_x, *start_v;
  PaddedVector *x, *v, *force, *sum_x, *sum_v;  // x, v and force of the stage
};

/// The stage whose forces are known: that at the start of a step, one of the two in its middle, or the last one.
enum class Stage { first, middle, last };

/// To the stage that follows, `reach` [s] from the start of the step; or to the end of the step, with `reach` as the
/// weight of the sums. The vertices from `first` to before `last`.
///
/// post     the forces are zero
/// returns  whether the end of the step is finite; true before
template <Stage stage, bool viscous>
DARTBOARD_AVX2 bool advance(const Mechanics mechanics, const Columns at, double reach, std::size_t first,
                            std::size_t last) {
  const Four far = four(reach), two = four(2.0), zero = four(0.0), gravity = load(mechanics.gravity);
  Four sum = zero;  // 0 * x is 0 for every finite x and NaN for all others
  for (std::size_t i = first; i < last; ++i) {
    const Four v = load(at.v[i]), a = mechanics.acceleration<viscous>(i, load(at.force[i]), v, gravity);
    store(at.force[i], zero);
    if constexpr (stage == Stage::last) {
      const Four x_end = load(at.start_x[i]) + far * (load(at.sum_x[i]) + v);
      const Four v_end = load(at.start_v[i]) + far * (load(at.sum_v[i]) + a);
      sum = sum + (zero * x_end + zero * v_end);
      store(at.x[i], x_end);
      store(at.v[i], v_end);
    } else {
      store(at.sum_x[i], stage == Stage::first ? v : load(at.sum_x[i]) + two * v);
      store(at.sum_v[i], stage == Stage::first ? a : load(at.sum_v[i]) + two * a);
      store(at.x[i], load(at.start_x[i]) + far * v);
      store(at.v[i], load(at.start_v[i]) + far * a);
    }
  }
  return _mm256_movemask_pd(_mm256_cmp_pd(sum, zero, _CMP_NEQ_UQ)) == 0;
}

template <class To, class From>
DARTBOARD_AVX2 void copy(const From* from, To* to, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) store(to[i], load(from[i]));
}

/// Goes on with all vertices, after the forces of the stage.
template <Stage stage>
bool go_on(const SpringSystem& system, const Terms& terms, const Columns& at, double reach) {
  sum_spring_forces<PaddedVector>(system, terms, {at.x, at.size}, {at.v, at.size}, {at.force, at.size}, true);
  const Mechanics mechanics(system, terms);
  std::atomic<bool> is_finite = true;
  terms.for_each_share(at.size, [&](std::size_t first, std::size_t last) {
    const auto own = terms.viscosity ? advance<stage, true> : advance<stage, false>;
    if (!own(mechanics, at, reach, first, last)) is_finite = false;
  });
  return is_finite;
}

}  // namespace

StepResult PaddedRungeKutta::step(const SpringSystem& system, const Terms& terms, Motion motion, double h,
                                  WorkCounters& work) {
  const std::size_t n = motion.x.size();
  for (auto* column : {&x_, &v_, &force_, &sum_x_, &sum_v_}) column->resize(n);
  const Columns at{n,         motion.x.data(), motion.v.data(), x_.data(),
                   v_.data(), force_.data(),   sum_x_.data(),   sum_v_.data()};
  terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
    copy<PaddedVector, Vector3d>(motion.x.data(), x_.data(), first, last);
    copy<PaddedVector, Vector3d>(motion.v.data(), v_.data(), first, last);
  });
  go_on<Stage::first>(system, terms, at, h / 2);
  go_on<Stage::middle>(system, terms, at, h / 2);
  go_on<Stage::middle>(system, terms, at, h);
  const bool is_finite = go_on<Stage::last>(system, terms, at, h / 6);
  work.force_evaluations += 4;
  if (!is_finite) {
    TrialState end;
    for (std::size_t i = 0; i < n; ++i) {
      end.x.push_back(three_of(x_[i]));
      end.v.push_back(three_of(v_[i]));
    }
    return end.commit(motion, work);  // diagnoses it
  }
  terms.for_each_share(n, [&](std::size_t first, std::size_t last) {
    copy(x_.data(), motion.x.data(), first, last);
    copy(v_.data(), motion.v.data(), first, last);
  });
  ++work.steps;
  return {};
}

#else

StepResult PaddedRungeKutta::step(const SpringSystem&, const Terms&, Motion, double, WorkCounters&) { return {}; }

#endif

}  // namespace dartboard
