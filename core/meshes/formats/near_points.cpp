#include "core/meshes/formats/near_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dartboard {
namespace {

/// Boxes of a grid that is wider than the distance searched, so that most points are in few of them. Their numbers are
/// whole, and doubles, because some are beyond all integers.
using Box = std::array<double, 3>;
struct BoxHash {
  std::size_t operator()(const Box& box) const {
    std::uint64_t hash = 0;
    for (const double k : box) hash = (hash ^ std::bit_cast<std::uint64_t>(k + 0.0)) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

double width_of_boxes(std::span<const Eigen::Vector3d> points, double near, double spacing) {
  double farthest = 0.0;
  for (const Eigen::Vector3d& x : points) farthest = std::max(farthest, x.cwiseAbs().maxCoeff());
  const double wide = spacing > 0.0 ? spacing : 1e-7 * farthest;
  const double width = near > 0.0 ? std::min(64.0 * near, std::max(4.0 * near, wide)) : wide;
  // so that numbers of boxes are finite
  return std::max({width, 1e-290 * farthest, std::numeric_limits<double>::min()});
}

}  // namespace

void for_near_points(std::span<const Eigen::Vector3d> points, double near, double spacing,
                     const std::function<void(std::uint32_t, std::uint32_t, double)>& found) {
  const double width = width_of_boxes(points, near, spacing);
  struct Held {
    std::uint32_t first, last;
  };
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::unordered_map<Box, Held, BoxHash> boxes;
  boxes.reserve(points.size());
  std::vector<std::uint32_t> next(points.size(), none);  // in the same box
  for (std::uint32_t k = 0; k < points.size(); ++k) {
    const Eigen::Vector3d& at = points[k];
    // a point is in its own box alone, and searches the one or two along each axis that its neighbours can be in
    const auto box_of = [width](const Eigen::Vector3d& x) {
      return Box{std::floor(x.x() / width), std::floor(x.y() / width), std::floor(x.z() / width)};
    };
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(near);
    const Box ends[] = {box_of(at - margin), box_of(at + margin)};
    for (int corner = 0; corner < 8; ++corner) {
      Box box{};
      bool is_new = true;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_high = (corner >> axis & 1) != 0;
        box[axis] = ends[is_high][axis];
        is_new = is_new && !(is_high && ends[0][axis] == ends[1][axis]);
      }
      const auto there = is_new ? boxes.find(box) : boxes.end();
      if (there == boxes.end()) continue;
      for (std::uint32_t other = there->second.first; other != none; other = next[other])
        if (const double distance = (at - points[other]).norm(); distance <= near) found(other, k, distance);
    }
    const auto [own, is_first] = boxes.try_emplace(box_of(at), Held{k, k});
    if (!is_first) next[std::exchange(own->second.last, k)] = k;
  }
}

double seam_distance(std::span<const Eigen::Vector3d> points, double shortest_edge) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : points) box.extend(x);
  const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  const double near = std::min(1e-6 * size, 1e-3 * shortest_edge);
  return std::isfinite(near) ? near : 0.0;
}

CellEdge shortest_edge(const Mesh& mesh) {
  CellEdge shortest{std::numeric_limits<double>::infinity(), 0, 0, 0};
  double square = shortest.length;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.cell(c);
    for (const auto& face : faces_of(mesh.kinds[c]))
      for (std::size_t k = 0; k < face.size(); ++k) {
        const std::uint32_t a = nodes[static_cast<std::size_t>(face[k])],
                            b = nodes[static_cast<std::size_t>(face[(k + 1) % face.size()])];
        if (a == b) continue;
        const double squared = (mesh.points[b] - mesh.points[a]).squaredNorm();
        if (!(squared < square)) continue;
        square = squared;
        if (const double length = std::sqrt(squared); length < shortest.length) shortest = {length, c, a, b};
      }
  }
  return shortest;
}

}  // namespace dartboard
