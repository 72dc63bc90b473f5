#include "benchmarks/harness/paired.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/plain/error.h"

namespace dartboard::paired_test {
namespace {

/// Three tasks "a", "b", "c" that count up from their restored state, and a log of what was called.
struct Recorder {
  std::string log;
  int state = -1;
  std::vector<TimedTask> tasks;
  std::vector<Sample> samples;

  Recorder() {
    for (const char* name : {"a", "b", "c"})
      tasks.push_back({name,
                       [this] {
                         state = 0;
                         log += 'r';
                       },
                       [this, name] {
                         ++state;
                         log += name;
                       },
                       [this] {
                         log += 'h';
                         return static_cast<std::uint64_t>(state);
                       }});
  }
  void run(const PairedOptions& options) {
    run_rounds(tasks, options, [this](const Sample& sample) { samples.push_back(sample); });
  }
  std::string order() const {
    std::string names;
    for (const Sample& sample : samples) names += sample.task;
    return names;
  }
};

Sample sample_of(std::string task, int process, int round, std::int64_t cpu_ns, std::uint64_t hash = 0) {
  return {std::move(task), process, round, 0, cpu_ns, 2 * cpu_ns, hash};
}

TEST(RunRounds, RestoresEachTaskBeforeItsRunAndHashesAfterIt) {
  Recorder recorder;
  recorder.run({.rounds = 4, .warmup = 1});
  ASSERT_EQ(recorder.log.size(), 3u * 3u * 5u);
  for (std::size_t i = 0; i < recorder.log.size(); i += 3) {
    EXPECT_EQ(recorder.log[i], 'r');
    EXPECT_EQ(recorder.log[i + 2], 'h');
  }
  for (const Sample& sample : recorder.samples) EXPECT_EQ(sample.hash, 1u);  // one run from the restored state
}

TEST(RunRounds, ReportsEveryTaskOncePerRoundAndNoWarmup) {
  Recorder recorder;
  recorder.run({.rounds = 5, .warmup = 3, .process = 7});
  ASSERT_EQ(recorder.samples.size(), 15u);
  for (std::size_t i = 0; i < 15; ++i) {
    EXPECT_EQ(recorder.samples[i].process, 7);
    EXPECT_EQ(recorder.samples[i].round, static_cast<int>(i / 3));
    EXPECT_EQ(recorder.samples[i].position, static_cast<int>(i % 3));
    EXPECT_GE(recorder.samples[i].cpu_ns, 0);
    EXPECT_GE(recorder.samples[i].wall_ns, 0);
  }
}

TEST(RunRounds, PutsEachTaskInEachPlaceOncePerBlock) {
  Recorder recorder;
  recorder.run({.rounds = 12, .warmup = 0});
  for (int block = 0; block < 4; ++block) {
    std::set<std::pair<std::string, int>> places;
    for (const Sample& sample : recorder.samples)
      if (sample.round / 3 == block) places.emplace(sample.task, sample.position);
    EXPECT_EQ(places.size(), 9u) << "block " << block;
  }
}

TEST(RunRounds, RepeatsItsOrderForTheSameSeedAndProcessOnly) {
  Recorder first, again, other;
  first.run({.rounds = 30, .warmup = 0, .process = 0, .seed = 5});
  again.run({.rounds = 30, .warmup = 2, .process = 0, .seed = 5});
  other.run({.rounds = 30, .warmup = 0, .process = 1, .seed = 5});
  EXPECT_EQ(first.order(), again.order());
  EXPECT_NE(first.order(), other.order());
}

TEST(RunRounds, SaysWhatItRefuses) {
  const auto refused = [](const PairedOptions& options) {
    try {
      Recorder().run(options);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(refused({.rounds = -7, .warmup = 2, .process = 3}), "rounds: -7 is not >= 1");
  EXPECT_EQ(refused({.rounds = 5, .warmup = -6, .process = 3}), "warmup: -6 is not >= 0");
}

TEST(RunRounds, RefusesToMeasureNothing) {
  Recorder recorder;
  EXPECT_THROW(recorder.run({.rounds = 0}), InputError);
  EXPECT_THROW(recorder.run({.warmup = -1}), InputError);
  recorder.tasks[1].name = "a";
  EXPECT_THROW(recorder.run({}), InputError);
  recorder.tasks.clear();
  EXPECT_THROW(recorder.run({}), InputError);
  EXPECT_EQ(recorder.log, "");
}

TEST(PairedRatio, CancelsWhatDisturbsAWholeRound) {
  std::vector<Sample> samples;
  for (int process = 0; process < 6; ++process)
    for (int round = 0; round < 5; ++round) {
      const std::int64_t slowness = 1 << ((round * 3 + process) % 7);
      samples.push_back(sample_of("walk", process, round, 300 * slowness));
      samples.push_back(sample_of("base", process, round, 200 * slowness));
    }
  std::reverse(samples.begin(), samples.end());  // their order does not matter
  const Ratio ratio = paired_ratio(samples, "walk", "base");
  EXPECT_EQ(ratio.cpu.median, 1.5);
  EXPECT_EQ(ratio.wall.median, 1.5);
  EXPECT_EQ(ratio.cpu.interval.low, 1.5);
  EXPECT_EQ(ratio.cpu.interval.high, 1.5);
  EXPECT_EQ(ratio.rounds, 30u);
  EXPECT_EQ(ratio.flagged_rounds, 0u);
}

TEST(PairedRatio, TakesTheIntervalOverProcessesNotRounds) {
  // process p has ratio p in most of its 99 rounds, and one disturbed round that the median of the process ignores
  std::vector<Sample> samples;
  for (int process = 1; process <= 6; ++process)
    for (int round = 0; round < 99; ++round) {
      samples.push_back(sample_of("base", process, round, 100));
      samples.push_back(sample_of("walk", process, round, round == 42 ? 10000 : 100 * process));
    }
  const Ratio ratio = paired_ratio(samples, "walk", "base");
  EXPECT_EQ(ratio.cpu_of_process, (std::vector<double>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(ratio.cpu.median, 3.5);
  EXPECT_EQ(ratio.cpu.interval.low, 1.0);
  EXPECT_EQ(ratio.cpu.interval.high, 6.0);
  EXPECT_DOUBLE_EQ(ratio.cpu.interval.coverage, 62.0 / 64.0);
  EXPECT_EQ(ratio.flagged_rounds, 6u);
  EXPECT_EQ(to_string(ratio.cpu), "3.5 [1, 6] at 96.9 %");
}

TEST(PairedRatio, OfOneProcessClaimsNoConfidence) {
  std::vector<Sample> samples;
  for (int round = 0; round < 50; ++round) {
    samples.push_back(sample_of("base", 0, round, 100));
    samples.push_back(sample_of("walk", 0, round, 100 + round));
  }
  const Ratio ratio = paired_ratio(samples, "walk", "base");
  EXPECT_EQ(ratio.cpu.interval.coverage, 0.0);
  EXPECT_FALSE(ratio.cpu.interval.reached);
}

TEST(PairedRatio, RefusesRoundsWithoutAPartner) {
  const auto walk = sample_of("walk", 0, 0, 1), base = sample_of("base", 0, 0, 1);
  const auto later_walk = sample_of("walk", 0, 1, 1), later_base = sample_of("base", 0, 1, 1);
  const auto instant = sample_of("base", 0, 0, 0);
  EXPECT_THROW(paired_ratio(std::vector{walk}, "walk", "base"), InputError);
  EXPECT_THROW(paired_ratio(std::vector{walk, base, later_walk}, "walk", "base"), InputError);
  EXPECT_THROW(paired_ratio(std::vector{walk, base, later_base}, "walk", "base"), InputError);
  EXPECT_THROW(paired_ratio(std::vector{walk, walk, base}, "walk", "base"), InputError);
  EXPECT_THROW(paired_ratio(std::vector{walk, instant}, "walk", "base"), InputError);
}

TEST(Times, AreMediansOfProcessesBesideTheMinimum) {
  const std::vector samples{sample_of("walk", 0, 0, 10), sample_of("walk", 0, 1, 20), sample_of("walk", 0, 2, 90),
                            sample_of("walk", 1, 0, 40)};
  const Times times = times_of(samples, "walk");
  EXPECT_EQ(times.cpu_median, 30.0);  // of 20 and 40
  EXPECT_EQ(times.cpu_min, 10.0);
  EXPECT_EQ(times.wall_median, 60.0);
  EXPECT_THROW(times_of(samples, "base"), InputError);
}

TEST(Hashes, OfATaskThatRepeatsItselfAreOne) {
  const std::vector samples{sample_of("walk", 0, 0, 1, 7), sample_of("walk", 1, 0, 1, 7), sample_of("base", 0, 0, 1, 9),
                            sample_of("base", 1, 0, 1, 8)};
  EXPECT_EQ(hashes_of(samples, "walk"), (std::vector<std::uint64_t>{7}));
  EXPECT_EQ(hashes_of(samples, "base"), (std::vector<std::uint64_t>{8, 9}));
}

TEST(Hashes, AreCheckedOfEveryTaskOverAllRoundsAndProcesses) {
  const std::vector steady{sample_of("walk", 0, 0, 1, 7), sample_of("walk", 1, 0, 1, 7), sample_of("base", 0, 0, 1, 9)};
  EXPECT_NO_THROW(check_repeats(steady));
  auto unsteady = steady;
  unsteady.push_back(sample_of("base", 1, 0, 1, 8));
  EXPECT_THROW(check_repeats(unsteady), SolverError);
}

TEST(Sample, SurvivesTheWayThroughJson) {
  const Sample sample{"walk", 3, 14, 2, 123456789012, 123456789013, 0xFEDCBA9876543210};
  const Sample back = nlohmann::json::parse(nlohmann::json(sample).dump()).get<Sample>();
  EXPECT_EQ(back.task, sample.task);
  EXPECT_EQ(back.process, sample.process);
  EXPECT_EQ(back.round, sample.round);
  EXPECT_EQ(back.position, sample.position);
  EXPECT_EQ(back.cpu_ns, sample.cpu_ns);
  EXPECT_EQ(back.wall_ns, sample.wall_ns);
  EXPECT_EQ(back.hash, sample.hash);

  nlohmann::json broken = sample;
  broken["hash"] = "12 apples";
  EXPECT_THROW(broken.get<Sample>(), InputError);
}

}  // namespace
}  // namespace dartboard::paired_test
