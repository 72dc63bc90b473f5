// The vertex that a body tears first, and the side of the starting face from which its fan goes on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/operations/tear_fan.h"
#include "tests/support/torn_body_for_tests.h"

namespace dartboard::tearing_choice_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using namespace torn_body;

template <class Map>
struct TearingChoice : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(TearingChoice, Solids);

// The mean of |n . direction| over a fan: 1 if it lies in the plane across the direction.
template <class Map>
double flatness(const Body<Map>& body, const std::vector<Dart>& fan, const Vector3d& direction) {
  double sum = 0.0;
  for (const Dart face : fan) sum += std::abs(normal_of(body, face).dot(direction));
  return sum / static_cast<double>(fan.size());
}

// Each vertex in turn has all the springs that pull, and is the most stressed one unless it is a large one next to a
// small one. If the two fans are equally flat to 24 bits, something else decides.
TYPED_TEST(TearingChoice, GoesOnFromTheSideWhoseFanIsNearerToThePlaneAcrossTheStress) {
  std::size_t from_here = 0, from_across = 0;
  auto stretched = body_of<TypeParam>(jittered_box());
  move(stretched, along_z);
  for (std::uint32_t k = 0; k < stretched.vertices.size(); ++k) {
    Torn<TypeParam> bar(stretched);
    slacken_all_but_around(bar.body, k);
    if (most_stressed(bar.body) != k) continue;
    const Vector3d direction = principal_stress(vertex_stress(bar.body, k)).direction;
    const Dart start = starting_face(bar.body, k, direction);
    if (start == no_dart) continue;
    const auto here = fan(bar.body.map, start), across = fan(bar.body.map, bar.body.map.template alpha<3>(start));
    const double gain = flatness(bar.body, here, direction) - flatness(bar.body, across, direction);
    if (std::abs(gain) < 0x1p-20) continue;
    std::set<Triple> expected;
    for (const Dart face : gain > 0 ? here : across)
      if (!bar.body.map.template is_free<3>(face)) expected.insert(points_of(bar.body, face));
    ASSERT_EQ(bar.tear({.threshold = 1.0, .least_alignment = 0.0, .most_per_step = 1}).tears, 1u);
    EXPECT_EQ(bar.faces, expected) << k;
    ++(gain > 0 ? from_here : from_across);
  }
  EXPECT_GT(from_here, 5u);
  EXPECT_GT(from_across, 5u);
}

// Among vertices with equal stress the one with the lowest number that has a face to tear comes first.
TEST(TearingChoiceOfHexahedra, BeginsWithTheLowestNumberOfVerticesUnderOneStress) {
  Torn<Map3> bar(body_of<Map3>(hexahedron_box(2, 2, 3, 0.5)));
  move(bar.body, along_z);
  std::uint32_t lowest = 0;
  while (starting_face(bar.body, lowest, {0, 0, 1}, {}, 0.5) == no_dart) ++lowest;
  const std::uint32_t point = bar.body.vertices.point[lowest];
  const TornVertices torn = bar.tear({.threshold = 15.5, .most_per_step = 1});
  ASSERT_EQ(torn.tears, 1u);
  ASSERT_GT(torn.stressed, 10u);
  for (const Triple& face : bar.faces) {
    bool has_it = false;
    for (const std::uint32_t k : face) has_it = has_it || k == point;
    EXPECT_TRUE(has_it) << point;
  }
}

// The vertex of a fan is the one point that all its faces have in common. Other vertices on it may come apart, and
// wait.
TYPED_TEST(TearingChoice, LeavesThePartsOfAVertexToTheNextCall) {
  auto body = body_of<TypeParam>(jittered_box());
  move(body, along_z);
  CellArrays arrays;
  arrays.rebuild(body);
  std::vector<std::array<std::uint32_t, 2>> ends;
  for (const EdgeEntry& edge : arrays.edges) ends.push_back(edge.ends);
  std::vector<Matrix3d> stress;
  std::set<std::uint32_t> apart;
  std::size_t known = 0;
  const auto follow = [&](const TopologyChange& change) {
    adapt(body, change);
    std::set<std::uint32_t> common, met;
    for (const DissociatedCell& face : change.faces) {
      const Triple triple = points_of(body, face.kept);
      std::set<std::uint32_t> of_this(triple.begin(), triple.end());
      if (&face != &change.faces.front()) std::erase_if(of_this, [&](std::uint32_t p) { return !common.contains(p); });
      common = of_this;
    }
    if (common.size() == 1) {
      ++known;
      EXPECT_FALSE(apart.contains(*common.begin())) << *common.begin();
    }
    for (const std::uint32_t p : body.vertices.point)
      if (!met.insert(p).second) apart.insert(p);
  };
  tear_where_stressed(body, ends, {.threshold = 0.5, .least_alignment = 0.0}, {}, follow, stress);
  EXPECT_GT(known, 5u);
  EXPECT_GT(apart.size(), known);
}

}  // namespace
}  // namespace dartboard::tearing_choice_test
