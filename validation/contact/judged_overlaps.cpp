#include "validation/contact/judged_overlaps.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace dartboard {
namespace {

/// The tetrahedra at each corner.
std::vector<std::vector<std::uint32_t>> cells_around(std::size_t corners, std::span<const CellCorners> tetrahedra) {
  std::vector<std::vector<std::uint32_t>> around(corners);
  for (std::uint32_t c = 0; c < tetrahedra.size(); ++c)
    for (const std::uint32_t k : tetrahedra[c]) around[k].push_back(c);
  return around;
}

bool has(std::span<const std::uint32_t> nodes, std::uint32_t k) { return std::ranges::find(nodes, k) != nodes.end(); }
bool meet(std::span<const std::uint32_t> a, std::span<const std::uint32_t> b) {
  return std::ranges::any_of(a, [b](std::uint32_t k) { return has(b, k); });
}

}  // namespace

std::vector<JudgedOverlap> judged_overlaps(const BodyContact& contact, std::span<const Eigen::Vector3d> x,
                                           std::span<const CellCorners> tetrahedra,
                                           const std::function<bool(std::uint32_t, std::uint32_t)>& may_touch) {
  const auto around = cells_around(x.size(), tetrahedra);
  const auto are_neighbours = [&](const CellCorners& a, const CellCorners& b) {
    return std::ranges::any_of(a, [&](std::uint32_t k) {
      return std::ranges::any_of(around[k], [&](std::uint32_t c) { return meet(tetrahedra[c], b); });
    });
  };
  std::vector<BodyTouch> touches;
  for (const BodyTouch& touch : contact.touching({x})) touches.push_back(touch);
  touches.insert(touches.end(), contact.out_of_reach().begin(), contact.out_of_reach().end());
  const auto is_felt = [&](const CellCorners& a, const CellCorners& b) {
    return std::ranges::any_of(touches, [&](const BodyTouch& touch) {
      const auto sample = contact.samples()[touch.sample].corners();
      const auto& in = contact.solids().tetrahedra()[touch.tetrahedron].nodes;
      return (meet(sample, a) && meet(in, b)) || (meet(sample, b) && meet(in, a));
    });
  };

  std::vector<JudgedOverlap> judged;
  for (const reference::Overlap& overlap : reference::overlaps(x, tetrahedra)) {
    const CellCorners &a = tetrahedra[overlap.first], &b = tetrahedra[overlap.second];
    if (!may_touch(overlap.first, overlap.second) || are_neighbours(a, b)) continue;
    judged.push_back({overlap, is_felt(a, b)});
  }
  return judged;
}

void OverlapTally::add(double share, bool felt) {
  const double place = std::min(0.5 * share * static_cast<double>(classes), static_cast<double>(classes - 1));
  const auto k = static_cast<std::size_t>(std::max(place, 0.0));
  ++overlaps[k];
  deepest = std::max(deepest, share);
  if (felt) return;
  ++missed[k];
  deepest_missed = std::max(deepest_missed, share);
}

void OverlapTally::add(const OverlapTally& other) {
  for (std::size_t k = 0; k < classes; ++k) {
    overlaps[k] += other.overlaps[k];
    missed[k] += other.missed[k];
  }
  deepest = std::max(deepest, other.deepest);
  deepest_missed = std::max(deepest_missed, other.deepest_missed);
}

std::size_t OverlapTally::count() const { return std::accumulate(overlaps.begin(), overlaps.end(), std::size_t{0}); }
std::size_t OverlapTally::count_missed() const { return std::accumulate(missed.begin(), missed.end(), std::size_t{0}); }

}  // namespace dartboard
