// Tables of the verbs of `bench` from their samples: every figure in its own place.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "benchmarks/studies/operations/bench_operations_report.h"
#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/bench_ablation_report.h"
#include "benchmarks/studies/scenes/output_tasks.h"
#include "benchmarks/studies/topology/bench_topology_report.h"
#include "benchmarks/studies/topology/topology_tasks.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/tables_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::bench_tables_test {
namespace {

/// A ratio that was the same in all of so many processes.
std::string steady(double ratio, std::size_t processes = 7) {
  return to_string(Figure{ratio, median_interval(std::vector<double>(processes, ratio))});
}

// ---- topology

/// Times of so many units, and how many they are.
void set_times(TopologyFigures& f, const std::string& group,
               const std::vector<std::tuple<std::string, double, double>>& ns_and_units) {
  std::vector<std::pair<std::string, double>> totals;
  for (const auto& [contender, ns, units] : ns_and_units) {
    totals.emplace_back(contender, ns * units);
    f.units[group + ":" + contender] = units;
  }
  f.samples[group] = timed_samples(totals);
}

TopologyFigures topology() {
  TopologyFigures f;
  f.bytes["liver564"] = {{"general", 516.0}, {"tetrahedral", 50.0}, {"CGAL", 1850.0}};
  f.bytes["kuhn-48000"] = {{"general", 517.0}, {"tetrahedral", 65.0}, {"CGAL", 1950.0}};
  // units differ, so that a time by another's is wrong
  set_times(f, "liver564:vertex-orbit",
            {{"general", 5.0, 1e6}, {"tetrahedral", 2.0, 2e6}, {"CGAL", 50.0, 4e6}, {"bare CGAL", 20.0, 8e6}});
  set_times(f, "kuhn-48000:vertex-orbit", {{"general", 6.0, 1e6}, {"tetrahedral", 4.0, 2e6}, {"CGAL", 100.0, 4e6}});
  set_times(f, "liver564:unsew-scattered", {{"general", 3000.0, 1e3}, {"tetrahedral", 1200.0, 1e3}});
  set_times(f, "kuhn-48000:vertex-to-tetrahedra", {{"tetrahedral", 100.0, 1e5}, {"CGAL", 20000.0, 1e3}});
  set_times(f, "scaling:unsew-cut", {{"2058", 100.0, 1e4}, {"48000", 120.0, 2e4}, {"998250", 140.0, 4e4}});
  set_times(f, "scaling:unsew-scattered", {{"2058", 200.0, 1e4}, {"48000", 300.0, 2e4}});
  return f;
}

const Row& row_with(const Table& table, const std::string& figure, const std::string& body) {
  for (const auto& row : table.rows())
    if (row[0] == figure && row[1] == body) return row;
  throw std::out_of_range(figure + " of " + body);
}

TEST(BenchTopologyTable, HasTheFiguresOfEachBodyByContender) {
  const Table table = figures_table(topology());
  EXPECT_EQ(alignment(table), "lllrrrrrrl");
  // memory of two bodies, and seven figures of both, one of them in two ways
  ASSERT_EQ(table.rows().size(), 2u + 8u * 2u);
  const auto find = [&](const std::string& figure, const std::string& body) {
    for (std::size_t k = 0; k < table.rows().size(); ++k)
      if (table.rows()[k][0] == figure && table.rows()[k][1] == body) return labelled(table, k);
    return Row{};
  };
  EXPECT_EQ(find("memory, vertex and edge ids included", "liver564"),
            (Row{"figure: memory, vertex and edge ids included", "body: liver564",
                 "target: <= 64 bytes per tetrahedron", "general: 516", "tetrahedral: 50", "CGAL: 1850",
                 "its ratio to tetrahedral: 37", "bare CGAL: -", "its ratio: -", "verdict: holds"}));
  EXPECT_EQ(row_with(table, "memory, vertex and edge ids included", "kuhn-48000").back(), "falls short");
  EXPECT_EQ(find("vertex orbit", "liver564"),
            (Row{"figure: vertex orbit", "body: liver564", "target: <= 3 ns per dart, 20x CGAL", "general: 5",
                 "tetrahedral: 2", "CGAL: 50", "its ratio to tetrahedral: " + steady(25.0), "bare CGAL: 20",
                 "its ratio: 10", "verdict: holds"}));
  EXPECT_EQ(row_with(table, "vertex orbit", "kuhn-48000"),
            (Row{"vertex orbit", "kuhn-48000", "<= 3 ns per dart, 20x CGAL", "6", "4", "100", steady(25.0), "-", "-",
                 "falls short"}));
  EXPECT_EQ(row_with(table, "unsew a face and report what came apart, at random", "liver564"),
            (Row{"unsew a face and report what came apart, at random", "liver564", "<= 1.5 us per face", "3", "1.2",
                 "-", "-", "-", "-", "holds"}));
  EXPECT_EQ(row_with(table, "unsew a face and report what came apart, along a cut", "liver564").back(), "not timed");
  EXPECT_EQ(row_with(table, "vertex to tetrahedra", "kuhn-48000"),
            (Row{"vertex to tetrahedra", "kuhn-48000", "-", "-", "0.1", "20", steady(200.0), "-", "-", "-"}));
}

TEST(BenchTopologyTable, CannotTellWhereTheBoundLiesWithinTheInterval) {
  TopologyFigures f = topology();
  for (Sample& s : f.samples["liver564:unsew-scattered"])
    if (s.task == "tetrahedral") s.cpu_ns = 1000 * (s.process % 2 == 0 ? 1600 : 1300);
  EXPECT_EQ(row_with(figures_table(f), "unsew a face and report what came apart, at random", "liver564").back(),
            "undecided");
}

TEST(BenchTopologyTable, HasTheTimesOfAllSizesOfABody) {
  const Table table = scaling_table(topology());
  EXPECT_EQ(alignment(table), "lrrrrl");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0), (Row{"unsew, tetrahedral map: along a cut", "2,058 [us]: 0.1", "48,000 [us]: 0.12",
                                     "998,250 [us]: 0.14", "largest / smallest: " + steady(1.4), "target: <= 1.5"}));
  EXPECT_EQ(table.rows()[1], (Row{"at random", "0.2", "0.3", "-", "-", "<= 3"}));
}

TEST(BenchTopologyTable, OfPeersHasAFigureOrNoneOfEach) {
  const Table table = peers_table();
  EXPECT_EQ(alignment(table), "lrrrr");
  EXPECT_EQ(table.rows().size(), 7u);
  // in all of them the probe of an implicit map is the least
  for (const auto& row : table.rows()) EXPECT_NE(row.back(), "none") << row[0];
}

TEST(BenchTopologyClaimsInWords, SayWhatIsAskedAndWhatWasMeasured) {
  TopologyFigures f = topology();
  set_times(f, "kuhn-48000:vertex-orbit",
            {{"general", 6.0, 1e6}, {"tetrahedral", 2.5, 2e6}, {"CGAL", 75.0, 4e6}, {"bare CGAL", 30.0, 1e6}});
  const auto claims = claims_of(f);
  expect_words(claims, "topology-memory", "<= 64 bytes per tetrahedron", "65 / 50", "counted");
  expect_words(claims, "topology-vertex-orbit", "<= 3 ns per dart, 20x CGAL", "2 / 2.5",
               steady(25.0) + " (bare: 10); " + steady(30.0) + " (bare: 12)");
  expect_words(claims, "topology-unsew-cut-scaling", "<= 1.5", "1.4",
               to_string(median_interval(std::vector<double>(7, 1.4))));
  expect_words(claims, "topology-unsew-random-scaling", "<= 3", "", "");
  EXPECT_NE(find_claim(claims, "topology-unsew-cut-scaling").text.find("along a cut"), std::string::npos);
  EXPECT_NE(find_claim(claims, "topology-unsew-random-scaling").text.find("at random"), std::string::npos);
}

// ---- operations

/// Each phase takes so many nanoseconds every time except the last, which takes ten times as long.
OperationSample operation(const std::vector<std::int64_t>& ns) {
  OperationSample sample;
  for (const std::int64_t each : ns) {
    sample.ns.emplace_back(100, each);
    sample.ns.back().back() = 10 * each;
    sample.ns.back()[98] = 10 * each;
  }
  return sample;
}

OperationFigures operation_figures() {
  OperationFigures f;
  // map, embeddings, four views
  f.operations["liver564:remove"].assign(3, operation({1000, 2000, 100, 200, 300, 400, 500, 600}));
  f.operations["liver564:dissociate, random"].assign(3, operation({3000, 5000, 10, 20, 30, 40, 50, 60}));
  BodySample body;
  for (int view = 0; view < 6; ++view) body.rebuild_ns.emplace_back(3, (view + 1) * 1'000'000);
  body.step_ns.assign(9, 50'000);
  body.eventful_step_ns.assign(9, 75'000);
  f.bodies["liver564"].assign(3, body);
  return f;
}

TEST(BenchOperationsTable, HasThePartsOfEachOperationOnEachBody) {
  const Table table = operations_table(operation_figures(), {"liver564"});
  EXPECT_EQ(alignment(table), "llrrrrrr");
  ASSERT_EQ(table.rows().size(), 2u);  // of the timed ones, in the order of operations()
  EXPECT_EQ(table.rows()[0][0], "dissociate, random");
  EXPECT_EQ(labelled(table, 1),
            (Row{"operation: remove", "body: liver564", "map [us]: 1", "embeddings [us]: 2", "four views [us]: 2.1",
                 "all: median [us]: 5.1", "99th percentile [us]: 51", "median over a step: 0.1"}));
}

TEST(BenchOperationsTable, HasTheCostsOfEachView) {
  const Table table = views_table(operation_figures(), {"liver564"});
  EXPECT_EQ(alignment(table), "llrrrr");
  ASSERT_EQ(table.rows().size(), operation_phases().size() - 2);
  for (std::size_t view = 0; view < table.rows().size(); ++view) {
    const double k = static_cast<double>(view + 1);
    EXPECT_EQ(labelled(table, view), (Row{"view: " + operation_phases()[view + 2], "body: liver564",
                                          fmt::format("follow a dissociation [us]: {:g}", 0.01 * k),
                                          fmt::format("follow a removal [us]: {:g}", 0.1 * k),
                                          fmt::format("rebuild [ms]: {:g}", k), "a step [ms]: 0.05"}));
  }
}

TEST(BenchOperationsClaimsInWords, SayWhatIsAskedAndWhatWasMeasured) {
  const auto claims = claims_of(operation_figures(), {"liver564"});
  const Claim& remove = find_claim(claims, "operation-remove");
  EXPECT_EQ(remove.paper_value, "<= 10 us");
  EXPECT_EQ(remove.measured, "5.1 us");
  EXPECT_EQ(remove.bound_or_interval, "99th percentile 51");
  EXPECT_EQ(remove.text, "remove, with embeddings and four views");
  EXPECT_EQ(find_claim(claims, "operation-tear-fan").reason, "it was not timed on any body");
  const Claim& step = find_claim(claims, "operation-step-liver564");
  EXPECT_EQ(step.paper_value, "<= 2");
  EXPECT_EQ(step.measured, "1.5");
  EXPECT_EQ(step.bound_or_interval, to_string(median_interval(std::vector<double>(3, 1.5))));
}

// ---- ablation

/// Every task takes its own time and every scene its own bytes.
AblationFigures ablation() {
  AblationFigures f;
  f.steps = 20;
  std::vector<std::pair<std::string, double>> ns;
  double next = 1e6;
  for (const AblationVariant& variant : ablation_variants()) {
    ns.emplace_back(variant.name, next);
    f.bytes[variant.name] = {.total = static_cast<std::size_t>(next / 1e2), .tetrahedra = 10};
    next += 1e5;
  }
  for (const std::string& task :
       {std::string("plain loop"), std::string("loop"), std::string("loop and detector"), std::string("watched loop"),
        std::string("simulation"), output_run, output_run_by_two, output_integrator, output_bytes}) {
    ns.emplace_back(task, next);
    next += 1e5;
  }
  f.samples = timed_samples(ns);
  return f;
}

double ns_of(const AblationFigures& f, const std::string& task) {
  for (const Sample& s : f.samples)
    if (s.task == task) return static_cast<double>(s.cpu_ns);
  throw std::out_of_range(task);
}
double ratio_of(const AblationFigures& f, const AblationPair& pair) {
  return ns_of(f, pair.task) / ns_of(f, pair.baseline);
}
/// Bytes per tetrahedron: a thousandth of the nanoseconds, as in `ablation`.
double bytes_of(const AblationFigures& f, const AblationPair& pair) {
  return (ns_of(f, pair.task) - ns_of(f, pair.baseline)) / 1e3;
}
std::string percent(double ratio) { return fmt::format("{:+.2f} %", 100 * (ratio - 1)); }

TEST(BenchAblationTable, HasWhatEachFeatureTakesOnAndOff) {
  const AblationFigures f = ablation();
  const Table table = features_table(f);
  EXPECT_EQ(alignment(table), "llrrrr");
  const std::size_t count = switched_on().size();
  ASSERT_EQ(table.rows().size(), count + switched_off().size());
  const double coverage = 100 * median_interval(std::vector<double>(7, 1.0)).coverage;
  const auto expect = [&](std::size_t row, const AblationPair& pair, const std::string& switched) {
    const double ratio = ratio_of(f, pair);
    EXPECT_EQ(labelled(table, row),
              (Row{"feature: " + pair.feature, "switched: " + switched,
                   fmt::format("bytes per tetrahedron: {:+.1f}", bytes_of(f, pair)),
                   fmt::format("us per step: {:+.2f}", (ns_of(f, pair.task) - ns_of(f, pair.baseline)) / 20 / 1e3),
                   "of a step: " + percent(ratio),
                   fmt::format("interval: [{0:+.2f}, {0:+.2f}] at {1:.1f} %", 100 * (ratio - 1), coverage)}));
  };
  for (std::size_t k = 0; k < count; ++k) {
    expect(k, switched_on()[k], "on, from bare");
    expect(count + k, switched_off()[k], "off, from full");
  }
}

TEST(BenchAblationTable, HasTheStairsFromTheSceneToThePlainLoop) {
  const AblationFigures f = ablation();
  const Table table = staircase_table(f);
  EXPECT_EQ(alignment(table), "lllrrr");
  ASSERT_EQ(table.rows().size(), staircase().size());
  for (std::size_t k = 0; k < staircase().size(); ++k) {
    const AblationPair pair = staircase()[k];
    const Row row = labelled(table, k);
    EXPECT_EQ(Row(row.begin(), row.begin() + 5),
              (Row{"not requested, or always there: " + pair.feature, "task: " + pair.task, "over: " + pair.baseline,
                   fmt::format("us per step: {:.2f}", ns_of(f, pair.task) / 20 / 1e3),
                   "of a step: " + percent(ratio_of(f, pair))}));
    EXPECT_TRUE(row[5].starts_with(fmt::format("interval: [{:+.2f}, ", 100 * (ratio_of(f, pair) - 1)))) << row[5];
  }
}

TEST(BenchAblationTable, HasASceneWithItsOutputOverItsIntegrator) {
  AblationFigures f = ablation();
  for (Sample& sample : f.samples)
    if (sample.task == output_run_by_two) sample.wall_ns = sample.cpu_ns / 2;
  const Table table = output_table(f);
  EXPECT_EQ(alignment(table), "lrrrrrr");
  const std::vector<std::string> tasks{output_run, output_run_by_two, output_integrator, output_bytes};
  ASSERT_EQ(table.rows().size(), tasks.size());
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const double ratio = ratio_of(f, {"", tasks[k], output_integrator}), ms = ns_of(f, tasks[k]) / 1e6,
                 by_clock = k == 1 ? 0.5 : 1.0;
    const auto interval = [](double of) {
      return "interval: " + to_string(median_interval(std::vector<double>(7, of)));
    };
    EXPECT_EQ(labelled(table, k),
              (Row{"task: " + tasks[k], fmt::format("ms of its thread: {:.3g}", ms),
                   fmt::format("over the integrator: {:.3f}", ratio), interval(ratio),
                   fmt::format("ms by the clock: {:.3g}", by_clock * ms),
                   fmt::format("over the integrator: {:.3f}", by_clock * ratio), interval(by_clock * ratio)}));
  }
}

TEST(BenchAblationClaimsInWords, SayWhatIsAskedAndWhatWasMeasured) {
  AblationFigures f = ablation();
  f.bytes["bare"] = {.total = 1, .tetrahedra = 2, .springs = 3, .not_asked_for = 4, .damping = 5};
  f.bytes["bare + damping"].damping = 6;
  const auto claims = claims_of(f);
  const double speed = ns_of(f, "simulation") / ns_of(f, "loop");
  const Claim& bare = find_claim(claims, "bare-scene-speed");
  EXPECT_EQ(bare.paper_value, "<= 1.02");
  EXPECT_EQ(bare.measured, fmt::format("{:.4f}", speed));
  EXPECT_EQ(bare.bound_or_interval, to_string(median_interval(std::vector<double>(7, speed))));
  EXPECT_EQ(find_claim(claims, "bare-scene-holds-no-dart").measured, "4 bytes");
  const Claim& damping = find_claim(claims, "unasked-damping-bytes");
  EXPECT_EQ(damping.measured, "5 bytes for 3 springs; 6 where it is requested");
  EXPECT_EQ(damping.paper_value, "0 bytes");
  EXPECT_EQ(damping.bound_or_interval, "exact");
  const Claim& detector = find_claim(claims, "detector-time");
  EXPECT_EQ(detector.text, "divergence detector: time when not requested");
  EXPECT_EQ(detector.paper_value, "<= 0.5 % of a step");
  EXPECT_EQ(detector.measured, percent(ns_of(f, "loop and detector") / ns_of(f, "loop")));
  EXPECT_EQ(detector.reason, "'loop and detector' over 'loop'");
}

TEST(AblationPlot, HasARowForEachFeatureFromTheTop) {
  const AblationFigures f = ablation();
  const Plot plot = ablation_plot(f);
  EXPECT_EQ(plot.title, "What a feature costs: on from a bare scene, off from a full one");
  EXPECT_EQ(plot.subtitle, "interval over processes; bytes per tetrahedron");
  EXPECT_EQ(plot.x_axis, "time per step with it, over that without");
  const std::size_t count = switched_on().size();
  ASSERT_EQ(plot.rows.size(), count);
  for (std::size_t k = 0; k < count; ++k) EXPECT_EQ(plot.rows[k], switched_on()[count - 1 - k].feature);
  EXPECT_LT(plot.y_low, 1.0);
  EXPECT_GT(plot.y_low, 0.0);
  EXPECT_GT(plot.y_high, static_cast<double>(count));
  EXPECT_LT(plot.y_high, static_cast<double>(count) + 1.0);
  // an interval for each figure, then the line of no cost, then the figures
  ASSERT_EQ(plot.series.size(), 2 * count + 3);
  const PlotSeries &none = plot.series[2 * count], &on = plot.series[2 * count + 1], &off = plot.series[2 * count + 2];
  ASSERT_EQ(none.points.size(), 2u);
  for (const auto& p : none.points) EXPECT_EQ(p.x, 1.0);
  EXPECT_EQ(none.points[0].y, plot.y_low);
  EXPECT_EQ(none.points[1].y, plot.y_high);
  EXPECT_EQ(none.symbol, 0);
  EXPECT_GT(none.width, 0.0);
  EXPECT_EQ(on.title, "on, from bare");
  EXPECT_EQ(off.title, "off, from full");
  EXPECT_NE(on.colour, off.colour);
  EXPECT_NE(on.symbol, off.symbol);
  EXPECT_EQ(on.size, off.size);
  EXPECT_GT(on.size, 1.0);
  EXPECT_LT(on.size, 2.0);
  EXPECT_EQ(on.width, 0.0);
  ASSERT_EQ(on.points.size(), count);
  ASSERT_EQ(off.points.size(), count);
  for (std::size_t k = 0; k < count; ++k)
    for (const bool first : {true, false}) {
      const AblationPair pair = first ? switched_on()[k] : switched_off()[k];
      const auto& p = (first ? on : off).points[k];
      const auto row = static_cast<double>(count - k);
      EXPECT_DOUBLE_EQ(p.x, ratio_of(f, pair));
      EXPECT_NEAR(p.y, row, 0.4);
      EXPECT_EQ(p.y > row, first);  // both are seen
      const PlotSeries& interval = plot.series[first ? k : count + k];
      ASSERT_EQ(interval.points.size(), 2u);
      for (const auto& end : interval.points) {
        EXPECT_DOUBLE_EQ(end.x, p.x);  // all processes took the same time
        EXPECT_EQ(end.y, p.y);
      }
      EXPECT_EQ(interval.points[0].label, "");
      EXPECT_EQ(interval.points[1].label, fmt::format("{:+.1f} B", bytes_of(f, pair)));
      EXPECT_EQ(interval.colour, first ? on.colour : off.colour);
      EXPECT_EQ(interval.symbol, 0);
      EXPECT_GT(interval.width, 0.0);
      EXPECT_LT(plot.x_low, p.x);
      EXPECT_GT(plot.x_high, p.x);
    }
}

}  // namespace
}  // namespace dartboard::bench_tables_test
