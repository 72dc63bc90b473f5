#include "reference/schemes/rosenbrock_witness.h"

#include <Eigen/LU>
#include <cmath>

#include "core/plain/random.h"
#include "reference/schemes/rounding.h"
#include "reference/schemes/step_comparison.h"
#include "reference/schemes/step_matrix.h"

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
using Vectors = std::vector<Vector>;

// Verwer, Spee, Blom, Hundsdorfer 1999: (1 - tau J) k1 = F(u), (1 - tau J) k2 = F(u + h k1) - 2 k1, u += h (3 k1 +
// k2)/2.
class Rosenbrock {
 public:
  Rosenbrock(const SpringNetwork& network, const Vectors& x, Extended h, Tangent tangent)
      : network_(network), x_(x), h_(h), tau_((1 - 1 / std::sqrt(Extended(2))) * h), tangent_(tangent) {
    const DenseMatrix a = step_matrix(network, x, tau_, tangent);
    positive_definite_ = is_positive_definite(a);
    factor_ = Eigen::PartialPivLU<DenseMatrix>(a);
  }

  bool positive_definite() const { return positive_definite_; }

  // `off`: the residual of a solution over its right-hand side, in directions drawn at random
  void step(std::vector<Extended>& y, Extended off, SplitMix64& random) const {
    const std::size_t n = y.size();
    const NetworkRates<Extended> rates(network_);
    std::vector<Extended> rate(n), moved(y), k1(n), k2(n);
    rates(y.data(), rate.data());
    solve(rate, k1, off, random);
    for (std::size_t c = 0; c < n; ++c) moved[c] += h_ * k1[c];
    rates(moved.data(), rate.data());
    for (std::size_t c = 0; c < n; ++c) rate[c] -= 2 * k1[c];
    solve(rate, k2, off, random);
    for (std::size_t c = 0; c < n; ++c) y[c] += h_ / 2 * (3 * k1[c] + k2[c]);
  }

 private:
  // kx = rx + tau kv, so (M + tau C + tau^2 K) kv = M rv - tau K rx.
  void solve(const std::vector<Extended>& r, std::vector<Extended>& k, Extended off, SplitMix64& random) const {
    const std::size_t n = network_.point_count();
    Vectors right(n);
    for (std::size_t i = 0; i < n; ++i) right[i] = network_.mass[i] * three(r, n + i);
    for (const Spring& s : network_.springs) {
      const Vector pull = tau_ * (stiffness_of(s, x_[s.b] - x_[s.a], tangent_) * (three(r, s.b) - three(r, s.a)));
      right[s.a] += pull;
      right[s.b] -= pull;
    }
    const std::vector<Extended> places = numbers_of(x_);
    for (const ElasticPoint& point : network_.elements) {
      const StressSlope slope = slope_of(point, places.data(), tangent_);
      for (std::size_t p = 0; p < point.corner.size(); ++p)
        for (std::size_t q = 0; q < point.corner.size(); ++q)
          right[point.corner[p]] -= tau_ * (stiffness_block(point, slope, p, q) * three(r, point.corner[q]));
    }
    DenseColumn b = column_of(network_, right);
    const Extended size = off * b.norm() / std::sqrt(Extended(b.size()));
    for (Extended& c : b)
      if (c != 0) c += size * Extended(random.next_signed());
    const DenseColumn kv = factor_.solve(b);
    for (std::size_t c = 0; c < 3 * n; ++c) {
      k[3 * n + c] = kv[static_cast<Eigen::Index>(c)];
      k[c] = r[c] + tau_ * k[3 * n + c];
    }
  }

  const SpringNetwork& network_;
  Vectors x_;
  Extended h_, tau_;
  Tangent tangent_;
  Eigen::PartialPivLU<DenseMatrix> factor_;
  bool positive_definite_;
};

}  // namespace

StepJudgement judge_rosenbrock(const SpringNetwork& network, const TakenStep& step) {
  const std::vector<Extended> start = vector_of<Extended>(step.before);
  const Vectors x = part_of(start, 0);
  const auto judge = [&](const Rosenbrock& method) {
    SplitMix64 random(2);
    std::vector<std::vector<Extended>> others;
    for (int run = 0; run < 2; ++run) method.step(others.emplace_back(start), solver_tolerance, random);
    return compare_step(
        network, step, [&](std::vector<Extended>& y) { method.step(y, 0, random); }, others);
  };
  const Rosenbrock exact(network, x, step.h, Tangent::exact);
  const StepJudgement judgement = judge(exact);
  if (judgement.right() || exact.positive_definite()) return judgement;
  return judge(Rosenbrock(network, x, step.h, Tangent::projected));
}

}  // namespace dartboard::reference
