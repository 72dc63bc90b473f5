#include "core/meshes/vtk/join_pieces.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

using Numbers = std::vector<std::uint32_t>;

struct Pieces {
  std::span<const PieceFile> files;
  std::span<const Eigen::Vector3d> points;
  const std::string& file;

  std::size_t piece_of(std::uint32_t p) const {
    const auto after = std::ranges::upper_bound(files, std::size_t{p}, {}, &PieceFile::first_point);
    return static_cast<std::size_t>(after - files.begin()) - 1;
  }
  std::string called(std::uint32_t p) const {
    const PieceFile& piece = files[piece_of(p)];
    return fmt::format("point {} of {}", p - piece.first_point, in_quotes(piece.name));
  }
};

std::array<double, 3> place_of(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }

/// The points at one place, ascending: of each piece one, or all of one piece.
void join_place(const Pieces& p, std::span<const std::uint32_t> there, Numbers& same) {
  if (p.piece_of(there.front()) == p.piece_of(there.back())) return;
  for (std::size_t k = 1; k < there.size(); ++k) {
    if (p.piece_of(there[k]) == p.piece_of(there[k - 1])) {
      const std::uint32_t other = p.piece_of(there.front()) == p.piece_of(there[k]) ? there.back() : there.front();
      fail_at(
          p.file, 0,
          fmt::format("{} and {} are at the place of {}", p.called(there[k - 1]), p.called(there[k]), p.called(other)),
          "one point of each piece there: which are to be joined cannot be told");
    }
    same[there[k]] = there.front();
  }
}

/// Of each point the one that it is to be.
Numbers join_equal(const Pieces& p) {
  Numbers same(p.points.size()), order(p.points.size());
  std::iota(same.begin(), same.end(), 0u);
  std::iota(order.begin(), order.end(), 0u);
  const auto place = [&](std::uint32_t k) { return place_of(p.points[k]); };
  std::ranges::stable_sort(order, {}, place);
  for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
    while (end < order.size() && place(order[end]) == place(order[first])) ++end;
    join_place(p, std::span(order).subspan(first, end - first), same);
  }
  return same;
}

/// Boxes of a grid that is much wider than the distance looked for, so that almost every point is in one of them.
using Box = std::array<std::int64_t, 3>;
struct BoxHash {
  std::size_t operator()(const Box& box) const {
    std::uint64_t hash = 0;
    for (const std::int64_t k : box) hash = (hash ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(hash ^ hash >> 32);
  }
};

void refuse_near(const Pieces& p, const Numbers& same, double near) {
  if (!(near > 0.0)) return;
  const double width = 64.0 * near;
  std::unordered_map<Box, Numbers, BoxHash> boxes;
  for (std::uint32_t k = 0; k < p.points.size(); ++k) {
    if (same[k] != k) continue;
    Box low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      low[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor((p.points[k][axis] - near) / width));
      high[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(std::floor((p.points[k][axis] + near) / width));
    }
    for (std::int64_t x = low[0]; x <= high[0]; ++x)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t z = low[2]; z <= high[2]; ++z) {
          Numbers& there = boxes[{x, y, z}];
          for (const std::uint32_t other : there) {
            const double distance = (p.points[k] - p.points[other]).norm();
            if (distance <= near && p.piece_of(other) != p.piece_of(k))
              fail_at(p.file, 0, fmt::format("{} is {:.3g} from {}", p.called(k), distance, p.called(other)),
                      fmt::format("the same three numbers, so that they are one point, or more than {:.3g}", near));
          }
          there.push_back(k);
        }
  }
}

/// How near points of two pieces may not be without being equal. Within 2^53 boxes of the origin, so that coordinates
/// can be told apart at all.
double near_distance(const MeshBuilder& builder) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : builder.points()) box.extend(x);
  const double size = box.isEmpty() ? 0.0 : box.diagonal().norm();
  const double near = std::min(1e-6 * size, 1e-3 * builder.shortest_edge());
  const double farthest =
      box.isEmpty() ? 0.0 : std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return std::isfinite(near) && farthest / near < 9e15 ? near : 0.0;
}

}  // namespace

std::size_t join_pieces(std::span<const PieceFile> pieces, const std::string& file, MeshBuilder& builder) {
  const Pieces p{.files = pieces, .points = builder.points(), .file = file};
  const Numbers same = join_equal(p);
  refuse_near(p, same, near_distance(builder));
  const std::size_t before = builder.point_count();
  builder.join_points(same);
  return before - builder.point_count();
}

}  // namespace dartboard
