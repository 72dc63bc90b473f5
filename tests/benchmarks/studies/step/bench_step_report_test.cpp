// The conclusions of `bench step` from its measurements: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/step/bench_step_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <set>

#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/step/machine_limits.h"
#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "core/plain/error.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::bench_step_report_test {
namespace {

using namespace step_task;
using Ids = std::vector<std::string>;
constexpr std::size_t largest = 1'000'000;

void set_time(StepCosts& c, const std::string& task, double ns) {
  for (Sample& s : c.samples)
    if (s.task == task) s.cpu_ns = s.wall_ns = std::llround(ns);
}

/// A graph of 10 ms, columns of 2 ms on one thread and of 1 ms on two.
StepCosts good_costs() {
  StepCosts c;
  c.largest = largest;
  std::vector<std::pair<std::string, double>> times;
  std::size_t springs = 1000;
  for (const std::string& body : step_bodies(largest)) {
    const bool shared = body.starts_with("10^5") || body.starts_with("10^6");
    c.counts[body] = {.body = body,
                      .tetrahedra = springs,
                      .vertices = springs / 5,
                      .springs = springs,
                      .steps = 2,
                      .lanes = true,
                      .threads = shared ? 2u : 1u,
                      .bytes = 100.0 * static_cast<double>(springs),
                      .copied_bytes = 40e6,
                      .roots = 1e6};
    times.emplace_back(body + graph, 10e6);
    times.emplace_back(body + one, 3e6);
    times.emplace_back(body + lanes, 2.5e6);
    times.emplace_back(body + padded, 2e6);
    if (shared) times.emplace_back(body + threads, 1e6);
    times.emplace_back(body + copy, 4e6);
    if (shared) times.emplace_back(body + copy_by_threads, 2.5e6);
    times.emplace_back(body + roots, 2e6);
    springs *= 2;
  }
  c.samples = timed_samples(times);
  return c;
}

Ids short_with(const std::function<void(StepCosts&)>& spoil) {
  StepCosts c = good_costs();
  spoil(c);
  return ids_of(claims_of(c), Verdict::falls_short);
}

TEST(BenchStepClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_costs());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"step-agreement", "step-liver-damped", "step-liver-undamped", "step-shuffled", "step-in-order",
                 "step-in-order-threads", "step-threads-large", "step-threads-medium", "step-threads-no-loss"}));
  expect_words(claims, "step-liver-damped", "<= 0.58", "0.200", "[0.2, 0.2] at 98.4 %");
}

TEST(BenchStepClaims, FallShortOfColumnsThatTakeLongerThanTheirShareOfTheGraph) {
  const auto slow = [](const std::string& body, const char* task, double share) {
    return short_with([&](auto& c) { set_time(c, body + task, 10e6 * share); });
  };
  EXPECT_EQ(slow(paper_step_body(true), padded, 0.59), Ids{"step-liver-damped"});
  EXPECT_EQ(slow(paper_step_body(false), padded, 0.51), Ids{"step-liver-undamped"});
  EXPECT_EQ(slow(step_box(largest, true), padded, 0.26), Ids{"step-shuffled"});
  EXPECT_EQ(slow(step_box(largest, false), padded, 0.51), Ids{"step-in-order"});
  EXPECT_EQ(short_with([](auto& c) {
              set_time(c, step_box(largest, false) + padded, 5e6);
              set_time(c, step_box(largest, false) + threads, 3.1e6);
              set_time(c, step_box(largest, true) + threads, 1e6);
            }),
            (Ids{"step-in-order-threads", "step-threads-large"}));
}

TEST(BenchStepClaims, FallShortOfThreadsThatGainLittle) {
  for (const bool shuffled : {false, true}) {
    EXPECT_EQ(short_with([&](auto& c) { set_time(c, step_box(largest, shuffled) + threads, 1.15e6); }),
              Ids{"step-threads-large"});
    EXPECT_EQ(short_with([&](auto& c) { set_time(c, step_box(100'000, shuffled) + threads, 1.4e6); }),
              Ids{"step-threads-medium"});
  }
}

TEST(BenchStepClaims, OnThreadsThatGainLittleReportWhatCopiesGain) {
  StepCosts c = good_costs();
  set_time(c, step_box(largest, true) + threads, 1.15e6);
  EXPECT_EQ(
      find_claim(claims_of(c), "step-threads-large").reason,
      "all processors copy columns as large 1.60 / 1.60 times as fast as one: they share the memory, and only fewer bytes "
      "would gain more");
}

TEST(BenchStepClaims, FallShortOfThreadsThatAreSlowerThanOne) {
  EXPECT_EQ(short_with([](auto& c) { set_time(c, step_box(100'000, true) + threads, 2.1e6); }),
            (Ids{"step-threads-medium", "step-threads-no-loss"}));
}

TEST(BenchStepClaims, AreNotTestedWhereTheMotionsDoNotAgree) {
  const std::function<void(StepCosts&)> wrongs[]{[](auto& c) { c.counts.begin()->second.differing = 1; },
                                                 [](auto& c) {
                                                   for (Sample& s : c.samples)
                                                     if (s.task == step_box(largest, true) + threads) s.hash = 1;
                                                 },
                                                 [](auto& c) {
                                                   for (Sample& s : c.samples)
                                                     if (s.task == paper_step_body(true) + one) s.hash = 1;
                                                 },
                                                 [](auto& c) { c.counts.clear(); }};
  for (const auto& wrong : wrongs) {
    StepCosts c = good_costs();
    wrong(c);
    const auto claims = claims_of(c);
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{"step-agreement"});
    EXPECT_EQ(ids_of(claims, Verdict::not_tested).size(), claims.size() - 1);
  }
}

// As in a quick run: no body of a million, and three processes, all alike, which cannot predict others.
TEST(BenchStepClaims, AreNotJudgedByAQuickRun) {
  StepCosts c = good_costs();
  c.largest = 100'000;
  std::erase_if(c.counts, [](const auto& n) { return n.first.starts_with("10^6"); });
  std::erase_if(c.samples, [](const Sample& s) { return s.process >= 3 || s.task.starts_with("10^6"); });
  const auto claims = claims_of(c);
  EXPECT_EQ(ids_of(claims, Verdict::undecided),
            (Ids{"step-liver-damped", "step-liver-undamped", "step-threads-medium", "step-threads-no-loss"}));
  EXPECT_EQ(ids_of(claims, Verdict::not_tested),
            (Ids{"step-shuffled", "step-in-order", "step-in-order-threads", "step-threads-large"}));
  EXPECT_EQ(exit_code(claims), 0);
}

TEST(BenchStepClaims, OnThreadsAreNotTestedByOneProcessor) {
  StepCosts c = good_costs();
  std::erase_if(c.samples, [](const Sample& s) { return s.task.ends_with(threads); });
  const auto claims = claims_of(c);
  EXPECT_EQ(ids_of(claims, Verdict::not_tested),
            (Ids{"step-in-order-threads", "step-threads-large", "step-threads-medium", "step-threads-no-loss"}));
  EXPECT_EQ(find_claim(claims, "step-threads-large").reason, "there is one processor");
}

// The wall clock is that of all threads; processor time is that of the one that calls them.
TEST(BenchStepClaims, CompareThreadsByTheWallClock) {
  EXPECT_EQ(short_with([](auto& c) {
              for (Sample& s : c.samples)
                if (s.task == step_box(100'000, false) + threads) s.wall_ns = 2'100'000;
            }),
            (Ids{"step-threads-medium", "step-threads-no-loss"}));
}

TEST(BenchStepCosts, DivideByEvaluationsAndSprings) {
  const StepCosts c = good_costs();
  const std::string body = paper_step_body(true);  // 1000 springs, two steps of four evaluations
  EXPECT_DOUBLE_EQ(c.spring_ns(body, padded), 2e6 / 8000.0);
  EXPECT_DOUBLE_EQ(c.in_core_ns(body), 2.0);
  EXPECT_DOUBLE_EQ(c.bytes_of_spring(body), 100.0);
  EXPECT_DOUBLE_EQ(c.copied_per_second(body), 10.0);
  EXPECT_DOUBLE_EQ(c.bandwidth_ns(body), 10.0);
}

TEST(BenchStepTables, HaveARowForEachBodyAndWayToStepIt) {
  const StepCosts c = good_costs();
  const std::size_t bodies = step_bodies(largest).size();
  EXPECT_EQ(bodies, 10u);
  EXPECT_EQ(steps_table(c).rows().size(), 4 * bodies + 4);
  EXPECT_EQ(limits_table(c).rows().size(), bodies + 4);
}

// Four columns of 40 MB in 2.5 ms are 16 GB/s, 100 bytes 6.25 ns; a square root and a division take half as long by
// two.
TEST(BenchStepTables, HaveTheLimitsOfAllProcessors) {
  const auto rows = limits_table(good_costs()).rows();
  EXPECT_EQ(std::vector(rows.back().begin() + 1, rows.back().begin() + 6),
            (std::vector<std::string>{"2", "100", "16.0", "6.25", "1.00"}));
}

TEST(BenchStepPlot, ShowsBothLimitsAndAllWaysInBothOrders) {
  const Plot plot = roofline_plot(good_costs());
  ASSERT_EQ(plot.series.size(), 2u + 2 * 5);
  for (const PlotSeries& series : plot.series)
    for (const PlotSeries::Point& p : series.points) {
      EXPECT_GT(p.x, plot.x_low);
      EXPECT_LT(p.x, plot.x_high);
      EXPECT_GT(p.y, plot.y_low);
      EXPECT_LT(p.y, plot.y_high);
    }
  EXPECT_EQ(plot.series[2].points.size(), 4u);
  EXPECT_EQ(plot.series.back().points.size(), 2u);
}

TEST(StepCosts, AreMeasuredForEachBodyWhoseMotionsAgree) {
  StepCosts c;
  c.largest = 1'000;
  compare_steps({.largest = 1'000}, [&](const StepCounts& n) {
    EXPECT_EQ(n.differing, 0u) << n.body;
    EXPECT_TRUE(n.arrays) << n.body;
    EXPECT_GT(n.springs, n.tetrahedra) << n.body;
    c.counts[n.body] = n;
  });
  measure_step_costs({.rounds = 2, .largest = 1'000}, [&](const Sample& s) { c.samples.push_back(s); });
  check_repeats(c.samples);
  EXPECT_EQ(c.counts.size(), 4u);
  for (const std::string& body : step_bodies(1'000)) {
    for (const char* task : {graph, arrays, one, copy, roots}) EXPECT_TRUE(c.timed(body, task)) << body << task;
    for (const char* task : {lanes, padded}) EXPECT_EQ(c.timed(body, task), c.counts.at(body).lanes) << body << task;
    EXPECT_FALSE(c.timed(body, threads)) << body;
  }
  EXPECT_EQ(find_claim(claims_of(c), "step-agreement").verdict, Verdict::holds);
}

TEST(StepCosts, AreMeasuredForMeshesOfFilesCutFiner) {
  const std::vector<std::filesystem::path> meshes{paper_body("liver").mesh};
  ASSERT_EQ(step_meshes(meshes), std::vector<std::string>{"liver564"});
  StepCosts c{.samples = {}, .counts = {}, .largest = 0, .meshes = step_meshes(meshes)};
  const StepCostPlan plan{.rounds = 2, .largest = 0, .meshes = meshes, .least_of_mesh = 1857};
  compare_steps(plan, [&](const StepCounts& n) { c.counts[n.body] = n; });
  ASSERT_TRUE(c.counts.contains("liver564"));
  EXPECT_EQ(c.counts.at("liver564").tetrahedra, 8u * 1856u);
  EXPECT_EQ(c.counts.at("liver564").differing, 0u);
  measure_step_costs(plan, [&](const Sample& s) { c.samples.push_back(s); });
  EXPECT_TRUE(c.timed("liver564", one));
  EXPECT_EQ(c.bodies().back(), "liver564");
  const auto rows = steps_table(c).rows();
  EXPECT_EQ(rows.back().front(), "liver564");
}

TEST(StepCosts, AreNamedByFilesOfDifferentNames) {
  EXPECT_THROW(step_meshes({"a/liver.mesh", "b/liver.msh"}), InputError);
  EXPECT_EQ(step_meshes({"a/liver.mesh", "b/torso.msh"}), (std::vector<std::string>{"liver", "torso"}));
}

TEST(StepCosts, CountNoBytesOfDampingWhereThereIsNone) {
  std::map<std::string, double> bytes;
  compare_steps({.largest = 0}, [&](const StepCounts& n) { bytes[n.body] = n.bytes; });
  // 8 B of each of 2850 springs, and of each of 564 velocities a row
  const double row = lanes_are_on() ? 32.0 : 24.0;
  EXPECT_DOUBLE_EQ(bytes.at(paper_step_body(true)) - bytes.at(paper_step_body(false)), 8.0 * 2850 + row * 564);
}

TEST(MachineLimits, CopyColumnsThereAndBack) {
  CopiedColumns columns(1 << 12);
  EXPECT_EQ(columns.bytes(), std::size_t{1 << 12});
  const auto before = columns.hash();
  columns.run(2);
  const auto copied = columns.hash();
  EXPECT_NE(copied, before);
  columns.run(4);
  EXPECT_EQ(columns.hash(), copied);
}

TEST(MachineLimits, CopyAllColumnsBySeveralThreads) {
  CopiedColumns columns(1 << 12), other(1 << 12);
  const unsigned threads_before = use_threads(3);
  columns.run_by_threads(2);
  use_threads(threads_before);
  other.run(2);
  EXPECT_EQ(columns.hash(), other.hash());
}

TEST(MachineLimits, TakeTheRootOfEachSquare) {
  RootsAndQuotients first, second;
  const auto before = first.hash();
  first.run(1024);
  EXPECT_NE(first.hash(), before);
  second.run(4096);
  EXPECT_EQ(first.hash(), second.hash());
}

}  // namespace
}  // namespace dartboard::bench_step_report_test
