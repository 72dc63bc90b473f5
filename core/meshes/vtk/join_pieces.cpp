#include "core/meshes/vtk/join_pieces.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>

#include "core/meshes/formats/near_points.h"
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
          "one point of each piece there: which points to join is ambiguous");
    }
    same[there[k]] = there.front();
  }
}

/// For each point, the point that it becomes.
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

void refuse_near(const Pieces& p, const Numbers& same, double shortest_edge) {
  const double near = seam_distance(p.points, shortest_edge);
  for_near_points(p.points, near, shortest_edge, [&](std::uint32_t a, std::uint32_t b, double distance) {
    if (same[a] == a && same[b] == b && p.piece_of(a) != p.piece_of(b))
      fail_at(
          p.file, 0, fmt::format("{} is {:.3g} from {}", p.called(b), distance, p.called(a)),
          fmt::format("the same three numbers, so that they are one point, or more than {:.3g}, or a distance to weld "
                      "them at",
                      near));
  });
}

}  // namespace

std::size_t join_pieces(std::span<const PieceFile> pieces, const std::string& file, MeshBuilder& builder) {
  const Pieces p{.files = pieces, .points = builder.points(), .file = file};
  const Numbers same = join_equal(p);
  // points that are welded later may be near
  if (builder.weld() == 0.0) refuse_near(p, same, builder.shortest_edge());
  const std::size_t before = builder.point_count();
  builder.join_points(same);
  return before - builder.point_count();
}

}  // namespace dartboard
