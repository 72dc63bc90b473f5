#include "core/mechanics/curve_order.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <numeric>
#include <utility>

#include "core/base/share_jobs.h"

namespace dartboard {
namespace {

constexpr int bits = 21;  // by axis: three of them in 64 bits

/// Two zeros before each of the lowest 21 bits.
std::uint64_t spread(std::uint64_t x) {
  x = (x | x << 32) & 0x001F00000000FFFFu;
  x = (x | x << 16) & 0x001F0000FF0000FFu;
  x = (x | x << 8) & 0x100F00F00F00F00Fu;
  x = (x | x << 4) & 0x10C30C30C30C30C3u;
  return (x | x << 2) & 0x1249249249249249u;
}

/// The place along the curve of a cube with 2^bits cells along each axis.
std::uint64_t place_on_curve(std::array<std::uint32_t, 3> x) {
  constexpr std::uint32_t highest = 1u << (bits - 1);
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& c : x) {
      // invert the lower bits of the first axis where the bit is set, and exchange them otherwise: no branch, as every
      // other one would go wrong
      const std::uint32_t inverts = 0u - static_cast<std::uint32_t>((c & bit) != 0);
      const std::uint32_t swapped = (x[0] ^ c) & below & ~inverts;
      c ^= swapped;
      x[0] ^= swapped | (below & inverts);
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flipped = 0;
  for (std::uint32_t bit = highest; bit > 1; bit >>= 1)
    if ((x[2] & bit) != 0) flipped ^= bit - 1;
  for (std::uint32_t& c : x) c ^= flipped;
  return spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2]);
}

template <class Row>
typename std::vector<Row>::iterator at(std::vector<Row>& rows, std::size_t k) {
  return rows.begin() + static_cast<std::ptrdiff_t>(k);
}

}  // namespace

std::vector<std::uint32_t> order_of_mesh(const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.cell_count());
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

std::size_t count_wide_cells(const Mesh& mesh, std::span<const std::uint32_t> order) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(mesh.points.size(), none);
  std::uint32_t next = 0;
  std::size_t wide = 0;
  for (const std::uint32_t c : order) {
    std::uint32_t least = none, most = 0;
    for (const std::uint32_t p : mesh.cell(c)) {
      if (number[p] == none) number[p] = next++;
      least = std::min(least, number[p]);
      most = std::max(most, number[p]);
    }
    wide += most - least > near_vertices;
  }
  return wide;
}

std::vector<std::uint32_t> order_along_curve(const Mesh& mesh) {
  if (mesh.points.size() <= near_vertices) return {};
  std::vector<std::uint32_t> order = order_of_mesh(mesh);
  const std::size_t as_given = count_wide_cells(mesh, order);
  if (as_given == 0) return {};

  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& x : mesh.points)
    if (x.allFinite()) box.extend(x);
  const double size = box.sizes().maxCoeff();
  if (!(size > 0.0 && size < std::numeric_limits<double>::max())) return {};
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places(mesh.cell_count());
  const auto sort_part = [&](std::size_t first, std::size_t last) {
    for (std::size_t c = first; c < last; ++c) {
      Eigen::Vector3d middle(0, 0, 0);
      for (const std::uint32_t p : mesh.cell(c)) middle += mesh.points[p] / static_cast<double>(mesh.cell(c).size());
      std::array<std::uint32_t, 3> x{};
      for (Eigen::Index k = 0; k < 3; ++k) {
        const double part = std::clamp((middle[k] - box.min()[k]) / size, 0.0, 1.0);  // 0 for NaN
        x[static_cast<std::size_t>(k)] = part > 0.0 ? static_cast<std::uint32_t>(part * ((1u << bits) - 1)) : 0u;
      }
      places[c] = {place_on_curve(x), static_cast<std::uint32_t>(c)};
    }
    std::sort(at(places, first), at(places, last));
  };
  const std::size_t half = places.size() / 2;
  const std::function<void()> jobs[]{[&] { sort_part(0, half); }, [&] { sort_part(half, places.size()); }};
  share_jobs(places.size(), jobs);
  std::inplace_merge(places.begin(), at(places, half), places.end());
  for (std::size_t k = 0; k < order.size(); ++k) order[k] = places[k].second;
  if (2 * count_wide_cells(mesh, order) >= as_given) return {};
  return order;
}

Problem in_order(const Problem& problem, std::span<const std::uint32_t> order) {
  Problem sorted = problem;
  sorted.mesh = {};
  sorted.mesh.points = problem.mesh.points;
  for (const std::uint32_t c : order) sorted.mesh.add_cell(problem.mesh.kinds[c], problem.mesh.cell(c));
  for (std::size_t k = 0; k < sorted.cell_material.size(); ++k)
    sorted.cell_material[k] = problem.cell_material[order[k]];
  return sorted;
}

}  // namespace dartboard
