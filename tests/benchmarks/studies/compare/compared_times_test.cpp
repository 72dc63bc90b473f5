#include "benchmarks/studies/compare/compared_times.h"

#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"

namespace dartboard::compared_times_test {
namespace {

/// Five tasks in processes of three rounds, whose times scatter by two percent, and by twenty with the process.
TimedTasks timed(unsigned seed, int processes, double machine = 1.0, double of_third = 1.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> scatter(0.0, 0.02), drift(0.0, 0.2);
  TimedTasks run;
  for (int p = 0; p < processes; ++p) {
    const double slow = machine * std::exp(drift(random));
    for (int k = 0; k < 5; ++k)
      for (int round = 0; round < 3; ++round)
        run.tasks["task " + std::to_string(k)].ns[p].push_back(1000.0 * (k + 1) * slow * (k == 2 ? of_third : 1.0) *
                                                               std::exp(scatter(random)));
  }
  return run;
}

TEST(ComparedTimes, FindNoDifferenceInTwoRunsOfOneProgramOnAnotherMachine) {
  const ComparedTimes found = compare_times(timed(1, 11), timed(2, 11, 1.5), 0.03);
  ASSERT_EQ(found.tasks.size(), 5U);
  for (const ComparedTask& t : found.tasks) {
    EXPECT_NE(t.verdict, TimeVerdict::slower) << t.task;
    EXPECT_NE(t.verdict, TimeVerdict::faster) << t.task;
    EXPECT_NEAR(t.shift.median, 1.0, 0.03) << t.task;
  }
  EXPECT_NEAR(found.all.median, 1.5, 0.45) << "three times the scatter of a median over eleven processes";
}

TEST(ComparedTimes, FindTheOneTaskThatBecameSlowerThoughTheMachineIsFaster) {
  const ComparedTimes found = compare_times(timed(1, 11), timed(2, 11, 0.5, 1.1), 0.03);
  for (const ComparedTask& t : found.tasks)
    EXPECT_EQ(t.verdict == TimeVerdict::slower, t.task == "task 2") << t.task << " " << t.shift.median;
  EXPECT_NEAR(found.tasks[2].shift.median, 1.1, 0.04);
  const ComparedTimes back = compare_times(timed(2, 11, 0.5, 1.1), timed(1, 11), 0.03);
  EXPECT_EQ(back.tasks[2].verdict, TimeVerdict::faster);
}

TEST(ComparedTimes, CountNoChangeThatIsTooSmall) {
  const ComparedTimes found = compare_times(timed(1, 11), timed(2, 11, 1.0, 1.1), 0.3);
  for (const ComparedTask& t : found.tasks) EXPECT_EQ(t.verdict, TimeVerdict::same) << t.task;
}

TEST(ComparedTimes, CannotTellByTooFewProcesses) {
  const ComparedTimes found = compare_times(timed(1, 4), timed(2, 4, 1.0, 2.0), 0.03);
  for (const ComparedTask& t : found.tasks) EXPECT_EQ(t.verdict, TimeVerdict::cannot_tell) << t.task;
}

TEST(ComparedTimes, OfOneTaskAreComparedAsTheyAre) {
  const auto one = [](unsigned seed, double factor) {
    TimedTasks run;
    run.tasks["alone"] = timed(seed, 11, factor).tasks.at("task 0");
    return run;
  };
  EXPECT_EQ(compare_times(one(1, 1.0), one(2, 3.0), 0.03).tasks.at(0).verdict, TimeVerdict::slower);
}

TEST(ComparedTimes, NameTasksOfOneRunAloneAndThoseThatLeaveOtherBits) {
  TimedTasks first = timed(1, 6), second = timed(2, 6);
  first.tasks["old"] = first.tasks["task 0"];
  second.tasks["new"] = second.tasks["task 0"];
  first.tasks["task 1"].hashes = {"a"};
  second.tasks["task 1"].hashes = {"b"};
  const ComparedTimes found = compare_times(first, second, 0.03);
  EXPECT_EQ(found.alone, (std::vector<std::string>{"old", "new"}));
  for (const ComparedTask& t : found.tasks) EXPECT_EQ(t.same_state, t.task != "task 1");
}

class TimedTasksOfFolder : public FolderTest {};

TEST_F(TimedTasksOfFolder, AreReadPerStepWithTheTextsThatTellThemApart) {
  std::filesystem::create_directories(folder_ / "larger");
  std::ofstream(folder_ / "samples.jsonl")
      << R"({"task": "orbit", "body": "liver", "process": 0, "round": 0, "cpu_ns": 100, "steps": 20, "hash": "0a"})"
      << "\n"
      << R"({"body": "liver", "bytes": 3})"
      << "\n";
  std::ofstream(folder_ / "larger" / "samples.jsonl") << R"({"task": "step", "process": 2, "cpu_ns": 7})"
                                                      << "\n";
  const TimedTasks run = read_timed_tasks(folder_);
  ASSERT_EQ(run.tasks.size(), 2U);
  EXPECT_EQ(run.tasks.at("liver, orbit").ns.at(0), std::vector{5.0});
  EXPECT_EQ(run.tasks.at("liver, orbit").hashes, std::set<std::string>{"0a"});
  EXPECT_EQ(run.tasks.at("larger: step").ns.at(2), std::vector{7.0});
}

TEST_F(TimedTasksOfFolder, AreRefusedWithTheirLineWhereItIsCutOff) {
  std::ofstream(folder_ / "samples.jsonl") << R"({"task": "a", "process": 0, "cpu_ns": 7})"
                                           << "\n"
                                           << R"({"task": "a", "proc)";
  try {
    read_timed_tasks(folder_);
    FAIL() << "accepted";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("samples.jsonl:2: "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dartboard::compared_times_test
