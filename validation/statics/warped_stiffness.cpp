#include "validation/statics/warped_stiffness.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>

#include "core/elements/polar_factor.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d edges_at(const std::array<std::uint32_t, 4>& node, std::span<const Vector3d> x) {
  Matrix3d edges;
  for (std::size_t k = 1; k < 4; ++k) edges.col(static_cast<Eigen::Index>(k) - 1) = x[node[k]] - x[node[0]];
  return edges;
}

}  // namespace

WarpedStiffness::WarpedStiffness(const SpringSystem& system, std::span<const Vector3d> rest)
    : vertices_(system.vertex_count()) {
  for (const ForceTerm* term : system.terms)
    term->for_each_tangent({rest}, Compression::exact, [&](ForceTerm::Nodes nodes, std::span<const Matrix3d> blocks) {
      if (nodes.size() != 4)
        throw InputError(fmt::format("a piece of {} vertices is warped; expected tetrahedra", nodes.size()));
      Element element;
      std::ranges::copy(nodes, element.node.begin());
      element.inverse = edges_at(element.node, rest).inverse();
      std::ranges::copy(blocks, element.blocks.begin());
      elements_.push_back(element);
    });
}

Eigen::SparseMatrix<double> WarpedStiffness::operator()(std::span<const Vector3d> x) const {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&entries](std::uint32_t a, std::uint32_t b, const Matrix3d& block) {
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c)
        entries.emplace_back(static_cast<int>(3 * a) + r, static_cast<int>(3 * b) + c, block(r, c));
  };
  for (const Element& e : elements_) {
    const Matrix3d r = polar_rotation(edges_at(e.node, x) * e.inverse);
    for (std::size_t a = 0, k = 0; a < 4; ++a)
      for (std::size_t b = 0; b <= a; ++b, ++k) {
        const Matrix3d block = r * e.blocks[k] * r.transpose();
        add(e.node[a], e.node[b], block);
        if (b < a) add(e.node[b], e.node[a], block.transpose());
      }
  }
  const auto unknowns = static_cast<Eigen::Index>(3 * vertices_);
  Eigen::SparseMatrix<double> stiffness(unknowns, unknowns);
  stiffness.setFromTriplets(entries.begin(), entries.end());
  return stiffness;
}

}  // namespace dartboard
