#include "reference/schemes/local_global_witness.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <limits>

#include "reference/schemes/stage_equation.h"
#include "reference/schemes/step_comparison.h"
#include "reference/schemes/step_matrix.h"

namespace dartboard::reference {
namespace {

using Vector = Vector3<Extended>;
using Vectors = std::vector<Vector>;

// Liu, Bargteil, O'Brien, Kavan 2013: backward Euler's equation by twenty corrections with the constant matrix
// m + h c + h^2 k of the spring graph (for elements, the trace of their stiffness at rest), or fewer if it is
// solved earlier.
class LocalGlobalWitness {
 public:
  static constexpr int corrections = 20;

  LocalGlobalWitness(const SpringNetwork& network, Extended h) : network_(network), h_(h) {
    const auto n = static_cast<Eigen::Index>(network.point_count());
    DenseMatrix a = DenseMatrix::Zero(n, n);
    const auto fixed = [&](Eigen::Index i) { return network.fixed[static_cast<std::size_t>(i)] != 0; };
    for (Eigen::Index i = 0; i < n; ++i)
      a(i, i) =
          fixed(i) ? Extended(1) : network.mass[static_cast<std::size_t>(i)] * (1 + h * Extended(network.viscosity));
    for (const Spring& s : network.springs)
      for (const Eigen::Index i : {s.a, s.b})
        for (const Eigen::Index j : {s.a, s.b})
          if (!fixed(i) && !fixed(j))
            a(i, j) += (i == j ? 1 : -1) * (h * h * Extended(s.stiffness) + h * Extended(s.damping));
    for (const ElasticPoint& point : network.elements) {
      for (std::size_t p = 0; p < point.corner.size(); ++p)
        for (std::size_t q = 0; q < point.corner.size(); ++q) {
          const Eigen::Index i = point.corner[p], j = point.corner[q];
          if (!fixed(i) && !fixed(j))
            a(i, j) += h * (h + point.damping_time) * point.volume * modulus(point.law) *
                       point.gradient[p].dot(point.gradient[q]);
        }
    }
    factor_ = Eigen::LLT<DenseMatrix>(a);
  }

  // `lenient`: by how many roundings in double precision Armijo's condition may be missed.
  void step(std::vector<Extended>& y, int lenient = 0) const {
    const std::size_t n = network_.point_count();
    const StageEquation stage = equation(y);
    Vectors w = stage.start();
    for (int k = 0; k < corrections && stage.excess(w) > 0.5L; ++k) {  // `excess` allows twice the tolerance
      const StageForces at = stage.forces(w);
      DenseMatrix residual = DenseMatrix::Zero(static_cast<Eigen::Index>(n), 3);
      for (std::size_t i = 0; i < n; ++i)
        if (!network_.fixed[i])
          residual.row(static_cast<Eigen::Index>(i)) =
              network_.mass[i] * (w[i] - stage.vh[i] - h_ * at.acceleration[i]).transpose();
      const DenseMatrix correction = factor_.solve(residual);
      // Armijo's condition; with springs the whole correction meets it, because the matrix is at least as stiff
      const Extended slope = -residual.cwiseProduct(correction).sum();
      for (Extended share = 1; share > 1e-12L; share /= 2) {
        Vectors trial = w;
        for (std::size_t i = 0; i < n; ++i)
          if (!network_.fixed[i]) trial[i] -= share * correction.row(static_cast<Eigen::Index>(i)).transpose();
        const StageEquation::Change change = stage.potential_change(w, trial);
        const Extended rounding = 64 * std::numeric_limits<Extended>::epsilon() * change.sizes +
                                  lenient * Extended(std::numeric_limits<double>::epsilon()) * change.sizes;
        if (network_.elements.empty() || change.value <= 1e-4L * share * slope + rounding) {
          w = trial;
          break;
        }
      }
    }
    for (std::size_t i = 0; i < n; ++i) {
      three(y, i) += h_ * w[i];
      three(y, n + i) = w[i];
    }
  }

  // [m, m/s] The effect of a correction too many or too few, and of the rounding in all of them: the sizes of the
  // inverse's entries times the residuals allowed. (With springs the inverse has no negative entry, as no off-diagonal
  // entry of the matrix is positive.)
  std::array<Extended, 2> tolerated(const std::vector<Extended>& y) const {
    StageEquation stage = equation(y);
    const StageForces at = stage.forces(stage.vh);
    const std::vector<Extended> allowed = stage.allowed(stage.vh, at);
    stage.tolerance = 0;
    const std::vector<Extended> rounding = stage.allowed(stage.vh, at);
    DenseColumn residual = DenseColumn::Zero(static_cast<Eigen::Index>(allowed.size()));
    for (std::size_t i = 0; i < allowed.size(); ++i)
      if (!network_.fixed[i])
        residual[static_cast<Eigen::Index>(i)] = network_.mass[i] * (allowed[i] + corrections * rounding[i]);
    if (residual.size() == 0) return {0, 0};
    const DenseMatrix inverse = factor_.solve(DenseMatrix::Identity(residual.size(), residual.size()));
    const Extended change = DenseColumn(inverse.cwiseAbs() * residual).maxCoeff();
    return {h_ * change, change};
  }

 private:
  StageEquation equation(const std::vector<Extended>& y) const {
    StageEquation stage{.network = network_, .xh = part_of(y, 0), .vh = part_of(y, 1), .tau = h_, .tolerance = 1e-10L};
    stage.top_speed = largest_of(stage.vh);
    return stage;
  }

  const SpringNetwork& network_;
  Extended h_;
  Eigen::LLT<DenseMatrix> factor_;
};

}  // namespace

StepJudgement judge_local_global(const SpringNetwork& network, const TakenStep& step) {
  const LocalGlobalWitness method(network, step.h);
  // if a rounding of the energies decides which share of a correction is taken, either is correct
  std::vector<std::vector<Extended>> others;
  if (!network.elements.empty()) method.step(others.emplace_back(vector_of<Extended>(step.before)), 8);
  return compare_step(
      network, step, [&](std::vector<Extended>& y) { method.step(y); }, others,
      method.tolerated(vector_of<Extended>(step.before)));
}

}  // namespace dartboard::reference
