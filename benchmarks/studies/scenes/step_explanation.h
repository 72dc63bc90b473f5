#pragma once
// The causes that limit the time step of a scene, and the effect of changes of its body.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"
#include "core/time/method/step_limit.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// A spring or a vertex and its share of the energy of the fastest oscillation.
struct StepShare {
  std::uint32_t number = 0;
  double share = 0.0;
};

/// An element, its share of that energy, and its shape.
struct CellStepShare {
  std::uint32_t number = 0;
  std::vector<std::uint32_t> corners;  // as `StepExplanation::name` has them
  double width = 0.0;                  // [m] of a simplex its least altitude, else the least distance of two corners
  double share = 0.0;
};

/// A change of the body, and the step [s] that it makes stable.
struct StepRemedy {
  std::string what;
  double step = 0.0;
};

struct StepExplanation {
  StableStep limits;
  StepLimit limit;     // at the start: the limit that the simulation uses
  double quick = 0.0;  // [s] stable in any state, by Gershgorin's bound
  // the largest first, at most five of each; empty where nothing oscillates
  std::vector<StepShare> springs, vertices;
  std::vector<CellStepShare> cells;  // of elements
  std::vector<StepRemedy> remedies;
  SpringColumns body;                // at the start; its vertices and springs have numbers of their own
  std::vector<std::uint32_t> names;  // for each vertex the number of its point in the file; empty: its own

  std::uint32_t name(std::uint32_t vertex) const { return names.empty() ? vertex : names[vertex]; }
};

/// throws  InputError for a scene with contact; as the constructor of Simulation; refused steps are explained, too
StepExplanation explain_step(SceneFile scene);

/// For the terminal.
std::string to_text(const StepExplanation& explanation, const SceneFile& scene);

/// JSON has no infinity: a step without a limit is null.
nlohmann::ordered_json to_json(const StepExplanation& explanation, const SceneFile& scene);

}  // namespace dartboard
