// A body in figures that a reader can check.

#include "core/scene/run/body_in_words.h"

#include <gtest/gtest.h>

#include "tests/support/moving_box.h"

namespace dartboard::body_in_words_test {
namespace {

using namespace moving;

TEST(InWords, MassesHaveAUnitOfTheirSize) {
  EXPECT_EQ(mass_in_words(36600), "36.6 tonnes");
  EXPECT_EQ(mass_in_words(2.5), "2.5 kg");
  EXPECT_EQ(mass_in_words(0.04), "40 g");
  EXPECT_EQ(mass_in_words(5e-6), "5 mg");
  EXPECT_EQ(mass_in_words(0), "0 kg");
}

// 768 kg/m^3 in (1/4 m)^3 are 12 kg. Edges are 1/8 m along the axes to sqrt(3)/8 m along a diagonal of a cube; an edge
// of the box with one tetrahedron around it has 64 N/m, the diagonal of a cube with six has 384 N/m, and inner ones
// along the axes have four or six.
TEST(InWords, ABoxIsItsSizeMassEdgesAndSprings) {
  const Simulation simulation(parse(moving_box()));
  EXPECT_EQ(
      in_words(simulation.body()),
      "0.25 m along x, 0.25 m along y, 0.25 m along z; 12 kg; edges of 0.125 to 0.217 m; springs of 64 to 384 N/m");
}

}  // namespace
}  // namespace dartboard::body_in_words_test
