#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/base/bytes.h"
#include "core/plain/error.h"
#include "core/scene/body/events/ready.h"

namespace dartboard {
namespace {

class ReadyRelease final : public ReadyEvent {
 public:
  ReadyRelease(VertexColumns& vertices, const Release& release, const std::string& path) : vertices_(vertices) {
    // selections number points, which there is one vertex of each of at rest
    std::vector<Eigen::Vector3d> place(vertices.size(), Eigen::Vector3d(0, 0, 0));
    std::vector<bool> held(vertices.size(), false);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      place[vertices.point[k]] = vertices.position[k];
      held[vertices.point[k]] =
          (!vertices.fixed.empty() && vertices.fixed[k]) || (!vertices.held_axes.empty() && vertices.held_axes[k]);
    }
    for (const std::uint32_t p : select_points(release.vertices, place, path))
      if (held[p]) points_.push_back(p);
    if (points_.empty())
      throw InputError(fmt::format("{}: selects no vertex that is fixed; expected at least one", path));
    std::ranges::sort(points_);
    points_.shrink_to_fit();
  }

  /// cost  O(vertices log(points))
  std::size_t apply(EventTargets*) override {
    std::size_t count = 0;
    for (std::size_t k = 0; k < vertices_.size(); ++k) {
      if (!std::ranges::binary_search(points_, vertices_.point[k])) continue;
      const auto let_go = [k](std::vector<std::uint8_t>& column) {
        return !column.empty() && std::exchange(column[k], std::uint8_t{0}) != 0;
      };
      const bool still = let_go(vertices_.fixed), along_axes = let_go(vertices_.held_axes);
      count += still || along_axes;
    }
    return count;
  }
  std::size_t repeat(const EventTargets&) override { return apply(nullptr); }
  std::size_t bytes() const override { return bytes_of(points_); }

 private:
  VertexColumns& vertices_;
  std::vector<std::uint32_t> points_;  // of the mesh, ascending
};

}  // namespace

std::unique_ptr<ReadyEvent> ready(VertexColumns& vertices, const Release& release, const std::string& path) {
  return std::make_unique<ReadyRelease>(vertices, release, path);
}

}  // namespace dartboard
