// A run with its files: what it writes, how it goes on from its checkpoint, and its verdict.

#include "core/scene/recorded_run.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/base/thread_team.h"
#include "core/plain/error.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::recorded_run_test {
namespace {

using namespace moving;

class RecordedRuns : public FolderTest {
 protected:
  /// The moving box with a cut, in ten steps, a frame in every fifth.
  static Json cut_box() {
    Json json = with_events(
        moving_box(), R"([{"at": 0.004, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
    json["output"] =
        Json::parse(R"({"frames_every": {"steps": 5}, "diagnostics_every": {"steps": 1}, "checkpoint": 0.002})");
    json["expect"] = {{"components", 2}, {"cells", 48}};
    return json;
  }
  /// The message with which a run in the folder is not continued.
  std::string refusal(const char* folder, std::optional<std::uint64_t> most_steps = {}) const {
    try {
      RecordedRun::continued(folder_ / folder, most_steps).open();
      return "continued";
    } catch (const std::exception& error) {
      return error.what();
    }
  }
};

TEST_F(RecordedRuns, WriteFramesAndTablesIntoTheirFolder) {
  RecordedRun run(parse(cut_box()), {.folder = folder_ / "run"});
  run.run();
  EXPECT_EQ(run.frame_count(), 3u);
  for (const char* name : {"frame_000000.vtu", "frame_000002.vtu", "frames.pvd", "diagnostics.csv", "checkpoint"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / name)) << name;
  const std::string rows = text("run/diagnostics.csv");
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 11);
}

// Frames are written by another thread where there is one.
TEST_F(RecordedRuns, WriteTheSameFilesWithAnyNumberOfThreads) {
  RecordedRun alone(parse(cut_box()), {.folder = folder_ / "alone"});
  alone.run();
  const unsigned before = use_threads(2);
  {
    RecordedRun together(parse(cut_box()), {.folder = folder_ / "together"});
    together.run();
    EXPECT_EQ(together.frame_count(), 3u);
  }
  use_threads(before);
  for (const char* name :
       {"frame_000000.vtu", "frame_000001.vtu", "frame_000002.vtu", "frames.pvd", "diagnostics.csv", "checkpoint"})
    EXPECT_EQ(text(std::string("alone/") + name), text(std::string("together/") + name)) << name;
}

TEST_F(RecordedRuns, CompressTheirFramesAsTheSceneAsks) {
  Json json = cut_box();
  for (const char* how : {"no", "zlib", "lz4"}) {
    json["output"]["compressed"] = how;
    RecordedRun run(parse(json), {.folder = folder_ / how});
    run.run();
  }
  EXPECT_EQ(text("no/frame_000002.vtu").find("compressor"), std::string::npos);
  EXPECT_NE(text("zlib/frame_000002.vtu").find("compressor=\"vtkZLibDataCompressor\""), std::string::npos);
  EXPECT_NE(text("lz4/frame_000002.vtu").find("compressor=\"vtkLZ4DataCompressor\""), std::string::npos);
}

TEST_F(RecordedRuns, ThrowWhatAnotherThreadHasThrown) {
  Json json = cut_box();
  json["output"].erase("checkpoint");
  const unsigned before = use_threads(2);
  RecordedRun run(parse(json), {.folder = folder_ / "run"});
  run.open();
  std::filesystem::create_directory(folder_ / "run" / "frame_000002.vtu");  // the last of three
  EXPECT_THROW(run.run(), IoError);
  use_threads(before);
}

TEST_F(RecordedRuns, LeaveNothingBehindForAWrongScene) {
  Json wrong = cut_box();
  wrong["events"][0]["dissociate"] = {{"points", {{0, 1, 99}}}};
  EXPECT_THROW(RecordedRun(parse(wrong), {.folder = folder_ / "run"}), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "run"));
}

TEST_F(RecordedRuns, WithoutAFolderWriteNothing) {
  RecordedRun run(parse(cut_box()));
  run.run();
  EXPECT_EQ(run.simulation().steps_done(), 10u);
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
  EXPECT_EQ(run.continues_after(), std::nullopt);
}

struct Rows : RunWatcher {
  explicit Rows(bool with_frames) : takes(with_frames) {}
  bool takes;
  std::size_t frames = 0;
  std::vector<Diagnostics> rows = {};

  bool takes_frames() const override { return takes; }
  void frame(const Frame&) override { ++frames; }
  void diagnostics(const Diagnostics& row) override { rows.push_back(row); }
};

TEST_F(RecordedRuns, MakeNoFramesWhereNoneAreTaken) {
  Rows with(true), without(false);
  RecordedRun(parse(cut_box()), {.most_steps = 8}).run(with);
  RecordedRun(parse(cut_box()), {.most_steps = 8}).run(without);
  EXPECT_EQ(with.frames, 3u);  // at 0, 5 and the last
  EXPECT_EQ(without.frames, 0u);
  ASSERT_EQ(with.rows.size(), without.rows.size());
  for (std::size_t k = 0; k < with.rows.size(); ++k) {
    EXPECT_EQ(with.rows[k].largest_stress, without.rows[k].largest_stress);
    EXPECT_EQ(with.rows[k].elastic, without.rows[k].elastic);
  }
  // the folder takes them, whoever else does not
  Rows beside(false);
  RecordedRun(parse(cut_box()), {.folder = folder_ / "run"}).run(beside);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "run" / "frame_000002.vtu"));
  EXPECT_EQ(beside.frames, 3u);
}

TEST_F(RecordedRuns, HoldWhereAllIsAsTheSceneExpects) {
  RecordedRun run(parse(cut_box()));
  run.run();
  ASSERT_EQ(run.expected().size(), 2u);
  EXPECT_TRUE(run.holds());
  EXPECT_EQ(run.unjudged(), "");
}

TEST_F(RecordedRuns, DoNotHoldWhereAnExpectationFails) {
  Json json = cut_box();
  json["expect"]["components"] = 3;
  RecordedRun run(parse(json));
  run.run();
  EXPECT_FALSE(run.holds());
}

TEST_F(RecordedRuns, DoNotHoldWhereTheMotionDiverges) {
  Json json = cut_box();
  json["step"] = 0.5;
  json["duration"] = 50;
  json["output"].erase("checkpoint");
  RecordedRun run(parse(json), {.folder = folder_ / "run"});
  run.run();
  EXPECT_TRUE(run.result().divergence);
  EXPECT_FALSE(run.holds());
  EXPECT_TRUE(run.expected().empty());
  EXPECT_EQ(run.continues_after(), std::nullopt);
}

TEST_F(RecordedRuns, ThatAreCutShortAreNotJudgedAndGoOnToTheSameFiles) {
  RecordedRun whole(parse(cut_box()), {.folder = folder_ / "whole"});
  whole.run();
  // the text of the scene has to be there for the continuation: it is in the checkpoint
  RecordedRun first(parse(cut_box()), {.folder = folder_ / "parts", .most_steps = 7});
  EXPECT_EQ(first.last_step(), 7u);
  first.run();
  EXPECT_EQ(first.unjudged(), "The run was cut short: what the scene expects of its end is not judged.");
  EXPECT_TRUE(first.expected().empty());
  EXPECT_EQ(first.continues_after(), 7u);
  {
    const RecordedRun done = std::move(first);  // gives its folder up
  }
  RecordedRun second = RecordedRun::continued(folder_ / "parts");
  EXPECT_EQ(second.first_step(), 7u);
  EXPECT_EQ(second.simulation().steps_done(), 0u);  // at the start until it is opened
  second.run();
  EXPECT_TRUE(second.holds());
  EXPECT_EQ(second.expected().size(), 2u);
  EXPECT_EQ(second.continues_after(), std::nullopt);
  EXPECT_EQ(second.simulation().body().state_hash(), whole.simulation().body().state_hash());
  for (const char* name : {"frame_000001.vtu", "frame_000002.vtu", "frames.pvd", "diagnostics.csv"})
    EXPECT_EQ(text("parts/" + std::string(name)), text("whole/" + std::string(name))) << name;
}

TEST_F(RecordedRuns, ThatHaveNoStepLeftAreNotContinued) {
  {
    RecordedRun(parse(cut_box()), {.folder = folder_ / "whole"}).run();
    RecordedRun(parse(cut_box()), {.folder = folder_ / "part", .most_steps = 7}).run();
  }
  EXPECT_NE(refusal("whole").find("the run has come to its end, after 10 steps"), std::string::npos)
      << refusal("whole");
  EXPECT_NE(refusal("part", 5).find("is to stop after 5 steps, and its checkpoint is one after 7 steps"),
            std::string::npos)
      << refusal("part", 5);
  EXPECT_EQ(refusal("part"), "continued");
}

TEST_F(RecordedRuns, OfASceneThatAsksForAnAccuracyHaveTheStepChosenForIt) {
  Json json = cut_box();
  const double step = json.at("step");
  json.erase("step");
  json["accuracy"] = 0.001;
  EXPECT_THROW(RecordedRun(parse(json)), InputError);
  const auto choose = [step](SceneFile& scene) {
    EXPECT_EQ(scene.accuracy, 0.001);
    scene.step = step;
    scene.integrator = "verlet";
    return std::optional(SettledAccuracy{.accuracy = 0.001, .integrator = "verlet", .step = step, .predicted_s = 17.0});
  };
  {
    RecordedRun run(parse(json), {.folder = folder_ / "run", .most_steps = 7, .choose_step = choose});
    EXPECT_EQ(run.simulation().step_count(), 10u);
    run.run();
  }
  const RecordedRun continued = RecordedRun::continued(folder_ / "run");
  ASSERT_TRUE(continued.settled());
  EXPECT_EQ(continued.settled()->integrator, "verlet");
  EXPECT_EQ(continued.settled()->step, step);
  EXPECT_EQ(continued.settled()->predicted_s, 17.0);
}

TEST_F(RecordedRuns, OfOtherCellsThanTheScenesAreNotJudged) {
  Json json = cut_box();
  json["events"] = Json::parse(R"([{"at": 0.004, "remove": {"random": {"count": 2, "seed": 1}}}])");
  json["expect"] = {{"cells", 46}};
  SceneFile scene = parse(json);
  ASSERT_TRUE(reseed(scene, 3));
  RecordedRun run(std::move(scene));
  run.run();
  EXPECT_EQ(run.unjudged(), "Other cells were drawn than the scene's own: what it expects is not judged.");
  EXPECT_TRUE(run.expected().empty());
}

/// Counts what it receives, and interrupts before a step.
struct Counter : RunWatcher {
  std::size_t frames = 0, rows = 0, checkpoints = 0, steps = 0, most = 1000;
  void frame(const Frame&) override { ++frames; }
  void diagnostics(const Diagnostics&) override { ++rows; }
  void checkpoint(const Simulation&, const RunProgress&) override { ++checkpoints; }
  void stepped(const Simulation&) override { ++steps; }
  bool interrupts() override { return steps + 1 == most; }
};

TEST_F(RecordedRuns, HandAllThatTheyWriteToTheirWatcher) {
  RecordedRun run(parse(cut_box()), {.folder = folder_ / "run"});
  Counter counter;
  run.run(counter);
  EXPECT_EQ(counter.frames, 3u);
  EXPECT_EQ(counter.rows, 11u);
  EXPECT_EQ(counter.checkpoints, 5u);
  EXPECT_EQ(counter.steps, 10u);
}

TEST_F(RecordedRuns, EndWhereTheirWatcherInterrupts) {
  RecordedRun run(parse(cut_box()), {.folder = folder_ / "run"});
  Counter counter;
  counter.most = 3;
  run.run(counter);
  EXPECT_TRUE(run.result().interrupted);
  EXPECT_EQ(run.continues_after(), 3u);
  EXPECT_EQ(run.unjudged(), "Interrupted after 3 steps, t = 0.003 s: what the scene expects of its end is not judged.");
}

}  // namespace
}  // namespace dartboard::recorded_run_test
