#include "benchmarks/studies/large/large_bodies.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <vector>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_fields.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/harness/statistics.h"
#include "benchmarks/studies/step/machine_limits.h"
#include "core/base/bytes.h"
#include "core/base/thread_team.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/output/write_vtu.h"
#include "core/scene/recorded_run.h"
#include "core/scene/run/simulation.h"
#include "core/topology/build.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using namespace large_part;

constexpr std::uint64_t cut_after = 5, step_count = 10;
constexpr std::size_t copied_of_tetrahedron = 200;  // bytes, of both halves: about as large as the body

SceneFile box_scene(std::size_t side, bool is_cut) {
  constexpr double spacing = 0.01, h = 0.0004;
  const std::size_t middle = side / 2;
  const std::string events = fmt::format(
      R"("events": [{{"at": {}, "dissociate": {{"plane": {{"point": [{}, 0, 0], "normal": [1, 0, 0]}}}}}}],)",
      cut_after * h, spacing * (static_cast<double>(middle) + 0.001));
  return parse_scene(fmt::format(R"({{"name": "box of {0}", {1}
    "body": {{"generate": {{"box": {{"cells": [{0}, {0}, {0}], "spacing": {2}}}}}}},
    "material": {{"density": 1000, "stiffness": 30, "damping": 0.02, "viscosity": 1}}, "gravity": [0, 0, -9.81],
    "fixed": [{{"plane": {{"point": [{3}, 0, 0], "normal": [-1, 0, 0]}}}}], "step": {4}, "duration": {5}}})",
                                 side, is_cut ? events : "", spacing, 0.1 * spacing, h, step_count * h),
                     "box", {});
}

double seconds_of(const std::function<void()>& work) {
  const std::int64_t start = steady_wall_ns();
  work();
  return static_cast<double>(steady_wall_ns() - start) * 1e-9;
}

/// To read or write a byte where columns as large as the body are copied.
double seconds_of_moved_byte(std::size_t side) {
  CopiedColumns columns(copied_of_tetrahedron * tetrahedra_of(side));
  constexpr int passes = 4;
  return seconds_of([&] { columns.run(passes); }) / (passes * static_cast<double>(columns.bytes()));
}

std::size_t bytes_of_mesh(const Mesh& mesh) { return bytes_of(mesh.points, mesh.kinds, mesh.first, mesh.nodes); }

std::size_t bytes_of_frame(const Frame& f) {
  return bytes_of_mesh(f.mesh) + bytes_of(f.velocity, f.mass, f.mesh_point, f.mesh_cell, f.component, f.held, f.stress);
}

std::size_t bytes_of_report(const MemoryReport& report) {
  std::size_t bytes = 0;
  for (const MemoryItem& item : report) bytes += item.bytes;
  return bytes;
}

std::size_t peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// A file of as many bytes, in blocks as large as those of frames.
double seconds_to_write(const fs::path& path, std::uintmax_t bytes) {
  const std::string block(1 << 20, 'A');
  const double seconds = seconds_of([&] {
    std::ofstream out(path, std::ios::binary);
    for (std::uintmax_t done = 0; done < bytes; done += block.size())
      out.write(block.data(), static_cast<std::streamsize>(std::min<std::uintmax_t>(block.size(), bytes - done)));
    if (!out.flush()) throw IoError(fmt::format("{} cannot be written", path.string()));
  });
  fs::remove(path);
  return seconds;
}

double seconds_to_read(const fs::path& path) {
  std::string text(fs::file_size(path), '\0');
  return seconds_of(
      [&] { std::ifstream(path, std::ios::binary).read(text.data(), static_cast<std::streamsize>(text.size())); });
}

/// The times of one process.
class PartTimes {
 public:
  PartTimes(const LargePlan& plan, const std::function<void(const LargeTime&)>& sink) : plan_(plan), sink_(sink) {}

  void take(const char* part, double seconds, double bytes = 0.0, double limit_seconds = 0.0) const {
    sink_({.side = plan_.side,
           .process = plan_.process,
           .part = part,
           .seconds = seconds,
           .bytes = bytes,
           .limit_seconds = limit_seconds});
  }
  /// A part that leaves as many bytes in memory.
  void take_memory(const char* part, double seconds, std::size_t bytes) const {
    take(part, seconds, static_cast<double>(bytes), 2.0 * static_cast<double>(bytes) * moved_byte_);
  }

 private:
  const LargePlan& plan_;
  const std::function<void(const LargeTime&)>& sink_;
  double moved_byte_ = seconds_of_moved_byte(plan_.side);
};

/// The parts that a simulation is made of, each by itself.
void measure_making(const LargePlan& plan, const PartTimes& times) {
  const SceneFile scene = box_scene(plan.side, true);
  Problem problem;
  const double generated = seconds_of([&] { problem = make_problem(scene); });
  times.take_memory(mesh, generated, bytes_of_mesh(problem.mesh));
  std::size_t bytes = 0;
  const double built = seconds_of([&] {
    const BuiltMap<TetMap> made = build_map<TetMap>(problem.mesh);
    bytes = made.map.bytes() + bytes_of(made.point, made.first_dart);
  });
  times.take_memory(map, built, bytes);
  const double made = seconds_of([&] { bytes = bytes_of_report(make_simulated_body(problem, false)->memory()); });
  times.take_memory(columns, made, bytes);
}

void advance(Simulation& simulation) {
  if (simulation.advance()) throw SolverError("the run of a large body ended early");
}

double seconds_of_steps_until(Simulation& simulation, std::uint64_t last) {
  std::vector<double> seconds;
  while (simulation.steps_done() < last) seconds.push_back(seconds_of([&] { advance(simulation); }));
  return median(seconds);
}

LargeCounts measure_run(Simulation& simulation, const LargePlan& plan, const PartTimes& times) {
  const SimulatedBody& body = simulation.body();
  LargeCounts counts{.side = plan.side,
                     .vertices = body.vertices().position.size(),
                     .springs = body.system().springs.size(),
                     .bytes = bytes_of_report(simulation.memory()),
                     .peak_bytes = peak_bytes()};
  const double mass = body.mass(), before = seconds_of_steps_until(simulation, cut_after - 1);
  times.take(step, before);
  times.take(cut, seconds_of([&] { advance(simulation); }) - before);
  times.take(step_after, seconds_of_steps_until(simulation, step_count));
  counts.operations = simulation.operations();
  counts.components = body.counts().components;
  counts.keeps_mass = body.mass() == mass;
  counts.violation = body.violation();
  return counts;
}

void measure_files(const Frame& frame, const PartTimes& times) {
  const ScratchFolder folder("large");
  const fs::path file = folder.path() / "frame.vtu", other = folder.path() / "other";
  const double seconds = seconds_of([&] { write_vtu(file, frame); });
  const auto bytes = fs::file_size(file);
  times.take(written, seconds, static_cast<double>(bytes), seconds_to_write(other, bytes));
  const double packed = seconds_of([&] { write_vtu(other, frame, Compressor::lz4); });
  const auto fewer = fs::file_size(other);
  fs::remove(other);
  times.take(compressed, packed, static_cast<double>(fewer), seconds_to_write(other, fewer));
  times.take(read, seconds_of([&] { read_mesh_file(file); }), static_cast<double>(bytes), seconds_to_read(file));
}

/// Ends a run after its first step, and has the time of its end.
class FirstStep : public RunWatcher {
 public:
  bool interrupts() override {
    at = steady_wall_ns();
    return true;
  }
  std::int64_t at = 0;
};

}  // namespace

std::span<const char* const> large_parts() {
  static constexpr const char* all[]{mesh,       map,         columns, simulation, first_step, step, cut,
                                     step_after, diagnostics, frame,   written,    compressed, read, info};
  return all;
}

std::size_t tetrahedra_of(std::size_t side) { return 6 * side * side * side; }

void measure_large(const LargePlan& plan, const std::function<void(const LargeTime&)>& time,
                   const std::function<void(const LargeCounts&)>& counts) {
  const PartTimes times(plan, time);
  measure_making(plan, times);
  LargeCounts found;
  {
    std::unique_ptr<Simulation> run;
    const SceneFile scene = box_scene(plan.side, true);
    const double made = seconds_of([&] { run = std::make_unique<Simulation>(scene); });
    times.take_memory(simulation, made, bytes_of_report(run->memory()));
    found = measure_run(*run, plan, times);
    times.take(diagnostics, seconds_of([&] { run->diagnostics(); }));
    Frame last;
    const double seconds = seconds_of([&] { last = run->frame(); });
    times.take_memory(frame, seconds, bytes_of_frame(last));
    run.reset();
    measure_files(last, times);
  }
  found.bytes_without_events = bytes_of_report(Simulation(box_scene(plan.side, false)).memory());
  counts(found);
}

void measure_large_start(const LargePlan& plan, const std::function<void(const LargeTime&)>& time) {
  const PartTimes times(plan, time);
  const ScratchFolder folder("large");
  const unsigned before = use_threads(0);
  {
    const std::int64_t start = steady_wall_ns();
    FirstStep watcher;
    RecordedRun run(box_scene(plan.side, true), {.folder = folder.path() / "run"});
    run.run(watcher);
    times.take(first_step, static_cast<double>(watcher.at - start) * 1e-9);
  }
  use_threads(before);
  const fs::path file = folder.path() / "run" / "frame_000000.vtu";
  const double seconds = seconds_of([&] { run_self({"mesh", "info", file.string()}, [](std::string_view) {}); });
  times.take(info, seconds, static_cast<double>(fs::file_size(file)), seconds_to_read(file));
}

DARTBOARD_JSON_FIELDS(LargeTime, side, process, part, seconds, bytes, limit_seconds)

DARTBOARD_JSON_FIELDS(LargeCounts, side, vertices, springs, operations, components, keeps_mass, violation, bytes,
                      bytes_without_events, peak_bytes)

}  // namespace dartboard
