#pragma once
// A scene cut down to what a fault needs.

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>

namespace dartboard {

/// Removes keys and entries of lists, halves counts, and rounds numbers, for as long as the fault stays: no single
/// change of these makes the scene smaller, unless the trials ran out.
///
/// pre  `is_at_fault` of the scene; it has to be false, not throw, for a scene that is wrong
nlohmann::ordered_json smallest_scene(nlohmann::ordered_json scene,
                                      const std::function<bool(const nlohmann::ordered_json&)>& is_at_fault,
                                      std::size_t most_trials = 500);

}  // namespace dartboard
