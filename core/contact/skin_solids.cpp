#include "core/contact/skin_solids.h"

#include <algorithm>
#include <tuple>

namespace dartboard {

namespace detail {

template <std::size_t n>
void RowsAround<n>::clear() {
  at_node_.clear();
  next_at_node_.clear();
  of_owner_.clear();
  next_of_owner_.clear();
}

template <std::size_t n>
void RowsAround<n>::resize(std::size_t nodes, std::size_t owners) {
  at_node_.resize(nodes, none);
  of_owner_.resize(owners, none);
}

template <std::size_t n>
void RowsAround<n>::push_back(std::uint32_t owner, const std::array<std::uint32_t, n>& nodes) {
  const auto place = static_cast<std::uint32_t>(next_of_owner_.size());
  next_of_owner_.push_back(none);
  next_at_node_.resize(next_at_node_.size() + n, none);
  link(place, nodes, owner);
}

template <std::size_t n>
void RowsAround<n>::erase(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner,
                          const std::array<std::uint32_t, n>& last_nodes, std::uint32_t last_owner) {
  const auto last = static_cast<std::uint32_t>(next_of_owner_.size() - 1);
  unlink(place, nodes, owner);
  if (place != last) {
    unlink(last, last_nodes, last_owner);
    link(place, last_nodes, last_owner);
  }
  next_of_owner_.pop_back();
  next_at_node_.resize(next_at_node_.size() - n);
}

template <std::size_t n>
void RowsAround<n>::unlink(std::uint32_t& head, std::vector<std::uint32_t>& next, std::uint32_t entry) {
  std::uint32_t* at = &head;
  while (*at != entry) at = &next[*at];
  *at = next[entry];
}

template <std::size_t n>
void RowsAround<n>::unlink(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner) {
  for (std::uint32_t k = 0; k < n; ++k)
    unlink(at_node_[nodes[k]], next_at_node_, static_cast<std::uint32_t>(n) * place + k);
  unlink(of_owner_[owner], next_of_owner_, place);
}

template <std::size_t n>
void RowsAround<n>::link(std::uint32_t place, const std::array<std::uint32_t, n>& nodes, std::uint32_t owner) {
  for (std::uint32_t k = 0; k < n; ++k) {
    const auto entry = static_cast<std::uint32_t>(n) * place + k;
    next_at_node_[entry] = at_node_[nodes[k]];
    at_node_[nodes[k]] = entry;
  }
  next_of_owner_[place] = of_owner_[owner];
  of_owner_[owner] = place;
}

template class RowsAround<3>;
template class RowsAround<4>;

}  // namespace detail

void SkinSolids::clear() {
  tetrahedra_.clear();
  triangles_.clear();
  cells_.clear();
  faces_.clear();
  ++changes_;
}

void SkinSolids::resize(std::size_t nodes, std::size_t faces, std::size_t cells) {
  for (std::size_t k = cells; k < cell_count(); ++k) erase_cell(static_cast<std::uint32_t>(k));
  for (std::size_t k = faces; k < face_count(); ++k) erase_face(static_cast<std::uint32_t>(k));
  cells_.resize(nodes, cells);
  faces_.resize(nodes, faces);
  ++changes_;
}

void SkinSolids::add(const SkinTetrahedron& tetrahedron) {
  cells_.push_back(tetrahedron.cell, tetrahedron.nodes);
  tetrahedra_.push_back(tetrahedron);
  ++changes_;
}

void SkinSolids::add(const SkinTriangle& triangle) {
  faces_.push_back(triangle.face, triangle.nodes);
  triangles_.push_back(triangle);
  ++changes_;
}

void SkinSolids::erase_cell(std::uint32_t cell) {
  for (std::uint32_t place = cells_.first_of(cell); place != none; place = cells_.first_of(cell)) {
    const SkinTetrahedron &gone = tetrahedra_[place], &last = tetrahedra_.back();
    cells_.erase(place, gone.nodes, gone.cell, last.nodes, last.cell);
    tetrahedra_[place] = last;
    tetrahedra_.pop_back();
    ++changes_;
  }
}

void SkinSolids::erase_face(std::uint32_t face) {
  for (std::uint32_t place = faces_.first_of(face); place != none; place = faces_.first_of(face)) {
    const SkinTriangle &gone = triangles_[place], &last = triangles_.back();
    faces_.erase(place, gone.nodes, gone.face, last.nodes, last.face);
    triangles_[place] = last;
    triangles_.pop_back();
    ++changes_;
  }
}

bool operator==(const SkinSolids& a, const SkinSolids& b) {
  const auto sorted = [](auto rows, auto key) {
    std::ranges::sort(rows, {}, key);
    return rows;
  };
  const auto of_cell = [](const SkinTetrahedron& t) { return std::tuple(t.cell, t.part); };
  const auto of_face = [](const SkinTriangle& t) { return std::tuple(t.face, t.part); };
  return a.node_count() == b.node_count() && a.cell_count() == b.cell_count() && a.face_count() == b.face_count() &&
         sorted(a.tetrahedra_, of_cell) == sorted(b.tetrahedra_, of_cell) &&
         sorted(a.triangles_, of_face) == sorted(b.triangles_, of_face);
}

}  // namespace dartboard
