#include "core/views/skin_solids_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The corners of the face of d, in its cell.
template <class Body, class Face>
Face face_from(const Body& body, Dart d) {
  Face face;
  face.outer = body.map.template is_free<3>(d);
  Dart at = d;
  do {
    face.nodes[face.count++] = body.vertex(body.map, at);
    at = body.map.template alpha<0, 1>(at);
  } while (at != d && face.count < face.nodes.size());
  // from the lowest point; the orientation is decided later
  const auto& point = body.vertices.point;
  const auto first = face.nodes.begin(), last = first + face.count;
  const auto lowest =
      std::min_element(first, last, [&point](std::uint32_t a, std::uint32_t b) { return point[a] < point[b]; });
  std::rotate(first, lowest, last);
  return face;
}

template <class Face>
bool has_node(const Face& face, std::uint32_t node) {
  return std::find(face.nodes.begin(), face.nodes.begin() + face.count, node) != face.nodes.begin() + face.count;
}

void sort_out(std::vector<std::uint32_t>& numbers) {
  std::ranges::sort(numbers);
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

template <class Body>
void SkinSolidsView::rebuild(const Body& body) {
  solids_.clear();
  if constexpr (Body::dimension == 3) {
    solids_.resize(body.vertices.size(), body.face_dart.size(), body.cell_dart.size());
    if (body.vertices.rest.empty()) return;
    for (std::uint32_t k = 0; k < body.face_dart.size(); ++k) add_face(body, k);
    for (std::uint32_t k = 0; k < body.cell_dart.size(); ++k) add_cell(body, k);
  }
}

template <class Body>
void SkinSolidsView::apply(const Body& body, const ChangedEmbeddings& changed) {
  if constexpr (Body::dimension == 3) {
    if (body.vertices.rest.empty()) {
      solids_.resize(changed.vertex_count, changed.face_count, changed.cell_count);
      return;
    }
    cells_ = changed.cells;
    faces_ = changed.faces;
    const auto add_around = [&](std::uint32_t vertex) {
      for_each_dart_of(body.map, Vertex{body.vertices.dart[vertex]}, [&](Dart d) {
        cells_.push_back(body.cell(body.map, d));
        if (body.map.template is_free<3>(d)) faces_.push_back(body.face(body.map, d));
      });
    };
    // cells around a vertex with another number refer to its new number, and cells around a vertex that came to the
    // boundary are now along it
    for (const std::uint32_t k : changed.vertices) add_around(k);
    for (const std::uint32_t k : changed.faces)
      if (const Dart first = body.face_dart[k]; body.map.template is_free<3>(first)) {
        Dart d = first;
        do {
          add_around(body.vertex(body.map, d));
          d = body.map.template alpha<0, 1>(d);
        } while (d != first);
      }
    sort_out(cells_);
    sort_out(faces_);
    // rows are erased by the numbers that they were made with, before these numbers get another meaning
    for (const std::uint32_t k : cells_)
      if (k < solids_.cell_count()) solids_.erase_cell(k);
    for (const std::uint32_t k : faces_)
      if (k < solids_.face_count()) solids_.erase_face(k);
    solids_.resize(changed.vertex_count, changed.face_count, changed.cell_count);
    for (const std::uint32_t k : faces_) add_face(body, k);
    for (const std::uint32_t k : cells_) add_cell(body, k);
  }
}

template <class Body>
void SkinSolidsView::add_face(const Body& body, std::uint32_t number) {
  const Dart d = body.face_dart[number];
  if (!body.map.template is_free<3>(d)) return;
  const Face face = face_from<Body, Face>(body, d);
  const auto& rest = body.vertices.rest;
  // outwards is away from the middle of the cell
  Vector3d middle(0, 0, 0);
  double corners = 0.0;
  for_each_dart_of(body.map, Volume{d}, [&](Dart e) {
    middle += rest[body.vertex(body.map, e)];
    corners += 1.0;
  });
  middle /= corners;
  for (std::uint32_t k = 1; k + 1 < face.count; ++k) {
    std::array<std::uint32_t, 3> nodes{face.nodes[0], face.nodes[k], face.nodes[k + 1]};
    const Vector3d normal = (rest[nodes[1]] - rest[nodes[0]]).cross(rest[nodes[2]] - rest[nodes[0]]);
    if (normal.dot(rest[nodes[0]] - middle) < 0.0) std::swap(nodes[1], nodes[2]);
    solids_.add(SkinTriangle{nodes, number, k - 1});
  }
}

template <class Body>
void SkinSolidsView::add_cell(const Body& body, std::uint32_t number) {
  around_.clear();
  Mark seen(body.map);
  bool along_boundary = false;
  std::uint32_t lowest = no_point, top = 0;
  for_each_dart_of(body.map, Volume{body.cell_dart[number]}, [&](Dart d) {
    if (seen(d)) return;
    Dart at = d;
    do {
      seen.set(at);
      seen.set(body.map.template alpha<0>(at));
      at = body.map.template alpha<0, 1>(at);
    } while (at != d);
    around_.push_back(face_from<Body, Face>(body, d));
    const Face& face = around_.back();
    for (std::uint32_t k = 0; k < face.count; ++k) {
      along_boundary = along_boundary || solids_.is_on_boundary(face.nodes[k]);
      if (const std::uint32_t point = body.vertices.point[face.nodes[k]]; point <= lowest) {
        lowest = point;
        top = face.nodes[k];
      }
    }
  });
  if (!along_boundary) return;

  const auto& rest = body.vertices.rest;
  SkinTetrahedron tetrahedron{.nodes = {}, .cell = number, .group = group_ ? group_(number) : 0};
  for (const Face& face : around_) {
    if (has_node(face, top)) continue;
    for (std::uint32_t k = 1; k + 1 < face.count; ++k, ++tetrahedron.part) {
      auto& nodes = tetrahedron.nodes;
      nodes = {top, face.nodes[0], face.nodes[k], face.nodes[k + 1]};
      const auto side = [&](std::size_t corner) -> Vector3d { return rest[nodes[corner]] - rest[nodes[0]]; };
      if (side(1).cross(side(2)).dot(side(3)) < 0.0) std::swap(nodes[2], nodes[3]);
      tetrahedron.outer = 0;
      for (std::uint32_t without = 0; without < 4; ++without)
        for (const Face& outer : around_) {
          bool all = outer.outer;
          for (std::uint32_t corner = 0; corner < 4; ++corner)
            all = all && (corner == without || has_node(outer, nodes[corner]));
          if (all) tetrahedron.outer = static_cast<std::uint16_t>(tetrahedron.outer | 1u << without);
        }
      solids_.add(tetrahedron);
    }
  }
}

DARTBOARD_SKIN_SOLIDS(, Map2)
DARTBOARD_SKIN_SOLIDS(, Map3)
DARTBOARD_SKIN_SOLIDS(, TetMap)

}  // namespace dartboard
