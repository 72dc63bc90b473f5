#include "core/views/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "core/base/bytes.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The faces that are sampled, by number: the boundary faces of a solid, the cells of a surface.
template <class Body>
const std::vector<Dart>& face_darts(const Body& body) {
  if constexpr (Body::dimension == 3)
    return body.face_dart;
  else
    return body.cell_dart;
}
template <class Body>
std::uint32_t face_number(const Body& body, Dart d) {
  if constexpr (Body::dimension == 3)
    return body.face(body.map, d);
  else
    return body.cell(body.map, d);
}
template <class Body>
bool is_sampled(const Body& body, Dart d) {
  if constexpr (Body::dimension == 3)
    return body.map.template is_free<3>(d);
  else
    return true;
}

/// A face with the areas that its corners and its middle stand for.
struct WeightedFace {
  SkinSample middle;
  std::array<double, 4> corner{};  // [m^2]
};

/// Computed from its lowest dart, so that the areas have the same bits for every caller.
template <class Body>
WeightedFace weighted(const Body& body, std::uint32_t k) {
  WeightedFace face;
  auto& nodes = face.middle.nodes;
  std::uint32_t& count = face.middle.count;
  const Dart first = face_darts(body)[k];
  Dart d = first;
  do {
    nodes[count++] = body.vertex(body.map, d);
    d = body.map.template alpha<0, 1>(d);
  } while (d != first && count < nodes.size());

  const auto& rest = body.vertices.rest;
  // from corner `from` to the one `by` further on
  const auto side = [&](std::uint32_t from, std::uint32_t by) -> Vector3d {
    return rest[nodes[(from + by) % count]] - rest[nodes[from]];
  };
  if (count == 3) {
    const double area = 0.5 * side(0, 1).cross(side(0, 2)).norm();
    for (std::size_t a = 0; a < 3; ++a) face.corner[a] = area / 12.0;
    face.middle.area = 0.75 * area;
    return face;
  }
  const Vector3d twice = side(0, 2).cross(side(1, 2));  // the area vector, from the diagonals
  const double area = 0.5 * twice.norm();
  face.middle.area = area / 1.5;
  bool convex = area > 0.0;
  for (std::uint32_t a = 0; a < 4; ++a) {
    const double triangle = 0.25 * side(a, 1).cross(side(a, 3)).dot(twice) / area;
    face.corner[a] = triangle / 6.0;
    convex = convex && triangle >= 0.0;
  }
  if (!convex) face.corner.fill(area / 12.0);
  return face;
}

}  // namespace

template <class Body>
void Skin::rebuild(const Body& body) {
  samples_.clear();
  owner_.clear();
  of_vertex_.clear();
  of_face_.clear();
  resize(body.vertices.size(), face_darts(body).size());
  if (body.vertices.rest.empty()) return;
  for (std::uint32_t k = 0; k < of_vertex_.size(); ++k) find_vertex(body, k);
  for (std::uint32_t k = 0; k < of_face_.size(); ++k) find_face(body, k);
}

template <class Body>
void Skin::apply(const Body& body, const ChangedEmbeddings& changed) {
  const bool solid = Body::dimension == 3;
  resize(changed.vertex_count, solid ? changed.face_count : changed.cell_count);
  if (body.vertices.rest.empty()) return;
  touched_ = changed.vertices;
  for (const std::uint32_t k : solid ? changed.faces : changed.cells) {
    find_face(body, k);
    const std::uint32_t place = of_face_[k];
    if (place == no_place) continue;
    const auto corners = samples_[place].corners();
    touched_.insert(touched_.end(), corners.begin(), corners.end());
  }
  // the samples around a vertex with another number, or with other parts, refer to its new number
  for (const std::uint32_t k : changed.vertices)
    for_each_dart_of(body.map, Vertex{body.vertices.dart[k]}, [&](Dart d) {
      if (is_sampled(body, d)) find_face(body, face_number(body, d));
    });
  std::ranges::sort(touched_);
  touched_.erase(std::unique(touched_.begin(), touched_.end()), touched_.end());
  for (const std::uint32_t k : touched_) find_vertex(body, k);
}

template <class Body>
void Skin::find_face(const Body& body, std::uint32_t k) {
  SkinSample sample;
  if (is_sampled(body, face_darts(body)[k])) sample = weighted(body, k).middle;
  set(2 * k + 1, sample);
}

// The shares are summed in the order of the faces' darts: numbers depend on earlier changes.
template <class Body>
void Skin::find_vertex(const Body& body, std::uint32_t k) {
  around_.clear();
  for_each_dart_of(body.map, Vertex{body.vertices.dart[k]}, [&](Dart d) {
    if (!is_sampled(body, d)) return;
    const std::uint32_t face = face_number(body, d);
    around_.emplace_back(face_darts(body)[face].index, face);
  });
  std::ranges::sort(around_);
  around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
  SkinSample sample{{k}, 1, 0.0};
  for (const auto& [dart, number] : around_) {
    const WeightedFace face = weighted(body, number);
    for (std::uint32_t a = 0; a < face.middle.count; ++a)
      if (face.middle.nodes[a] == k) sample.area += face.corner[a];
  }
  set(2 * k, sample);
}

void Skin::resize(std::size_t vertices, std::size_t faces) {
  for (std::size_t k = vertices; k < of_vertex_.size(); ++k) erase(static_cast<std::uint32_t>(2 * k));
  for (std::size_t k = faces; k < of_face_.size(); ++k) erase(static_cast<std::uint32_t>(2 * k + 1));
  of_vertex_.resize(vertices, no_place);
  of_face_.resize(faces, no_place);
}

void Skin::set(std::uint32_t owner, const SkinSample& sample) {
  if (!(sample.area > 0.0)) return erase(owner);
  std::uint32_t& at = place(owner);
  if (at == no_place) {
    at = static_cast<std::uint32_t>(samples_.size());
    samples_.push_back(sample);
    owner_.push_back(owner);
  } else {
    samples_[at] = sample;
  }
}

void Skin::erase(std::uint32_t owner) {
  const std::uint32_t at = place(owner);
  if (at == no_place) return;
  samples_[at] = samples_.back();
  owner_[at] = owner_.back();
  place(owner_[at]) = at;
  place(owner) = no_place;
  samples_.pop_back();
  owner_.pop_back();
}

bool operator==(const Skin& a, const Skin& b) {
  if (a.samples_.size() != b.samples_.size() || a.of_vertex_.size() != b.of_vertex_.size() ||
      a.of_face_.size() != b.of_face_.size())
    return false;
  for (std::size_t k = 0; k < a.samples_.size(); ++k) {
    const std::uint32_t owner = a.owner_[k], at = (owner % 2 == 0 ? b.of_vertex_ : b.of_face_)[owner / 2];
    if (at == Skin::no_place || b.samples_[at] != a.samples_[k]) return false;
  }
  return true;
}

std::size_t Skin::bytes() const { return bytes_of(samples_, owner_, of_vertex_, of_face_); }

DARTBOARD_SKIN(, Map2)
DARTBOARD_SKIN(, Map3)
DARTBOARD_SKIN(, TetMap)

}  // namespace dartboard
