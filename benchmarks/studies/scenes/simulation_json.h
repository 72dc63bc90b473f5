#pragma once
// What a simulation says of itself, as JSON.

#include <nlohmann/json.hpp>

#include "core/scene/body/diagnostics.h"
#include "core/scene/run/event_jumps.h"

namespace dartboard {

/// JSON has no infinity: a number that is not finite is left null.
nlohmann::ordered_json to_json(const Diagnostics& diagnostics);
nlohmann::ordered_json to_json(const EventJumps& jumps);

}  // namespace dartboard
