// The work of `bench topology` as Google Benchmark cases, "vertex-orbit/kuhn-48000/CGAL". Not paired and in one
// process: for a look while working on the code; the figures that are published come from `dartboard bench topology`.

#include <benchmark/benchmark.h>

#include "benchmarks/studies/topology/topology_tasks.h"

namespace dartboard {
namespace {

void time_task(benchmark::State& state, const TopologyGroup::Entry& entry) {
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    entry.task.restore();
    state.ResumeTiming();
    benchmark::DoNotOptimize(entry.task.run());
  }
  entry.task.restore();
  // seconds per dart, vertex, tetrahedron or face
  state.counters["per_unit"] =
      benchmark::Counter(entry.units, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace
}  // namespace dartboard

int main(int argc, char** argv) {
  using namespace dartboard;
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  std::deque<TopologyStage> stages;
  for (const std::string& body : {topology_bodies[0], topology_bodies[1], scaling}) {
    for (const TopologyGroup& group : stages.emplace_back(make_topology_stage(body, 1)).groups)
      for (const TopologyGroup::Entry& entry : group.entries)
        benchmark::RegisterBenchmark((group.figure + "/" + body + "/" + entry.name).c_str(),
                                     [&entry](benchmark::State& state) { time_task(state, entry); })
            ->Unit(benchmark::kMicrosecond);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}
