#pragma once
// The tetrahedra along the boundary of a body, which a place can be inside of, and its triangles, the ways out.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/base/bytes.h"

namespace dartboard {

/// A cell, or a part of one that has more corners than four, right-handed at rest.
struct SkinTetrahedron {
  std::array<std::uint32_t, 4> nodes{};
  std::uint32_t cell = 0;
  std::uint32_t group = 0;  // the body of a scene that the cell belongs to
  std::uint16_t part = 0;   // its number among the parts of its cell
  std::uint16_t outer = 0;  // bit k: its face without node k is on the boundary

  friend bool operator==(const SkinTetrahedron&, const SkinTetrahedron&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(nodes, cell, group, part, outer);
  }
};

/// A face of the boundary, or a half of one, counter-clockwise at rest seen from outside.
struct SkinTriangle {
  std::array<std::uint32_t, 3> nodes{};
  std::uint32_t face = 0, part = 0;

  friend bool operator==(const SkinTriangle&, const SkinTriangle&) = default;
  template <class Archive>
  void state(Archive& archive) {
    archive(nodes, face, part);
  }
};

namespace detail {

/// Rows of n nodes, found by their owner and by each node: chains through them, in no particular order.
template <std::size_t n>
class RowsAround {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  void clear();
  /// Set how many nodes and owners have a number.
  ///
  /// pre  rows of higher numbers have been erased
  void resize(std::size_t nodes, std::size_t owners);
  std::size_t owner_count() const { return of_owner_.size(); }
  void push_back(std::uint32_t owner, const std::array<std::uint32_t, n>& nodes);
  /// Erase a row; the last row takes its place, and the caller's columns must do the same.
  ///
  /// pre  `nodes` of the place and of the last
  void erase(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner,
             const std::array<std::uint32_t, n>& last_nodes, std::uint32_t last_owner);

  /// f(place) for each row with this node, of this owner; f may return true to stop.
  template <class F>
  void for_each_at(std::uint32_t node, F&& f) const {
    for (std::uint32_t k = at_node_[node]; k != none; k = next_at_node_[k]) f(k / static_cast<std::uint32_t>(n));
  }
  template <class F>
  void for_each_of(std::uint32_t owner, F&& f) const {
    for (std::uint32_t k = of_owner_[owner]; k != none; k = next_of_owner_[k]) f(k);
  }
  std::uint32_t first_of(std::uint32_t owner) const { return of_owner_[owner]; }
  std::uint32_t first_at(std::uint32_t node) const { return at_node_[node] == none ? none : at_node_[node] / n; }
  bool has_node(std::uint32_t node) const { return at_node_[node] != none; }
  std::size_t node_count() const { return at_node_.size(); }

  template <class Archive>
  void state(Archive& archive) {
    archive(at_node_, next_at_node_, of_owner_, next_of_owner_);
  }
  std::size_t bytes() const { return bytes_of(at_node_, next_at_node_, of_owner_, next_of_owner_); }

 private:
  static void unlink(std::uint32_t& head, std::vector<std::uint32_t>& next, std::uint32_t entry);
  void unlink(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner);
  void link(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner);

  std::vector<std::uint32_t> at_node_, next_at_node_;    // entries are n place + corner
  std::vector<std::uint32_t> of_owner_, next_of_owner_;  // entries are places
};

extern template class RowsAround<3>;
extern template class RowsAround<4>;

}  // namespace detail

/// For a solid: the tetrahedra of all cells that have a corner on the boundary, with hexahedra and other cells split
/// into tetrahedra of their own corners, and the triangles of the boundary.
///
/// These are plain arrays without a map: core/views/skin_solids_view.h fills them and follows changes. Both are in no
/// particular order; a tetrahedron is named by its cell and part, a triangle by its face and part, so that search
/// results do not depend on that order.
class SkinSolids {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  const std::vector<SkinTetrahedron>& tetrahedra() const { return tetrahedra_; }
  const std::vector<SkinTriangle>& triangles() const { return triangles_; }

  /// Calls f(place in `tetrahedra()`) for those with this node; the next function for those of this cell.
  template <class F>
  void for_each_tetrahedron_at(std::uint32_t node, F&& f) const {
    cells_.for_each_at(node, f);
  }
  template <class F>
  void for_each_tetrahedron_of(std::uint32_t cell, F&& f) const {
    cells_.for_each_of(cell, f);
  }
  /// Calls f(place in `triangles()`) for those with this node; a vertex within the body has no triangles.
  template <class F>
  void for_each_triangle_at(std::uint32_t node, F&& f) const {
    faces_.for_each_at(node, f);
  }
  bool is_on_boundary(std::uint32_t node) const { return faces_.has_node(node); }
  /// The group of the cells around a node; 0 if no tetrahedron is kept there.
  std::uint32_t group_at(std::uint32_t node) const {
    const std::uint32_t first = node < cells_.node_count() ? cells_.first_at(node) : none;
    return first == none ? 0 : tetrahedra_[first].group;
  }
  /// The number of nodes.
  std::size_t node_count() const { return cells_.node_count(); }
  /// Increases with every change: data derived from the arrays are valid while it stays the same.
  std::uint64_t changes() const { return changes_; }

  void clear();
  /// Set the present numbers of nodes, faces and cells; rows of higher numbers are erased.
  ///
  /// pre  no remaining row names a node of a higher number
  void resize(std::size_t nodes, std::size_t faces, std::size_t cells);
  void add(const SkinTetrahedron& tetrahedron);
  void add(const SkinTriangle& triangle);
  void erase_cell(std::uint32_t cell);
  void erase_face(std::uint32_t face);
  std::size_t cell_count() const { return cells_.owner_count(); }
  std::size_t face_count() const { return faces_.owner_count(); }

  /// Equal if they have the same rows, in any order.
  friend bool operator==(const SkinSolids& a, const SkinSolids& b);
  template <class Archive>
  void state(Archive& archive) {
    archive(tetrahedra_, triangles_, cells_, faces_);
    ++changes_;
  }
  std::size_t bytes() const { return bytes_of(tetrahedra_, triangles_) + cells_.bytes() + faces_.bytes(); }

 private:
  std::vector<SkinTetrahedron> tetrahedra_;
  std::vector<SkinTriangle> triangles_;
  detail::RowsAround<4> cells_;
  detail::RowsAround<3> faces_;
  std::uint64_t changes_ = 0;
};

}  // namespace dartboard
