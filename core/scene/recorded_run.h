#pragma once
// A run of a scene from its start or from a checkpoint to its end, with all that it writes and its verdict.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/folder_claim.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/restart/checkpoint.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"
#include "core/scene/settled_accuracy.h"
#include "core/scene/survey/scene_survey.h"

namespace dartboard {

struct RecordPlan {
  std::filesystem::path folder{};             // new or empty; without one nothing is written
  std::optional<std::uint64_t> most_steps{};  // after which the run is cut short
  // gives a scene that asks for an accuracy its step; without it, such a scene needs one already
  std::function<std::optional<SettledAccuracy>(SceneFile&)> choose_step{};
};

/// The files of a run are those of `SceneOutput`, and the checkpoint that it can be continued from.
class RecordedRun {
 public:
  /// A run from the start of a scene.
  ///
  /// throws  as Simulation and `choose_step`
  explicit RecordedRun(SceneFile scene, RecordPlan plan = {});
  /// The rest of a run that left a checkpoint in its folder. Its output will be that of an uninterrupted run.
  ///
  /// throws  IoError as FolderClaim::of_ended_run and Checkpoint; InputError if the scene or its mesh has changed, and if
  ///         no step is left
  static RecordedRun continued(const std::filesystem::path& folder, std::optional<std::uint64_t> most_steps = {});

  const SceneFile& scene() const { return *scene_; }
  /// At the start of the scene until `open` or `run`, for a continued run too.
  const Simulation& simulation() const { return *simulation_; }
  /// What is known before the first step.
  const SceneSurvey& survey() const { return survey_; }
  /// The warnings before the first step.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// The choice of the step, if one was made; a continued run keeps that of its start.
  const std::optional<SettledAccuracy>& settled() const { return settled_; }
  const std::filesystem::path& folder() const { return plan_.folder; }
  /// The numbers of steps taken when the run begins, above 0 if it is continued, and when it ends.
  std::uint64_t first_step() const { return checkpoint_ ? checkpoint_->steps_done() : 0; }
  std::uint64_t last_step() const;

  /// Create the folder, or go to the checkpoint and the output until then. `run` does so first.
  ///
  /// throws  IoError as SceneOutput and Checkpoint::load_into
  void open();
  /// Run to the end, until the watcher interrupts, or until it ends early (scene_run.h); to be called once. The
  /// watcher receives all that is written, after it has been.
  ///
  /// throws  IoError if a file cannot be written
  void run(RunWatcher& watcher);
  void run();

  // ---- after the run

  const RunResult& result() const { return result_; }
  /// The expectations of the scene compared with its end; empty where there is no verdict, and then `unjudged` has the
  /// reason, unless the run ended early or nothing is expected.
  const std::vector<ExpectedRow>& expected() const { return expected_; }
  const std::string& unjudged() const { return unjudged_; }
  /// No divergence, no step that was refused, and no expectation that fails.
  bool holds() const;
  /// The step of the checkpoint that the run can be continued from.
  const std::optional<std::uint64_t>& continues_after() const { return continues_after_; }
  std::size_t frame_count() const { return output_ ? output_->frame_count() : 0; }
  /// [kg] of what events at the start removed, before the first state that is handed out.
  double removed_at_start() const { return removed_at_start_; }

 private:
  class Recorder;
  RecordedRun(SceneFile scene, RecordPlan plan, std::unique_ptr<Checkpoint> checkpoint,
              std::optional<FolderClaim> claim);
  void judge();

  RecordPlan plan_;
  std::optional<SettledAccuracy> settled_;
  std::unique_ptr<SceneFile> scene_;
  std::unique_ptr<Simulation> simulation_;
  SceneSurvey survey_;
  std::vector<std::string> warnings_;
  double removed_at_start_ = 0.0;
  std::unique_ptr<Checkpoint> checkpoint_;  // null from the start
  std::optional<FolderClaim> claim_;        // of a continued run, until `open`
  std::optional<SceneOutput> output_;
  bool is_open_ = false;

  RunResult result_;
  std::vector<ExpectedRow> expected_;
  std::string unjudged_;
  std::optional<std::uint64_t> continues_after_;
};

}  // namespace dartboard
