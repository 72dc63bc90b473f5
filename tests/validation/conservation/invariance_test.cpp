// A simulation with a cut must not depend on these: the numbering of its mesh, and the scene's place in space.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/mechanics/fracture/seam.h"
#include "core/mechanics/fracture/stress.h"
#include "core/mechanics/fracture/tearing.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/random.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/runge_kutta_4.h"
#include "core/walks/spring_forces.h"
#include "reference/rebuild.h"
#include "reference/summation_bound.h"
#include "tests/support/rotation_for_tests.h"

namespace dartboard::invariance_test {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;
using Triple = std::array<std::uint32_t, 3>;

constexpr Material soft{.density = 1000.0, .stiffness = 200.0, .damping = 0.5, .viscosity = 0.5};

Problem moving_box() {
  Problem problem;
  problem.mesh = kuhn_box(3, 3, 3, 0.125, 0.2, 5);
  problem.material = soft;
  problem.h = 1e-3;
  for (const auto& p : problem.mesh.points)
    problem.initial_velocity.emplace_back(0.5 * p.y() - p.z(), p.x() * p.z(), p.x() - 0.25 * p.y());
  problem.fixed = {0, 1, 5};
  return problem;
}

/// A random permutation: the new number of each.
std::vector<std::uint32_t> permutation(std::size_t count, std::uint64_t seed) {
  std::vector<std::uint32_t> to(count);
  for (std::uint32_t k = 0; k < count; ++k) to[k] = k;
  SplitMix64 random(seed);
  for (std::uint32_t k = static_cast<std::uint32_t>(count); k > 1; --k) std::swap(to[k - 1], to[random.below(k)]);
  return to;
}

/// The same body: points, cells and the nodes of each cell in another order. The nodes of a cell are turned by an even
/// permutation, which keeps it right-handed.
Problem renumbered(const Problem& problem, const std::vector<std::uint32_t>& point_to, std::uint64_t seed) {
  Problem other = problem;
  const std::size_t points = problem.mesh.points.size();
  for (std::uint32_t k = 0; k < points; ++k) {
    other.mesh.points[point_to[k]] = problem.mesh.points[k];
    other.initial_velocity[point_to[k]] = problem.initial_velocity[k];
  }
  other.mesh.kinds.clear();
  other.mesh.nodes.clear();
  other.mesh.first = {0};
  for (const std::uint32_t c : permutation(problem.mesh.cell_count(), seed)) {
    std::vector<std::uint32_t> nodes;
    for (const std::uint32_t p : problem.mesh.cell(c)) nodes.push_back(point_to[p]);
    if (c % 3 == 1) std::rotate(nodes.begin(), nodes.begin() + 1, nodes.begin() + 3);
    if (c % 3 == 2) {
      std::swap(nodes[0], nodes[1]);
      std::swap(nodes[2], nodes[3]);
    }
    other.mesh.add_cell(CellKind::tetrahedron, nodes);
  }
  for (std::uint32_t& p : other.fixed) p = point_to[p];
  std::sort(other.fixed.begin(), other.fixed.end());
  return other;
}

Problem rotated(const Problem& problem, const Eigen::Matrix3d& r) {
  Problem other = problem;
  for (auto& p : other.mesh.points) p = r * p;
  for (auto& v : other.initial_velocity) v = r * v;
  other.surroundings.gravity = r * problem.surroundings.gravity;
  return other;
}

/// The mesh points of the corners of a tetrahedron.
template <class Map>
std::array<std::uint32_t, 4> points_of_cell(const Body<Map>& body, Dart d) {
  std::set<std::uint32_t> points;
  for_each_dart_of(body.map, Volume{d},
                   [&points, &body](Dart e) { points.insert(body.vertices.point[body.vertex(body.map, e)]); });
  std::array<std::uint32_t, 4> all{};
  std::copy(points.begin(), points.end(), all.begin());
  return all;
}

template <class Map>
Triple points_of_face(const Body<Map>& body, Dart d) {
  Triple points{};
  for (std::uint32_t& p : points) {
    p = body.vertices.point[body.vertex(body.map, d)];
    d = body.map.template alpha<0, 1>(d);
  }
  std::sort(points.begin(), points.end());
  return points;
}

/// The state at every corner of every cell, by mesh points: it distinguishes the parts of a vertex, whatever their
/// numbers.
struct CornerState {
  Eigen::Vector3d x, v;
};
using Corners = std::map<std::pair<std::array<std::uint32_t, 4>, std::uint32_t>, CornerState>;

template <class Map>
Corners corners(const Body<Map>& body) {
  Corners states;
  for (const Dart cell : body.cell_dart) {
    const auto points = points_of_cell(body, cell);
    for_each_dart_of(body.map, Volume{cell}, [&states, &points, &body](Dart d) {
      const std::uint32_t k = body.vertex(body.map, d);
      states[{points, body.vertices.point[k]}] = {body.vertices.position[k], body.vertices.velocity[k]};
    });
  }
  return states;
}

/// States with the point numbers of another numbering translated back.
Corners with_points(const Corners& states, const std::vector<std::uint32_t>& back) {
  Corners other;
  for (const auto& [key, state] : states) {
    auto points = key.first;
    for (std::uint32_t& p : points) p = back[p];
    std::sort(points.begin(), points.end());
    other[{points, back[key.second]}] = state;
  }
  return other;
}

std::vector<std::uint32_t> inverse(const std::vector<std::uint32_t>& to) {
  std::vector<std::uint32_t> back(to.size());
  for (std::uint32_t k = 0; k < to.size(); ++k) back[to[k]] = k;
  return back;
}

/// The faces between cells on either side of a plane through the middle, by mesh points.
std::vector<Triple> seam_across(const Problem& problem) {
  const auto body = build_body<TetMap, Held::by_every_dart>(problem);
  std::vector<Triple> seam;
  for (const Dart d : faces_on_plane(body, {0.18, 0.18, 0.18}, {1.0, 0.25, 0.125}))
    seam.push_back(points_of_face(body, d));
  return seam;
}

// ---- how far two runs of one scene may be apart
//
// Write y = (w x, v) with the largest |w x_i|, |v_i| over the vertices as its norm, and a(x, v) for the accelerations.
// A spring with l >= L / 2 has a tangent of norm k max(1, |L / l - 1|) <= k, its damper one of c, and turning the
// damper with x gives at most 2 c |dv| / l. Both ends may move. So with
//
//     K = max over vertices of 2 / m sum (k + 2 c |dv| / l),  D = max of 2 / m sum c + viscosity,  w = sqrt(K),
//
// y' = (w v, a) has the Lipschitz constant sqrt(K) + D =: lambda, and a step of RK4 multiplies the difference of two
// starts by at most 1 + h lambda + ... + (h lambda)^4 / 24 <= exp(h lambda). The terms of K and D are taken at every
// step of one run; the stages, and the other run, within 1e-8 of it, are covered by doubling |dv| and asking for
// l >= 0.6 L. Accelerations that differ by e add at most t e growth to |v| after a time t.
//
// The two runs round: state_bound says by how much each is apart, at most, from the exact steps of its own problem, for
// any order of sums; in coordinates, so sqrt(3) times that as a length. It is taken for each leg of a run from the
// state at its beginning, on the mesh that has the body's vertices for points.

struct Difference {
  double x = 0.0, v = 0.0;
};

/// A run of the scene with all quantities that the bound needs.
template <class Map>
class Scene {
 public:
  explicit Scene(const Problem& problem) : body(build_body<Map, Held::by_every_dart>(problem)), problem_(problem) {
    arrays.rebuild(body);
  }

  /// Ten steps; their rounding goes into `rounding`, and `rate` becomes lambda.
  void leg() {
    rate = stiffest = 0.0;
    const auto bound = reference::state_bound(as_mesh(), {body.vertices.position, body.vertices.velocity}, steps);
    rounding = {std::sqrt(3.0) * bound.position, std::sqrt(3.0) * bound.velocity};
    look();
    for (int k = 0; k < steps; ++k) {
      rk4_.step(arrays, body, problem_.h);
      look();
    }
    rate = std::sqrt(stiffest) + damped_;
  }
  void cut(const std::vector<Triple>& seam) { follow(dissociate_all(body.map, faces_of_points<Map>(body, seam))); }
  void follow(const TopologyChange& change) { arrays.apply(body, adapt(body, change)); }

  static constexpr int steps = 10;
  Body<Map> body;
  CellArrays arrays;
  Difference rounding;
  double rate = 0.0, stiffest = 0.0;  // lambda and K of the leg
  double largest_acceleration = 0.0;  // [m/s^2] and more than force over mass: drag is far below gravity

 private:
  Problem as_mesh() const {
    Problem rest = problem_;
    rest.initial_velocity.clear();
    rest.fixed.clear();
    rest.mesh = {};
    for (std::uint32_t k = 0; k < body.vertices.size(); ++k) {
      rest.mesh.points.push_back(problem_.mesh.points[body.vertices.point[k]]);
      if (body.vertices.fixed[k]) rest.fixed.push_back(k);
    }
    for (const Dart cell : body.cell_dart) {
      std::vector<std::uint32_t> nodes;
      for (const Vertex v : incident_cells<0>(body.map, Volume{cell})) nodes.push_back(body.vertex(body.map, v.dart));
      rest.mesh.add_cell(CellKind::tetrahedron, nodes);
    }
    // no springs side by side, which a mesh cannot tell
    EXPECT_EQ(reference::rebuild(rest.mesh, rest.material).springs.size(), body.springs.size());
    return rest;
  }

  void look() {
    const VertexColumns& v = body.vertices;
    std::vector<double> k(v.size(), 0.0), c(k);
    std::vector<Eigen::Vector3d> force(v.size(), Eigen::Vector3d(0, 0, 0));
    for (const EdgeEntry& e : arrays.edges) {
      const Spring& s = body.springs[e.embedding];
      const auto [a, b] = e.ends;
      const Eigen::Vector3d dx = v.position[b] - v.position[a], dv = v.velocity[b] - v.velocity[a];
      const double l = dx.norm();
      EXPECT_GE(l, 0.6 * s.rest_length);
      const Eigen::Vector3d f = spring_force(s, dx, dv);
      force[a] += f;
      force[b] -= f;
      for (const std::uint32_t end : {a, b}) {
        k[end] += s.stiffness + 4.0 * s.damping * dv.norm() / l;
        c[end] += s.damping;
      }
    }
    for (std::uint32_t i = 0; i < v.size(); ++i) {
      stiffest = std::max(stiffest, 2.0 * k[i] / v.mass[i]);
      damped_ = std::max(damped_, 2.0 * c[i] / v.mass[i] + problem_.material.viscosity);
      largest_acceleration = std::max(
          largest_acceleration, (force[i] / v.mass[i] - problem_.material.viscosity * v.velocity[i]).norm() + 9.81);
    }
  }

  Problem problem_;
  RungeKutta4 rk4_;
  double damped_ = 0.0;
};

/// The difference at the end of a leg that follows from one at its beginning, with the roundings of both runs.
template <class Map>
Difference after_leg(const Difference& before, const Scene<Map>& a, const Scene<Map>& b, double h,
                     double acceleration) {
  const double t = h * Scene<Map>::steps, w = std::sqrt(a.stiffest), growth = 1.001 * std::exp(t * a.rate);
  const double y = growth * (std::max(w * before.x, before.v) + t * acceleration);
  return {y / w + a.rounding.x + b.rounding.x, y + a.rounding.v + b.rounding.v};
}

/// The corners of `actual` must be where those of `expected` are, turned.
void expect_close(const Corners& expected, const Corners& actual, const Difference& bound,
                  const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity()) {
  ASSERT_EQ(actual.size(), expected.size());
  double x = 0.0, v = 0.0;
  for (const auto& [key, state] : expected) {
    const auto found = actual.find(key);
    ASSERT_NE(found, actual.end());
    x = std::max(x, (found->second.x - turn * state.x).norm());
    v = std::max(v, (found->second.v - turn * state.v).norm());
  }
  EXPECT_LE(x, bound.x);
  EXPECT_LE(v, bound.v);
  EXPECT_LE(bound.x, 1e-8);  // a bound that is useful, and small enough for lambda
}

std::vector<Triple> with_points(const std::vector<Triple>& seam, const std::vector<std::uint32_t>& to) {
  std::vector<Triple> other;
  for (Triple t : seam) {
    for (std::uint32_t& p : t) p = to[p];
    std::sort(t.begin(), t.end());
    other.push_back(t);
  }
  return other;
}

// Effect of rounding in a rotation: each entry of it is off by u, and so is each product and sum with it, so a point is
// off by some 8 u times its size, all sqrt(3) as a length.
constexpr double turned_off = 16 * 0x1p-53;

// How far accelerations of the turned problem are from the turned ones. Rest lengths: points off by e make them off by
// 2 e, and accelerations by sum 2 k e / m <= K e. Masses: a volume changes, relatively, by e over the altitude when one
// corner moves by e, and all four do; force over mass changes likewise, its size taken twice for the stages. Gravity is
// turned too.
template <class Map>
double acceleration_off(const Scene<Map>& scene, const Problem& problem) {
  double size = 0.0, least_altitude = 1.0;
  for (const auto& p : problem.mesh.points) size = std::max(size, p.norm());
  for (std::uint32_t c = 0; c < problem.mesh.cell_count(); ++c)
    for (const auto& face : faces_of(CellKind::tetrahedron)) {
      const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
        return problem.mesh.points[problem.mesh.cell(c)[static_cast<std::size_t>(face[k])]];
      };
      const double area = 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
      least_altitude = std::min(least_altitude, 3.0 * std::abs(signed_measure(problem.mesh, c)) / area);
    }
  const double e = turned_off * size;
  const double mass = 1.01 * 4.0 * e / least_altitude;
  return scene.stiffest * e + 2.0 * mass * scene.largest_acceleration + 9.81 * turned_off;
}

template <class Map>
struct Invariance : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Invariance, Solids);

TYPED_TEST(Invariance, ACutBodyMovesAlikeInAnyNumbering) {
  const Problem problem = moving_box();
  const auto seam = seam_across(problem);
  ASSERT_GT(seam.size(), 18u);
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto to = permutation(problem.mesh.points.size(), seed);
    Scene<TypeParam> a(problem), b(renumbered(problem, to, seed + 10));
    a.leg();
    b.leg();
    const Difference at_cut = after_leg({}, a, b, problem.h, 0.0);
    a.cut(seam);
    b.cut(with_points(seam, to));
    ASSERT_GT(a.body.vertices.size(), problem.mesh.points.size());
    ASSERT_EQ(a.body.vertices.size(), b.body.vertices.size());
    a.leg();
    b.leg();
    expect_close(corners(a.body), with_points(corners(b.body), inverse(to)), after_leg(at_cut, a, b, problem.h, 0.0));
  }
}

TYPED_TEST(Invariance, ACutBodyMovesAlikeHoweverTheSceneLies) {
  const Problem problem = moving_box();
  const auto seam = seam_across(problem);
  double size = 0.0, speed = 0.0;
  for (const auto& p : problem.mesh.points) size = std::max(size, p.norm());
  for (const auto& v : problem.initial_velocity) speed = std::max(speed, v.norm());
  for (const Eigen::Matrix3d& turn : some_rotations()) {
    Scene<TypeParam> a(problem), b(rotated(problem, turn));
    a.leg();
    b.leg();
    const Difference start{turned_off * size, turned_off * speed};
    const Difference at_cut = after_leg(start, a, b, problem.h, acceleration_off(a, problem));
    a.cut(seam);
    b.cut(seam);
    a.leg();
    b.leg();
    Difference bound = after_leg(at_cut, a, b, problem.h, acceleration_off(a, problem));
    bound.x += turned_off * 2.0 * size;  // rotating the expected values
    bound.v += turned_off * 2.0 * speed;
    expect_close(corners(a.body), corners(b.body), bound, turn);
  }
}

/// Moved, then torn where stressed, along a seam or anywhere: the faces torn, by mesh points.
template <class Map>
std::set<Triple> torn_in_mid_run(const Problem& problem, const std::vector<Triple>* seam = nullptr) {
  Scene<Map> scene(problem);
  scene.leg();
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const EdgeEntry& e : scene.arrays.edges) ends.push_back(e.ends);
  std::vector<Eigen::Matrix3d> stress;
  std::set<Triple> torn;
  const auto& body = scene.body;
  VolumeRoom room;
  vertex_stresses(ends, body.springs, vertex_volumes(body, {}, room), body.vertices.position, stress);
  std::vector<double> values;
  for (const auto& s : stress) values.push_back(principal_stress(s).value);
  std::sort(values.begin(), values.end());
  // in the middle of a gap, so that rounding moves no vertex across
  const std::size_t n = values.size() / 2;
  const TearRule rule{.threshold = 0.5 * (values[n - 1] + values[n])};
  EXPECT_GT(values[n] - values[n - 1], 1e-9 * values[n]);
  EXPECT_GT(rule.threshold, 0.0);
  const auto follow = [&scene, &torn](const TopologyChange& change) {
    scene.follow(change);
    for (const DissociatedCell& face : change.faces) torn.insert(points_of_face(scene.body, face.kept));
  };
  FaceFilter filter;
  if (seam != nullptr) {
    const FaceSet faces(body.map, faces_of_points<Map>(body, *seam));
    filter = [faces, &body](Dart d) { return faces.contains(body.map, d); };
  }
  const TornVertices result = tear_where_stressed<Map>(scene.body, ends, rule, filter, follow, stress);
  EXPECT_GT(result.tears, 3u);
  EXPECT_EQ(result.faces, torn.size());
  return torn;
}

Problem stretched_box() {
  Problem problem = moving_box();
  for (std::size_t k = 0; k < problem.mesh.points.size(); ++k) {
    problem.initial_velocity[k] *= 8.0;
    problem.initial_velocity[k].z() += 16.0 * problem.mesh.points[k].z();
  }
  return problem;
}

TYPED_TEST(Invariance, TheSameFacesTearHoweverTheSceneLies) {
  const Problem problem = stretched_box();
  const auto expected = torn_in_mid_run<TypeParam>(problem);
  for (const Eigen::Matrix3d& turn : some_rotations())
    EXPECT_EQ(torn_in_mid_run<TypeParam>(rotated(problem, turn)), expected);
}

TYPED_TEST(Invariance, TheSameFacesTearInAnyNumbering) {
  const Problem problem = stretched_box();
  const auto expected = torn_in_mid_run<TypeParam>(problem);
  for (const std::uint64_t seed : {4, 5, 6, 7}) {
    const auto to = permutation(problem.mesh.points.size(), seed);
    const auto torn = torn_in_mid_run<TypeParam>(renumbered(problem, to, seed));
    const auto back = with_points(std::vector<Triple>(torn.begin(), torn.end()), inverse(to));
    EXPECT_EQ(std::set<Triple>(back.begin(), back.end()), expected);
  }
}

TYPED_TEST(Invariance, TheSameFacesOfASeamTearInAnyNumbering) {
  const Problem problem = stretched_box();
  const auto seam = seam_across(problem);
  const auto expected = torn_in_mid_run<TypeParam>(problem, &seam);
  EXPECT_LT(expected.size(), seam.size());
  for (const std::uint64_t seed : {4, 5, 6, 7}) {
    const auto to = permutation(problem.mesh.points.size(), seed);
    const auto other_seam = with_points(seam, to);
    const auto torn = torn_in_mid_run<TypeParam>(renumbered(problem, to, seed), &other_seam);
    const auto back = with_points(std::vector<Triple>(torn.begin(), torn.end()), inverse(to));
    EXPECT_EQ(std::set<Triple>(back.begin(), back.end()), expected);
  }
}

}  // namespace
}  // namespace dartboard::invariance_test
