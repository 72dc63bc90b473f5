#include "validation/paper/maps/orbits_come_apart.h"

#include <gtest/gtest.h>

#include "core/operations/dissociate_face.h"
#include "core/topology/build.h"
#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::orbits_come_apart_test {
namespace {

Map3 solid() { return build_map<Map3>(kuhn_box(2, 2, 2, 1.0)).map; }
Map2 surface() { return build_map<Map2>(triangle_sheet(5, 5, 1.0)).map; }

TEST(OrbitsComeApart, AsReported) {
  expect_yes(try_orbits(solid(), 100, 1));
  expect_yes(try_orbits(surface(), 50, 1));
}

TEST(OrbitsComeApart, NotWhereAVertexIsKeptSilentOrAnEdge) {
  for (const bool vertices : {true, false})
    expect_no(try_orbits<Map3>(solid(), 100, 1, [&](Map3& map, Dart d) {
      TopologyChange change = dissociate_face(map, d);
      (vertices ? change.vertices : change.edges).clear();
      return change;
    }));
}

TEST(OrbitsComeApart, NotWhereOneIsToldTwiceOrHoldsTogether) {
  for (const bool twice : {true, false})
    expect_no(try_orbits<Map3>(solid(), 100, 1, [&](Map3& map, Dart d) {
      const Dart other = map.alpha<3>(d);
      TopologyChange change = dissociate_face(map, d);
      if (twice && !change.edges.empty()) change.edges.push_back(change.edges.front());
      if (!twice && change.vertices.empty()) change.vertices.push_back({d, other});
      return change;
    }));
}

TEST(OrbitsComeApart, NotWhereAnEdgeOfASurfaceLeavesItsVerticesUntold) {
  expect_no(try_orbits<Map2>(surface(), 50, 1, [](Map2& map, Dart d) {
    TopologyChange change = dissociate_edge(map, d);
    if (change.vertices.size() > 1) change.vertices.pop_back();
    return change;
  }));
}

TEST(OrbitsComeApart, NotWhereNoneDoesOrAllDo) {
  expect_no(try_orbits(solid(), 0, 1));
  expect_no(try_orbits(build_map<Map3>(two_tetrahedra()).map, 5, 1));  // the one face parts all of its cells
}

}  // namespace
}  // namespace dartboard::orbits_come_apart_test
