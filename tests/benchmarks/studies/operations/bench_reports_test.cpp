// The conclusions of the verbs of `bench` from their samples: with one task too slow, the claim about it falls short.

#include <gtest/gtest.h>

#include <functional>

#include "benchmarks/studies/operations/bench_operations_report.h"
#include "benchmarks/studies/operations/operation_study.h"
#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/bench_ablation_report.h"
#include "benchmarks/studies/scenes/output_tasks.h"
#include "benchmarks/studies/topology/bench_topology_report.h"
#include "benchmarks/studies/topology/topology_tasks.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::bench_reports_test {
namespace {

using Ids = std::vector<std::string>;

// ---- topology

constexpr double units = 1e6;  // in each run, so that a picosecond per unit is a tick of the clock

void set_times(TopologyFigures& f, const std::string& group, const std::vector<std::pair<std::string, double>>& ns) {
  std::vector<std::pair<std::string, double>> totals;
  for (const auto& [contender, each] : ns) {
    totals.emplace_back(contender, units * each);
    f.units[group + ":" + contender] = units;
  }
  f.samples[group] = timed_samples(totals);
}

/// Every figure at 0.9 of its target, CGAL 25 times as slow.
TopologyFigures good_topology() {
  TopologyFigures f;
  const std::pair<const char*, double> targets[]{{"vertex-orbit", 3.0}, {"full-check", 5.0},
                                                 {"local-check", 1e3},  {"build", 0.8e3},
                                                 {"unsew-cut", 1.5e3},  {"unsew-scattered", 1.5e3}};
  for (const std::string& body : topology_bodies) {
    f.bytes[body] = {{"general", 500.0}, {"tetrahedral", 60.0}, {"CGAL", 1800.0}};
    for (const auto& [figure, bound] : targets)
      set_times(f, body + ":" + figure,
                {{"general", 2.0 * bound}, {"tetrahedral", 0.9 * bound}, {"CGAL", 22.5 * bound}, {"bare CGAL", bound}});
  }
  set_times(f, "scaling:unsew-cut", {{"2058", 100.0}, {"48000", 120.0}, {"998250", 145.0}});
  set_times(f, "scaling:unsew-scattered", {{"2058", 100.0}, {"48000", 200.0}, {"998250", 290.0}});
  return f;
}

Ids topology_short_with(const std::function<void(TopologyFigures&)>& spoil) {
  TopologyFigures f = good_topology();
  spoil(f);
  return ids_of(claims_of(f), Verdict::falls_short);
}
void slow(TopologyFigures& f, const std::string& group, double ours_ns, double cgal_ns = 1e6) {
  set_times(f, group, {{"general", 1.0}, {"tetrahedral", ours_ns}, {"CGAL", cgal_ns}, {"bare CGAL", 1.0}});
}

TEST(BenchTopologyClaims, HoldWhenEverythingIsAsPromised) {
  EXPECT_EQ(ids_of(claims_of(good_topology()), Verdict::holds),
            (Ids{"topology-memory", "topology-vertex-orbit", "topology-full-check", "topology-local-check",
                 "topology-build", "topology-unsew", "topology-unsew-cut-scaling", "topology-unsew-random-scaling"}));
}

TEST(BenchTopologyClaims, FallShortOfABodyThatTakesMoreMemory) {
  EXPECT_EQ(topology_short_with([](auto& f) { f.bytes["kuhn-48000"]["tetrahedral"] = 64.1; }), Ids{"topology-memory"});
}

TEST(BenchTopologyClaims, FallShortOfAFigureThatIsTooSlowOnOneBody) {
  const std::pair<const char*, double> slower[]{
      {"vertex-orbit", 3.1}, {"full-check", 5.1}, {"local-check", 1010.0}, {"build", 810.0}};
  for (const std::string& body : topology_bodies)
    for (const auto& [figure, ns] : slower)
      EXPECT_EQ(topology_short_with([&body, figure = figure, ns = ns](auto& f) { slow(f, body + ":" + figure, ns); }),
                Ids{std::string("topology-") + figure})
          << body;
}

TEST(BenchTopologyClaims, FallShortOfUnsewingAlongACutAndAtRandomAlike) {
  for (const char* figure : {":unsew-cut", ":unsew-scattered"})
    EXPECT_EQ(topology_short_with([&](auto& f) { slow(f, "liver564" + std::string(figure), 1510.0); }),
              Ids{"topology-unsew"});
}

TEST(BenchTopologyClaims, FallShortOfWhatIsNotTwentyTimesAsFastAsCgal) {
  EXPECT_EQ(topology_short_with([](auto& f) { slow(f, "liver564:vertex-orbit", 1.0, 19.9); }),
            Ids{"topology-vertex-orbit"});
  EXPECT_EQ(topology_short_with([](auto& f) { slow(f, "liver564:full-check", 1.0, 19.9); }),
            Ids{"topology-full-check"});
}

TEST(BenchTopologyClaims, AreNotTestedWhereCgalWasNotTimed) {
  TopologyFigures f = good_topology();
  f.units.erase("liver564:full-check:CGAL");
  EXPECT_EQ(ids_of(claims_of(f), Verdict::not_tested), Ids{"topology-full-check"});
}

TEST(BenchTopologyClaims, CountTheUnitsOfEachContender) {
  TopologyFigures f = good_topology();
  f.units["liver564:build:tetrahedral"] = 0.5 * units;  // the same time for half as many tetrahedra
  EXPECT_EQ(ids_of(claims_of(f), Verdict::falls_short), Ids{"topology-build"});
}

TEST(BenchTopologyClaims, FallShortOfUnsewingThatGrowsWithTheBody) {
  EXPECT_EQ(topology_short_with([](auto& f) {
              set_times(f, "scaling:unsew-cut", {{"2058", 100.0}, {"48000", 100.0}, {"998250", 151.0}});
            }),
            Ids{"topology-unsew-cut-scaling"});
  EXPECT_EQ(topology_short_with([](auto& f) {
              set_times(f, "scaling:unsew-scattered", {{"2058", 100.0}, {"48000", 100.0}, {"998250", 301.0}});
            }),
            Ids{"topology-unsew-random-scaling"});
}

TEST(BenchTopologyClaims, AreNotTestedWhereContendersDisagreed) {
  TopologyFigures f;  // figures that disagree are not timed
  for (const Claim& c : claims_of(f)) {
    EXPECT_EQ(c.verdict, Verdict::not_tested) << c.id;
    EXPECT_NE(c.reason.find("do not find the same"), std::string::npos) << c.id;
  }
}

// A claim on all bodies is not made for one, however good it is.
TEST(BenchTopologyClaims, AreNotTestedWhereABodyWasLeftOut) {
  TopologyFigures f = good_topology();
  f.all_bodies = false;
  f.bytes.erase("kuhn-48000");
  for (const char* group : {"kuhn-48000", "scaling"}) {
    std::erase_if(f.units, [&](const auto& entry) { return entry.first.starts_with(group); });
    std::erase_if(f.samples, [&](const auto& entry) { return entry.first.starts_with(group); });
  }
  for (const Claim& c : claims_of(f)) {
    EXPECT_EQ(c.verdict, Verdict::not_tested) << c.id;
    EXPECT_NE(c.reason.find("--only"), std::string::npos) << c.id;
  }
}

// ---- operations

const std::vector<std::string> bodies{"liver564", "kuhn-2058", "kuhn-105456", "kuhn-998250"};

/// Times of the map, the embeddings and one view, the same in six processes of nine runs.
void set_operation(OperationFigures& f, const std::string& body, const std::string& operation, double us) {
  const auto part = static_cast<std::int64_t>(1e3 * us / 4.0);
  OperationSample sample;
  sample.body = body;
  sample.operation = operation;
  sample.ns.assign(4, std::vector<std::int64_t>(9, part));
  f.operations[body + ":" + operation].assign(6, sample);
}
void set_step(OperationFigures& f, const std::string& body, double eventful_ms) {
  BodySample sample;
  sample.body = body;
  sample.rebuild_ns.assign(6, std::vector<std::int64_t>(3, 400'000));
  sample.step_ns.assign(9, 1'000'000);
  sample.eventful_step_ns.assign(9, static_cast<std::int64_t>(1e6 * eventful_ms));
  f.bodies[body].assign(6, sample);
}

OperationFigures good_operations() {
  OperationFigures f;
  for (const std::string& body : bodies) {
    set_operation(f, body, "dissociate, cut", body == "kuhn-998250" ? 4.4 : 3.2);
    set_operation(f, body, "dissociate, random", body == "kuhn-998250" ? 4.4 : 2.0);
    set_operation(f, body, "remove", 8.0);
    set_operation(f, body, "tear fan", 16.0);
    set_step(f, body, 1.5);
  }
  return f;
}

Ids operations_short_with(const std::function<void(OperationFigures&)>& spoil) {
  OperationFigures f = good_operations();
  spoil(f);
  const auto claims = claims_of(f, bodies);
  // of the paper: 400 us are not negligible compared with 4, which is known
  EXPECT_EQ(find_claim(claims, "rebuild-negligible").verdict, Verdict::does_not_carry_over);
  return ids_of(claims, Verdict::falls_short);
}

TEST(BenchOperationsClaims, HoldWhenEverythingIsAsPromised) {
  EXPECT_EQ(ids_of(claims_of(good_operations(), bodies), Verdict::holds),
            (Ids{"operation-dissociate", "operation-remove", "operation-tear-fan", "operation-cut-scaling",
                 "operation-random-scaling", "operation-step-liver564", "operation-step-kuhn-105456"}));
}

TEST(BenchOperationsClaims, FallShortOfAnOperationThatIsTooSlowOnOneBody) {
  const auto with = [](const char* operation, double us) {
    return operations_short_with([=](auto& f) { set_operation(f, "kuhn-105456", operation, us); });
  };
  EXPECT_EQ(with("dissociate, cut", 5.2), Ids{"operation-dissociate"});
  EXPECT_EQ(with("dissociate, random", 5.2), Ids{"operation-dissociate"});
  EXPECT_EQ(with("remove", 10.4), Ids{"operation-remove"});
  EXPECT_EQ(with("tear fan", 20.4), Ids{"operation-tear-fan"});
}

TEST(BenchOperationsClaims, CountEveryPhaseOfAnOperation) {
  for (std::size_t phase = 0; phase < 4; ++phase)
    EXPECT_EQ(operations_short_with([=](auto& f) {
                for (OperationSample& s : f.operations["liver564:remove"]) s.ns[phase].assign(9, 4'100);
              }),
              Ids{"operation-remove"})
        << phase;
}

TEST(BenchOperationsClaims, FallShortOfAnOperationThatGrowsWithTheBody) {
  EXPECT_EQ(operations_short_with([](auto& f) { set_operation(f, "kuhn-2058", "dissociate, cut", 2.8); }),
            Ids{"operation-cut-scaling"});
  EXPECT_EQ(operations_short_with([](auto& f) { set_operation(f, "kuhn-2058", "dissociate, random", 1.4); }),
            Ids{"operation-random-scaling"});
}

TEST(BenchOperationsClaims, FallShortOfAStepWithADissociationThatTakesTwiceAsLong) {
  EXPECT_EQ(operations_short_with([](auto& f) { set_step(f, "liver564", 2.1); }), Ids{"operation-step-liver564"});
  EXPECT_EQ(operations_short_with([](auto& f) { set_step(f, "kuhn-105456", 2.1); }), Ids{"operation-step-kuhn-105456"});
}

// As in a quick run: three processes, all alike, cannot predict others.
TEST(BenchOperationsClaims, AreNotTestedInThreeProcesses) {
  OperationFigures f = good_operations();
  for (auto& [name, samples] : f.operations) samples.resize(3);
  for (auto& [name, samples] : f.bodies) samples.resize(3);
  const auto claims = claims_of(f, bodies);
  EXPECT_EQ(ids_of(claims, Verdict::undecided).size(), claims.size());
  EXPECT_EQ(exit_code(claims), 0);
}

TEST(BenchOperationsClaims, AreNotTestedOfAnOperationThatWasNotTimed) {
  OperationFigures f = good_operations();
  for (const std::string& body : bodies) f.operations.erase(body + ":tear fan");
  EXPECT_EQ(ids_of(claims_of(f, bodies), Verdict::not_tested), Ids{"operation-tear-fan"});
}

TEST(BenchOperationsClaims, CompareTheRebuildWithOneRemovalOfMapAndEmbeddings) {
  OperationFigures f = good_operations();  // 400 us compared with 1 + 3
  for (OperationSample& s : f.operations["liver564:remove"]) {
    s.ns[0].assign(9, 1000);
    s.ns[1].assign(9, 3000);
  }
  EXPECT_EQ(find_claim(claims_of(f, bodies), "rebuild-negligible").measured, "rebuilding takes 100 removals");
  for (BodySample& s : f.bodies["liver564"]) s.rebuild_ns[0].assign(3, 390);
  const auto claims = claims_of(f, bodies);
  EXPECT_EQ(find_claim(claims, "rebuild-negligible").verdict, Verdict::holds);
  EXPECT_EQ(claims.back().id, "rebuild-negligible");  // the last, as its header says
}

// ---- ablation

AblationFigures good_ablation() {
  AblationFigures f;
  f.steps = 20;
  f.samples = timed_samples({{"plain loop", 1'000'000},
                             {"loop", 1'002'000},
                             {"loop and detector", 1'004'000},
                             {"watched loop", 1'006'000},
                             {"simulation", 1'008'000},
                             {output_run, 1'990'000},
                             {output_run_by_two, 1'490'000},
                             {output_integrator, 1'000'000},
                             {output_bytes, 10'000}});
  for (const AblationVariant& variant : ablation_variants()) f.bytes[variant.name] = {.total = 100, .tetrahedra = 1};
  return f;
}
Ids ablation_short_with(const std::function<void(AblationFigures&)>& spoil) {
  AblationFigures f = good_ablation();
  spoil(f);
  return ids_of(claims_of(f), Verdict::falls_short);
}
void set_task(AblationFigures& f, const std::string& task, std::int64_t ns) {
  for (Sample& sample : f.samples)
    if (sample.task == task) sample.cpu_ns = sample.wall_ns = ns;
}

TEST(BenchAblationClaims, HoldWhenEverythingIsAsPromised) {
  EXPECT_EQ(ids_of(claims_of(good_ablation()), Verdict::holds),
            (Ids{"bare-scene-speed", "bare-scene-holds-no-dart", "unasked-damping-bytes", "unasked-terms-time",
                 "detector-time", "speed-check-time", "unasked-events-and-output-time", "output-liver-cut"}));
}

TEST(BenchAblationClaims, FallShortOfASceneSlowerThanItsLoop) {
  EXPECT_EQ(ablation_short_with([](auto& f) { set_task(f, "simulation", 1'023'000); }),
            (Ids{"bare-scene-speed", "unasked-events-and-output-time"}));
}

TEST(BenchAblationClaims, FallShortOfTheStairThatTakesMoreThanHalfAPercent) {
  const auto from = [](int stair) {  // the tasks from a stair on, 0.6 % slower
    return ablation_short_with([=](auto& f) {
      const char* tasks[]{"loop", "loop and detector", "watched loop", "simulation"};
      for (int k = stair; k < 4; ++k) set_task(f, tasks[k], 1'008'000 + 2'000 * k);
    });
  };
  EXPECT_EQ(from(0), Ids{"unasked-terms-time"});
  EXPECT_EQ(from(1), Ids{"detector-time"});
  EXPECT_EQ(from(2), Ids{"speed-check-time"});
  EXPECT_EQ(from(3), Ids{"unasked-events-and-output-time"});
}

TEST(BenchAblationClaims, FallShortOfABareSceneThatHoldsAnythingNotAskedFor) {
  EXPECT_EQ(ablation_short_with([](auto& f) { f.bytes["bare"].not_asked_for = 1; }), Ids{"bare-scene-holds-no-dart"});
  EXPECT_EQ(ablation_short_with([](auto& f) { f.bytes["bare"].damping = 8; }), Ids{"unasked-damping-bytes"});
}

TEST(BenchAblationClaims, FallShortOfASceneWhoseOutputTakesMoreThanHalfOfItsIntegrator) {
  EXPECT_EQ(ablation_short_with([](auto& f) { set_task(f, output_run_by_two, 1'510'000); }), Ids{"output-liver-cut"});
}

TEST(BenchAblationClaims, SayNothingOfAStairWhoseLowerTaskIsTheSlowerOne) {
  AblationFigures f = good_ablation();
  set_task(f, "plain loop", 1'010'000);
  EXPECT_EQ(ids_of(claims_of(f), Verdict::undecided), Ids{"unasked-terms-time"});
}

// ---- operations

// The map follows first and each view after it: if all views follow, each of them takes some time, and the journal
// restores the map only.
TEST(StudyOperations, TimeEveryPhaseOfEveryOperation) {
  std::size_t operations_seen = 0;
  study_operations(
      "kuhn-2058", {.times = 5},
      [&](const OperationSample& sample) {
        ++operations_seen;
        ASSERT_EQ(sample.ns.size(), operation_phases().size());
        for (std::size_t phase = 0; phase < sample.ns.size(); ++phase) {
          std::int64_t sum = 0;
          for (const std::int64_t ns : sample.ns[phase]) {
            EXPECT_GE(ns, 0);
            sum += ns;
          }
          if (phase == 0 || sample.operation != "undo")
            EXPECT_GT(sum, 0) << sample.operation << ": " << operation_phases()[phase];
          else
            EXPECT_EQ(sum, 0) << operation_phases()[phase];
        }
      },
      [](const BodySample& sample) {
        EXPECT_EQ(sample.rebuild_ns.size() + 2, operation_phases().size());
        EXPECT_EQ(sample.step_ns.size(), sample.eventful_step_ns.size());
        EXPECT_GT(sample.step_ns.size(), 0u);
      });
  EXPECT_EQ(operations_seen, operations().size());
}

}  // namespace
}  // namespace dartboard::bench_reports_test
