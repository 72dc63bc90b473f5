#include "benchmarks/studies/reproduce/real_time.h"

#include <gtest/gtest.h>

namespace dartboard::real_time_test {
namespace {

using Frames = std::vector<FrameTime>;

TEST(RealTime, IsReadBetweenTheBodiesMeasured) {
  EXPECT_NEAR(cells_in_real_time(Frames{{1000, 0.5 * frame_s}, {2000, 1.5 * frame_s}}), 1500.0, 1e-9);
  EXPECT_NEAR(cells_in_real_time(Frames{{1000, 2.0 * frame_s}}), 500.0, 1e-9);
  EXPECT_NEAR(cells_in_real_time(Frames{{1000, 0.1 * frame_s}, {2000, 0.2 * frame_s}}), 2000.0, 1e-9);
}

TEST(RealTime, HasAFrameOfSeventeenStepsOfAMillisecond) {
  EXPECT_EQ(steps_of_frame(1e-3), 17);
  EXPECT_EQ(steps_of_frame(1.0), 1);
}

std::vector<Frames> rounds(double factor, double jitter = 0.0) {
  std::vector<Frames> all;
  for (int k = 0; k < 7; ++k) all.push_back({{1000, 0.0}, {100000, factor * (1.0 + jitter * (k - 3)) * frame_s}});
  return all;
}

TEST(RealTime, HoldsWhereAFrameOfThePapersBodyTakesLess) {
  // 1000 + 99000 / 50 = 2980 tetrahedra
  const Claim claim = answer_real_time(rounds(50.0), false);
  EXPECT_EQ(claim.verdict, Verdict::holds);
  EXPECT_TRUE(claim.measured.starts_with("2980 tetrahedra")) << claim.measured;
}

TEST(RealTime, DoesNotCarryOverWhereItTakesMore) {
  const Claim claim = answer_real_time(rounds(150.0), false);  // 1660
  EXPECT_EQ(claim.verdict, Verdict::does_not_carry_over);
  EXPECT_EQ(exit_code(std::span(&claim, 1)), 1);
  EXPECT_EQ(answer_real_time(rounds(150.0), true).verdict, Verdict::undecided);
}

TEST(RealTime, IsOpenWhereTheIntervalLiesOnBothSides) {
  EXPECT_EQ(answer_real_time(rounds(120.0, 0.1), false).verdict, Verdict::undecided);
}

TEST(RealTime, IsMeasuredOnBodiesThatGrowUntilAFrameTakesTooLong) {
  // steps of a tenth of the frame: a few of them take little time, so the largest bodies are reached or time is up
  const Frames frames = time_frames(frame_s / 10.0);
  ASSERT_GE(frames.size(), 1u);
  for (std::size_t k = 1; k < frames.size(); ++k) {
    EXPECT_GT(frames[k].cells, frames[k - 1].cells);
    EXPECT_LE(frames[k - 1].seconds, frame_s);
  }
  EXPECT_TRUE(frames.back().seconds > frame_s || frames.back().cells == 64000u);
}

}  // namespace
}  // namespace dartboard::real_time_test
