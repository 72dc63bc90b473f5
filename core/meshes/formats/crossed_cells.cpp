#include "core/meshes/formats/crossed_cells.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

namespace dartboard {
namespace {

using Corners = std::array<Eigen::Vector3d, 8>;

Corners corners_of(const Mesh& mesh, std::size_t c) {
  Corners x{};
  for (std::size_t k = 0; k < mesh.cell(c).size(); ++k) x[k] = mesh.points[mesh.cell(c)[k]];
  return x;
}

/// Whether determinants, or turns of corners, have one sign: those within rounding of zero count as either.
struct Signs {
  int positive = 0, negative = 0;

  void count(double value, double rounding) {
    positive += value > rounding;
    negative += value < -rounding;
  }
};

/// The Jacobian of a trilinear hexahedron at one of its Gauss points: each column from the four edges along an axis.
double hexahedron_jacobian(const Corners& x, const std::array<double, 3>& at) {
  constexpr int edges[3][4][2] = {
      {{0, 1}, {3, 2}, {4, 5}, {7, 6}}, {{0, 3}, {1, 2}, {4, 7}, {5, 6}}, {{0, 4}, {1, 5}, {3, 7}, {2, 6}}};
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double u = at[axis == 0 ? 1 : 0], v = at[axis == 2 ? 1 : 2];
    const double share[4] = {(1 - u) * (1 - v), u * (1 - v), (1 - u) * v, u * v};
    for (std::size_t e = 0; e < 4; ++e)
      jacobian.col(static_cast<Eigen::Index>(axis)) +=
          share[e] * (x[static_cast<std::size_t>(edges[axis][e][1])] - x[static_cast<std::size_t>(edges[axis][e][0])]);
  }
  return jacobian.determinant();
}

/// The Jacobian of a prism, near one of its three axial edges.
double prism_jacobian(const Corners& x, std::size_t near, double z) {
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < 3; ++k) jacobian.col(2) += (k == near ? 2.0 / 3.0 : 1.0 / 6.0) * (x[k + 3] - x[k]);
  jacobian.col(0) = (1 - z) * (x[1] - x[0]) + z * (x[4] - x[3]);
  jacobian.col(1) = (1 - z) * (x[2] - x[0]) + z * (x[5] - x[3]);
  return jacobian.determinant();
}

/// The length that bounds all edges and diagonals.
double size_of_cell(const Corners& x, std::size_t corners) {
  double size = 0.0;
  for (std::size_t k = 1; k < corners; ++k) size = std::max(size, (x[k] - x[0]).norm());
  return 2.0 * size;
}

// The columns are shorter than L, the size: the six products of a determinant are each off by a few u L^3.
double rounding_of_volume(CellKind kind, const Corners& corners) {
  const double size = size_of_cell(corners, static_cast<std::size_t>(node_count(kind)));
  return 1e-14 * size * size * size;
}

Signs signs_of_volume(CellKind kind, const Corners& corners) {
  const double rounding = rounding_of_volume(kind, corners);
  const double near_end = 0.5 + 0.5 / std::sqrt(3.0), far_end = 1.0 - near_end;  // shares at a Gauss point
  Signs signs;
  Corners x = corners;
  if (kind == CellKind::pyramid) x[5] = x[6] = x[7] = x[4];  // one side contracted to a point
  if (kind == CellKind::prism) {
    for (const double z : {far_end, near_end})
      for (std::size_t near = 0; near < 3; ++near) signs.count(prism_jacobian(x, near, z), rounding);
  } else if (kind != CellKind::tetrahedron) {
    for (const double a : {far_end, near_end})
      for (const double b : {far_end, near_end})
        for (const double c : {far_end, near_end}) signs.count(hexahedron_jacobian(x, {a, b, c}), rounding);
  }
  return signs;
}

// Seen along its normal, a quadrilateral crosses itself exactly if two corners turn one way and two the other. One with
// equal lobes has no normal, and the direction of the first corner that turns is used instead.
Signs signs_of_corners(const Corners& x) {
  const double size = size_of_cell(x, 4), rounding = 1e-14 * size * size;
  const auto turn = [&x](std::size_t k) { return (x[(k + 1) % 4] - x[k]).cross(x[(k + 3) % 4] - x[k]); };
  Eigen::Vector3d normal = (x[2] - x[0]).cross(x[3] - x[1]);
  for (std::size_t k = 0; k < 4 && !(normal.norm() > rounding); ++k) normal = turn(k);
  Signs signs;
  for (std::size_t k = 0; k < 4; ++k) signs.count(turn(k).dot(normal), rounding * normal.norm());
  return signs;
}

/// The volume at each of the six corners of a prism, spanned by its three edges there.
std::array<double, 6> prism_corner_volumes(const Corners& x) {
  std::array<double, 6> volumes{};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t end = k / 3 * 3, next = end + (k + 1) % 3, last = end + (k + 2) % 3;
    volumes[k] = (x[next] - x[k]).cross(x[last] - x[k]).dot(x[k % 3 + 3] - x[k % 3]);
  }
  return volumes;
}

// If a corner of one triangle and one of the other are swapped, all Gauss points may keep one hand: the axial edge that
// has neither corner then lies in both triangles, and has no volume at its ends, except from the twist of faces. With
// the two swapped back every corner has volume. A valid prism becomes this flat by the swap; one with volume of one
// hand at every corner never counts as crossed.
bool has_swapped_ends(const Corners& x, double rounding) {
  const auto volumes = prism_corner_volumes(x);
  const double hand = std::accumulate(volumes.begin(), volumes.end(), 0.0) > 0 ? 1.0 : -1.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [smaller, larger] = std::minmax({hand * volumes[axis], hand * volumes[axis + 3]});
    if (smaller > rounding) continue;
    const double at_ends = std::max(larger, rounding);
    for (const std::size_t one : {(axis + 1) % 3, (axis + 2) % 3}) {
      Corners swapped = x;
      std::swap(swapped[one], swapped[3 + (3 - axis - one)]);
      const auto better = prism_corner_volumes(swapped);
      const auto [least, largest] = std::ranges::minmax(better);
      if (least > 4.0 * at_ends || largest < -4.0 * at_ends) return true;
    }
  }
  return false;
}

bool is_crossed(CellKind kind, const Corners& x) {
  if (kind == CellKind::quadrilateral) {
    const Signs signs = signs_of_corners(x);
    return signs.positive > 1 && signs.negative > 1;
  }
  const Signs signs = signs_of_volume(kind, x);
  if (signs.positive > 0 && signs.negative > 0) return true;
  return kind == CellKind::prism && has_swapped_ends(x, rounding_of_volume(kind, x));
}

bool is_whole(CellKind kind, const Corners& x) {
  const Signs signs = kind == CellKind::quadrilateral ? signs_of_corners(x) : signs_of_volume(kind, x);
  return (signs.positive == 0) != (signs.negative == 0) && !is_crossed(kind, x);
}

using Swaps = std::vector<std::pair<std::size_t, std::size_t>>;

/// Corners that voxels and pixels have the other way round: on both sides, or on one if a writer has corrected one.
std::vector<Swaps> voxel_swaps(CellKind kind) {
  switch (kind) {
    case CellKind::quadrilateral:
    case CellKind::pyramid: return {{{2, 3}}};
    case CellKind::prism: return {{{2, 3}}, {{4, 5}}};
    case CellKind::hexahedron: return {{{2, 3}, {6, 7}}, {{2, 3}}, {{6, 7}}};
    case CellKind::triangle:
    case CellKind::tetrahedron: break;
  }
  return {};
}

/// Six times the mean of the Jacobians of a prism.
double prism_volume(const Corners& x) {
  double sum = 0.0;
  for (const double z : {0.0, 0.5, 1.0})
    for (std::size_t near = 0; near < 3; ++near) sum += (z == 0.5 ? 4.0 : 1.0) / 3.0 * prism_jacobian(x, near, z);
  return std::abs(sum);
}

/// Whether another order of the corners of a prism, with two of its ends swapped, has more volume: a prism turned by
/// 120 degrees against itself is valid, too, but was not intended.
bool is_turned_against_itself(const Corners& x) {
  for (std::size_t one = 0; one < 3; ++one)
    for (const std::size_t other : {3 + (one + 1) % 3, 3 + (one + 2) % 3}) {
      Corners swapped = x;
      std::swap(swapped[one], swapped[other]);
      if (prism_volume(swapped) > 1.01 * prism_volume(x)) return true;
    }
  return false;
}

/// The swaps that make a crossed cell valid; empty if it is crossed in another way.
Swaps swaps_of(const Mesh& mesh, std::size_t c) {
  for (const Swaps& swaps : voxel_swaps(mesh.kinds[c])) {
    Corners x = corners_of(mesh, c);
    for (const auto& [a, b] : swaps) std::swap(x[a], x[b]);
    const bool is_prism = mesh.kinds[c] == CellKind::prism;
    if (is_whole(mesh.kinds[c], x) && !(is_prism && is_turned_against_itself(x))) return swaps;
  }
  return {};
}

/// "swap the third and fourth points of each such cell".
std::string in_words(CellKind kind, const Swaps& swaps) {
  constexpr std::string_view ordinals[] = {"first", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth"};
  std::string words;
  for (const auto& [a, b] : swaps)
    words += fmt::format("{}the {} and {}", words.empty() ? "" : ", and ", ordinals[a], ordinals[b]);
  const bool has_type = kind == CellKind::quadrilateral || kind == CellKind::hexahedron;
  return fmt::format("swap {} points of each such cell{}", words,
                     has_type ? fmt::format(", or give it VTK's type of a {}",
                                            kind == CellKind::hexahedron ? "voxel (11)" : "pixel (8)")
                              : "");
}

}  // namespace

CrossedCells find_crossed_cells(const Mesh& mesh) {
  CrossedCells crossed;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    const CellKind kind = mesh.kinds[c];
    if (kind == CellKind::triangle || kind == CellKind::tetrahedron || !is_crossed(kind, corners_of(mesh, c))) continue;
    crossed.cells.push_back(static_cast<std::uint32_t>(c));
    const Swaps swaps = swaps_of(mesh, c);
    if (swaps.empty()) continue;
    if (crossed.voxel_order++ == 0) crossed.swap = in_words(kind, swaps);
  }
  return crossed;
}

std::string CrossedCells::found() const {
  constexpr std::size_t most = 5;
  const std::size_t count = cells.size();
  const std::string looks = voxel_order == 0 ? ""
                            : voxel_order == count
                                ? fmt::format("; {} like voxel order", count == 1 ? "it looks" : "they look")
                                : fmt::format("; {} of them look like voxel order", voxel_order);
  return fmt::format("{} crossed, with corners that do not go round {} faces: {} {}{}{}",
                     count == 1 ? "1 cell is" : fmt::format("{} cells are", count), count == 1 ? "its" : "their",
                     count == 1 ? "cell" : "cells",
                     fmt::join(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(std::min(count, most)), ", "),
                     count > most ? ", ..." : "", looks);
}

std::string CrossedCells::remedy() const {
  const std::string order = "corners in the order of Gmsh and VTK";
  return voxel_order == 0 ? order : order + ": " + swap;
}

}  // namespace dartboard
