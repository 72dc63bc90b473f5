#pragma once
// The events of a frozen scene in the keys of a scene file, by the numbers of facets and cells.

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "validation/frozen/frozen_scene.h"

namespace dartboard {

/// The events of the scene's file, where those that are left to the run (is_left_to_the_run) are replaced by events
/// that name what the accurate run has chosen, at its times.
///
/// returns  no value where no key can name it, as what refinement has made and facets of bodies of several dimensions,
///          and where an event has no part in the frozen scene, though it is not at the end
std::optional<nlohmann::ordered_json> events_by_number(const FrozenScene& scene, const nlohmann::ordered_json& events);

}  // namespace dartboard
