#pragma once
// Tasks timed by `bench ablation`: a scene with all that it writes, and the least that this could take.

#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"

namespace dartboard {

/// The scene whose output is timed.
inline constexpr const char* output_scene = "liver_cut";
inline const std::string output_run = std::string(output_scene) + " with its output";
inline const std::string output_run_by_two = output_run + ", written by another thread";
inline const std::string output_integrator = std::string(output_scene) + ", its integrator alone";
inline const std::string output_bytes = std::string(output_scene) + ", its bytes copied";

/// `output_run`: a run to its end, with events, probes, diagnostics and frames, into a scratch folder, from its first
/// step on, by one thread; `output_run_by_two`: with the files of frames written by another. `output_integrator`: the
/// same steps by an integrator and nothing else, from one operation to the next; it leaves the same bits.
/// `output_bytes`: as many bytes as the run writes, copied from memory to memory.
std::vector<TimedTask> output_tasks();

}  // namespace dartboard
