#include "benchmarks/studies/scenes/output_tasks.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/scratch_folder.h"
#include "core/base/thread_team.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/recorded_run.h"
#include "core/scene/run/simulation.h"
#include "core/time/integrators.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

/// A run into a folder of its own.
struct Written {
  ScratchFolder folder{"output"};
  RecordedRun run;

  explicit Written(const SceneFile& scene) : run(scene, {.folder = folder.path() / "run"}) { run.open(); }
};

/// A simulation brought to a step.
std::unique_ptr<Simulation> simulation_at(const SceneFile& scene, std::uint64_t step) {
  auto simulation = std::make_unique<Simulation>(scene);
  while (simulation->steps_done() < step)
    if (simulation->advance()) throw SolverError(fmt::format("the scene '{}' ended early", scene.name));
  return simulation;
}

/// The steps after which operations change a scene, and its first and last.
std::vector<std::uint64_t> steps_of_changes(const SceneFile& scene) {
  Simulation simulation(scene);
  std::vector<std::uint64_t> steps{0};
  while (simulation.steps_done() < simulation.step_count()) {
    const std::size_t operations = simulation.operations();
    if (simulation.advance()) throw SolverError(fmt::format("the scene '{}' ended early", scene.name));
    if (simulation.operations() != operations) steps.push_back(simulation.steps_done());
  }
  steps.push_back(simulation.step_count());
  return steps;
}

/// The steps between two operations, on positions and velocities of their own.
struct Stretch {
  std::unique_ptr<Simulation> start;
  std::vector<Eigen::Vector3d> x, v;
  std::uint64_t steps;

  Stretch(const SceneFile& scene, std::uint64_t from, std::uint64_t to)
      : start(simulation_at(scene, from)),
        x(start->body().vertices().position),
        v(start->body().vertices().velocity),
        steps(to - from) {}
  void run(Integrator& integrator) {
    const SpringSystem system = start->body().system();
    integrator.restart();
    for (std::uint64_t k = 0; k < steps; ++k)
      if (!integrator.step(system, {x, v}, start->step()).ok())
        throw SolverError("a step failed that the scene has taken");
  }
  std::uint64_t hash() const {
    Hash hash;
    hash.add(x);
    hash.add(v);
    return hash.value();
  }
};

std::uint64_t bytes_in(const fs::path& folder) {
  std::uint64_t bytes = 0;
  for (const auto& file : fs::directory_iterator(folder)) bytes += file.file_size();
  return bytes;
}

}  // namespace

std::vector<TimedTask> output_tasks() {
  const SceneFile scene = read_scene(source_folder() / "benchmarks" / "scenes" / fmt::format("{}.json", output_scene));
  const std::vector<std::uint64_t> steps = steps_of_changes(scene);
  auto written = std::make_shared<std::unique_ptr<Written>>();
  auto stretches = std::make_shared<std::vector<Stretch>>();
  auto integrator = std::make_shared<std::unique_ptr<Integrator>>();
  Written whole(scene);
  whole.run.run();
  const auto from = std::make_shared<std::string>(bytes_in(whole.run.folder()), 'A');
  const auto to = std::make_shared<std::string>(from->size(), 'B');
  const auto run_by = [&](const std::string& name, unsigned threads) {
    return TimedTask{.name = name,
                     .restore =
                         [written, scene] {
                           written->reset();
                           *written = std::make_unique<Written>(scene);
                         },
                     .run =
                         [written, threads] {
                           const unsigned before = use_threads(threads);
                           (*written)->run.run();
                           use_threads(before);
                         },
                     .hash = [written] { return (*written)->run.simulation().body().state_hash(); }};
  };
  return {run_by(output_run, 1),
          run_by(output_run_by_two, 2),
          {.name = output_integrator,
           .restore =
               [stretches, integrator, scene, steps] {
                 stretches->clear();
                 for (std::size_t k = 0; k + 1 < steps.size(); ++k)
                   stretches->emplace_back(scene, steps[k], steps[k + 1]);
                 *integrator = make_integrator(scene.integrator, scene.solver);
               },
           .run =
               [stretches, integrator] {
                 for (Stretch& stretch : *stretches) stretch.run(**integrator);
               },
           .hash = [stretches] { return stretches->back().hash(); }},
          {.name = output_bytes,
           .restore = [] {},
           .run = [from, to] { to->assign(*from); },
           .hash =
               [to] {
                 Hash hash;
                 hash.add_bytes(to->data(), to->size());
                 return hash.value();
               }}};
}

}  // namespace dartboard
