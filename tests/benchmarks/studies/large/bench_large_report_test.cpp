// The conclusions of `bench large` from its measurements: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/large/bench_large_report.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "tests/support/claims_for_tests.h"

namespace dartboard::bench_large_report_test {
namespace {

using namespace large_part;
using Ids = std::vector<std::string>;

/// A second for each part of each body, in six processes; the largest body once.
LargeFigures good_figures(bool quick = false) {
  LargeFigures f{.sides = large_sides(quick), .times = {}, .counts = {}};
  for (const std::size_t side : f.sides)
    for (int process = 0; process < (side == largest_side ? 1 : 6); ++process) {
      for (const char* part : large_parts())
        f.times.push_back(
            {.side = side, .process = process, .part = part, .seconds = 1.0, .bytes = 6e6, .limit_seconds = 0.5});
      f.counts.push_back({.side = side,
                          .vertices = side,
                          .springs = side,
                          .operations = 2 * side * side,
                          .components = 2,
                          .keeps_mass = true,
                          .bytes = 250 * tetrahedra_of(side),
                          .bytes_without_events = 120 * tetrahedra_of(side),
                          .peak_bytes = 400 * tetrahedra_of(side)});
    }
  return f;
}

Ids short_with(const std::function<void(LargeFigures&)>& spoil) {
  LargeFigures f = good_figures();
  spoil(f);
  return ids_of(claims_of(f), Verdict::falls_short);
}

void set_seconds(LargeFigures& f, std::size_t side, const char* part, double seconds) {
  for (LargeTime& time : f.times)
    if (time.side == side && time.part == part) time.seconds = seconds;
}

TEST(BenchLargeClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_figures());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"large-cut", "large-bytes", "large-bytes-without-events", "large-first-step", "large-info"}));
  expect_words(claims, "large-cut", "0 differ", "0 differ", "of 19 runs of up to 10110954 tetrahedra");
  expect_words(claims, "large-bytes", "<= 300 a tetrahedron", "250", "exact, the largest of all bodies");
  expect_words(claims, "large-first-step", "<= 5 s", "1.00 s", "[1, 1] at 96.9 %");
}

TEST(BenchLargeClaims, FallShortOfACutThatIsNotOne) {
  const std::function<void(LargeCounts&)> wrongs[]{[](auto& c) { --c.operations; }, [](auto& c) { c.components = 1; },
                                                   [](auto& c) { c.keeps_mass = false; },
                                                   [](auto& c) { c.violation = "dart 3 is 0-free"; }};
  for (const auto& wrong : wrongs) EXPECT_EQ(short_with([&](auto& f) { wrong(f.counts.back()); }), Ids{"large-cut"});
}

TEST(BenchLargeClaims, FallShortOfTheBytesOfTheLargestBody) {
  EXPECT_EQ(short_with([](auto& f) { f.counts.back().bytes = 301 * tetrahedra_of(largest_side); }), Ids{"large-bytes"});
  EXPECT_EQ(short_with([](auto& f) { f.counts.front().bytes_without_events = 191 * tetrahedra_of(26); }),
            Ids{"large-bytes-without-events"});
}

TEST(BenchLargeClaims, AreAboutTheStartOfTwoMillion) {
  EXPECT_EQ(short_with([](auto& f) { set_seconds(f, started_side, first_step, 5.1); }), Ids{"large-first-step"});
  EXPECT_EQ(short_with([](auto& f) { set_seconds(f, started_side, info, 4.1); }), Ids{"large-info"});
  EXPECT_EQ(short_with([](auto& f) { set_seconds(f, largest_side, info, 9.0); }), Ids{});
}

TEST(BenchLargeClaims, AreNotTestedWithoutMeasurements) {
  EXPECT_EQ(ids_of(claims_of(good_figures(true)), Verdict::not_tested), (Ids{"large-first-step", "large-info"}));
  EXPECT_EQ(short_with([](auto& f) { f.counts.clear(); }),
            (Ids{"large-cut", "large-bytes", "large-bytes-without-events"}));
}

TEST(BenchLargeTables, DivideByTetrahedra) {
  const LargeFigures f = good_figures(true);  // 105,456 tetrahedra
  const auto parts = parts_table(f).rows();
  ASSERT_EQ(parts.size(), large_parts().size());
  EXPECT_EQ(parts.front(),
            (std::vector<std::string>{mesh, "105456", "1", "[1, 1] at 96.9 %", "9482.6", "56.9", "2.00"}));
  const auto memory = memory_table(f).rows();
  ASSERT_EQ(memory.size(), 1u);
  EXPECT_EQ(memory.front(),
            (std::vector<std::string>{"105456", "26", "26", "1352", "739.64", "250", "120", "42", "400"}));
}

TEST(BenchLargeTables, HaveOneRunOfTheLargestBody) {
  const auto rows = parts_table(good_figures()).rows();
  EXPECT_EQ(rows.size(), 4 * large_parts().size());
  EXPECT_EQ(rows[3][3], "one run");
}

TEST(BenchLargePlot, ShowsPartsAndTheLimit) {
  const Plot plot = large_plot(good_figures());
  ASSERT_EQ(plot.series.size(), 9u);
  for (const PlotSeries& series : plot.series)
    for (const PlotSeries::Point& p : series.points) {
      EXPECT_GT(p.x, plot.x_low);
      EXPECT_LT(p.x, plot.x_high);
      EXPECT_GT(p.y, plot.y_low);
      EXPECT_LT(p.y, plot.y_high);
    }
}

// On a small body: every part is measured once, and the cut is right.
TEST(LargeBodies, AreMeasuredPartByPart) {
  LargeFigures f{.sides = {4}, .times = {}, .counts = {}};
  measure_large(
      {.side = 4}, [&](const LargeTime& t) { f.times.push_back(t); },
      [&](const LargeCounts& c) { f.counts.push_back(c); });
  ASSERT_EQ(f.counts.size(), 1u);
  EXPECT_EQ(f.counts[0].vertices, 125u);
  EXPECT_GT(f.counts[0].bytes, f.counts[0].bytes_without_events);
  for (const char* part : large_parts()) EXPECT_EQ(f.has(4, part), part != first_step && part != info) << part;
  EXPECT_EQ(find_claim(claims_of(f), "large-cut").verdict, Verdict::holds);
  for (const char* part : {mesh, map, columns, simulation, frame, written, compressed, read}) {
    const auto time = std::ranges::find(f.times, part, &LargeTime::part);
    EXPECT_GT(time->bytes, 0.0) << part;
    EXPECT_GT(time->limit_seconds, 0.0) << part;
  }
}

}  // namespace
}  // namespace dartboard::bench_large_report_test
