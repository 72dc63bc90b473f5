// When a load acts, with which sign, and its mean over a step.

#include "core/scene/timeline/acting_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

namespace dartboard {
namespace {

constexpr double unending = std::numeric_limits<double>::infinity();

TEST(ActingTime, IsAShareOfAStepThatItBeginsOrEndsIn) {
  const ActingTime time{0.25, 0.875, {}};
  EXPECT_EQ(time.mean_sign(0.0, 0.25), 0.0);
  EXPECT_EQ(time.mean_sign(0.0, 0.5), 0.5);
  EXPECT_EQ(time.mean_sign(0.25, 0.5), 1.0);
  EXPECT_EQ(time.mean_sign(0.75, 1.0), 0.5);
  EXPECT_EQ(time.mean_sign(0.875, 1.0), 0.0);
  EXPECT_EQ(time.mean_sign(0.0, 1.0), 0.625);
  EXPECT_EQ((ActingTime{0.25, unending, {}}.mean_sign(1.0, 2.0)), 1.0);
}

// 0.1 * 3 is 0.30000000000000004, and so on: decimals of steps are boundaries.
TEST(ActingTime, IsWholeOrNothingInStepsThatItBeginsAndEndsWith) {
  for (const double step : {0.1, 0.001, 1.0 / 3.0, 0.0007})
    for (std::uint64_t first = 0; first < 400; first += 7) {
      const std::uint64_t last = first + 5;
      const ActingTime time{step * static_cast<double>(first), step * static_cast<double>(last), 2.0 * step};
      for (std::uint64_t n = first > 0 ? first - 1 : 0; n <= last; ++n) {
        const double sign = n < first || n >= last ? 0.0 : (n - first) / 2 % 2 == 0 ? 1.0 : -1.0;
        const double begin = static_cast<double>(n) * step, end = static_cast<double>(n + 1) * step;
        EXPECT_EQ(time.mean_sign(begin, end), sign) << step << " " << first << " " << n;
        EXPECT_EQ(time.next_between(begin, end), std::nullopt) << step << " " << first << " " << n;
      }
    }
}

/// The mean of the sign by its definition, from parts so small that each has one sign but for one in each time.
double mean_by_parts(const ActingTime& time, double begin, double end) {
  constexpr int parts = 100000;
  int sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double t = begin + (end - begin) * (k + 0.5) / parts;
    if (t < time.from || t >= time.until) continue;
    sum += !time.reverse_every || std::fmod(std::floor((t - time.from) / *time.reverse_every), 2.0) == 0.0 ? 1 : -1;
  }
  return static_cast<double>(sum) / parts;
}

TEST(ActingTime, TurnsBackWithinStepsAsOftenAsItSays) {
  for (const double every : {0.013, 0.21, 0.5, 2.0})
    for (const double begin : {0.0, 0.1, 0.33, 0.9}) {
      const ActingTime time{0.07, 1.13, every};
      // at most one part in a hundred thousand is wrong for each turn, and for both ends
      EXPECT_NEAR(time.mean_sign(begin, begin + 0.31), mean_by_parts(time, begin, begin + 0.31),
                  2e-5 * (0.31 / every + 3))
          << every << " " << begin;
    }
}

TEST(ActingTime, ChangesNextWhereItBeginsTurnsBackOrEnds) {
  const ActingTime time{0.25, 1.5, 0.5};
  EXPECT_EQ(time.next_between(0.0, 0.25), std::nullopt);
  EXPECT_EQ(time.next_between(0.0, 2.0), 0.25);
  EXPECT_EQ(time.next_between(0.25, 2.0), 0.75);
  EXPECT_EQ(time.next_between(0.75, 2.0), 1.25);
  EXPECT_EQ(time.next_between(1.25, 2.0), 1.5);
  EXPECT_EQ(time.next_between(1.5, 2.0), std::nullopt);
  EXPECT_EQ((ActingTime{0.25, unending, {}}.next_between(0.25, 1e300)), std::nullopt);
}

TEST(ActingTime, OverlapsAnotherButForItsEnds) {
  EXPECT_TRUE((ActingTime{0.0, 0.3, {}}.overlaps({0.2, unending, {}})));
  EXPECT_FALSE((ActingTime{0.0, 0.3, {}}.overlaps({0.3, unending, {}})));
  EXPECT_FALSE((ActingTime{0.1 * 3, unending, {}}.overlaps({0.0, 0.3, {}})));
}

}  // namespace
}  // namespace dartboard
