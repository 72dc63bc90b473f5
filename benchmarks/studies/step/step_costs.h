#pragma once
// Steps of RK4 over springs, timed in this process: the columns of a scene, and what they are compared with.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/studies/step/step_bodies.h"

namespace dartboard {

/// A body, and what one sample of its tasks does.
struct StepCounts {
  std::string body;
  std::size_t tetrahedra = 0, vertices = 0, springs = 0;
  int steps = 1;              // in a sample
  bool lanes = false;         // the processor can take four springs at a time
  unsigned threads = 1;       // that share the forces of the body; 1 where it is too small for several, or there is one
  bool arrays = false;        // cell arrays are timed
  double bytes = 0.0;         // read and written in one evaluation, that of the vertices included
  double copied_bytes = 0.0;  // read and written in a sample of a task that copies
  double roots = 0.0;         // springs in a sample of the task "roots"
  std::size_t differing = 0;  // contenders that end in other bits, or are too far from the graph
};
void to_json(nlohmann::json& json, const StepCounts& counts);
void from_json(const nlohmann::json& json, StepCounts& counts);

/// The ways to step a body; its tasks are named "BODY: graph", "BODY: arrays" ... "BODY: threads".
namespace step_task {
inline constexpr const char *graph = ": graph", *arrays = ": arrays", *one = ": one", *lanes = ": lanes",
                            *padded = ": padded", *threads = ": threads";
/// The limits: columns as large as those of the body, copied by one thread, or by as many as share the body; a square
/// root and a division for each spring.
inline constexpr const char *copy = ": copy", *copy_by_threads = ": copy by threads", *roots = ": roots";
}  // namespace step_task

struct StepCostPlan {
  int process = 0;
  int rounds = 20;                              // a fifth of them for the largest boxes
  std::size_t largest = 1'000'000;              // tetrahedra
  std::uint64_t seed = 1;                       // of the order of the tasks, of shuffled meshes and of velocities
  std::vector<std::filesystem::path> meshes{};  // of further bodies, called as their files
  std::size_t least_of_mesh = 100'000;          // tetrahedra, to which these are cut
  std::string only{};                           // the name of the one body to step; empty: all
};

/// Compare the ways to step each body: those over columns must end in the same bits, and keep to the rounding bound of
/// the graph (validation/contenders/motion_agreement.h).
/// throws  IoError and InputError for a mesh that cannot be read, or has other cells than tetrahedra
void compare_steps(const StepCostPlan& plan, const std::function<void(const StepCounts&)>& sink);

/// Take turns in this process, body by body, and report every sample.
void measure_step_costs(const StepCostPlan& plan, const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
