#pragma once
// The complete output of a run, as text; cut short somewhere, and continued from the checkpoint there.

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/archive.h"
#include "core/scene/output/write_vtu.h"
#include "core/scene/run/scene_run.h"

namespace dartboard::recorded {

struct Record : RunWatcher {
  std::vector<std::string> frames, rows, probe_rows;
  // at the last checkpoint
  std::optional<std::string> state;
  std::vector<std::uint64_t> checkpoints;  // the steps of all of them
  std::size_t frames_then = 0, rows_then = 0, probe_rows_then = 0;
  std::optional<std::uint64_t> interrupt_after;

  void frame(const Frame& frame) override {
    frames.push_back(to_vtu(frame));
    for (const RefinedFacet& facet : frame.refined_facets)  // not in files, but in pictures
      for (std::size_t k = 0; k < 3; ++k)
        frames.back() += std::to_string(facet.points[k]) + ' ' + std::to_string(facet.lies_in[k]) + '\n';
  }
  void diagnostics(const Diagnostics& d) override { rows.push_back(diagnostics_row(d)); }
  void probes(const ProbeRow& row) override { probe_rows.push_back(probes_row(row)); }
  void checkpoint(const Simulation& simulation, const RunProgress& now) override {
    Archive archive;
    simulation.save(archive);
    RunProgress copy = now;
    archive(copy);
    state = archive.written();
    frames_then = frames.size();
    rows_then = rows.size();
    probe_rows_then = probe_rows.size();
    checkpoints.push_back(simulation.steps_done());
  }
  void stepped(const Simulation& simulation) override { done_ = simulation.steps_done(); }
  // called before `stepped`
  bool interrupts() override { return interrupt_after && done_ + 1 == *interrupt_after; }
  /// Drops the output after the checkpoint.
  void cut_back() {
    frames.resize(frames_then);
    rows.resize(rows_then);
    probe_rows.resize(probe_rows_then);
  }

 private:
  std::uint64_t done_ = 0;
};

struct RunInMemory {
  Record record;
  std::unique_ptr<Simulation> simulation;
  RunResult result;
};

inline RunInMemory whole(const SceneFile& scene) {
  RunInMemory run;
  run.simulation = std::make_unique<Simulation>(scene);
  run.simulation->watch_events(true);
  run.result = run_scene(*run.simulation, scene.output, run.record);
  return run;
}

/// The output of a run up to its checkpoint and, by a new simulation, after it.
inline RunInMemory continued(const SceneFile& scene, Record record) {
  RunInMemory run;
  run.record = std::move(record);
  run.record.cut_back();
  run.record.interrupt_after.reset();
  run.simulation = std::make_unique<Simulation>(scene);
  run.simulation->watch_events(true);
  Archive archive(*run.record.state, "state");
  run.simulation->load(archive);
  RunProgress progress;
  archive(progress);
  archive.require_end();
  run.result = run_scene(*run.simulation, scene.output, run.record, {}, &progress);
  return run;
}

/// The run interrupted after so many steps, and continued.
inline RunInMemory in_two(const SceneFile& scene, std::uint64_t steps) {
  Simulation first(scene);
  first.watch_events(true);
  Record record;
  record.interrupt_after = steps;
  const RunResult result = run_scene(first, scene.output, record);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(first.steps_done(), steps);
  return continued(scene, std::move(record));
}

inline std::string text(const std::optional<Divergence>& divergence) {
  return divergence ? to_string(*divergence) + " back " + std::to_string(divergence->taken_back) : "none";
}

inline void expect_same(const RunInMemory& a, const RunInMemory& b) {
  EXPECT_EQ(a.simulation->body().state_hash(), b.simulation->body().state_hash());
  EXPECT_EQ(a.simulation->steps_done(), b.simulation->steps_done());
  EXPECT_EQ(a.record.rows, b.record.rows);
  EXPECT_EQ(a.record.probe_rows, b.record.probe_rows);
  EXPECT_EQ(a.record.frames.size(), b.record.frames.size());
  EXPECT_TRUE(a.record.frames == b.record.frames) << "frames differ";
  EXPECT_EQ(diagnostics_row(a.result.first), diagnostics_row(b.result.first));
  EXPECT_EQ(diagnostics_row(a.result.last), diagnostics_row(b.result.last));
  EXPECT_EQ(a.result.energy_drift, b.result.energy_drift);
  EXPECT_EQ(text(a.result.divergence), text(b.result.divergence));
  EXPECT_EQ(a.result.refusal.has_value(), b.result.refusal.has_value());
  EXPECT_EQ(a.simulation->operations(), b.simulation->operations());
  EXPECT_EQ(a.simulation->idle_events(), b.simulation->idle_events());
  EXPECT_EQ(a.simulation->body().violation(), b.simulation->body().violation());
  EXPECT_EQ(a.simulation->body().removed_mass(), b.simulation->body().removed_mass());
  EXPECT_EQ(a.simulation->step_warning().has_value(), b.simulation->step_warning().has_value());
  const EventJumps &ja = a.simulation->jumps(), &jb = b.simulation->jumps();
  EXPECT_EQ(ja.events, jb.events);
  EXPECT_EQ(ja.mass, jb.mass);
  EXPECT_EQ(ja.momentum, jb.momentum);
  EXPECT_EQ(ja.energy, jb.energy);
  const WorkCounters &wa = a.simulation->work(), &wb = b.simulation->work();
  EXPECT_EQ(wa.steps, wb.steps);
  EXPECT_EQ(wa.force_evaluations, wb.force_evaluations);
  EXPECT_EQ(wa.factorisations, wb.factorisations);
  EXPECT_EQ(wa.rank_one_updates, wb.rank_one_updates);
  EXPECT_EQ(wa.linear_iterations, wb.linear_iterations);
}

}  // namespace dartboard::recorded
