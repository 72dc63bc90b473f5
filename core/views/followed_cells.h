#pragma once
// Some cells of a mesh, followed in a body that changes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "core/base/bytes.h"
#include "core/mechanics/adapt.h"
#include "core/topology/cells.h"

namespace dartboard {

/// Cells of a mesh in ascending order, each with its number in the body for as long as it is there.
///
/// pre  the body is not refined
class FollowedCells {
 public:
  /// The cell of the mesh that a cell of the body is, by its number.
  using MeshCell = std::function<std::uint32_t(std::uint32_t)>;
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

  FollowedCells() = default;
  /// `of_mesh` are numbers of cells in any order, each any number of times.
  FollowedCells(std::vector<std::uint32_t> of_mesh, MeshCell mesh_cell)
      : of_mesh_(std::move(of_mesh)), mesh_cell_(std::move(mesh_cell)) {
    std::ranges::sort(of_mesh_);
    of_mesh_.erase(std::unique(of_mesh_.begin(), of_mesh_.end()), of_mesh_.end());
  }

  std::size_t size() const { return of_mesh_.size(); }
  bool empty() const { return of_mesh_.empty(); }
  /// The place of a cell of the mesh in their order; nothing if it is not followed.
  std::uint32_t place_of(std::uint32_t mesh_cell) const {
    const auto found = std::ranges::lower_bound(of_mesh_, mesh_cell);
    return found == of_mesh_.end() || *found != mesh_cell ? nothing
                                                          : static_cast<std::uint32_t>(found - of_mesh_.begin());
  }
  bool is_there(std::uint32_t place) const { return cell_[place] != nothing; }

  /// cost    O(cells log(followed ones)); nothing without followed ones
  template <class Body>
  void rebuild(const Body& body) {
    cell_.assign(size(), nothing);
    place_of_cell_.clear();
    for (std::uint32_t c = 0; c < body.cell_dart.size() && !empty(); ++c) {
      const std::uint32_t place = place_of(mesh_cell_(c));
      place_of_cell_.push_back(place);
      if (place != nothing) cell_[place] = c;
    }
  }

  /// Follow the numbers that `adapt` reports; removed(place) is called for each that is not there any more.
  ///
  /// cost    O(moved cells)
  template <class Removed>
  void apply(const ChangedEmbeddings& changed, Removed&& removed) {
    if (empty()) return;
    place_of_cell_.resize(changed.cell_count + changed.moved_cells.size(), nothing);
    for (const auto& [from, to] : changed.moved_cells) {
      if (const std::uint32_t place = place_of_cell_[to]; place != nothing) {
        cell_[place] = nothing;
        removed(place);
      }
      if (from != to) {
        place_of_cell_[to] = place_of_cell_[from];
        if (const std::uint32_t place = place_of_cell_[to]; place != nothing) cell_[place] = to;
      }
      place_of_cell_.pop_back();
    }
  }

  /// Calls visit(place) for the followed cells around a vertex; for some more than once.
  template <class Body, class Visit>
  void for_each_around(const Body& body, std::uint32_t vertex, Mark& seen, Visit&& visit) const {
    if (empty()) return;
    for_each_place_of(body.map, Vertex{body.vertices.dart[vertex]}, seen, [&](Dart d) {
      if (const std::uint32_t place = place_of_cell_[body.cell(body.map, d)]; place != nothing) visit(place);
    });
  }

  using Corner = CellCorner;
  /// The vertices of a cell that is there, each as often as it has darts in it.
  template <class Body>
  void find_corners(const Body& body, std::uint32_t place, std::vector<Corner>& corners) const {
    corners.clear();
    for_each_dart_of(body.map, Cell<Body::dimension>{body.cell_dart[cell_[place]]}, [&](Dart d) {
      const std::uint32_t vertex = body.vertex(body.map, d);
      corners.push_back({body.vertices.point[vertex], vertex});
    });
  }
  /// pre  the point is one of the cell's
  static std::uint32_t vertex_at(std::span<const Corner> corners, std::uint32_t point) {
    return std::ranges::find(corners, point, &Corner::point)->vertex;
  }

  /// Are the same cells of the body the same ones of the mesh?
  friend bool operator==(const FollowedCells& a, const FollowedCells& b) {
    return a.cell_ == b.cell_ && a.place_of_cell_ == b.place_of_cell_;
  }
  template <class Archive>
  void state(Archive& archive) {
    archive(cell_, place_of_cell_);
  }
  std::size_t bytes() const { return bytes_of(of_mesh_, cell_, place_of_cell_); }
  void shrink_to_fit() {
    of_mesh_.shrink_to_fit();
    place_of_cell_.shrink_to_fit();
  }

 private:
  std::vector<std::uint32_t> of_mesh_;  // constant
  MeshCell mesh_cell_;
  std::vector<std::uint32_t> cell_;           // of the body, by place; nothing where it was removed
  std::vector<std::uint32_t> place_of_cell_;  // by cell of the body; empty if no cell is followed
};

}  // namespace dartboard
