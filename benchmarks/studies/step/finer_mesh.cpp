#include "benchmarks/studies/step/finer_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {

Mesh finer_mesh(const Mesh& mesh) {
  Mesh finer;
  finer.points = mesh.points;
  std::unordered_map<std::uint64_t, std::uint32_t> middle_of;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax(a, b);
    const auto next = static_cast<std::uint32_t>(finer.points.size());
    const auto [found, is_new] = middle_of.try_emplace(std::uint64_t{low} << 32u | high, next);
    if (is_new) finer.points.push_back(0.5 * (mesh.points[low] + mesh.points[high]));
    return found->second;
  };
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    if (mesh.kinds[c] != CellKind::tetrahedron)
      throw InputError(fmt::format("cell {} is a {}, expected tetrahedra alone", c, name(mesh.kinds[c])));
    const auto n = mesh.cell(c);
    const std::uint32_t m01 = middle(n[0], n[1]), m02 = middle(n[0], n[2]), m03 = middle(n[0], n[3]),
                        m12 = middle(n[1], n[2]), m13 = middle(n[1], n[3]), m23 = middle(n[2], n[3]);
    const auto add = [&finer](const std::array<std::uint32_t, 4>& nodes) {
      finer.add_cell(CellKind::tetrahedron, nodes);
    };
    add({n[0], m01, m02, m03});
    add({m01, n[1], m12, m13});
    add({m02, m12, n[2], m23});
    add({m03, m13, m23, n[3]});
    // from one end of the diagonal to the other, and the four corners around it, right-handed
    struct Octahedron {
      std::uint32_t from, to;
      std::array<std::uint32_t, 4> around;
    };
    const std::array<Octahedron, 3> all{
        {{m01, m23, {m02, m12, m13, m03}}, {m02, m13, {m03, m23, m12, m01}}, {m03, m12, {m01, m13, m23, m02}}}};
    const Octahedron& shortest = *std::ranges::min_element(
        all, {}, [&finer](const Octahedron& o) { return (finer.points[o.to] - finer.points[o.from]).squaredNorm(); });
    for (std::size_t k = 0; k < 4; ++k)
      add({shortest.from, shortest.to, shortest.around[(k + 1) % 4], shortest.around[k]});
  }
  return finer;
}

Mesh finer_mesh_of(Mesh mesh, std::size_t least_cells) {
  while (mesh.cell_count() < least_cells) mesh = finer_mesh(mesh);
  return mesh;
}

}  // namespace dartboard
