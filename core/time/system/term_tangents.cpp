#include "core/time/system/term_tangents.h"

#include <cmath>

#include "core/plain/nan_maximum.h"

namespace dartboard {

using Eigen::Matrix3d;

void stiffness_of_terms(const SpringSystem& system, const TermTangents& tangents, BlockMatrix& matrix) {
  const NodePattern& pattern = matrix.pattern;
  matrix.diagonal.assign(system.vertex_count(), Matrix3d::Zero());
  matrix.below.assign(pattern.row.size(), Matrix3d::Zero());
  std::size_t pair = system.ends.size();  // the places of springs come first
  const ForceTerm::VisitTangent add = [&](ForceTerm::Nodes nodes, std::span<const Matrix3d> blocks) {
    for (std::size_t a = 0, k = 0; a < nodes.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b, ++k, ++pair) {
        const std::uint32_t place = pattern.place[pair];
        if (place == NodePattern::none) continue;
        if (nodes[a] > nodes[b])
          matrix.below[place] += blocks[k];
        else
          matrix.below[place] += blocks[k].transpose();
      }
      if (!system.fixed[nodes[a]]) matrix.diagonal[nodes[a]] += blocks[k];
      ++k;
    }
  };
  for (const ForceTerm* term : system.terms)
    if (tangents.kind == TermTangents::Kind::constant)
      term->for_each_constant_tangent(add);
    else
      term->for_each_tangent(
          tangents.at, tangents.kind == TermTangents::Kind::exact ? Compression::exact : Compression::projected, add);
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
