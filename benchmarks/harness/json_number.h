#pragma once
// Numbers in JSON: it has neither NaN nor infinity.

#include <cmath>
#include <nlohmann/json.hpp>

namespace dartboard {

/// The number, or null where it is not finite.
inline nlohmann::json number(double x) { return std::isfinite(x) ? nlohmann::json(x) : nlohmann::json(nullptr); }

}  // namespace dartboard
