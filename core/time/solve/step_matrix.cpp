#include "core/time/solve/step_matrix.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/time/system/accelerations.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Terms of (p I + q d d') between two nodes; d is a unit vector or zero.
void add_terms(const SpringEnds& ends, const Vector3d& d, double p, double q, std::vector<RankOneTerm>& terms) {
  const auto add = [&ends, &terms](const Vector3d& direction, double weight) {
    if (weight != 0.0) terms.push_back({ends[0], ends[1], direction, weight});
  };
  if (d.isZero(0.0)) {
    for (int c = 0; c < 3; ++c) add(Vector3d::Unit(c), p);
    return;
  }
  Eigen::Index smallest = 0;
  d.cwiseAbs().minCoeff(&smallest);
  const Vector3d t = d.cross(Vector3d::Unit(smallest)).normalized();
  add(d, p + q);
  add(t, p);
  add(d.cross(t), p);
}

}  // namespace

StepMatrix::Block StepMatrix::block_of(const SpringSystem& system, std::size_t e, const SpringTangent& t) const {
  return {system.ends[e], t.direction, tau_ * tau_ * t.across, tau_ * tau_ * (t.along - t.across) + tau_ * t.damping};
}

void StepMatrix::set_inertia(const SpringSystem& system) {
  const std::size_t n = system.vertex_count();
  inertia_.resize(n);
  fixed_.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    fixed_[i] = system.fixed[i];
    inertia_[i] = fixed_[i] ? 1.0 : system.mass[i] + tau_ * system.viscosity[i];
  }
  held_axes_.assign(system.held_axes.begin(), system.held_axes.end());
}

// A block without the rows of the axes held at vertex i, and the columns of those held at j.
Matrix3d StepMatrix::free_block(std::size_t i, std::size_t j, Matrix3d block) const {
  for (int c = 0; c < 3; ++c) {
    if (holds(held_axes_[i], c)) block.row(c).setZero();
    if (holds(held_axes_[j], c)) block.col(c).setZero();
  }
  return block;
}

// Velocities along held axes are given: their diagonal entries are the inertia.
void StepMatrix::hold_axes() {
  for (std::size_t i = 0; i < held_axes_.size(); ++i) {
    if (held_axes_[i] == 0) continue;
    diagonal_[i] = free_block(i, i, diagonal_[i]);
    for (int c = 0; c < 3; ++c)
      if (holds(held_axes_[i], c)) diagonal_[i](c, c) = inertia_[i];
  }
}

void StepMatrix::sum_diagonal() {
  diagonal_.resize(inertia_.size());
  links_.clear();
  anchors_.clear();
  for (std::size_t i = 0; i < inertia_.size(); ++i) diagonal_[i] = inertia_[i] * Matrix3d::Identity();
  for (std::uint32_t e = 0; e < blocks_.size(); ++e) {
    const Block& block = blocks_[e];
    const auto [a, b] = block.ends;
    if (a == b || (fixed_[a] && fixed_[b])) continue;
    (fixed_[a] || fixed_[b] ? anchors_ : links_).push_back(e);
    Matrix3d m = (block.q * block.d) * block.d.transpose();
    m.diagonal().array() += block.p;
    if (!fixed_[a]) diagonal_[a] += m;
    if (!fixed_[b]) diagonal_[b] += m;
  }
}

void StepMatrix::evaluate(const SpringSystem& system, std::span<const SpringTangent> tangents, double tau) {
  tau_ = tau;
  set_inertia(system);
  blocks_.resize(tangents.size());
  sources_.resize(tangents.size());
  for (std::size_t e = 0; e < tangents.size(); ++e) {
    blocks_[e] = block_of(system, e, tangents[e]);
    sources_[e] = {system.springs[e].stiffness, system.springs[e].damping};
  }
  sum_diagonal();
  hold_axes();
}

void StepMatrix::evaluate(const SpringSystem& system, std::span<const SpringTangent> tangents, double tau,
                          const NodePattern& pattern, const TermTangents& terms) {
  evaluate(system, tangents, tau);
  sum_terms(system, pattern, terms);
  hold_axes();
}

void StepMatrix::sum_terms(const SpringSystem& system, const NodePattern& pattern, const TermTangents& tangents) {
  if (!terms_.pattern.same_entries(pattern) || terms_.pattern.place != pattern.place) terms_.pattern = pattern;
  stiffness_of_terms(system, tangents, terms_);
  const double square = tau_ * tau_;
  for (Matrix3d& block : terms_.below) block *= square;
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    terms_.diagonal[i] *= square;
    diagonal_[i] += terms_.diagonal[i];
  }
  if (!has_damped_terms(system)) {
    dampers_.diagonal.clear();
    dampers_.below.clear();
    return;
  }
  if (!dampers_.pattern.same_entries(pattern) || dampers_.pattern.place != pattern.place) dampers_.pattern = pattern;
  damping_of_terms(system, tangents, dampers_);
  for (Matrix3d& block : dampers_.below) block *= tau_;
  for (std::size_t i = 0; i < diagonal_.size(); ++i) {
    dampers_.diagonal[i] *= tau_;
    diagonal_[i] += dampers_.diagonal[i];
  }
}

void StepMatrix::add_stiffness_of_terms(std::span<const Vector3d> x, std::span<Vector3d> y) const {
  if (terms_.diagonal.empty()) return;
  std::vector<Vector3d> product(x.size());
  terms_.multiply(x, product);
  for (std::size_t i = 0; i < y.size(); ++i) y[i] += free_at(i, product[i]) / (tau_ * tau_);
}

void StepMatrix::multiply(std::span<const Vector3d> x, std::span<Vector3d> y) const {
  for (std::size_t i = 0; i < inertia_.size(); ++i) y[i] = inertia_[i] * x[i];
  for (const std::uint32_t e : links_) {
    const Block& block = blocks_[e];
    const auto [a, b] = block.ends;
    const Vector3d dx = x[b] - x[a];
    const Vector3d f = block.p * dx + (block.q * block.d.dot(dx)) * block.d;
    y[a] -= f;
    y[b] += f;
  }
  for (const std::uint32_t e : anchors_) {
    const Block& block = blocks_[e];
    const std::uint32_t a = fixed_[block.ends[0]] ? block.ends[1] : block.ends[0];
    y[a] += block.p * x[a] + (block.q * block.d.dot(x[a])) * block.d;
  }
  if (!terms_.diagonal.empty()) terms_.add_product(x, y);
  if (!dampers_.diagonal.empty()) dampers_.add_product(x, y);
  for (std::size_t i = 0; i < held_axes_.size(); ++i) y[i] = free_at(i, y[i]);
}

void StepMatrix::assemble(const NodePattern& pattern, BlockMatrix& matrix) const {
  if (!matrix.pattern.same_entries(pattern) || matrix.pattern.place != pattern.place) matrix.pattern = pattern;
  matrix.diagonal = diagonal_;
  matrix.below.assign(pattern.row.size(), Matrix3d::Zero());
  for (const std::uint32_t e : links_) {
    Matrix3d& entry = matrix.below[pattern.place[e]];
    const Block& block = blocks_[e];
    entry -= (block.q * block.d) * block.d.transpose();
    entry.diagonal().array() -= block.p;
  }
  for (std::size_t k = 0; k < terms_.below.size(); ++k) matrix.below[k] += terms_.below[k];
  for (std::size_t k = 0; k < dampers_.below.size(); ++k) matrix.below[k] += dampers_.below[k];
  if (held_axes_.empty()) return;
  for (std::size_t j = 0; j < held_axes_.size(); ++j)
    for (std::uint32_t k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
      matrix.below[k] = free_block(pattern.row[k], j, matrix.below[k]);
}

std::vector<RankOneTerm> StepMatrix::follow(const SpringSystem& system, std::span<const SpringTangent> tangents,
                                            double spare) {
  std::vector<RankOneTerm> terms;
  const std::vector<double> old_inertia = inertia_;
  const std::vector<std::uint8_t> was_fixed = fixed_;
  set_inertia(system);
  const auto inertia_change = [&](std::size_t i) {
    return inertia_[i] - (i < old_inertia.size() ? old_inertia[i] : spare);
  };
  for (std::uint32_t i = 0; i < inertia_.size(); ++i)
    if (const double change = inertia_change(i); change != 0.0)
      for (int c = 0; c < 3; ++c) terms.push_back({i, NodePattern::none, Vector3d::Unit(c), change});
  for (auto i = static_cast<std::uint32_t>(inertia_.size()); i < old_inertia.size(); ++i)
    for (int c = 0; c < 3; ++c) terms.push_back({i, NodePattern::none, Vector3d::Unit(c), spare - old_inertia[i]});

  // The ends that a block couples; `none` in place of fixed vertices, which are eliminated.
  const auto coupled = [](const SpringEnds& ends, const std::vector<std::uint8_t>& fixed) {
    const auto [a, b] = ends;
    if (a == b || (fixed[a] && fixed[b])) return SpringEnds{NodePattern::none, NodePattern::none};
    if (fixed[a]) return SpringEnds{b, NodePattern::none};
    if (fixed[b]) return SpringEnds{a, NodePattern::none};
    return ends;
  };
  const auto add = [&terms](const SpringEnds& ends, const Vector3d& d, double p, double q) {
    if (ends[0] != NodePattern::none) add_terms(ends, d, p, q, terms);
  };
  const std::size_t old_count = blocks_.size(), count = tangents.size();
  for (std::size_t e = 0; e < std::max(old_count, count); ++e) {
    const bool was = e < old_count, is = e < count;
    const SpringEnds before = was ? coupled(blocks_[e].ends, was_fixed) : SpringEnds{NodePattern::none, 0};
    const SpringEnds after = is ? coupled(system.ends[e], fixed_) : SpringEnds{NodePattern::none, 0};
    if (!is) {
      add(before, blocks_[e].d, -blocks_[e].p, -blocks_[e].q);
      continue;
    }
    const Source source{system.springs[e].stiffness, system.springs[e].damping};
    if (was && blocks_[e].ends == system.ends[e] && before == after) {
      if (sources_[e] == source) continue;
      const double ratio = source.stiffness / sources_[e].stiffness;
      if (std::isfinite(ratio) && source.damping == ratio * sources_[e].damping) {
        // A proportional change, as when a spring gains or loses cells, keeps the direction: half the terms suffice.
        Block& block = blocks_[e];
        add(after, block.d, (ratio - 1.0) * block.p, (ratio - 1.0) * block.q);
        block.p *= ratio;
        block.q *= ratio;
        sources_[e] = source;
        continue;
      }
    }
    const Block block = block_of(system, e, tangents[e]);
    if (was) add(before, blocks_[e].d, -blocks_[e].p, -blocks_[e].q);
    add(after, block.d, block.p, block.q);
    if (was) {
      blocks_[e] = block;
      sources_[e] = source;
    } else {
      blocks_.push_back(block);
      sources_.push_back(source);
    }
  }
  blocks_.resize(count);
  sources_.resize(count);
  sum_diagonal();
  return terms;
}

}  // namespace dartboard
