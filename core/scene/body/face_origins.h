#pragma once
// For each face of a refined body with a vertex that refinement made: the face of the mesh in which it lies.

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "core/base/bytes.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/operations/subdivide.h"

namespace dartboard {

/// Kept by dart, so that cuts and removals change nothing; empty until the body is refined.
class FaceOrigins {
 public:
  using Points = std::array<std::uint32_t, 3>;  // of the mesh, ascending

  /// Follow a subdivision. A face of a child is that of its parent, lies in one that has the subdivided edge or face,
  /// or is within the parent.
  ///
  /// pre  embeddings have not followed it yet
  template <class Body>
  void follow(const Body& body, const Subdivision& subdivision) {
    std::vector<std::array<std::uint32_t, 4>> of_parents;
    for (const Subdivision::Parent& parent : subdivision.parents) {
      of_parents.emplace_back();
      for (std::size_t f = 0; f < 4; ++f) {
        const Dart dart = parent.darts[6 * f];
        const bool is_divided = (parent.of_cell >> f & 1u) == 0;
        of_parents.back()[f] = row(dart) == 0 && is_divided ? add_row(body, parent, f) : row(dart);
      }
    }
    for (const Subdivision::Child& child : subdivision.children) {
      const std::uint8_t of_cell = subdivision.parents[child.parent].of_cell;
      for (std::size_t p = 0; p < child.darts.size(); ++p) {
        const std::size_t f = p / 6;  // opposite node f
        const bool is_within = f != child.replaced && (of_cell >> f & 1u) != 0;
        set_row(child.darts[p], is_within ? 0 : of_parents[child.parent][f]);
      }
    }
  }

  /// The face of the mesh that a face lies in; null for a face that lies within a cell of the mesh or has only points
  /// of the mesh.
  const Points* of(Dart d) const { return row(d) == 0 ? nullptr : &points_[row(d) - 1]; }

  std::size_t bytes() const { return bytes_of(row_, points_); }
  template <class Archive>
  void state(Archive& archive) {
    archive(row_, points_);
  }

 private:
  std::uint32_t row(Dart d) const { return d.index < row_.size() ? row_[d.index] : 0; }
  void set_row(Dart d, std::uint32_t row) {
    if (d.index >= row_.size()) row_.resize(d.index + 1, 0);
    row_[d.index] = row;
  }
  /// 0 for a face with a vertex that refinement made, if no row says that it lies in a face of the mesh.
  template <class Body>
  std::uint32_t add_row(const Body& body, const Subdivision::Parent& parent, std::size_t face) {
    Points points{};
    for (std::size_t r = 0; r < 3; ++r)
      points[r] = body.vertices.point[body.vertex(body.map, parent.darts[6 * face + 2 * r])];
    std::ranges::sort(points);
    if (points.back() == no_point) return 0;
    points_.push_back(points);
    return static_cast<std::uint32_t>(points_.size());
  }

  std::vector<std::uint32_t> row_;  // by dart: the place of its face in `points_`, from 1, or 0
  std::vector<Points> points_;
};

}  // namespace dartboard
