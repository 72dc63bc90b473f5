#include "reference/spring_network.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"

namespace dartboard::reference {
namespace {

// The largest eigenvalue of M^-1 K, `add(p, result)` being result += K p.
template <class Add>
double largest_eigenvalue(const SpringNetwork& network, const Add& add) {
  const std::size_t n = network.point_count();
  std::vector<Eigen::Vector3d> now(n), next(n);
  SplitMix64 random(1);
  for (auto& p : now) p = random.next_in_ball();
  double eigenvalue = 0.0;
  for (int iteration = 0; iteration < 200; ++iteration) {
    double norm = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (network.fixed[i]) now[i].setZero();
      norm += network.mass[i] * now[i].squaredNorm();
    }
    if (norm == 0.0) return 0.0;
    std::fill(next.begin(), next.end(), Eigen::Vector3d::Zero());
    add(now, next);
    double product = 0.0;  // Rayleigh's quotient: at worst too low
    for (std::size_t i = 0; i < n; ++i) {
      product += now[i].dot(next[i]);
      next[i] /= network.mass[i] * std::sqrt(norm);
    }
    eigenvalue = product / norm;
    std::swap(now, next);
  }
  return eigenvalue;
}

// K = sum of w u u^T, w being the weights of the springs along their lines.
template <class Weight>
void add_springs(const SpringNetwork& network, std::span<const Eigen::Vector3d> x, Weight&& weight,
                 const std::vector<Eigen::Vector3d>& p, std::vector<Eigen::Vector3d>& result) {
  for (const Spring& s : network.springs) {
    const Eigen::Vector3d line = x[s.b] - x[s.a];
    const double square = line.squaredNorm();
    if (square == 0.0) continue;
    const Eigen::Vector3d pull = weight(s) * (p[s.b] - p[s.a]).dot(line) / square * line;
    result[s.a] -= pull;
    result[s.b] += pull;
  }
}

// K of an element at rest times a weight; for all laws it is that of linear elasticity.
template <class Weight>
void add_elements(const SpringNetwork& network, Weight&& weight, const std::vector<Eigen::Vector3d>& p,
                  std::vector<Eigen::Vector3d>& result) {
  for (const ElasticPoint& point : network.elements) {
    Eigen::Matrix3d strain = Eigen::Matrix3d::Zero();
    for (std::size_t a = 0; a < point.corner.size(); ++a)
      strain += p[point.corner[a]] * point.gradient[a].cast<double>().transpose();
    strain = ((strain + strain.transpose()) / 2).eval();
    const Eigen::Matrix3d stress = 2 * static_cast<double>(point.law.mu) * strain +
                                   static_cast<double>(point.law.lambda) * strain.trace() * Eigen::Matrix3d::Identity();
    for (std::size_t a = 0; a < point.corner.size(); ++a)
      result[point.corner[a]] +=
          weight(point) * static_cast<double>(point.volume) * (stress * point.gradient[a].cast<double>());
  }
}

}  // namespace

SpringNetwork spring_network(const Problem& problem) {
  Rebuilt body = rebuild(problem.mesh, problem.material);
  SpringNetwork network;
  network.mass = std::move(body.mass);
  network.springs = std::move(body.springs);
  network.viscosity = problem.material.viscosity;
  network.gravity = problem.surroundings.gravity;
  network.fixed.assign(network.mass.size(), 0);
  for (const std::uint32_t i : problem.fixed) {
    if (i >= network.fixed.size())
      throw InputError(fmt::format("point {} is fixed, and there are {}", i, network.fixed.size()));
    network.fixed[i] = 1;
  }
  check(network);
  return network;
}

void check(const SpringNetwork& network) {
  const std::size_t n = network.point_count();
  if (network.fixed.size() != n)
    throw InputError(fmt::format("{} points, {} entries in `fixed`", n, network.fixed.size()));
  for (const std::size_t size : {network.pull.size(), network.held_axes.size()})
    if (size != 0 && size != n) throw InputError(fmt::format("a column of {} for {} points", size, n));
  for (const Eigen::Vector3d& pull : network.pull)
    if (!pull.allFinite()) throw InputError("a pull that is not finite");
  for (std::size_t i = 0; i < n; ++i)
    if (!(network.mass[i] > 0.0) || !std::isfinite(network.mass[i]))
      throw InputError(fmt::format("point {} has a mass of {}, expected a positive one", i, network.mass[i]));
  for (std::size_t e = 0; e < network.springs.size(); ++e) {
    const Spring& s = network.springs[e];
    if (s.a >= n || s.b >= n || s.a == s.b)
      throw InputError(fmt::format("spring {} joins points {} and {} of {}", e, s.a, s.b, n));
    if (!std::isfinite(s.stiffness) || !std::isfinite(s.damping) || !std::isfinite(s.rest_length))
      throw InputError(fmt::format("spring {} has a number that is not finite", e));
  }
  for (std::size_t e = 0; e < network.elements.size(); ++e) {
    const ElasticPoint& point = network.elements[e];
    for (const std::uint32_t i : point.corner)
      if (i >= n) throw InputError(fmt::format("element {} has point {} of {}", e, i, n));
    bool finite = std::isfinite(point.law.mu) && std::isfinite(point.law.lambda) && std::isfinite(point.volume) &&
                  std::isfinite(point.damping_time);
    for (const auto& gradient : point.gradient) finite = finite && gradient.allFinite();
    if (!finite) throw InputError(fmt::format("element {} has a number that is not finite", e));
  }
  if (!std::isfinite(network.viscosity) || !network.gravity.allFinite())
    throw InputError("viscosity and gravity must be finite");
}

double mean_rest_length(const SpringNetwork& network) {
  if (network.edge > 0.0) return network.edge;
  if (network.springs.empty()) return 1.0;
  double sum = 0.0;
  for (const Spring& s : network.springs) sum += s.rest_length;
  return sum > 0.0 ? sum / static_cast<double>(network.springs.size()) : 1.0;
}

double fastest_rate(const SpringNetwork& network, std::span<const Eigen::Vector3d> x) {
  const double omega = std::sqrt(largest_eigenvalue(network, [&](const auto& p, auto& result) {
    add_springs(
        network, x, [](const Spring& s) { return std::abs(s.stiffness); }, p, result);
    add_elements(
        network, [](const ElasticPoint&) { return 1.0; }, p, result);
  }));
  const double decay = largest_eigenvalue(network, [&](const auto& p, auto& result) {
    add_springs(
        network, x, [](const Spring& s) { return std::abs(s.damping); }, p, result);
    add_elements(
        network, [](const ElasticPoint& e) { return static_cast<double>(e.damping_time); }, p, result);
  });
  return max_or_nan(omega, decay + network.viscosity);
}

}  // namespace dartboard::reference
