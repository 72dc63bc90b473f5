#pragma once
// Bodies that are torn, for tests: their lost faces are identified by mesh points, which tearing does not renumber.

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <set>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/walks/cell_arrays.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::torn_body {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

template <class Map>
Body<Map> body_of(const Mesh& mesh, std::vector<std::uint32_t> fixed = {}) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 8.0, .stiffness = 4.0, .damping = 0.25, .viscosity = 0.5};
  problem.fixed = std::move(fixed);
  return build_body<Map, Held::by_every_dart>(problem);
}

template <class Map>
void move(Body<Map>& body, const Eigen::Matrix3d& matrix) {
  for (Eigen::Vector3d& x : body.vertices.position) x = matrix * x;
}

using Triple = std::array<std::uint32_t, 3>;

// The face's three lowest mesh points, which identify it.
template <class Map>
Triple points_of(const Body<Map>& body, Dart face) {
  std::set<std::uint32_t> points;
  for_each_dart_of(body.map, Face{face}, [&](Dart d) { points.insert(body.vertices.point[body.vertex(body.map, d)]); });
  auto next = points.begin();
  Triple triple{};
  for (auto& p : triple) p = *next++;
  return triple;
}

// The unit normal of a face whose first three corners are not on a line.
template <class Map>
Eigen::Vector3d normal_of(const Body<Map>& body, Dart d) {
  const Dart next = body.map.template alpha<0, 1>(d), last = body.map.template alpha<0, 1>(next);
  const auto x = [&](Dart e) { return body.vertices.position[body.vertex(body.map, e)]; };
  const Eigen::Vector3d a = x(next) - x(d), b = x(last) - x(d);
  return Eigen::Vector3d(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x())
      .normalized();
}

/// Springs that do not end at vertex k are slack afterwards.
template <class Map>
void slacken_all_but_around(MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t k) {
  CellArrays arrays;
  arrays.rebuild(body);
  for (const EdgeEntry& edge : arrays.edges)
    if (edge.ends[0] != k && edge.ends[1] != k)
      body.springs.change(edge.embedding, [](Spring& spring) { spring.stiffness = 0.0; });
}

template <class Map>
std::uint32_t most_stressed(const MassSpringBody<Map, Held::by_every_dart>& body) {
  std::uint32_t most = 0;
  const auto stress = [&body](std::uint32_t k) { return principal_stress(vertex_stress(body, k)).value; };
  for (std::uint32_t k = 1; k < body.vertices.size(); ++k)
    if (stress(k) > stress(most)) most = k;
  return most;
}

/// A body with arrays that follow it, and the faces that came apart.
template <class Map>
struct Torn {
  Body<Map> body;
  CellArrays arrays{};
  std::vector<Eigen::Matrix3d> stress{};
  std::set<Triple> faces{};                // the parted ones, by mesh points
  std::vector<Eigen::Vector3d> normals{};  // of the parted faces
  std::size_t followed = 0, vertices_apart = 0;

  explicit Torn(Body<Map> start) : body(std::move(start)) { arrays.rebuild(body); }

  TornVertices tear(const TearRule& rule, const FaceFilter& filter = {}) {
    std::vector<std::array<std::uint32_t, 2>> ends;
    for (const EdgeEntry& edge : arrays.edges) ends.push_back(edge.ends);
    return tear_where_stressed(
        body, ends, rule, filter,
        [this](const TopologyChange& change) {
          ++followed;
          vertices_apart += change.vertices.size();
          arrays.apply(body, adapt(body, change));
          for (const DissociatedCell& face : change.faces) {
            faces.insert(points_of(body, face.kept));
            normals.push_back(normal_of(body, face.kept));
          }
        },
        stress);
  }
};

inline Mesh jittered_box() { return kuhn_grid(3, 2, 4, 0.5, 0.1, 9); }
inline const Eigen::Matrix3d along_z = Eigen::Vector3d(1, 1, 1.5).asDiagonal();

}  // namespace dartboard::torn_body
