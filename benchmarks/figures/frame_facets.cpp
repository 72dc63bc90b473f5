#include "benchmarks/figures/frame_facets.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include "core/mechanics/fracture/stress.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Key = FrameFacets::Key;

Key sorted(Key nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// A face of a cell.
struct Side {
  std::array<std::uint32_t, 4> corners;  // of a volume's, ascending; after three the largest number
  std::uint32_t cell, face;
};

// The polygons of a surface; the faces of volumes that belong to one cell.
std::vector<FrameFacet> facets_of(const Mesh& mesh) {
  std::vector<Side> sides, seen;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const bool is_volume = dimension(mesh.kinds[c]) == 3;
    std::uint32_t face = 0;
    for (const std::vector<int>& corners : faces_of(mesh.kinds[c])) {
      Side side{{}, static_cast<std::uint32_t>(c), face++};
      if (is_volume) {
        side.corners.fill(std::numeric_limits<std::uint32_t>::max());
        for (std::size_t k = 0; k < corners.size(); ++k)
          side.corners[k] = mesh.cell(c)[static_cast<std::size_t>(corners[k])];
        std::ranges::sort(side.corners);
      }
      (is_volume ? sides : seen).push_back(side);
    }
  }
  std::ranges::sort(sides, {}, &Side::corners);
  for (std::size_t k = 0, next = 0; k < sides.size(); k = next) {
    for (next = k + 1; next < sides.size() && sides[next].corners == sides[k].corners;) ++next;
    if (next == k + 1) seen.push_back(sides[k]);
  }
  std::ranges::sort(seen, {}, [](const Side& side) { return std::pair(side.cell, side.face); });
  std::vector<FrameFacet> facets;
  for (const Side& side : seen) {
    FrameFacet facet{{}, side.cell};
    for (const int k : faces_of(mesh.kinds[side.cell])[side.face])
      facet.nodes.push_back(mesh.cell(side.cell)[static_cast<std::size_t>(k)]);
    facets.push_back(std::move(facet));
  }
  return facets;
}

// The points of the mesh by which facets are compared: their own, or those of the face of the mesh that contains them.
class Origins {
 public:
  explicit Origins(const Frame& frame) : frame_(frame) {
    for (const RefinedFacet& facet : frame.refined_facets)
      lies_in_.try_emplace(sorted(Key(facet.points.begin(), facet.points.end())),
                           sorted(Key(facet.lies_in.begin(), facet.lies_in.end())));
  }
  // For a facet inside a cell of the mesh, the points include a vertex made by refinement.
  Key of(const FrameFacet& facet) const {
    Key points;
    for (const std::uint32_t k : facet.nodes) points.push_back(static_cast<std::uint32_t>(frame_.mesh_point[k]));
    const auto found = lies_in_.find(sorted(facet.nodes));
    return found == lies_in_.end() ? sorted(std::move(points)) : found->second;
  }

 private:
  const Frame& frame_;
  std::map<Key, Key> lies_in_;
};

}  // namespace

FrameFacets::FrameFacets(const Frame& first) {
  const Origins origins(first);
  for (const FrameFacet& facet : facets_of(first.mesh)) skin_.insert(origins.of(facet));
}

std::vector<FrameFacet> FrameFacets::of(const Frame& frame) const {
  std::vector<FrameFacet> facets = facets_of(frame.mesh);
  const Origins origins(frame);
  for (FrameFacet& facet : facets) facet.was_inside = !skin_.contains(origins.of(facet));
  return facets;
}

FrameValues::FrameValues(ColourBy by, const Frame& frame) : frame_(frame) {
  if (by == ColourBy::speed) {
    unit_ = "m/s";
    for (const Vector3d& v : frame.velocity) at_points_.push_back(v.norm());
  }
  if (by == ColourBy::contact) {
    unit_ = "N";
    for (const Vector3d& force : frame.contact_force) at_points_.push_back(force.norm());
  }
  if (by != ColourBy::stress) return;
  for (const Eigen::Matrix3d& stress : frame.stress) at_points_.push_back(measures_of(stress).von_mises);
  least_ = 1;
  for (const CellKind kind : frame.mesh.kinds) least_ = std::max(least_, dimension(kind));
  unit_ = least_ == 3 ? "Pa" : least_ == 2 ? "N/m" : "N";
}

double FrameValues::at(std::span<const std::uint32_t> nodes, int dimension) const {
  if (at_points_.empty() || dimension < least_) return none;
  double sum = 0.0;
  for (const std::uint32_t k : nodes) sum += at_points_[k] / static_cast<double>(nodes.size());
  return sum;
}

double FrameValues::at_link(std::size_t k) const {
  return least_ == 1 ? std::abs(frame_.tension[k]) : at(frame_.links[k], 1);
}

std::vector<std::uint32_t> LastingComponents::of(const Frame& frame) {
  const auto cell = [&frame](std::size_t c) {
    return std::uint64_t{frame.body.empty() ? 0 : frame.body[c]} << 32 |
           (frame.mesh_cell.empty() ? c : frame.mesh_cell[c]);
  };
  const std::uint32_t components = frame.component.empty() ? 0 : *std::ranges::max_element(frame.component) + 1;
  constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::uint32_t> number(components, none);
  // of each component, the cells that each number had before; (cells, component) of the largest for each number
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> had;
  std::map<std::uint32_t, std::pair<std::size_t, std::uint32_t>> largest;
  for (std::size_t c = 0; c < frame.component.size(); ++c)
    if (const auto found = before_.find(cell(c)); found != before_.end()) ++had[{frame.component[c], found->second}];
  for (const auto& [of, cells] : had)
    if (cells > largest[of.second].first) largest[of.second] = {cells, of.first};
  for (const auto& [kept, by] : largest)
    if (number[by.second] == none) number[by.second] = kept;
  std::vector<std::size_t> cells(components, 0);
  for (const std::uint32_t of : frame.component) ++cells[of];
  std::vector<std::uint32_t> others;
  for (std::uint32_t k = 0; k < components; ++k)
    if (number[k] == none) others.push_back(k);
  if (count_ > 0) std::ranges::stable_sort(others, std::greater{}, [&cells](std::uint32_t k) { return cells[k]; });
  for (const std::uint32_t k : others) number[k] = count_++;
  before_.clear();
  for (std::size_t c = 0; c < frame.component.size(); ++c) before_[cell(c)] = number[frame.component[c]];
  return number;
}

}  // namespace dartboard
