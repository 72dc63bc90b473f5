#pragma once
// The parts shared by the generators of solids (mesh_generators.cpp) and of surfaces (mesh_generators_2d.cpp). Private
// to them.

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "core/base/cell_limits.h"
#include "core/plain/error.h"
#include "core/plain/mesh.h"

namespace dartboard::detail {

inline void require_at_least(const char* generator, const char* what, int value, int least) {
  if (value < least) throw InputError(fmt::format("{}: {} = {}, expected at least {}", generator, what, value, least));
}

inline void require_spacing(const char* generator, double spacing) {
  if (!(spacing > 0.0 && std::isfinite(spacing)))
    throw InputError(fmt::format("{}: spacing = {}, expected a finite number > 0", generator, spacing));
}

/// Require that so many cells fit into a map; the node numbers of such a mesh fit into 32 bits too.
inline void require_room(const char* generator, CellKind kind, double count) {
  CountsByKind cells{};
  cells[static_cast<std::size_t>(kind)] = count;
  if (const std::string beyond = beyond_a_map(cells); !beyond.empty())
    throw InputError(fmt::format("{}: {}", generator, beyond));
}

template <class... Nodes>
void add(Mesh& mesh, CellKind kind, Nodes... nodes) {
  mesh.add_cell(kind, std::array{static_cast<std::uint32_t>(nodes)...});
}

/// Point i of n on the unit circle, counter-clockwise from (1, 0), 0 <= i; the angles between neighbours differ by a
/// factor of at most two. They lie evenly on the square |x| + |y| = 1 and are projected onto the circle.
inline Eigen::Vector2d on_circle(std::int64_t i, std::int64_t n) {
  const std::int64_t quarter = 4 * i / n % 4, y = 4 * i % n, x = n - y;
  const std::array<std::array<std::int64_t, 2>, 4> turned{{{x, y}, {-y, x}, {-x, -y}, {y, -x}}};
  const auto& at = turned[static_cast<std::size_t>(quarter)];
  const double length = std::sqrt(static_cast<double>(x * x + y * y));
  return {static_cast<double>(at[0]) / length, static_cast<double>(at[1]) / length};
}

}  // namespace dartboard::detail
