#include "validation/stability/energy_rounding.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/time/explicit/compensated_splitting.h"
#include "core/time/integrators.h"

namespace dartboard {
namespace {

constexpr double omega = 2.0, length = 2.0;

/// A mass of 1 kg on a spring at a wall, and the digits that its position and velocity lack.
class Oscillator {
 public:
  Oscillator(std::string_view name, double q, double v) : integrator_(make_integrator(name)) {
    x_[1].x() = length + q;
    v_[1].x() = v;
    compensated_ = dynamic_cast<const CompensatedSplitting*>(integrator_.get());
  }
  void step(double h) {
    const StepResult result = integrator_->step(system_, {x_, v_}, h);
    if (!result.ok()) throw SolverError(to_string(result));
  }
  double seen() const { return x_[1].x(); }
  long double q() const { return static_cast<long double>(x_[1].x()) - length + lost(&TrialState::x); }
  long double moved_from(double x) const { return static_cast<long double>(x_[1].x()) - x + lost(&TrialState::x); }
  long double v() const { return static_cast<long double>(v_[1].x()) + lost(&TrialState::v); }

 private:
  long double lost(std::vector<Eigen::Vector3d> TrialState::*column) const {
    return compensated_ && (compensated_->lost().*column).size() == 2 ? (compensated_->lost().*column)[1].x() : 0.0L;
  }

  std::array<SpringEnds, 1> ends_{{{0, 1}}};
  std::vector<Spring> springs_{{length, omega* omega, 0.0}};
  std::array<double, 2> mass_{1.0, 1.0}, viscosity_{0.0, 0.0};
  std::array<std::uint8_t, 2> fixed_{1, 0};
  SpringSystem system_{ends_, springs_, mass_, mass_, viscosity_, fixed_, {0, 0, 0}};
  std::array<Eigen::Vector3d, 2> x_{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0)};
  std::array<Eigen::Vector3d, 2> v_{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0)};
  std::unique_ptr<Integrator> integrator_;
  const CompensatedSplitting* compensated_ = nullptr;
};

// For a symmetric splitting, whose matrix [a b; c a] on (q, v) has determinant 1: v^2 - (c/b) q^2 is conserved.
long double weight_of_positions(std::string_view integrator, double h) {
  const bool verlet = integrator.starts_with("verlet");
  if (!verlet && !integrator.starts_with("blanes-moan-4"))
    throw InputError(fmt::format("the form that {} conserves is not known", integrator));
  const Splitting& splitting = verlet ? verlet_splitting() : blanes_moan_4_splitting();
  Eigen::Matrix<long double, 2, 2> product, part;
  product.setIdentity();
  const auto apply = [&](long double q_from_v, long double v_from_q) {
    part << 1, q_from_v, v_from_q, 1;
    product = (part * product).eval();
  };
  for (std::size_t k = 0; k < splitting.kicks.size(); ++k) {
    apply(splitting.drifts[k] * h, 0);
    apply(0, -static_cast<long double>(splitting.kicks[k] * h) * (omega * omega));
  }
  apply(splitting.last_drift * h, 0);
  return -product(1, 0) / product(0, 1);
}

}  // namespace

double exponent_of(std::span<const RoundingGrowth::Point> points) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(points.size());
  for (const auto& p : points) {
    const double x = std::log(static_cast<double>(p.steps)), y = std::log(p.error);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

double exponent_error(std::span<const RoundingGrowth::Point> points, const std::vector<std::vector<double>>& squares) {
  const auto n = static_cast<double>(squares.size());
  if (squares.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> without;
  for (std::size_t left_out = 0; left_out < squares.size(); ++left_out) {
    std::vector<RoundingGrowth::Point> rest(points.begin(), points.end());
    for (std::size_t p = 0; p < rest.size(); ++p) {
      double sum = 0.0;
      for (std::size_t start = 0; start < squares.size(); ++start)
        if (start != left_out) sum += squares[start][p];
      rest[p].error = std::sqrt(sum / (n - 1.0));
    }
    without.push_back(exponent_of(rest));
  }
  const double mean = std::accumulate(without.begin(), without.end(), 0.0) / n;
  double sum = 0.0;
  for (const double e : without) sum += (e - mean) * (e - mean);
  return std::sqrt((n - 1.0) / n * sum);
}

RoundingGrowth measure_rounding_growth(std::string_view integrator, std::uint64_t steps, int starts) {
  RoundingGrowth growth{.integrator = std::string(integrator), .h_omega = 0.05, .starts = starts};
  std::vector<std::vector<double>> squares;
  const double h = growth.h_omega / omega;
  const long double weight = weight_of_positions(integrator, h);
  for (double at = steps < 1000000 ? 1e3 : 1e4; at < 1.01 * static_cast<double>(steps); at *= std::sqrt(10.0))
    growth.points.push_back({static_cast<std::uint64_t>(std::llround(at)), 0.0});
  SplitMix64 random(5);
  for (int start = 0; start < starts; ++start) {
    const double q = 0.25 * (1.5 + 0.5 * random.next_signed()), v = 0.5 * random.next_signed();
    Oscillator body(integrator, q, v);
    const auto energy = [&] { return body.v() * body.v() + weight * body.q() * body.q(); };
    const long double before = energy();
    std::uint64_t done = 0;
    squares.emplace_back();
    for (RoundingGrowth::Point& point : growth.points) {
      for (; done < point.steps; ++done) body.step(h);
      const auto error = static_cast<double>((energy() - before) / before);
      squares.back().push_back(error * error);
      point.error += error * error / starts;
    }
  }
  for (RoundingGrowth::Point& point : growth.points) point.error = std::sqrt(point.error);
  growth.exponent = exponent_of(growth.points);
  growth.standard_error = exponent_error(growth.points, squares);
  return growth;
}

TinySteps measure_tiny_steps(std::string_view integrator, double h, std::uint64_t steps) {
  constexpr double q = 0.125, v = 0.25;
  TinySteps result{std::string(integrator), h, steps, 0.0, 0.0, 0.0};
  Oscillator body(integrator, q, v);
  for (std::uint64_t k = 0; k < steps; ++k) body.step(h);
  // the motion itself: the error of the methods is of order (h omega)^2
  const long double phase = static_cast<long double>(steps) * h * omega;
  // cos(phase) - 1 without cancellation
  const long double half = std::sin(phase / 2);
  const long double exact = -2.0L * q * half * half + v / omega * std::sin(phase);
  const auto share = [exact](long double moved) { return static_cast<double>(std::abs((moved - exact) / exact)); };
  result.lost = share(static_cast<long double>(body.seen()) - length - q);
  result.lost_with_digits = share(body.moved_from(length + q));
  const double place = std::nextafter(length + q, 4.0) - (length + q);
  result.readable = static_cast<double>(place / 2 / std::abs(exact));
  return result;
}

}  // namespace dartboard
