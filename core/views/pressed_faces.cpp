#include "core/views/pressed_faces.h"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "core/base/bytes.h"

namespace dartboard {

std::vector<PressedFace> outer_faces(const Mesh& mesh) {
  struct Side {
    PressedFace face;
    int cells;
  };
  std::map<std::array<std::uint32_t, 4>, Side> sides;  // by their corners in ascending order
  std::vector<PressedFace> faces;
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const bool solid = dimension(mesh.kinds[c]) == 3;
    // the faces of a cell are counter-clockwise seen from outside if it is right-handed
    const bool is_mirrored = solid && signed_measure(mesh, c) < 0.0;
    for (const std::vector<int>& cycle : faces_of(mesh.kinds[c])) {
      PressedFace face{.cell = c};
      for (const int k : cycle) face.corner[face.count++] = mesh.nodes[mesh.first[c] + static_cast<std::size_t>(k)];
      for (std::uint32_t k = 0; k < face.count; ++k)
        face.stiffness += (mesh.points[face.corner[(k + 1) % face.count]] - mesh.points[face.corner[k]]).norm() / 3.0;
      if (is_mirrored) std::reverse(face.corner.begin() + 1, face.corner.begin() + face.count);
      if (!solid) {
        faces.push_back(face);
        continue;
      }
      auto key = face.corner;
      if (face.count == 3) key[3] = std::max({key[0], key[1], key[2]});
      std::ranges::sort(key);
      ++sides.try_emplace(key, Side{face, 0}).first->second.cells;
    }
  }
  for (const auto& [key, side] : sides)
    if (side.cells == 1) faces.push_back(side.face);
  return faces;
}

PressedFacesView::PressedFacesView(std::vector<PressedFace> of_mesh, FollowedCells::MeshCell mesh_cell)
    : of_mesh_(std::move(of_mesh)) {
  std::ranges::stable_sort(of_mesh_, {}, &PressedFace::cell);
  std::vector<std::uint32_t> cells;
  for (const PressedFace& face : of_mesh_) cells.push_back(face.cell);
  cells_ = FollowedCells(std::move(cells), std::move(mesh_cell));
  first_.assign(cells_.size() + 1, 0);
  for (const PressedFace& face : of_mesh_) ++first_[cells_.place_of(face.cell) + 1];
  for (std::size_t p = 0; p < cells_.size(); ++p) first_[p + 1] += first_[p];
}

template <class Body>
void PressedFacesView::rebuild(const Body& body) {
  rows = of_mesh_;
  face_.resize(rows.size());
  std::iota(face_.begin(), face_.end(), 0u);
  row_ = face_;
  cells_.rebuild(body);
  for (std::uint32_t p = 0; p < cells_.size(); ++p) {
    if (cells_.is_there(p))
      find_corners(body, p);
    else
      erase_all_of(p);
  }
}

/// The last row takes the place of each one erased.
void PressedFacesView::erase_all_of(std::uint32_t place) {
  for (std::uint32_t face = first_[place]; face < first_[place + 1]; ++face) {
    const std::uint32_t row = row_[face];
    rows[row] = rows.back();
    face_[row] = face_.back();
    row_[face_[row]] = row;
    row_[face] = FollowedCells::nothing;
    rows.pop_back();
    face_.pop_back();
  }
}

template <class Body>
void PressedFacesView::apply(const Body& body, const ChangedEmbeddings& changed) {
  cells_.apply(changed, [this](std::uint32_t p) { erase_all_of(p); });
  touched_.clear();
  Mark seen(body.map);
  for (const std::uint32_t k : changed.vertices)
    cells_.for_each_around(body, k, seen, [this](std::uint32_t p) { touched_.push_back(p); });
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const std::uint32_t p : touched_) find_corners(body, p);
}

template <class Body>
void PressedFacesView::find_corners(const Body& body, std::uint32_t place) {
  cells_.find_corners(body, place, corners_);
  for (std::uint32_t face = first_[place]; face < first_[place + 1]; ++face) {
    PressedFace& row = rows[row_[face]];
    for (std::uint32_t k = 0; k < row.count; ++k)
      row.corner[k] = FollowedCells::vertex_at(corners_, of_mesh_[face].corner[k]);
  }
}

bool operator==(const PressedFacesView& a, const PressedFacesView& b) {
  const auto same_face = [&](std::uint32_t face) {
    const std::uint32_t in_a = a.row_[face], in_b = b.row_[face];
    if (in_a == FollowedCells::nothing || in_b == FollowedCells::nothing) return in_a == in_b;
    return a.rows[in_a] == b.rows[in_b];
  };
  if (a.rows.size() != b.rows.size() || a.row_.size() != b.row_.size() || a.cells_ != b.cells_) return false;
  for (std::uint32_t face = 0; face < a.row_.size(); ++face)
    if (!same_face(face)) return false;
  return true;
}

std::size_t PressedFacesView::bytes() const {
  return bytes_of(rows, of_mesh_) + bytes_of(first_, face_, row_) + cells_.bytes();
}

void PressedFacesView::shrink_to_fit() {
  rows.shrink_to_fit();
  of_mesh_.shrink_to_fit();
  cells_.shrink_to_fit();
}

DARTBOARD_PRESSED_FACES(, Map2)
DARTBOARD_PRESSED_FACES(, Map3)
DARTBOARD_PRESSED_FACES(, TetMap)

}  // namespace dartboard
