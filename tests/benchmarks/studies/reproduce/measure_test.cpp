#include "benchmarks/studies/reproduce/measure.h"

#include <gtest/gtest.h>

namespace dartboard::measure_test {
namespace {

// the times of a contender's run of so many steps
StepSample run_of(int steps, std::int64_t cpu_ns, std::int64_t wall_ns) {
  StepSample s{{}, steps};
  s.sample = {.task = "arrays", .process = 2, .round = 3, .position = 1, .cpu_ns = cpu_ns, .wall_ns = wall_ns};
  return s;
}

TEST(PerStep, DividesWhatARunTookByItsSteps) {
  const auto samples = per_step({run_of(20, 6'000, 8'000), run_of(2, 6'000, 8'000), run_of(1, 6'000, 8'000)});
  ASSERT_EQ(samples.size(), 3u);
  EXPECT_EQ(samples[0].cpu_ns, 300);
  EXPECT_EQ(samples[0].wall_ns, 400);
  EXPECT_EQ(samples[1].cpu_ns, 3'000);
  EXPECT_EQ(samples[1].wall_ns, 4'000);
  EXPECT_EQ(samples[2].cpu_ns, 6'000);
  EXPECT_EQ(samples[2].wall_ns, 8'000);
}

TEST(PerStep, KeepsWhoseSampleItIs) {
  const auto samples = per_step({run_of(20, 6'000, 8'000)});
  ASSERT_EQ(samples.size(), 1u);
  EXPECT_EQ(samples[0].task, "arrays");
  EXPECT_EQ(samples[0].process, 2);
  EXPECT_EQ(samples[0].round, 3);
  EXPECT_EQ(samples[0].position, 1);
}

}  // namespace
}  // namespace dartboard::measure_test
