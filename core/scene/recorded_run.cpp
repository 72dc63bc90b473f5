#include "core/scene/recorded_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/base/counted.h"
#include "core/base/thread_team.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/survey/scene_warnings.h"

namespace dartboard {
namespace fs = std::filesystem;
namespace {

std::optional<SettledAccuracy> settle(SceneFile& scene, const RecordPlan& plan, const Checkpoint* checkpoint) {
  if (checkpoint == nullptr) return plan.choose_step ? plan.choose_step(scene) : std::nullopt;
  if (checkpoint->notes().empty()) return {};
  return nlohmann::json::parse(checkpoint->notes()).get<SettledAccuracy>();
}

}  // namespace

/// Writes what the run hands out, and passes it on.
class RecordedRun::Recorder : public RunWatcher {
 public:
  Recorder(RecordedRun& run, RunWatcher& next) : run_(run), next_(next) {}

  void frame(const Frame& frame) override {
    if (run_.output_) threads_in_use() > 1 ? run_.output_->write_later(frame) : run_.output_->write(frame);
    next_.frame(frame);
  }
  bool takes_frames() const override { return run_.output_ || next_.takes_frames(); }
  void diagnostics(const Diagnostics& diagnostics) override {
    if (run_.output_) run_.output_->write(diagnostics);
    next_.diagnostics(diagnostics);
  }
  void probes(const ProbeRow& row) override {
    if (run_.output_) run_.output_->write(row);
    next_.probes(row);
  }
  void checkpoint(const Simulation& simulation, const RunProgress& progress) override {
    if (run_.output_) {
      const std::string notes = run_.settled() ? nlohmann::json(*run_.settled()).dump() : "";
      Checkpoint::write(run_.folder() / checkpoint_name, run_.scene(), simulation, progress, run_.output_->so_far(),
                        notes);
      run_.continues_after_ = simulation.steps_done();
    }
    next_.checkpoint(simulation, progress);
  }
  void stepped(const Simulation& simulation) override { next_.stepped(simulation); }
  bool interrupts() override { return next_.interrupts(); }

 private:
  RecordedRun& run_;
  RunWatcher& next_;
};

RecordedRun::RecordedRun(SceneFile scene, RecordPlan plan) : RecordedRun(std::move(scene), std::move(plan), {}, {}) {}

RecordedRun::RecordedRun(SceneFile scene, RecordPlan plan, std::unique_ptr<Checkpoint> checkpoint,
                         std::optional<FolderClaim> claim)
    : plan_(std::move(plan)),
      settled_(settle(scene, plan_, checkpoint.get())),
      scene_(std::make_unique<SceneFile>(std::move(scene))),
      checkpoint_(std::move(checkpoint)),
      claim_(std::move(claim)) {
  const Problem problem = make_problem(*scene_);
  simulation_ = std::make_unique<Simulation>(*scene_, problem);
  survey_ = survey_scene(*scene_, problem, *simulation_);
  warnings_ = warnings_of(*scene_, survey_, *simulation_);
  removed_at_start_ = simulation_->body().removed_mass();
  simulation_->watch_events(true);
}

RecordedRun RecordedRun::continued(const fs::path& folder, std::optional<std::uint64_t> most_steps) {
  std::optional<FolderClaim> claim = FolderClaim::of_ended_run(folder);
  auto checkpoint = std::make_unique<Checkpoint>(folder / checkpoint_name);
  SceneFile scene = checkpoint->scene();
  RecordPlan plan{.folder = folder, .most_steps = most_steps};
  RecordedRun run(std::move(scene), std::move(plan), std::move(checkpoint), std::move(claim));
  const std::string done = counted(run.first_step(), "step");
  if (run.first_step() >= run.simulation().step_count())
    throw InputError(
        fmt::format("{}: the run has come to its end, after {}; expected one that can go on, or a longer 'duration' in "
                    "its scene",
                    folder.string(), done));
  if (run.last_step() <= run.first_step())
    throw InputError(fmt::format("{}: the run is to stop after {}, and its checkpoint is one after {}; expected more",
                                 folder.string(), counted(*most_steps, "step"), done));
  return run;
}

std::uint64_t RecordedRun::last_step() const {
  return std::min(simulation_->step_count(), plan_.most_steps.value_or(simulation_->step_count()));
}

void RecordedRun::open() {
  if (std::exchange(is_open_, true)) return;
  if (checkpoint_) {
    checkpoint_->load_into(*simulation_);
    output_.emplace(std::move(*claim_), plan_.folder, checkpoint_->output(), scene_->probes);
    continues_after_ = checkpoint_->steps_done();
  } else if (!plan_.folder.empty()) {
    output_.emplace(plan_.folder, scene_->probes, simulation_->dimension(), !scene_->forces.empty(),
                    scene_->has_contact(), scene_->sleep.has_value());
  }
  if (output_) output_->compress(scene_->output.compressor);
}

void RecordedRun::run() {
  RunWatcher nothing;
  run(nothing);
}

void RecordedRun::run(RunWatcher& watcher) {
  open();
  Recorder recorder(*this, watcher);
  result_ = run_scene(*simulation_, scene_->output, recorder, plan_.most_steps,
                      checkpoint_ ? &checkpoint_->progress() : nullptr);
  if (output_) output_->finish();
  judge();
}

void RecordedRun::judge() {
  const bool is_over = simulation_->steps_done() >= simulation_->step_count();
  if (is_over || result_.ended_early()) continues_after_.reset();
  SceneFile reseeded = *scene_;
  if (result_.interrupted)
    unjudged_ = fmt::format("Interrupted after {}, t = {:.6g} s: what the scene expects of its end is not judged.",
                            counted(simulation_->steps_done(), "step"), simulation_->time());
  else if (!is_over && !result_.ended_early())
    unjudged_ = "The run was cut short: what the scene expects of its end is not judged.";
  else if (scene_->added_seed != 0 && reseed(reseeded, 1))
    unjudged_ = "Other cells were drawn than the scene's own: what it expects is not judged.";
  else if (!result_.ended_early())
    expected_ = compare_with_expectation(*scene_, *simulation_, result_);
}

bool RecordedRun::holds() const {
  return !result_.ended_early() && std::ranges::all_of(expected_, &ExpectedRow::holds);
}

}  // namespace dartboard
