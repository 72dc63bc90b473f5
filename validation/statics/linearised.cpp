#include "validation/statics/linearised.h"

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "core/time/system/tangent.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

using Entries = std::vector<Eigen::Triplet<double>>;

void add_block(Entries& entries, std::uint32_t a, std::uint32_t b, const Eigen::Matrix3d& block) {
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c)
      entries.emplace_back(static_cast<int>(3 * a) + r, static_cast<int>(3 * b) + c, block(r, c));
}

}  // namespace

reference::HeldSolid linearised(const SpringSystem& system, std::span<const Vector3d> x, Compression compression) {
  Entries stiffness, mass;
  std::vector<SpringTangent> tangents;
  evaluate_tangents(system, x, compression, tangents);
  for (std::size_t s = 0; s < tangents.size(); ++s) {
    const auto [a, b] = system.ends[s];
    const Eigen::Matrix3d k = tangents[s].stiffness();
    add_block(stiffness, a, a, k);
    add_block(stiffness, b, b, k);
    add_block(stiffness, a, b, -k);
    add_block(stiffness, b, a, -k);
  }
  for (const ForceTerm* term : system.terms)
    term->for_each_tangent({x}, compression, [&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
      for (std::size_t a = 0, k = 0; a < n.size(); ++a)
        for (std::size_t b = 0; b <= a; ++b, ++k) {
          add_block(stiffness, n[a], n[b], blocks[k]);
          if (b < a) add_block(stiffness, n[b], n[a], blocks[k].transpose());
        }
    });
  reference::HeldSolid solid;
  for (std::uint32_t i = 0; i < system.vertex_count(); ++i) {
    add_block(mass, i, i, system.mass[i] * Eigen::Matrix3d::Identity());
    if (system.fixed[i]) solid.held.push_back(i);
  }
  const auto unknowns = static_cast<Eigen::Index>(3 * system.vertex_count());
  solid.stiffness.resize(unknowns, unknowns);
  solid.mass.resize(unknowns, unknowns);
  solid.stiffness.setFromTriplets(stiffness.begin(), stiffness.end());
  solid.mass.setFromTriplets(mass.begin(), mass.end());
  return solid;
}

}  // namespace dartboard
