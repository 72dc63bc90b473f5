#include "validation/contact/ipctk/ipctk_shots.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard::ipctk_shots_test {
namespace {

/// A shot whose places are felt or not ("00111"), and the answer about its steps ("1011": the second collides).
struct Told {
  std::string felt, free;
  double way = 0.5;
  bool warned_in_flight = false, warned = false;
};
IpctkShotsFound found(const Told& told) {
  IpctkShot shot{.way = told.way, .warned_in_flight = told.warned_in_flight, .warned = told.warned};
  for (const char c : told.felt) shot.question.places.push_back({.x = {}, .samples = {}, .felt = c == '1'});
  IpctkAnswer answer;
  for (const char c : told.free) answer.free.push_back(c == '1');
  return found_by_ipctk({&shot, 1}, {&answer, 1});
}

TEST(IpctkShots, AreFeltAfterTheStepThatCollidesOrTheNext) {
  const IpctkShotsFound at_once = found({"00111", "1011"}), next = found({"00011", "1011"}),
                        later = found({"00001", "1011"}), never = found({"00000", "1011"});
  EXPECT_EQ(at_once.wrong(), 0u);
  EXPECT_EQ(at_once.slow, 1u);
  EXPECT_EQ(at_once.hits, 1u);
  EXPECT_EQ(at_once.at_once, 1u);
  EXPECT_EQ(next.wrong(), 0u);
  EXPECT_EQ(next.at_once, 0u);
  EXPECT_EQ(later.late, 1u);
  EXPECT_EQ(never.late, 1u);
}

TEST(IpctkShots, AreNotFeltBeforeAStepCollides) {
  EXPECT_EQ(found({"01111", "1011"}).early, 1u);
  EXPECT_EQ(found({"11000", "1111"}).early, 1u);
  EXPECT_EQ(found({"00001", "1111"}).early, 1u);
  EXPECT_EQ(found({"00000", "1111"}).early, 0u);
  EXPECT_EQ(found({"00000", "1111"}).hits, 0u);
  EXPECT_EQ(found({"01111", "1011", 7.0, true, true}).early, 1u);
}

TEST(IpctkShots, AreWarnedOfWhereTheyAreFast) {
  const IpctkShotsFound warned = found({"0000", "101", 7.0, true, true}), silent = found({"0000", "101", 7.0});
  EXPECT_EQ(warned.wrong(), 0u);
  EXPECT_EQ(warned.fast, 1u);
  EXPECT_EQ(warned.passes, 1u);
  EXPECT_EQ(silent.silent, 1u);
  EXPECT_EQ(found({"0011", "101", 7.0, false, true}).passes, 0u);
  EXPECT_EQ(found({"0001", "101", 7.0, false, true}).passes, 0u);
  EXPECT_EQ(found({"0000", "111", 7.0, false, true}).passes, 0u);
}

TEST(IpctkShots, AreNotWarnedOfInFlightWhereTheyAreSlow) {
  EXPECT_EQ(found({"00111", "1011", 0.5, true, true}).false_warnings, 1u);
  EXPECT_EQ(found({"00111", "1011", 0.5, false, true}).wrong(), 0u);  // after the impact
}

TEST(IpctkShots, AreNeitherSlowNorFastAtTheLimitItself) {
  const IpctkShotsFound at_limit = found({"0000", "101", 1.0005});
  EXPECT_EQ(at_limit.slow + at_limit.fast, 0u);
  EXPECT_EQ(at_limit.wrong(), 0u);
}

TEST(IpctkShots, FlyAtAPlateAtAllSpeeds) {
  const std::vector<IpctkShot> shots = ipctk_shots(12, 3);
  ASSERT_EQ(shots.size(), 12u);
  double before = 0.0;
  std::size_t unfelt = 0;
  for (const IpctkShot& shot : shots) {
    EXPECT_GT(shot.way, before);
    before = shot.way;
    const auto& places = shot.question.places;
    EXPECT_TRUE(shot.question.in_motion);
    EXPECT_EQ(places.front().x.size(), 58u);
    EXPECT_FALSE(places.front().felt);
    EXPECT_TRUE(places.front().samples.empty());
    // the second body falls, the first one stands
    EXPECT_LT(places[1].x.back().z(), places[0].x.back().z());
    EXPECT_EQ(places[1].x.front(), places[0].x.front());
    EXPECT_EQ(shot.warned_in_flight, shot.way > 1.0) << shot.way;
    unfelt += places.back().felt ? 0 : 1;
    EXPECT_TRUE(places.back().felt || shot.way > 1.0) << shot.way;
  }
  EXPECT_GE(shots.front().way, 0.1);
  EXPECT_LT(shots.front().way, 0.1 * std::pow(1000.0, 1.0 / 12));
  EXPECT_GT(shots.back().way, 50.0);
  EXPECT_GT(unfelt, 0u);
}

}  // namespace
}  // namespace dartboard::ipctk_shots_test
