#pragma once
// Diagnostics of a simulation as JSON.

#include <nlohmann/json.hpp>
#include <span>

#include "core/scene/body/diagnostics.h"
#include "core/scene/survey/selection_counts.h"
#include "core/scene/timeline/event_jumps.h"

namespace dartboard {

/// For a body of cells of a dimension, 0 for a chain: the largest stress has the key "largest_principal_stress" or
/// "largest_tension". JSON has no infinity: a number that is not finite is left null.
nlohmann::ordered_json to_json(const Diagnostics& diagnostics, int dimension);
nlohmann::ordered_json to_json(const EventJumps& jumps);
nlohmann::ordered_json to_json(std::span<const SelectionCount> selections);

}  // namespace dartboard
