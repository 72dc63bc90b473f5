#include "reference/schemes/explicit_schemes.h"

#include <algorithm>
#include <cmath>

#include "core/plain/error.h"
#include "reference/schemes/network_state.h"

namespace dartboard::reference {
namespace {

template <class Real>
using Rows = std::vector<std::vector<Real>>;

// Row s: the weights of the stages before stage s; the last row: those of the result.
template <class Real>
Rows<Real> tableau_of(std::string_view name) {
  const auto q = [](int p, int over) { return Real(p) / Real(over); };
  if (name == "explicit-euler") return {{}, {Real(1)}};
  if (name == "rk4") return {{}, {q(1, 2)}, {0, q(1, 2)}, {0, 0, 1}, {q(1, 6), q(1, 3), q(1, 3), q(1, 6)}};
  if (name == "dormand-prince-54")
    return {{},
            {q(1, 5)},
            {q(3, 40), q(9, 40)},
            {q(44, 45), q(-56, 15), q(32, 9)},
            {q(19372, 6561), q(-25360, 2187), q(64448, 6561), q(-212, 729)},
            {q(9017, 3168), q(-355, 33), q(46732, 5247), q(49, 176), q(-5103, 18656)},
            {q(35, 384), 0, q(500, 1113), q(125, 192), q(-2187, 6784), q(11, 84)}};
  return {};
}

// Drift, kick, drift, kick, ..., drift, as fractions of the step.
template <class Real>
struct Composition {
  std::vector<Real> drifts, kicks;
  enum class Damping { in_turn_once, in_turn_there_and_back, series } damping;
};

template <class Real>
Composition<Real> composition_of(std::string_view name) {
  using Damping = typename Composition<Real>::Damping;
  const Real half = Real(1) / Real(2);
  if (name == "symplectic-euler") return {{0, 1}, {1}, Damping::in_turn_once};
  if (name == "verlet") return {{half, half}, {1}, Damping::in_turn_there_and_back};
  if (name == "verlet-compensated") return {{half, half}, {1}, Damping::series};
  // Blanes, Moan 2002, table 2, S6; the last digits follow from consistency
  const auto a1 = Real(0.0792036964311957L), a2 = Real(0.353172906049774L), a3 = Real(-0.0420650803577195L);
  const auto b1 = Real(0.209515106613362L), b2 = Real(-0.143851773179818L), b3 = half - b1 - b2;
  const Real a4 = 1 - 2 * (a1 + a2 + a3);
  return {{a1, a2, a3, a4, a3, a2, a1}, {b1, b2, b3, b3, b2, b1}, Damping::series};
}

constexpr std::string_view runge_kutta_methods[]{"explicit-euler", "rk4", "dormand-prince-54"};
constexpr std::string_view splittings[]{"symplectic-euler", "verlet", "verlet-compensated", "blanes-moan-4",
                                        "blanes-moan-4-compensated"};

SpringNetwork elastic_part(SpringNetwork network) {
  network.viscosity = 0.0;
  for (Spring& s : network.springs) s.damping = 0.0;
  for (ElasticPoint& point : network.elements) point.damping_time = 0;
  return network;
}
SpringNetwork dissipative_part(SpringNetwork network) {
  network.gravity.setZero();
  network.pull.clear();
  std::erase_if(network.elements, [](const ElasticPoint& point) { return point.damping_time == 0; });
  for (ElasticPoint& point : network.elements) point.is_elastic = false;
  for (Spring& s : network.springs) s.stiffness = 0.0;
  return network;
}

}  // namespace

bool is_explicit_scheme(std::string_view name) {
  return std::ranges::find(runge_kutta_methods, name) != std::end(runge_kutta_methods) ||
         std::ranges::find(splittings, name) != std::end(splittings);
}

template <class Real>
ExplicitScheme<Real>::ExplicitScheme(std::string_view name, const SpringNetwork& network)
    : name_(name),
      network_(&network),
      elastic_(elastic_part(network)),
      dissipative_(dissipative_part(network)),
      rates_(network),
      elastic_rates_(elastic_),
      dissipative_rates_(dissipative_) {
  if (!is_explicit_scheme(name)) throw InputError("no explicit scheme has this name");
  dissipates_ = network.viscosity != 0.0 ||
                std::ranges::any_of(network.springs, [](const Spring& s) { return s.damping != 0.0; }) ||
                std::ranges::any_of(network.elements, [](const ElasticPoint& e) { return e.damping_time != 0; });
}

template <class Real>
void ExplicitScheme<Real>::step(std::vector<Real>& y, Real h) const {
  std::ranges::find(splittings, name_) != std::end(splittings) ? splitting(y, h) : runge_kutta(y, h);
}

template <class Real>
void ExplicitScheme<Real>::runge_kutta(std::vector<Real>& y, Real h) const {
  const Rows<Real> tableau = tableau_of<Real>(name_);
  Rows<Real> k;
  std::vector<Real> stage;
  for (const std::vector<Real>& row : tableau) {
    stage = y;
    for (std::size_t j = 0; j < row.size(); ++j)
      if (row[j] != Real(0))
        for (std::size_t c = 0; c < stage.size(); ++c) stage[c] += h * row[j] * k[j][c];
    if (k.size() + 1 < tableau.size()) rates_(stage.data(), k.emplace_back(stage.size()).data());
  }
  y = stage;
}

template <class Real>
void ExplicitScheme<Real>::splitting(std::vector<Real>& y, Real h) const {
  using Damping = typename Composition<Real>::Damping;
  const Composition<Real> parts = composition_of<Real>(name_);
  const std::size_t n = y.size() / 2;
  std::vector<Real> rate(y.size()), v(n), kick(n);
  for (std::size_t k = 0;; ++k) {
    for (std::size_t c = 0; c < n; ++c) y[c] += h * parts.drifts[k] * y[n + c];
    if (k == parts.kicks.size()) return;
    const Real t = h * parts.kicks[k];
    elastic_rates_(y.data(), rate.data());
    std::copy(rate.begin() + static_cast<std::ptrdiff_t>(n), rate.end(), kick.begin());
    std::copy(y.begin() + static_cast<std::ptrdiff_t>(n), y.end(), v.begin());
    if (!dissipates_) {
      for (std::size_t c = 0; c < n; ++c) v[c] += t * kick[c];
    } else if (parts.damping == Damping::series) {
      decay_by_series(y, kick, v, t);
    } else {
      // half of the kick before the decay and half after it if the decay goes there and back
      const bool both = parts.damping == Damping::in_turn_there_and_back;
      for (std::size_t c = 0; c < n; ++c) v[c] += (both ? t / 2 : t) * kick[c];
      decay_in_turn(y, v, t, both);
      for (std::size_t c = 0; both && c < n; ++c) v[c] += t / 2 * kick[c];
    }
    std::copy(v.begin(), v.end(), y.begin() + static_cast<std::ptrdiff_t>(n));
  }
}

// The exact flow of viscosity, then of each damper as if it were alone: the relative speed of its ends decays at the
// rate c (1/m + 1/m'). Dampers come in eight interleaved lots, which is part of the method: another order gives another
// result. Then each point of an element, strain by strain: N decays at the rate of its modulus times V sum |F N g|^2 /
// m. There and back: all that for half the time, then in the opposite order.
template <class Real>
void ExplicitScheme<Real>::decay_in_turn(const std::vector<Real>& y, std::vector<Real>& v, Real h,
                                         bool there_and_back) const {
  using std::exp, std::expm1;
  const std::size_t count = network_->springs.size(), lot = (count + 7) / 8;
  std::vector<std::size_t> order;
  for (std::size_t first = 0; first < lot; ++first)
    for (std::size_t s = first; s < count; s += lot) order.push_back(s);
  const Real part = there_and_back ? h / 2 : h;
  const auto slow_down = [&] {
    for (std::size_t i = 0; i < network_->point_count(); ++i)
      if (!network_->fixed[i]) three(v, i) *= exp(-Real(network_->viscosity) * part);
  };
  const auto relax = [&](std::size_t s) {
    const Spring& spring = network_->springs[s];
    const Vector3<Real> line = three(y, spring.b) - three(y, spring.a);
    const Real length = line.norm();
    const Real of_a = network_->fixed[spring.a] ? Real(0) : 1 / Real(network_->mass[spring.a]);
    const Real of_b = network_->fixed[spring.b] ? Real(0) : 1 / Real(network_->mass[spring.b]);
    if (length == Real(0) || of_a + of_b == Real(0)) return;
    const Vector3<Real> along = line / length;
    const Real apart = (three(v, spring.b) - three(v, spring.a)).dot(along);
    const Real impulse = -expm1(-Real(spring.damping) * (of_a + of_b) * part) / (of_a + of_b) * apart;
    three(v, spring.a) += of_a * impulse * along;
    three(v, spring.b) -= of_b * impulse * along;
  };
  const auto relax_strain = [&](const ElasticPoint& point, int k) {
    const Matrix3<Real> along = deformation(point, y.data()) * unit_strain<Real>(k);
    const Real modulus = Real(point.damping_time) * Real(2 * point.law.mu + (k == 0 ? 3 * point.law.lambda : 0));
    Real rate(0), mobile(0);
    std::vector<std::pair<Vector3<Real>, Real>> arms;  // and the mobility of the corner that each moves
    for (std::size_t a = 0; a < point.corner.size(); ++a) {
      const std::uint32_t i = point.corner[a];
      arms.emplace_back(along * point.gradient[a].template cast<Real>(),
                        network_->fixed[i] ? Real(0) : 1 / Real(network_->mass[i]));
      rate += arms.back().first.dot(three(v, i));
      mobile += arms.back().second * arms.back().first.squaredNorm();
    }
    if (mobile == Real(0)) return;
    const Real impulse = -expm1(-modulus * Real(point.volume) * mobile * part) / mobile * rate;
    for (std::size_t a = 0; a < arms.size(); ++a) three(v, point.corner[a]) -= arms[a].second * impulse * arms[a].first;
  };
  const std::vector<ElasticPoint>& points = dissipative_.elements;
  slow_down();
  std::ranges::for_each(order, relax);
  for (const ElasticPoint& point : points)
    for (int k = 0; k < 6; ++k) relax_strain(point, k);
  if (!there_and_back) return;
  for (auto point = points.rbegin(); point != points.rend(); ++point)
    for (int k = 6; k-- > 0;) relax_strain(*point, k);
  std::for_each(order.rbegin(), order.rend(), relax);
  slow_down();
}

// v' = a - B v over t with a held: v += t phi(-t B) (a - B v), phi(z) = (e^z - 1) / z, its series up to z^3.
template <class Real>
void ExplicitScheme<Real>::decay_by_series(const std::vector<Real>& y, const std::vector<Real>& kick,
                                           std::vector<Real>& v, Real h) const {
  const std::size_t n = v.size();
  std::vector<Real> state(y), rate(y.size());
  const auto minus_b = [&](const std::vector<Real>& of) {
    std::copy(of.begin(), of.end(), state.begin() + static_cast<std::ptrdiff_t>(n));
    dissipative_rates_(state.data(), rate.data());
    return std::vector<Real>(rate.begin() + static_cast<std::ptrdiff_t>(n), rate.end());
  };
  std::vector<Real> term = minus_b(v);
  for (std::size_t c = 0; c < n; ++c) term[c] += kick[c];
  Real weight = h;
  for (int power = 1;; ++power) {
    for (std::size_t c = 0; c < n; ++c) v[c] += weight * term[c];
    if (power == 4) return;
    term = minus_b(term);
    weight *= h / Real(power + 1);
  }
}

template class ExplicitScheme<double>;
template class ExplicitScheme<long double>;

}  // namespace dartboard::reference
