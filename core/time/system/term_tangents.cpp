#include "core/time/system/term_tangents.h"

#include <cmath>
#include <cstddef>

#include "core/forces/term_damping.h"
#include "core/plain/nan_maximum.h"

namespace dartboard {

using Eigen::Matrix3d;

namespace {

/// Puts the blocks of pieces into a matrix, term after term in the order of the pattern.
class Assembly {
 public:
  Assembly(const SpringSystem& system, BlockMatrix& matrix)
      : system_(system), matrix_(matrix), pair_(system.ends.size()) {  // the places of springs come first
    matrix.diagonal.assign(system.vertex_count(), Matrix3d::Zero());
    matrix.below.assign(matrix.pattern.row.size(), Matrix3d::Zero());
  }

  /// Adds every block, or `weight(piece)` times it.
  ForceTerm::VisitTangent add() {
    return [this](ForceTerm::Nodes nodes, std::span<const Matrix3d> blocks) {
      add_piece(nodes, [&blocks](std::size_t k) -> const Matrix3d& { return blocks[k]; });
    };
  }
  template <class Weight>
  ForceTerm::VisitTangent add_times(Weight weight) {
    return [this, weight, piece = std::size_t{0}](ForceTerm::Nodes nodes, std::span<const Matrix3d> blocks) mutable {
      const double times = weight(piece++);
      add_piece(nodes, [&blocks, times](std::size_t k) -> Matrix3d { return times * blocks[k]; });
    };
  }
  /// Go on without the blocks of a term.
  void pass(const ForceTerm& term) {
    for (std::size_t piece = 0; piece < term.size(); ++piece) {
      const std::size_t count = term.nodes(piece).size();
      pair_ += count * (count - 1) / 2;
    }
  }
  std::size_t pair() const { return pair_; }
  void go_back(std::size_t pair) { pair_ = pair; }

 private:
  template <class Block>
  void add_piece(ForceTerm::Nodes nodes, const Block& block) {
    for (std::size_t a = 0, k = 0; a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b, ++k, ++pair_) {
        const std::uint32_t place = matrix_.pattern.place[pair_];
        if (place == NodePattern::none) continue;
        if (nodes[a] > nodes[b])
          matrix_.below[place] += block(k);
        else
          matrix_.below[place] += block(k).transpose();
      }
      if (!system_.fixed[nodes[a]]) matrix_.diagonal[nodes[a]] += block(k);
      ++k;
    }
  }

  const SpringSystem& system_;
  BlockMatrix& matrix_;
  std::size_t pair_;
};

void visit_tangents(const ForceTerm& term, const TermTangents& tangents, const ForceTerm::VisitTangent& visit) {
  if (tangents.kind == TermTangents::Kind::constant)
    term.for_each_constant_tangent(visit);
  else
    term.for_each_tangent(
        tangents.at, tangents.kind == TermTangents::Kind::exact ? Compression::exact : Compression::projected, visit);
}

}  // namespace

void stiffness_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix) {
  Assembly assembly(system, matrix);
  for (const ForceTerm* term : system.terms) visit_tangents(*term, tangents, assembly.add());
}

void damping_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix) {
  Assembly assembly(system, matrix);
  for (const ForceTerm* term : system.terms) {
    const TermDamping* damping = term->damping();
    if (damping == nullptr) {
      assembly.pass(*term);
      continue;
    }
    const auto add = assembly.add_times([damping](std::size_t piece) { return damping->time(piece); });
    if (tangents.kind == TermTangents::Kind::constant)
      damping->is_viscous() ? damping->for_each_constant_tangent(add) : term->for_each_constant_tangent(add);
    else
      damping->for_each_tangent(tangents.at, add);
  }
}

void stiffness_of_stress(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix) {
  Assembly assembly(system, matrix);
  for (const ForceTerm* term : system.terms) {
    const TermDamping* damping = term->damping();
    if (damping == nullptr || damping->is_viscous()) {
      assembly.pass(*term);
      continue;
    }
    const std::size_t first = assembly.pair();
    visit_tangents(*term, tangents, assembly.add());
    assembly.go_back(first);
    damping->for_each_tangent(tangents.at, assembly.add_times([](std::size_t) { return -1.0; }));
  }
}

ForceTerm::VisitTangent add_row_sums(std::vector<double>& sum, double scale) {
  return [&sum, scale](ForceTerm::Nodes nodes, std::span<const Eigen::Matrix3d> blocks) {
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b)
        sum[nodes[a]] += scale * std::abs(blocks[a < b ? b * (b + 1) / 2 + a : a * (a + 1) / 2 + b](0, 0));
  };
}

double largest_row_sum(const SpringSystem& system, const BlockMatrix& stiffness) {
  std::vector<double> sum(system.vertex_count(), 0.0);
  const NodePattern& pattern = stiffness.pattern;
  for (std::size_t j = 0; j < sum.size(); ++j) {
    sum[j] += stiffness.diagonal[j].norm();
    for (std::uint32_t k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
      const double size = stiffness.below[k].norm();
      sum[j] += size;
      sum[pattern.row[k]] += size;
    }
  }
  double largest = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (!system.fixed[i]) largest = max_or_nan(largest, sum[i] * system.inverse_mass[i]);
  return largest;
}

}  // namespace dartboard
