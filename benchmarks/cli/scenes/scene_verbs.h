#pragma once
// The verbs of scenes and meshes, which need core and no harness; each has a file of its own.

#include <CLI/App.hpp>
#include <functional>
#include <optional>

#include "benchmarks/cli/cli.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/settled_accuracy.h"

namespace dartboard {

/// Gives a scene that asks for an accuracy its step, silently if that is asked for, and leaves others as they are.
using StepChoice = std::function<std::optional<SettledAccuracy>(SceneFile&, bool quiet)>;

// Each adds a verb whose callback does the work and stores its exit code in `outcome`, which must outlive the parse.
void add_simulate(CLI::App& app, Outcome& outcome, StepChoice choose_step);
void add_scene(CLI::App& app, Outcome& outcome);
void add_explain(CLI::App& app, Outcome& outcome, StepChoice choose_step);
void add_mesh(CLI::App& app, Outcome& outcome);

}  // namespace dartboard
